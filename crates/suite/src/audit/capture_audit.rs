//! Audit of a capture.

use frame::FAR_DEPTH;
use serde::Serialize;
use tracer::Scene;

use super::cause::{Cause, Defect};
use super::clear_pixels::select_clear_pixels;
use super::depth_audit::{DepthAudit, audit_depth};
use super::expected_motion::ExpectedMotion;
use super::velocity_audit::{ObjectAudit, audit_velocity};
use crate::Error;
use crate::capture::folder::Capture;

/// Part of the pixels that must show the same: the same object where the capture has ids, else something where the scene has something.
const LEAST_ALIKE: f64 = 0.8;

/// Agreement of an engine's velocity and depth with the scene's.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CaptureAudit {
    /// Name of the scene, with its variant.
    pub scene: String,
    /// Engine, as the capture names it.
    pub engine: String,
    /// Columns and rows.
    pub size: [u32; 2],
    /// Part of the pixels at which the engine shows what the scene shows.
    pub alike: f64,
    /// Velocity, object by object; the background is one.
    pub velocity: Vec<ObjectAudit>,
    /// Depth.
    pub depth: DepthAudit,
    /// What is wrong; empty if nothing is.
    pub findings: Vec<Defect>,
}

/// Compares a capture with the scene that it shows; returns what the scene's velocity should be as well.
///
/// # Errors
/// The capture is of another instant, or the scene's motion cannot be traced.
pub fn audit_capture(
    capture: &Capture,
    scene: &Scene,
) -> Result<(CaptureAudit, ExpectedMotion), Error> {
    let instant = capture.description.instant;
    if instant != 0.0 {
        return Err(Error::Usage(format!(
            "{}: instant = {instant}; allowed for an audit: 0, the `instant` of the exported manifest",
            capture.folder.join("capture.toml").display()
        )));
    }
    let size = [capture.color.width, capture.color.height];
    let expected = ExpectedMotion::trace(scene, size)?;
    let right = &expected.right;
    let names = scene.object_names();
    let is_something = |depth: &f32| *depth < 0.1 * FAR_DEPTH;
    let alike = match &capture.object_id {
        Some(ids) => count_equal(&ids.pixels, &right.object_id.pixels),
        None => {
            let [found, own] = [&capture.depth, &right.depth].map(|depth| depth.map(is_something));
            count_equal(&found.pixels, &own.pixels)
        }
    } as f64
        / right.object_id.pixels.len() as f64;
    let regions = select_clear_pixels(
        right,
        capture.object_id.as_ref(),
        &capture.depth,
        names.len(),
    );
    let (velocity, mut findings) = audit_velocity(&capture.velocity, &expected, &regions, &names);
    let (depth, wrong_depth) = audit_depth(&capture.depth, right, &regions, scene);
    findings.extend(wrong_depth);
    if alike < LEAST_ALIKE {
        // Whatever else differs follows from that.
        findings = vec![Defect::new(None, Cause::OtherView, Vec::new(), 1.0 - alike)];
    }
    let audit = CaptureAudit {
        scene: scene.name.clone(),
        engine: capture.description.engine.clone(),
        size,
        alike,
        velocity,
        depth,
        findings,
    };
    Ok((audit, expected))
}

fn count_equal<T: PartialEq>(a: &[T], b: &[T]) -> usize {
    a.iter().zip(b).filter(|(a, b)| a == b).count()
}
