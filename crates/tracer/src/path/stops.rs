//! Ways of rays through translucent surfaces, to where they stop.

use bvh::Ray;
use glam::Vec3;

use crate::hit::Hit;
use crate::material::passage::Passage;
use crate::motion::poses::Poses;
use crate::stage::Stage;

/// A surface at which a path goes no further straight ahead.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stop {
    pub hit: Hit,
    /// True if a pane of glass reflects the path; else the surface itself scatters it.
    pub mirrors: bool,
}

impl Stop {
    /// A stop at which the surface itself scatters the path.
    pub fn scattering(hit: Hit) -> Self {
        Self {
            hit,
            mirrors: false,
        }
    }
}

/// One of the stops of a ray, and how much it counts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Layer {
    /// None for the background.
    pub stop: Option<Stop>,
    /// Share of the ray's coverage; the shares of all layers sum to 1.
    pub share: f64,
    /// Share of the light from the stop that comes back along the ray. In front of a pane, the
    /// pane's own reflectance is left to the path.
    pub weight: Vec3,
}

/// Finds all stops of a ray, from near to far: each translucent surface, and at the end an opaque
/// one or the background. Calls `visit` for each.
pub(crate) fn visit_layers(
    stage: &Stage,
    poses: &mut Poses,
    ray: &Ray,
    mut visit: impl FnMut(&mut Poses, Layer),
) {
    let mut next = stage.closest(poses, ray);
    let (mut share, mut weight) = (1.0, Vec3::ONE);
    if stage.has_translucency {
        while let Some(hit) = next {
            let Some(passage) = Passage::at(stage.scene, poses, ray, &hit) else {
                break;
            };
            let stop = |mirrors| Some(Stop { hit, mirrors });
            if passage.opacity > 0.0 {
                let surface = Layer {
                    stop: stop(false),
                    share: share * passage.opacity,
                    weight: weight * passage.opacity as f32,
                };
                visit(poses, surface);
            }
            share *= 1.0 - passage.opacity;
            weight *= (1.0 - passage.opacity) as f32;
            let reflection = passage.chance_of_reflection();
            if reflection > 0.0 && share > 0.0 {
                let mirrored = Layer {
                    stop: stop(true),
                    share: share * reflection,
                    weight,
                };
                visit(poses, mirrored);
            }
            share *= 1.0 - reflection;
            weight *= passage.passed;
            if share <= 0.0 {
                return;
            }
            next = stage.closest_behind(poses, ray, &hit);
        }
    }
    let last = Layer {
        stop: next.map(Stop::scattering),
        share,
        weight,
    };
    visit(poses, last);
}

/// Draws one of the stops of a ray by their shares of coverage, with the weight that keeps the mean
/// of the light. `number` gives one in [0, 1), if it is needed. One number is enough for all
/// surfaces: the rest of it at each is uniform again.
pub(crate) fn find_stop(
    stage: &Stage,
    poses: &mut Poses,
    ray: &Ray,
    number: impl Fn() -> f64,
) -> (Option<Stop>, Vec3) {
    let mut next = stage.closest(poses, ray);
    let mut weight = Vec3::ONE;
    if !stage.has_translucency {
        return (next.map(Stop::scattering), weight);
    }
    let mut number = number();
    while let Some(hit) = next {
        let Some(passage) = Passage::at(stage.scene, poses, ray, &hit) else {
            break;
        };
        if number < passage.opacity {
            return (Some(Stop::scattering(hit)), weight);
        }
        number = (number - passage.opacity) / (1.0 - passage.opacity);
        let reflection = passage.chance_of_reflection();
        if number < reflection {
            let mirrors = true;
            return (Some(Stop { hit, mirrors }), weight / reflection as f32);
        }
        number = (number - reflection) / (1.0 - reflection);
        weight *= passage.passed / (1.0 - reflection) as f32;
        next = stage.closest_behind(poses, ray, &hit);
    }
    (next.map(Stop::scattering), weight)
}
