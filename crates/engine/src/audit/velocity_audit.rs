//! Audit of velocity: the end-point error per object.

use frame::Vectors;
use serde::Serialize;

use crate::audit::clear_pixels::{ClearPixels, select_judged};
use crate::audit::defect::Defect;
use crate::audit::depth_audit::LEAST_EXPLAINED;
use crate::audit::expected_motion::ExpectedMotion;
use crate::audit::fitted_motion::{TOLERANCE, fit_scale, length};
use crate::audit::ranking::Ranking;
use crate::audit::velocity_search::{Search, difference, share};
use crate::statistics::{median, percentile};

/// Median speed from which on a right object proves the convention, in pixels per frame.
const LEAST_PROOF: f64 = 1.0;

/// Agreement of an engine's velocity with the scene's, for one object.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ObjectAudit {
    /// Name of the object.
    pub object: String,
    /// Number of pixels compared.
    pub pixels: usize,
    /// Median of the right speed, in pixels per frame.
    pub speed: f64,
    /// Median of the end-point error, in pixels.
    pub median: f64,
    /// 95th percentile of the end-point error, in pixels.
    pub p95: f64,
    /// Largest end-point error, in pixels.
    pub worst: f64,
    /// Pixel of the largest error.
    pub worst_at: [u32; 2],
    /// Factor that fits the engine's velocity best; none for a still object.
    pub scale: Option<f64>,
    /// True if the velocity is correct.
    pub is_right: bool,
}

/// Compares velocity object by object; also returns what is wrong.
pub fn audit_velocity(
    buffer: &Vectors,
    expected: &ExpectedMotion<'_>,
    regions: &[ClearPixels],
    names: &[String],
) -> (Vec<ObjectAudit>, Vec<Defect>) {
    let judged = select_judged(regions);
    let objects: Vec<ObjectAudit> = (judged.iter())
        .map(|region| audit_object(buffer, expected, region, &names[region.object as usize]))
        .collect();
    let wrong: Vec<&ClearPixels> = (judged.iter().zip(&objects))
        .filter(|(_, object)| !object.is_right)
        .map(|(region, _)| *region)
        .collect();
    if wrong.is_empty() {
        return (objects, Vec::new());
    }
    let right = (judged.iter().zip(&objects)).filter(|(_, object)| object.is_right);
    let search = Search {
        buffer,
        expected,
        right: right.clone().map(|(region, _)| *region).collect(),
        ranking: Ranking {
            some_move_right: right.clone().any(|(_, object)| object.speed >= LEAST_PROOF),
        },
    };
    let wrong: Vec<(&ClearPixels, &str)> = (wrong.into_iter())
        .map(|region| (region, names[region.object as usize].as_str()))
        .collect();
    let findings = search.explain(&judged, &wrong);
    (objects, findings)
}

fn audit_object(
    buffer: &Vectors,
    expected: &ExpectedMotion<'_>,
    region: &ClearPixels,
    name: &str,
) -> ObjectAudit {
    let right = &expected.right.velocity;
    let error = |at: usize| length(difference(buffer.pixels[at], right.pixels[at]));
    let mut errors: Vec<f64> = region.pixels.iter().map(|at| error(*at)).collect();
    errors.sort_by(f64::total_cmp);
    let worst = (region.pixels.iter().copied())
        .max_by(|a, b| error(*a).total_cmp(&error(*b)))
        .expect("a judged object has pixels");
    let speed = |at: &usize| length(right.pixels[*at].map(f64::from));
    let speed = median(region.pixels.iter().map(speed));
    let at_part = |part: f64| percentile(&errors, part).expect("a judged object has pixels");
    let width = buffer.width as usize;
    ObjectAudit {
        object: name.to_owned(),
        pixels: region.pixels.len(),
        speed,
        median: at_part(0.5),
        p95: at_part(0.95),
        worst: error(worst),
        worst_at: [(worst % width) as u32, (worst / width) as u32],
        scale: (speed > TOLERANCE).then(|| fit_scale(buffer, right, &region.pixels, &[0, 1])),
        is_right: share(buffer, right, &region.pixels) >= LEAST_EXPLAINED,
    }
}
