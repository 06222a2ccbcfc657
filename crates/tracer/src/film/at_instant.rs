//! The view of the frame's instant on points that are seen at other times.

use glam::{DVec2, DVec3, Vec3};

use crate::film::canvas::Canvas;
use crate::film::sampler::Sampler;
use crate::geometry::hit::Hit;
use crate::geometry::ray::Ray;
use crate::light::integrator::{Integrator, LIFT, PathSample};
use crate::motion::camera::View;
use crate::motion::poses::Poses;
use crate::stage::Stage;

/// Rounding of a projected place, in pixels; points at the picture's very border still count as inside.
const ROUNDING: f64 = 1e-9;

/// The camera of the instant, and the picture that it takes.
pub(crate) struct InstantView {
    view: View,
    canvas: Canvas,
    /// True where nothing changes in the world and all surfaces are diffuse: shading is then the same at all times.
    unchanging: bool,
}

/// One sample, as it was at the instant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct InstantSample {
    /// Radiance of the visible point at the instant, minus its radiance now; none where it was not asked for.
    pub shift: Option<Vec3>,
    /// Place of the point at the instant, in pixels from the picture's top left; none behind the camera.
    pub place: Option<DVec2>,
    /// True if the frame shows the point.
    pub is_shown: bool,
}

/// Sums over the samples of a pixel.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct InstantSums {
    live: DVec3,
    shift: DVec3,
    shifts: u32,
    unknowable: f64,
    placed: f64,
    offset: DVec2,
    spread: DVec3,
}

/// Means over the samples of a pixel.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct InstantMeans {
    pub frozen: DVec3,
    pub unknowable: f64,
    pub placed: f64,
    pub offset: DVec2,
    /// xx, xy, yy.
    pub spread: DVec3,
}

/// The ray of the instant's camera to a visible point.
struct InstantRay {
    ray: Ray,
    hit: Hit,
    point: DVec3,
    /// True if the camera saw the same side of the surface then.
    same_side: bool,
}

impl InstantView {
    pub fn new(stage: &Stage, canvas: Canvas) -> Self {
        Self {
            view: stage.scene.camera.view(0.0, canvas.width, canvas.height),
            canvas,
            unchanging: stage.stands_still() && stage.is_diffuse(),
        }
    }

    /// Looks back at a sample that `ray` found at the time of `poses`; `then` are the poses of the instant. `shade` asks for
    /// the shading at the instant, which is the expensive part.
    pub fn sample(
        &self,
        integrator: &Integrator,
        (poses, then): (&mut Poses, &mut Poses),
        ray: &Ray,
        sample: &PathSample,
        sampler: &Sampler,
        shade: bool,
    ) -> InstantSample {
        let stage = integrator.stage;
        let Some(hit) = &sample.hit else {
            return self.sample_background(stage, then, ray.direction, shade);
        };
        let point = self.point(stage, then, hit);
        let instant = self.ray_to(stage, (poses, then), ray, hit, point);
        let place = self.view.project(point).map(DVec2::from);
        let shift = shade.then(|| {
            if self.unchanging || !sample.scattered {
                return Vec3::ZERO;
            }
            let frozen = integrator.radiance_along(then, instant.ray, Some(instant.hit), sampler);
            frozen - sample.radiance
        });
        InstantSample {
            shift,
            place,
            is_shown: self.shows_point(stage, then, &instant, place),
        }
    }

    /// Returns true if the frame shows the point that `ray` meets at the time of `poses`; `then` are the poses of the instant.
    pub fn shows(
        &self,
        stage: &Stage,
        (poses, then): (&mut Poses, &mut Poses),
        ray: &Ray,
        hit: Option<&Hit>,
    ) -> bool {
        let Some(hit) = hit else {
            return self
                .sample_background(stage, then, ray.direction, false)
                .is_shown;
        };
        let point = self.point(stage, then, hit);
        let instant = self.ray_to(stage, (poses, then), ray, hit, point);
        let place = self.view.project(point).map(DVec2::from);
        self.shows_point(stage, then, &instant, place)
    }

    /// Returns true if the frame shows a point, which lay at `place` in it.
    fn shows_point(
        &self,
        stage: &Stage,
        then: &mut Poses,
        instant: &InstantRay,
        place: Option<DVec2>,
    ) -> bool {
        instant.same_side
            && place.is_some_and(|place| self.contains(place))
            && !self.is_hidden(stage, then, instant)
    }

    /// Looks back at a point at infinity, whose radiance never changes.
    fn sample_background(
        &self,
        stage: &Stage,
        then: &mut Poses,
        direction: DVec3,
        shade: bool,
    ) -> InstantSample {
        let place = self.view.project_direction(direction).map(DVec2::from);
        let ray = Ray {
            origin: self.view.to_world.translation,
            direction,
        };
        InstantSample {
            shift: shade.then_some(Vec3::ZERO),
            place,
            is_shown: place.is_some_and(|place| self.contains(place))
                && !stage.blocked(then, &ray, f64::INFINITY),
        }
    }

    /// The position of a hit's point in the world at the instant.
    fn point(&self, stage: &Stage, then: &mut Poses, hit: &Hit) -> DVec3 {
        let mesh = &stage.scene.meshes[stage.scene.objects[hit.object].mesh];
        let point = mesh.at(0.0).point(hit.triangle, hit.weights);
        then.pose(hit.object).to_world.transform_point3(point)
    }

    /// The ray of the instant's camera to the point. Where that camera saw the surface's other side, the ray instead meets
    /// the side that is seen now, in the same direction as now in the object's own space.
    fn ray_to(
        &self,
        stage: &Stage,
        (poses, then): (&mut Poses, &mut Poses),
        ray: &Ray,
        hit: &Hit,
        point: DVec3,
    ) -> InstantRay {
        let mesh = &stage.scene.meshes[stage.scene.objects[hit.object].mesh];
        let side = |poses: &mut Poses, time: f64, direction: DVec3| {
            let to_world = &poses.pose(hit.object).to_world;
            let normal = mesh.at(time).area_normal(hit.triangle, to_world);
            normal.dot(direction) > 0.0
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
        InstantRay {
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

    /// Returns true if a place lies inside the picture.
    fn contains(&self, place: DVec2) -> bool {
        let size = DVec2::new(f64::from(self.canvas.width), f64::from(self.canvas.height));
        place.cmpge(DVec2::splat(-ROUNDING)).all() && place.cmplt(size + ROUNDING).all()
    }

    /// Returns true if anything lies between the eye and the point. The ray leaves the surface as shadow rays do.
    fn is_hidden(&self, stage: &Stage, then: &mut Poses, instant: &InstantRay) -> bool {
        let facet = stage.facet(then, &instant.ray, &instant.hit);
        let magnitude = instant.point.abs().max_element().max(instant.hit.t);
        let start = instant.point + LIFT * magnitude * facet;
        let way = self.view.to_world.translation - start;
        let back = Ray {
            origin: start,
            direction: way.normalize(),
        };
        stage.blocked(then, &back, way.length())
    }
}

impl InstantSums {
    /// Adds a sample of this radiance, of the pixel with this centre.
    pub fn add(&mut self, sample: &InstantSample, radiance: Vec3, centre: [f64; 2]) {
        self.live += radiance.as_dvec3();
        if let Some(shift) = sample.shift {
            self.shift += shift.as_dvec3();
            self.shifts += 1;
        }
        self.unknowable += f64::from(!sample.is_shown);
        if let Some(place) = sample.place {
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

    /// The means over `samples`.
    ///
    /// Frozen shading is the live shading of all samples plus the mean shift of those that were shaded again. Most samples
    /// shift little or not at all, so that a part of them suffices. Where few shift much the estimate may fall below 0; it
    /// must not be clamped, or its mean would be too high.
    pub fn means(&self, samples: u32) -> InstantMeans {
        let samples = f64::from(samples);
        InstantMeans {
            frozen: self.live / samples + self.shift / f64::from(self.shifts),
            unknowable: self.unknowable / samples,
            placed: self.placed / samples,
            offset: self.offset / samples,
            spread: self.spread / samples,
        }
    }
}
