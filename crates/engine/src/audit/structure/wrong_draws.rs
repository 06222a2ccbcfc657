//! Draw calls that keep the wrong shape, matrix or camera of the last frame, and their velocity.

use frame::{Size, Vectors};
use glam::DAffine3;
use scene::Scene;
use tracer::{PointLayers, TraceError};

use crate::audit::cause::Cause;
use crate::audit::fitted_motion::Candidate;
use crate::audit::structure::pinhole::Pinhole;
use crate::audit::structure::seen_points::{Drawn, SeenPoint, trace_points};
use crate::export::FRAMES_PER_SECOND;

/// Clock rates of engines, in frames per second.
const CLOCK_RATES: [f64; 3] = [60.0, 30.0, 120.0];
/// Upper limit on the difference of two matrices of one place, per number, relative to the largest
/// number of the two.
const SAME_MATRIX: f64 = 1e-9;
/// Upper limit on the objects whose matrices are tried, and on the key shapes.
const MOST_OTHERS: usize = 256;

/// A draw call in this frame and in the last one.
#[derive(Clone, Copy, Debug)]
pub struct Draw {
    pub this: Drawn,
    pub last: Drawn,
}

/// Points of a picture, with the draw calls of an engine that keeps something wrong.
pub struct WrongDraws<'a> {
    pub(super) scene: &'a Scene,
    size: Size,
    pub(super) points: Vec<Option<SeenPoint>>,
    right: Vectors,
}

impl<'a> WrongDraws<'a> {
    /// Traces the points of the instant, whose layers are given.
    pub fn trace(scene: &'a Scene, layers: &PointLayers) -> Result<Self, TraceError> {
        let size = layers.velocity.size();
        Ok(Self {
            scene,
            size,
            points: trace_points(scene, size, &layers.object_id)?,
            right: layers.velocity.clone(),
        })
    }

    /// Lists mistakes that an engine may make with every object, with their velocities; the most
    /// specific first.
    pub fn list_of_all(&self) -> Vec<Candidate> {
        let motions = [
            Cause::DeformationMissing,
            Cause::RestPose,
            Cause::ObjectMotionMissing,
            Cause::OwnMotionMissing,
            Cause::ParentMotionMissing,
            Cause::ParentMissing,
            Cause::ZoomMissing,
            Cause::CameraMotionMissing,
            Cause::ViewMissing,
            Cause::CameraTurnAlone,
            Cause::FrameLate,
            Cause::LateMatrix,
            Cause::FrameEarly,
            Cause::TwoFrames,
            Cause::OlderMatrix,
            Cause::MatrixNeverSet,
        ];
        let clocks = CLOCK_RATES.map(Cause::MotionOver);
        let all: Vec<usize> = (0..self.points.len()).collect();
        let is_distinct =
            |cause: &Cause| *cause != Cause::CameraTurnAlone || self.turns_and_moves();
        let causes = motions.into_iter().filter(is_distinct).chain(clocks);
        let candidates = causes.flat_map(|cause| {
            let velocity = self.velocity(&all, &|object| self.draw_wrongly(&cause, object));
            let kept_shape = self.keeps_shape(&cause).then(|| {
                self.velocity(&all, &|object| {
                    let mut draw = self.draw_wrongly(&cause, object);
                    draw.last.shape_at = -1.0;
                    draw
                })
            });
            let velocities = [velocity].into_iter().chain(kept_shape);
            velocities.map(move |velocity| (cause.clone(), velocity))
        });
        candidates.collect()
    }

    /// Returns whether the camera turns and moves. Where it does only one of both, the turn alone
    /// looks like right vectors of still things, or like none.
    fn turns_and_moves(&self) -> bool {
        let [before, now] = [-1.0, 0.0].map(|time| self.scene.camera.motion.at(time));
        before.matrix3 != now.matrix3 && before.translation != now.translation
    }

    /// Returns whether an engine may make a mistake with matrices and still move vertices rightly.
    fn keeps_shape(&self, cause: &Cause) -> bool {
        let is_of_matrices = matches!(cause, Cause::ObjectMotionMissing | Cause::OwnMotionMissing);
        is_of_matrices && self.scene.meshes.iter().any(scene::Mesh::deforms)
    }

    /// Lists last matrices of other objects for one object, with its velocity at some pixels. Each
    /// matrix is listed once; those of further instances of the same mesh come first.
    pub fn list_matrices_of_others(
        &self,
        object: usize,
        pixels: &[usize],
    ) -> impl Iterator<Item = Candidate> {
        let objects = &self.scene.objects;
        let own = self.matrix(object, -1.0);
        let is_instance = |other: &usize| objects[*other].mesh == objects[object].mesh;
        let (instances, others): (Vec<usize>, Vec<usize>) = (0..objects.len())
            .filter(|other| *other != object)
            .partition(is_instance);
        let mut listed: Vec<(DAffine3, Cause)> = Vec::new();
        for other in instances.iter().chain(&others).take(MOST_OTHERS) {
            let matrix = self.matrix(*other, -1.0);
            let name = objects[*other].name.clone();
            let known = (listed.iter_mut()).find(|(known, _)| is_same(known, &matrix));
            match known {
                Some((_, Cause::MatrixOf(names) | Cause::MatrixOfInstance(names))) => {
                    names.push(name);
                }
                _ if is_same(&matrix, &own) => {}
                _ if is_instance(other) => {
                    listed.push((matrix, Cause::MatrixOfInstance(vec![name])));
                }
                _ => listed.push((matrix, Cause::MatrixOf(vec![name]))),
            }
        }
        let draw = self.draw_rightly(Some(object));
        listed.into_iter().map(move |(to_world, cause)| {
            let last = Drawn {
                to_world,
                ..draw.last
            };
            (cause, self.velocity(pixels, &|_| Draw { last, ..draw }))
        })
    }

    /// Lists key shapes of a deforming object, except its first one, that it may come from instead
    /// of its last shape, with its velocity at some pixels.
    pub fn list_poses(&self, object: usize, pixels: &[usize]) -> impl Iterator<Item = Candidate> {
        let draw = self.draw_rightly(Some(object));
        let mesh = &self.scene.meshes[self.scene.objects[object].mesh];
        let times = mesh.shape_times().skip(1).take(MOST_OTHERS);
        let others = times.filter(|time| ![-1.0, 0.0].contains(time));
        others.map(move |shape_at| {
            let last = Drawn {
                shape_at,
                ..draw.last
            };
            let velocity = self.velocity(pixels, &|_| Draw { last, ..draw });
            (Cause::OtherPose(shape_at), velocity)
        })
    }

    /// Makes the velocity of some pixels, as their objects are drawn; the others are right.
    pub(super) fn velocity(
        &self,
        pixels: &[usize],
        draw: &dyn Fn(Option<usize>) -> Draw,
    ) -> Vectors {
        let mut draws: Vec<Option<Draw>> = vec![None; self.scene.objects.len() + 1];
        let mut velocity = self.right.clone();
        for at in pixels {
            let Some(point) = &self.points[*at] else {
                continue;
            };
            let object = match point {
                SeenPoint::Surface(hit) => Some(hit.object),
                SeenPoint::Infinity(_) => None,
            };
            let id = object.map_or(0, |object| object + 1);
            let draw = draws[id].get_or_insert_with(|| draw(object));
            let place = |drawn: &Drawn| point.place(self.scene, drawn);
            let [this, last] = [place(&draw.this), place(&draw.last)];
            velocity.pixels[*at] = [0, 1].map(|axis| (this[axis] - last[axis]) as f32);
        }
        velocity
    }

    /// Returns the right draw call of an object, or of the background.
    pub(super) fn draw_rightly(&self, object: Option<usize>) -> Draw {
        Draw {
            this: self.drawn_at(object, 0.0),
            last: self.drawn_at(object, -1.0),
        }
    }

    /// Returns the draw call of an object under a mistake.
    fn draw_wrongly(&self, cause: &Cause, object: Option<usize>) -> Draw {
        let right = self.draw_rightly(object);
        let this = match cause {
            Cause::FrameLate => right.last,
            Cause::LateMatrix => Drawn {
                camera: right.this.camera,
                ..right.last
            },
            Cause::FrameEarly => self.drawn_at(object, 1.0),
            _ => right.this,
        };
        let last = match object {
            Some(object) => self.object_wrongly(cause, object, right),
            None => right.last,
        };
        let camera = |placed_at: f64, zooms_at: f64| Drawn {
            camera: Pinhole::new(&self.scene.camera, placed_at, zooms_at, self.size),
            ..last
        };
        let last = match cause {
            Cause::CameraMotionMissing => camera(0.0, 0.0),
            Cause::ViewMissing => camera(0.0, -1.0),
            Cause::CameraTurnAlone => Drawn {
                camera: Pinhole::turned(&self.scene.camera, -1.0, self.size),
                ..right.this
            },
            Cause::ZoomMissing => camera(-1.0, 0.0),
            Cause::FrameLate | Cause::TwoFrames => self.drawn_at(object, -2.0),
            Cause::FrameEarly => right.this,
            Cause::MotionOver(rate) => self.drawn_at(object, -FRAMES_PER_SECOND / rate),
            _ => last,
        };
        Draw { this, last }
    }

    /// Returns the last draw call of an object with a wrong shape or matrix.
    fn object_wrongly(&self, cause: &Cause, object: usize, right: Draw) -> Drawn {
        let Draw { this, last } = right;
        let scene = self.scene;
        let within = |own: f64, parents: f64| scene.object_to_world_within(object, own, parents);
        let to_world = match cause {
            Cause::ObjectMotionMissing => this.to_world,
            Cause::OwnMotionMissing => within(0.0, -1.0),
            Cause::ParentMotionMissing => within(-1.0, 0.0),
            Cause::ParentMissing => scene.objects[object].motion.at(-1.0),
            Cause::MatrixNeverSet => DAffine3::IDENTITY,
            Cause::OlderMatrix | Cause::LateMatrix => self.matrix(object, -2.0),
            Cause::RestPose => return self.rest(object, last),
            _ => last.to_world,
        };
        let shape_at = match cause {
            Cause::DeformationMissing | Cause::ObjectMotionMissing | Cause::OwnMotionMissing => 0.0,
            Cause::OlderMatrix | Cause::LateMatrix => -2.0,
            _ => last.shape_at,
        };
        Drawn {
            shape_at,
            to_world,
            ..last
        }
    }

    /// Returns the last draw call of an object in its rest pose: its first key shape or, if it is
    /// rigid, its first key, with its parents right.
    fn rest(&self, object: usize, last: Drawn) -> Drawn {
        let scene = self.scene;
        let first_shape = scene.meshes[scene.objects[object].mesh]
            .shape_times()
            .next();
        let first_key = (scene.objects[object].motion.keys.first()).map_or(-1.0, |key| key.time);
        match first_shape {
            Some(shape_at) => Drawn { shape_at, ..last },
            None => Drawn {
                to_world: scene.object_to_world_within(object, first_key, -1.0),
                ..last
            },
        }
    }

    fn drawn_at(&self, object: Option<usize>, time: f64) -> Drawn {
        Drawn {
            shape_at: time,
            to_world: object.map_or(DAffine3::IDENTITY, |object| self.matrix(object, time)),
            camera: Pinhole::at(&self.scene.camera, time, self.size),
        }
    }

    fn matrix(&self, object: usize, time: f64) -> DAffine3 {
        self.scene.object_to_world(object, time)
    }
}

fn is_same(a: &DAffine3, b: &DAffine3) -> bool {
    let [a, b] = [a, b].map(DAffine3::to_cols_array);
    let largest = a
        .iter()
        .chain(&b)
        .fold(0.0, |most: f64, part| most.max(part.abs()));
    a.iter()
        .zip(&b)
        .all(|(a, b)| (a - b).abs() <= SAME_MATRIX * largest)
}
