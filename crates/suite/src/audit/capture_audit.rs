//! Audit of a capture.

use filters::DepthKind;
use frame::Raster;
use serde::Serialize;
use tracer::Scene;

use super::cause::Cause;
use super::clear_pixels::select_clear_pixels;
use super::color_audit::audit_color;
use super::defect::{Buffer, Defect, Explanation};
use super::depth_audit::{DepthAudit, DepthPair};
use super::expected_motion::ExpectedMotion;
use super::shown::{LEAST_SHOWN, ObjectShown, count_shown};
use super::velocity_audit::{ObjectAudit, audit_velocity};
use super::views::find_other_views;
use crate::Error;
use crate::capture::folder::Capture;

/// Part of the pixels whose depth must be known before it tells, without ids, what the engine shows there.
const LEAST_KNOWN: f64 = 0.3;

/// Part of the pixels that must agree before single objects are named.
const LEAST_ALIKE: f64 = 0.5;

/// Agreement of an engine's velocity and depth with the scene's.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CaptureAudit {
    /// Name of the scene, with its variant.
    pub scene: String,
    /// Engine, as the capture names it.
    pub engine: String,
    /// Columns and rows.
    pub size: [u32; 2],
    /// True if the capture has ids of objects; without them depth tells what it shows.
    pub has_ids: bool,
    /// Part of the pixels at which the engine shows what the scene shows.
    pub alike: f64,
    /// The same, object by object.
    pub objects: Vec<ObjectShown>,
    /// True if the engine shows the scene; else nothing is said about its vectors.
    pub shows_scene: bool,
    /// Velocity, object by object; the background is one.
    pub velocity: Vec<ObjectAudit>,
    /// Depth.
    pub depth: DepthAudit,
    /// True if colour was compared: it does not depend on light in this scene.
    pub compares_color: bool,
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
    let is_linear = capture.convention.depth == DepthKind::Linear;
    let pair = DepthPair {
        found: &capture.depth,
        right,
        near: capture.convention.near.filter(|_| !is_linear),
    };
    let ids = capture.object_id.as_ref();
    let is_same = |at: usize| ids.is_none_or(|ids| ids.pixels[at] == right.object_id.pixels[at]);
    let clear = select_clear_pixels(right, names.len(), &is_same);
    let (wrong_depth, known) = pair.explain(&clear, &names, scene);
    let shows = |from: usize, at: usize| match ids {
        Some(ids) => ids.pixels[from] == right.object_id.pixels[at],
        None if from == at => known.pixels[at],
        None => pair.is_close(capture.depth.pixels[from], right.depth.pixels[at]),
    };
    let pixels = right.object_id.pixels.len();
    let alike = (0..pixels).filter(|at| shows(*at, *at)).count() as f64 / pixels as f64;
    let objects = count_shown(&right.object_id, ids, &names, &shows);
    let missed: Vec<&ObjectShown> = objects.iter().filter(|it| it.is_missed()).collect();
    let is_missed = |name: &str| missed.iter().any(|object| object.object == name);
    let is_clear = |at: usize| {
        let object = right.object_id.pixels[at] as usize;
        (alike < LEAST_KNOWN || shows(at, at)) && !is_missed(&names[object])
    };
    let regions = select_clear_pixels(right, names.len(), &is_clear);
    let (velocity, wrong_velocity) = audit_velocity(&capture.velocity, &expected, &regions, &names);

    let views = find_other_views(capture, &pair, scene)?;
    let is_view = |buffer: Buffer| views.iter().any(|finding| finding.buffer == buffer);
    let shows_other_view = is_view(Buffer::Picture)
        || is_view(Buffer::ObjectId)
        || is_view(Buffer::Depth) && ids.is_none();
    let mut findings = match shows_other_view {
        true => Vec::new(),
        false => word_missed(&missed, alike, ids),
    };
    let shows_scene = !shows_other_view && findings.is_empty();
    // Whatever else differs follows from that.
    let is_all = shows_other_view || findings.iter().any(|finding| finding.object.is_none());
    let keeps_color = !is_view(Buffer::Color);
    let keeps_depth = !is_view(Buffer::Depth);
    findings.extend(views);
    if !is_all {
        findings.extend(wrong_velocity);
        let depth = wrong_depth.into_iter().filter(|_| keeps_depth);
        let of_shown = |finding: &Defect| finding.object.as_deref().is_none_or(|it| !is_missed(it));
        let depth = depth.filter(of_shown);
        findings.extend(
            depth.map(|finding| match ids.is_none() && finding.object.is_some() {
                true => finding.with("or the engine does not draw it there: object.exr would tell"),
                false => finding,
            }),
        );
        if keeps_color {
            findings.extend(audit_color(&capture.color, scene, &regions, &names)?);
        }
    }
    let audit = CaptureAudit {
        scene: scene.id.to_string(),
        engine: capture.description.engine.clone(),
        size,
        has_ids: ids.is_some(),
        alike,
        shows_scene,
        velocity,
        depth: pair.compare(&regions),
        compares_color: scene.is_unlit(),
        findings,
        objects,
    };
    Ok((audit, expected))
}

/// Words what the engine shows too little of: all of the picture, or single objects.
fn word_missed(missed: &[&ObjectShown], alike: f64, ids: Option<&Raster<u32>>) -> Vec<Defect> {
    let other = |object: Option<&str>, shown: f64| {
        let found = Explanation::by(Cause::OtherView, 1.0 - shown);
        Defect::new(Buffer::Picture, object, found)
    };
    let by = match ids {
        Some(_) => "by its ids",
        None => "by its depth, as the convention has it; object.exr would tell more",
    };
    let least = 100.0 * LEAST_SHOWN;
    if !missed.is_empty() && alike < LEAST_ALIKE {
        let text = format!("{:.1} % of the pixels agree, {by}", 100.0 * alike);
        return vec![other(None, alike).with(&text)];
    }
    let findings = missed.iter().map(|object| {
        let text = format!(
            "{:.1} % of its {} pixels agree, {by}; needed: {least} %",
            100.0 * object.shown,
            object.pixels
        );
        other(Some(&object.object), object.shown).with(&text)
    });
    findings.collect()
}
