//! Audit of a capture.

use frame::Size;
use measure::Error;
use scene::Scene;
use serde::Serialize;

use crate::audit::cause::Cause;
use crate::audit::clear_pixels::select_clear_pixels;
use crate::audit::color_audit::audit_color;
use crate::audit::defect::{Buffer, Defect, Explanation};
use crate::audit::depth_audit::{DepthAudit, DepthPair};
use crate::audit::expected_motion::ExpectedMotion;
use crate::audit::shown::{LEAST_SHOWN, ObjectShown, Shown};
use crate::audit::velocity_audit::{ObjectAudit, audit_velocity};
use crate::audit::views::find_other_views;
use crate::capture::description::CAPTURE_FILE;
use crate::capture::folder::Capture;
use crate::files::refuse;

/// Part of the pixels that must agree before single objects are named.
const LEAST_ALIKE: f64 = 0.5;

/// Agreement of an engine's velocity and depth with the scene's.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CaptureAudit {
    /// Name of the scene, with its variant.
    pub scene: String,
    /// Engine, as named in the capture.
    pub engine: String,
    /// Size of the pictures.
    pub size: Size,
    /// True if the capture has object ids; otherwise its depth identifies objects.
    pub has_ids: bool,
    /// Part of the pixels at which the engine shows the same as the scene.
    pub alike: f64,
    /// The same, object by object.
    pub objects: Vec<ObjectShown>,
    /// True if the engine shows the scene; otherwise its vectors are not judged.
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

/// Compares a capture with its scene; also returns the scene's correct velocity.
///
/// # Errors
/// The capture is of another instant, or the scene's motion cannot be traced.
pub fn audit_capture(
    capture: &Capture,
    scene: &Scene,
) -> Result<(CaptureAudit, ExpectedMotion), Error> {
    check_instant(capture)?;
    let size = capture.color.size();
    let expected = ExpectedMotion::trace(scene, size)?;
    let right = &expected.right;
    let names = scene.object_names();
    let pair = DepthPair::of(capture, right);
    let ids = capture.object_id.as_ref();
    let is_same = |at: usize| ids.is_none_or(|ids| ids.pixels[at] == right.object_id.pixels[at]);
    let clear = select_clear_pixels(right, names.len(), &is_same);
    let (wrong_depth, known) = pair.explain(&clear, &names, scene);
    let shows = |from: usize, at: usize| match ids {
        Some(ids) => ids.pixels[from] == right.object_id.pixels[at],
        None if from == at => known.pixels[at],
        None => pair.is_close(capture.depth.pixels[from], right.depth.pixels[at]),
    };
    let shown = Shown::compare(right, ids, &names, &shows);
    let regions = &shown.regions;
    let (velocity, wrong_velocity) = audit_velocity(&capture.velocity, &expected, regions, &names);

    let views = find_other_views(capture, &pair, scene)?;
    let is_view = |buffer: Buffer| views.iter().any(|finding| finding.buffer == buffer);
    let shows_other_view = is_view(Buffer::Picture)
        || is_view(Buffer::ObjectId)
        || is_view(Buffer::Depth) && ids.is_none();
    let missed = if shows_other_view {
        Vec::new()
    } else {
        word_missed(&shown, ids.is_some())
    };
    let mut wrong = Vec::new();
    // All other differences follow from another view or another subject.
    if !shows_other_view && missed.iter().all(|finding| finding.object.is_some()) {
        wrong.extend(wrong_velocity);
        if !is_view(Buffer::Depth) {
            let word = |defect| word_depth(defect, &shown, ids.is_some());
            wrong.extend(wrong_depth.into_iter().filter_map(word));
        }
        if !is_view(Buffer::Color) {
            wrong.extend(audit_color(&capture.color, scene, regions, &names)?);
        }
    }
    let audit = CaptureAudit {
        scene: scene.id.to_string(),
        engine: capture.description.engine.clone(),
        size,
        has_ids: ids.is_some(),
        alike: shown.alike,
        shows_scene: !shows_other_view && missed.is_empty(),
        velocity,
        depth: pair.compare(regions),
        compares_color: scene.is_unlit(),
        findings: [missed, views, wrong].concat(),
        objects: shown.objects,
    };
    Ok((audit, expected))
}

/// Refuses a capture of another instant than the scene's.
fn check_instant(capture: &Capture) -> Result<(), Error> {
    let instant = capture.description.instant;
    if instant == 0.0 {
        return Ok(());
    }
    refuse!(
        capture.folder.join(CAPTURE_FILE),
        "instant = {instant}; allowed for an audit: 0, the `instant` of the exported manifest"
    )
}

/// Words wrong depth; none for an object that the engine does not show. Without ids, nobody knows
/// whether it draws the others there.
fn word_depth(wrong: Defect, shown: &Shown, has_ids: bool) -> Option<Defect> {
    match &wrong.object {
        Some(name) if shown.is_missed(name) => None,
        Some(_) if !has_ids => {
            Some(wrong.with("or the engine does not draw it there: object.exr would show it"))
        }
        _ => Some(wrong),
    }
}

/// Words what the engine shows too little of: the whole picture, or single objects.
fn word_missed(shown: &Shown, has_ids: bool) -> Vec<Defect> {
    let other = |object: Option<&str>, part: f64, text: &str| {
        let explanation = Explanation::by(Cause::OtherView, 1.0 - part);
        Defect::new(Buffer::Picture, object, explanation).with(text)
    };
    let by = if has_ids {
        "by its ids"
    } else {
        "by its depth, as the convention has it; object.exr would show more"
    };
    let missed = shown.objects.iter().filter(|object| object.is_missed());
    if missed.clone().next().is_some() && shown.alike < LEAST_ALIKE {
        let text = format!("{:.1} % of the pixels agree, {by}", 100.0 * shown.alike);
        return vec![other(None, shown.alike, &text)];
    }
    let findings = missed.map(|object| {
        let text = format!(
            "{:.1} % of its {} pixels agree, {by}; needed: {} %",
            100.0 * object.shown,
            object.pixels,
            100.0 * LEAST_SHOWN
        );
        other(Some(&object.object), object.shown, &text)
    });
    findings.collect()
}
