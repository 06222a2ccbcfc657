//! Audit of a capture.

use filters::DepthKind;
use frame::Raster;
use serde::Serialize;
use suite::Error;
use tracer::Scene;

use crate::audit::cause::Cause;
use crate::audit::clear_pixels::select_clear_pixels;
use crate::audit::color_audit::audit_color;
use crate::audit::defect::{Buffer, Defect, Explanation};
use crate::audit::depth_audit::{DepthAudit, DepthPair};
use crate::audit::expected_motion::ExpectedMotion;
use crate::audit::shown::{LEAST_SHOWN, ObjectShown, count_shown};
use crate::audit::velocity_audit::{ObjectAudit, audit_velocity};
use crate::audit::views::find_other_views;
use crate::capture::description::CAPTURE_FILE;
use crate::capture::folder::Capture;
use crate::files::refuse;

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
        return refuse(
            &capture.folder.join(CAPTURE_FILE),
            &format!(
                "instant = {instant}; allowed for an audit: 0, the `instant` of the exported manifest"
            ),
        );
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
    let is_missed = |name: &str| (objects.iter()).any(|it| it.is_missed() && it.object == name);
    let is_clear = |at: usize| {
        let object = right.object_id.pixels[at] as usize;
        (alike < LEAST_KNOWN || shows(at, at)) && !is_missed(&names[object])
    };
    let regions = select_clear_pixels(right, names.len(), &is_clear);
    let (velocity, wrong_velocity) = audit_velocity(&capture.velocity, &expected, &regions, &names);
    let depth = pair.compare(&regions);

    let views = find_other_views(capture, &pair, scene)?;
    let is_view = |buffer: Buffer| views.iter().any(|finding| finding.buffer == buffer);
    let shows_other_view = is_view(Buffer::Picture)
        || is_view(Buffer::ObjectId)
        || is_view(Buffer::Depth) && ids.is_none();
    let missed = match shows_other_view {
        true => Vec::new(),
        false => word_missed(&objects, alike, ids),
    };
    let mut wrong = Vec::new();
    // Whatever else differs follows from another view, or from a picture of something else.
    if !shows_other_view && missed.iter().all(|finding| finding.object.is_some()) {
        wrong.extend(wrong_velocity);
        if !is_view(Buffer::Depth) {
            let of_shown = |it: &Defect| it.object.as_deref().is_none_or(|name| !is_missed(name));
            let depth = wrong_depth.into_iter().filter(of_shown);
            wrong.extend(depth.map(|it| doubt_depth(it, ids.is_some())));
        }
        if !is_view(Buffer::Color) {
            wrong.extend(audit_color(&capture.color, scene, &regions, &names)?);
        }
    }
    let audit = CaptureAudit {
        scene: scene.id.to_string(),
        engine: capture.description.engine.clone(),
        size,
        has_ids: ids.is_some(),
        alike,
        shows_scene: !shows_other_view && missed.is_empty(),
        velocity,
        depth,
        compares_color: scene.is_unlit(),
        findings: [missed, views, wrong].concat(),
        objects,
    };
    Ok((audit, expected))
}

/// Adds to a wrong depth of an object that the object may not be drawn, if no ids say so.
fn doubt_depth(finding: Defect, has_ids: bool) -> Defect {
    match has_ids || finding.object.is_none() {
        true => finding,
        false => finding.with("or the engine does not draw it there: object.exr would tell"),
    }
}

/// Words what the engine shows too little of: all of the picture, or single objects.
fn word_missed(objects: &[ObjectShown], alike: f64, ids: Option<&Raster<u32>>) -> Vec<Defect> {
    let mut missed = objects
        .iter()
        .filter(|object| object.is_missed())
        .peekable();
    let other = |object: Option<&str>, shown: f64| {
        let found = Explanation::by(Cause::OtherView, 1.0 - shown);
        Defect::new(Buffer::Picture, object, found)
    };
    let by = match ids {
        Some(_) => "by its ids",
        None => "by its depth, as the convention has it; object.exr would tell more",
    };
    let least = 100.0 * LEAST_SHOWN;
    if missed.peek().is_some() && alike < LEAST_ALIKE {
        let text = format!("{:.1} % of the pixels agree, {by}", 100.0 * alike);
        return vec![other(None, alike).with(&text)];
    }
    let findings = missed.map(|object| {
        let text = format!(
            "{:.1} % of its {} pixels agree, {by}; needed: {least} %",
            100.0 * object.shown,
            object.pixels
        );
        other(Some(&object.object), object.shown).with(&text)
    });
    findings.collect()
}
