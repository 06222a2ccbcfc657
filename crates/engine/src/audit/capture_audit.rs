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
use crate::audit::views::Views;
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

/// A scene as engines should draw it, prepared for audits of captures.
pub struct AuditedScene<'a> {
    scene: &'a Scene,
    /// Correct velocity, and what known mistakes make of it.
    pub expected: ExpectedMotion<'a>,
    views: Views,
}

impl<'a> AuditedScene<'a> {
    /// Traces the scene in the size of the captures.
    ///
    /// # Errors
    /// The scene's motion cannot be traced.
    pub fn trace(scene: &'a Scene, size: Size) -> Result<Self, Error> {
        Ok(Self {
            scene,
            expected: ExpectedMotion::trace(scene, size)?,
            views: Views::trace(scene, size)?,
        })
    }

    /// Compares a capture with the scene.
    ///
    /// # Errors
    /// The capture is of another instant.
    pub fn audit(&self, capture: &Capture) -> Result<CaptureAudit, Error> {
        check_instant(capture)?;
        let right = &self.expected.right;
        let names = self.scene.object_names();
        let pair = DepthPair::of(capture, right);
        let ids = capture.object_id.as_ref();
        let is_same =
            |at: usize| ids.is_none_or(|ids| ids.pixels[at] == right.object_id.pixels[at]);
        let clear = select_clear_pixels(right, names.len(), &is_same);
        let (wrong_depth, known) = pair.explain(&clear, &names, self.scene);
        let shows = |from: usize, at: usize| match ids {
            Some(ids) => ids.pixels[from] == right.object_id.pixels[at],
            None if from == at => known.pixels[at],
            None => pair.is_close(capture.depth.pixels[from], right.depth.pixels[at]),
        };
        let shown = Shown::compare(right, ids, &names, &shows);
        let regions = &shown.regions;
        let (velocity, wrong_velocity) =
            audit_velocity(&capture.velocity, &self.expected, regions, &names);
        let subject = self.find_subject(capture, &pair, &shown);
        let mut wrong = Vec::new();
        if subject.is_compared {
            wrong.extend(wrong_velocity);
            if !subject.is_view(Buffer::Depth) {
                let word = |defect| word_depth(defect, &shown, ids.is_some());
                wrong.extend(wrong_depth.into_iter().filter_map(word));
            }
            if !subject.is_view(Buffer::Color) {
                wrong.extend(audit_color(&capture.color, self.scene, regions, &names)?);
            }
        }
        Ok(CaptureAudit {
            scene: self.scene.id.to_string(),
            engine: capture.description.engine.clone(),
            size: capture.color.size(),
            has_ids: ids.is_some(),
            alike: shown.alike,
            shows_scene: subject.is_scene,
            velocity,
            depth: pair.compare(regions),
            compares_color: self.scene.is_unlit(),
            findings: [subject.missed, subject.views, wrong].concat(),
            objects: shown.objects,
        })
    }

    /// Finds out whether a capture shows another view or subject.
    fn find_subject(&self, capture: &Capture, pair: &DepthPair, shown: &Shown) -> Subject {
        let has_ids = capture.object_id.is_some();
        let mut subject = Subject {
            views: self.views.find_others(capture, pair),
            ..Subject::default()
        };
        let shows_other_view = subject.is_view(Buffer::Picture)
            || subject.is_view(Buffer::ObjectId)
            || subject.is_view(Buffer::Depth) && !has_ids;
        if !shows_other_view {
            subject.missed = word_missed(shown, has_ids);
        }
        subject.is_scene = !shows_other_view && subject.missed.is_empty();
        // All other differences follow from another view or another subject.
        let mut missed = subject.missed.iter();
        subject.is_compared = !shows_other_view && missed.all(|finding| finding.object.is_some());
        subject
    }
}

/// What a capture shows instead of the scene.
#[derive(Default)]
struct Subject {
    /// Objects that are missing, or the whole scene.
    missed: Vec<Defect>,
    /// Buffers of other frames, or upside down.
    views: Vec<Defect>,
    /// True if it shows the scene.
    is_scene: bool,
    /// True if it can be compared.
    is_compared: bool,
}

impl Subject {
    fn is_view(&self, buffer: Buffer) -> bool {
        self.views.iter().any(|finding| finding.buffer == buffer)
    }
}

/// Compares a capture with its scene; also returns the scene's correct velocity.
///
/// # Errors
/// The capture is of another instant, or the scene's motion cannot be traced.
pub fn audit_capture<'a>(
    capture: &Capture,
    scene: &'a Scene,
) -> Result<(CaptureAudit, ExpectedMotion<'a>), Error> {
    check_instant(capture)?;
    let audited = AuditedScene::trace(scene, capture.color.size())?;
    Ok((audited.audit(capture)?, audited.expected))
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
