//! What is seen at one time, as it was at the frame's instant.

use glam::{DVec2, DVec3, Vec3};

use crate::film::canvas::Canvas;
use crate::film::sampler::Sampler;
use crate::geometry::ray::Ray;
use crate::light::path::{Integrator, LIFT, PathSample};
use crate::material::surface::{corners, winding};
use crate::motion::camera::View;
use crate::motion::poses::Poses;
use crate::stage::{Hit, Stage};

/// Places are projected again and err by less than this many pixels: what is seen at the picture's very border is in it.
const ROUNDING: f64 = 1e-9;

/// The instant, made ready to be asked about what is seen at other times.
pub(crate) struct Recall {
    view: View,
    canvas: Canvas,
    /// Nothing changes in the world and all surfaces look the same from everywhere: shading at the instant is then shading at
    /// any time.
    unchanging: bool,
}

/// One sample as it was at the instant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Recalled {
    /// What the visible point would have sent beyond what it sends now; none where that was not asked.
    pub shift: Option<Vec3>,
    /// Where it was, in pixels from the picture's top left; none behind the camera.
    pub place: Option<DVec2>,
    /// Whether the frame shows it.
    pub known: bool,
}

/// Sums over samples.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Recollection {
    live: DVec3,
    shift: DVec3,
    shifts: u32,
    unknowable: f64,
    placed: f64,
    offset: DVec2,
    spread: DVec3,
}

/// The means of a pixel.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Recollected {
    pub frozen: DVec3,
    pub unknowable: f64,
    pub placed: f64,
    pub offset: DVec2,
    /// xx, xy, yy.
    pub spread: DVec3,
}

impl Recall {
    pub fn of(stage: &Stage, canvas: Canvas) -> Self {
        Self {
            view: stage.scene.camera.view(0.0, canvas.width, canvas.height),
            canvas,
            unchanging: stage.stands_still() && stage.is_diffuse(),
        }
    }

    /// The sample that `ray` brought home at the time of `poses`; `then` are the poses of the instant. Shading once more is
    /// the dear part: `shade` says whether to.
    pub fn sample(
        &self,
        integrator: &Integrator,
        (poses, then): (&mut Poses, &mut Poses),
        ray: &Ray,
        sample: &PathSample,
        sampler: &Sampler,
        shade: bool,
    ) -> Recalled {
        let Some(hit) = &sample.hit else {
            return self.background(integrator.stage, then, ray.direction, shade);
        };
        let point = self.point(integrator.stage, then, hit);
        let sight = self.sight(integrator.stage, (poses, then), ray, hit, point);
        let place = self.view.project(point).map(DVec2::from);
        let shift = shade.then(|| {
            if self.unchanging || !sample.scattered {
                return Vec3::ZERO;
            }
            let frozen = integrator.radiance_along(then, sight.ray, Some(sight.hit), sampler);
            frozen - sample.radiance
        });
        Recalled {
            shift,
            place,
            known: self.is_shown(integrator.stage, then, &sight, place),
        }
    }

    /// Whether the frame shows what `ray` meets at the time of `poses`; `then` are the poses of the instant.
    pub fn knows(
        &self,
        stage: &Stage,
        (poses, then): (&mut Poses, &mut Poses),
        ray: &Ray,
        hit: Option<&Hit>,
    ) -> bool {
        let Some(hit) = hit else {
            return self.background(stage, then, ray.direction, false).known;
        };
        let point = self.point(stage, then, hit);
        let sight = self.sight(stage, (poses, then), ray, hit, point);
        let place = self.view.project(point).map(DVec2::from);
        self.is_shown(stage, then, &sight, place)
    }

    /// Whether the frame shows the point that was looked at, which lay at `place` in it.
    fn is_shown(
        &self,
        stage: &Stage,
        then: &mut Poses,
        sight: &Sight,
        place: Option<DVec2>,
    ) -> bool {
        sight.same_side
            && place.is_some_and(|place| self.shows(place))
            && !self.hidden(stage, then, sight)
    }

    /// Infinity sends the same at all times.
    fn background(
        &self,
        stage: &Stage,
        then: &mut Poses,
        direction: DVec3,
        shade: bool,
    ) -> Recalled {
        let place = self.view.project_direction(direction).map(DVec2::from);
        let ray = Ray {
            origin: self.view.to_world.translation,
            direction,
        };
        Recalled {
            shift: shade.then_some(Vec3::ZERO),
            place,
            known: place.is_some_and(|place| self.shows(place))
                && !stage.blocked(then, &ray, f64::INFINITY),
        }
    }

    /// Where a hit's point was in the world.
    fn point(&self, stage: &Stage, then: &mut Poses, hit: &Hit) -> DVec3 {
        let mesh = &stage.scene.meshes[stage.scene.objects[hit.object].mesh];
        let [a, b, c] = corners(mesh, hit.triangle, 0.0);
        let point = a + hit.weights[0] * (b - a) + hit.weights[1] * (c - a);
        then.pose(hit.object).to_world.transform_point3(point)
    }

    /// The ray on which the instant's camera looked at the point. Where it looked at the surface's other side, the side
    /// that is seen now is looked at in the same way as now, in the object's own space.
    fn sight(
        &self,
        stage: &Stage,
        (poses, then): (&mut Poses, &mut Poses),
        ray: &Ray,
        hit: &Hit,
        point: DVec3,
    ) -> Sight {
        let side = |poses: &mut Poses, time: f64, direction: DVec3| {
            winding(stage.scene, poses.pose(hit.object), hit, time).dot(direction) > 0.0
        };
        let eye = self.view.to_world.translation;
        let way = point - eye;
        let seen = side(poses, hit.time, ray.direction);
        let same_side = side(then, 0.0, way) == seen;
        let direction = if same_side {
            way.normalize()
        } else {
            let own = poses
                .pose(hit.object)
                .to_object
                .transform_vector3(ray.direction);
            then.pose(hit.object)
                .to_world
                .transform_vector3(own)
                .normalize()
        };
        let distance = if same_side { way.length() } else { hit.t };
        Sight {
            ray: Ray {
                origin: point - distance * direction,
                direction,
            },
            hit: Hit {
                t: distance,
                time: 0.0,
                ..*hit
            },
            point,
            same_side,
        }
    }

    fn shows(&self, place: DVec2) -> bool {
        let size = DVec2::new(f64::from(self.canvas.width), f64::from(self.canvas.height));
        place.cmpge(DVec2::splat(-ROUNDING)).all() && place.cmplt(size + ROUNDING).all()
    }

    /// Whether anything lies between the eye and the point: a ray that leaves the surface as shadow rays do.
    fn hidden(&self, stage: &Stage, then: &mut Poses, sight: &Sight) -> bool {
        let facet = stage.facet(then, &sight.ray, &sight.hit);
        let magnitude = sight.point.abs().max_element().max(sight.hit.t);
        let start = sight.point + LIFT * magnitude * facet;
        let way = self.view.to_world.translation - start;
        let back = Ray {
            origin: start,
            direction: way.normalize(),
        };
        stage.blocked(then, &back, way.length())
    }
}

/// A look at a point of a surface at the instant.
struct Sight {
    ray: Ray,
    hit: Hit,
    point: DVec3,
    /// Whether the camera saw the same side then.
    same_side: bool,
}

impl Recollection {
    /// Adds a sample of this radiance of the pixel with this centre.
    pub fn add(&mut self, recalled: &Recalled, radiance: Vec3, centre: [f64; 2]) {
        self.live += radiance.as_dvec3();
        if let Some(shift) = recalled.shift {
            self.shift += shift.as_dvec3();
            self.shifts += 1;
        }
        self.unknowable += f64::from(!recalled.known);
        if let Some(place) = recalled.place {
            let offset = place - DVec2::from(centre);
            self.placed += 1.0;
            self.offset += offset;
            self.spread += DVec3::new(
                offset.x * offset.x,
                offset.x * offset.y,
                offset.y * offset.y,
            );
        }
    }

    /// The means over so many samples. Frozen shading is the live one, of all samples, and its mean change over those that
    /// were shaded again: most change little or not at all, so that a part of them tells it nearly as well as all would.
    /// Where few change much the estimate may fall below 0, and has to, or its mean would be too high.
    pub fn over(&self, samples: u32) -> Recollected {
        let samples = f64::from(samples);
        Recollected {
            frozen: self.live / samples + self.shift / f64::from(self.shifts),
            unknowable: self.unknowable / samples,
            placed: self.placed / samples,
            offset: self.offset / samples,
            spread: self.spread / samples,
        }
    }
}
