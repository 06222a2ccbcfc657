//! The instant's view of points that are seen at other times.

use bvh::Ray;
use glam::{DVec2, DVec3, Vec3};

use crate::film::canvas::Canvas;
use crate::film::eye::EyeRay;
use crate::hit::{Hit, LIFT};
use crate::motion::lens::LensPoint;
use crate::motion::poses::Poses;
use crate::motion::view::{Target, View};
use crate::path::integrator::Integrator;
use crate::path::stops::Stop;
use crate::sampler::Sampler;
use crate::stage::Stage;

/// Rounding of a projected place, in pixels; points at the picture's very border still count as
/// inside.
const ROUNDING: f64 = 1e-9;

/// The camera of the instant, and the picture that it takes.
pub(crate) struct InstantView {
    view: View,
    canvas: Canvas,
    /// True if the camera stands still. A still point that it sees at one time is then hidden at
    /// another only by a mover.
    camera_stands_still: bool,
    /// True if nothing changes in the world and all surfaces are diffuse: shading is then the same
    /// at all times.
    unchanging: bool,
}

/// A visible point, as the instant's camera saw it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct InstantPoint {
    /// Place in pixels from the picture's top left; none behind the camera.
    pub place: Option<DVec2>,
    /// True if the frame shows the point.
    pub is_shown: bool,
    /// Ray of the instant's camera to the point, and its hit; none at infinity.
    ray: Option<(Ray, Hit)>,
}

/// Sums over the samples of a pixel.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct InstantSums {
    /// Samples that were looked up at the instant.
    recalled: u32,
    shift: DVec3,
    unknowable: f64,
    placed: f64,
    offset: DVec2,
    spread: DVec2,
}

/// Means over the samples of a pixel.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct InstantMeans {
    /// Radiance at the instant minus radiance over the shutter.
    pub shift: DVec3,
    pub unknowable: f64,
    pub placed: f64,
    pub offset: DVec2,
    /// xx, yy.
    pub spread: DVec2,
}

impl InstantView {
    pub fn new(stage: &Stage, canvas: Canvas) -> Self {
        Self {
            view: View::new(&stage.scene.camera, 0.0, canvas.width, canvas.height),
            canvas,
            camera_stands_still: stage.scene.camera.stands_still(),
            unchanging: stage.stands_still() && stage.is_diffuse(),
        }
    }

    /// The view from the lens' centre of points that other points of the lens see.
    pub fn of_pinhole(stage: &Stage, canvas: Canvas) -> Self {
        Self {
            // Still objects may hide from the centre what the rim sees.
            camera_stands_still: false,
            ..Self::new(stage, canvas)
        }
    }

    /// Looks back at the point that `ray` meets at the time of `poses`; `then` are the poses of the
    /// instant.
    ///
    /// The camera of the instant looks from the same point of its lens: places, hidden points and
    /// shading then show motion alone, and nothing differs if nothing moves.
    pub fn look_back(
        &self,
        stage: &Stage,
        (poses, then): (&mut Poses, &mut Poses),
        EyeRay { ray, from }: &EyeRay,
        hit: Option<&Hit>,
    ) -> InstantPoint {
        let Some(hit) = hit else {
            return self.look_at_infinity(stage, then, ray.direction, *from);
        };
        let mesh = &stage.scene.meshes[stage.scene.objects[hit.object].mesh];
        let point = find_point(stage, then, hit);
        let side = |poses: &mut Poses, time: f64, direction: DVec3| {
            let to_world = &poses.pose(hit.object).to_world;
            let normal = mesh.at(time).area_normal(hit.triangle, to_world);
            normal.dot(direction) > 0.0
        };
        let eye = self.view.eye(*from);
        let way = point - eye;
        let is_still = self.sees_still(stage, Some(hit));
        let same_side = is_still || side(then, 0.0, way) == side(poses, hit.time, ray.direction);
        // If the camera saw the other side then, this ray meets the side that is seen now, in the
        // same direction as now in the object's own space.
        let direction = if same_side {
            way.normalize()
        } else {
            let to_object = poses.pose(hit.object).to_object;
            let to_world = then.pose(hit.object).to_world;
            let object_direction = to_object.transform_vector3(ray.direction);
            to_world.transform_vector3(object_direction).normalize()
        };
        let distance = if same_side { way.length() } else { hit.t };
        let ray = Ray {
            origin: point - distance * direction,
            direction,
        };
        let hit = Hit {
            t: distance,
            time: 0.0,
            ..*hit
        };
        let place = self.view.project_through(Target::Point(point), *from);
        InstantPoint {
            place,
            is_shown: same_side
                && place.is_some_and(|place| self.contains(place))
                && !self.is_hidden(stage, then, (&ray, eye), &hit, point),
            ray: Some((ray, hit)),
        }
    }

    /// Returns true if neither the camera nor what a ray met ever moves. The same ray meets it at
    /// all times, unless a mover is before it.
    pub fn sees_still(&self, stage: &Stage, hit: Option<&Hit>) -> bool {
        self.camera_stands_still && hit.is_none_or(|hit| stage.object_stands_still(hit.object))
    }

    /// Looks back at a point at infinity.
    fn look_at_infinity(
        &self,
        stage: &Stage,
        then: &mut Poses,
        direction: DVec3,
        from: LensPoint,
    ) -> InstantPoint {
        let place = self.view.project_through(Target::Infinity(direction), from);
        let ray = Ray {
            origin: self.view.eye(from),
            direction,
        };
        let is_still = self.sees_still(stage, None);
        InstantPoint {
            place,
            is_shown: place.is_some_and(|place| self.contains(place))
                && !is_blocked(stage, then, &ray, f64::INFINITY, is_still),
            ray: None,
        }
    }

    /// Finds the place that [`InstantView::look_back`] finds, and nothing else.
    pub fn find_place(
        &self,
        stage: &Stage,
        then: &mut Poses,
        EyeRay { ray, from }: &EyeRay,
        hit: Option<&Hit>,
    ) -> Option<DVec2> {
        let target = match hit {
            Some(hit) => Target::Point(find_point(stage, then, hit)),
            None => Target::Infinity(ray.direction),
        };
        self.view.project_through(target, *from)
    }

    /// Shades a sample's point at the instant; returns the radiance then minus the radiance of the
    /// sample's own path from `stop`, which scattered `bounces` times. `then` are the poses of the
    /// instant.
    pub fn shift(
        &self,
        integrator: &Integrator,
        then: &mut Poses,
        (point, stop): (&InstantPoint, Stop),
        (radiance, bounces): (Vec3, u32),
        sampler: &Sampler,
    ) -> Vec3 {
        match point.ray {
            Some((ray, hit)) if bounces > 0 && !self.unchanging => {
                let stop = Some(Stop { hit, ..stop });
                integrator.follow_path(then, ray, stop, sampler).0 - radiance
            }
            _ => Vec3::ZERO,
        }
    }

    /// Returns true if a place is inside the picture.
    fn contains(&self, place: DVec2) -> bool {
        let size = DVec2::new(f64::from(self.canvas.width), f64::from(self.canvas.height));
        place.cmpge(DVec2::splat(-ROUNDING)).all() && place.cmplt(size + ROUNDING).all()
    }

    /// Returns true if anything is between the eye and the point. The ray leaves the surface as
    /// shadow rays do.
    fn is_hidden(
        &self,
        stage: &Stage,
        then: &mut Poses,
        (ray, eye): (&Ray, DVec3),
        hit: &Hit,
        point: DVec3,
    ) -> bool {
        let facet = stage.facet(then, ray, hit);
        let magnitude = point.abs().max_element().max(hit.t);
        let start = point + LIFT * magnitude * facet;
        let way = eye - start;
        let back = Ray {
            origin: start,
            direction: way.normalize(),
        };
        let is_still = self.sees_still(stage, Some(hit));
        is_blocked(stage, then, &back, way.length(), is_still)
    }
}

/// Returns true if anything is between the eye and a point that some sample saw; `is_still` says
/// that only a mover can be.
fn is_blocked(stage: &Stage, then: &mut Poses, ray: &Ray, limit: f64, is_still: bool) -> bool {
    if is_still {
        stage.is_blocked_by_mover(then, ray, limit)
    } else {
        stage.is_blocked(then, ray, limit)
    }
}

/// Finds the point of a hit as it was at the instant, in the world.
fn find_point(stage: &Stage, then: &mut Poses, hit: &Hit) -> DVec3 {
    let mesh = &stage.scene.meshes[stage.scene.objects[hit.object].mesh];
    let point = mesh.at(0.0).point(hit.triangle, hit.weights);
    then.pose(hit.object).to_world.transform_point3(point)
}

impl InstantSums {
    /// Adds a sample that was looked up at the instant: the share of it that the frame does not
    /// show, and the change of its radiance.
    pub fn add_recalled(&mut self, unknowable: f64, shift: Vec3) {
        self.recalled += 1;
        self.unknowable += unknowable;
        self.shift += shift.as_dvec3();
    }

    /// Adds the place of a point that a sample saw, with its share of the sample, to the pixel with
    /// this centre.
    pub fn add_place(&mut self, place: DVec2, share: f64, centre: [f64; 2]) {
        let offset = place - DVec2::from(centre);
        self.placed += share;
        self.offset += share * offset;
        self.spread += share * (offset * offset);
    }

    /// The means over the pixel's samples, of which there are `samples`.
    ///
    /// Most samples shift little or not at all, so that a part of them suffices. If few shift much,
    /// radiance and shift may sum to less than 0; they must not be clamped, or their mean would be
    /// too high.
    pub fn means(&self, samples: u32) -> InstantMeans {
        let samples = f64::from(samples);
        // Without any, their sums are 0.
        let recalled = f64::from(self.recalled.max(1));
        InstantMeans {
            shift: self.shift / recalled,
            unknowable: self.unknowable / recalled,
            placed: self.placed / samples,
            offset: self.offset / samples,
            spread: self.spread / samples,
        }
    }
}
