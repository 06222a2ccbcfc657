//! Scores of a picture against a reference picture, of which nothing else need be known.

use frame::{
    Alignment, AtInstant, Display, FAR_DEPTH, Frame, FrameOptions, Image, Picture, Plane,
    Provenance, Raster, Replicate, Reprojection, Shutter, ShutterProfile, Support, Truth,
    VelocityKind,
};
use metrics::{
    EquivalentScores, FrozenScores, ImageScores, LabelScores, Measured, Measurement, Metric,
    ProbeScores, Reference, Regions, Scores, SkillScores,
};

use super::scores::group_by_reason;
use crate::{Error, PROGRAM};

const NEEDS_MOTION: &str = "needs --velocity, which says what moves";
const NEEDS_FRAME: &str =
    "needs --velocity, and --frame, the sharp picture that the blur was given";
const NEEDS_MATTES: &str = "needs --velocity, and --mattes, which say what shows each object";
const NEEDS_LINEAR: &str = "needs two scene-linear pictures, OpenEXR or HDR";
const NEEDS_TRUTH: &str = "needs --truth and --frame, as `run` and `truths render` write them for a scene and `engine ingest` for \
                           an engine's sub-frames";
const NEEDS_FILTER: &str = "needs the filter itself: `run --filter`";

/// Shutter of a reference: longer than most, and on both sides, since nobody states the real one.
const EXPOSURE: f64 = 1.0;

/// A picture, the reference that it is compared with, and what is known of them. All rasters have
/// one size.
pub struct PicturePair<'a> {
    /// What the picture should be: scene-linear radiance.
    pub reference: &'a Image,
    /// The picture.
    pub image: &'a Image,
    /// The sharp picture that the blur was given, if known.
    pub frame: Option<&'a Image>,
    /// Pixels where anything moves while the shutter is open, if known.
    pub moving: Option<&'a Raster<bool>>,
    /// Mattes of both pictures, if known.
    pub mattes: Option<&'a Mattes>,
    /// Exposures at which the pictures are compared.
    pub display: Display,
    /// True if one of them is a picture of a display: nothing in it is brighter than its white.
    pub display_referred: bool,
}

/// Shares of each pixel that both pictures give to each object.
pub struct Mattes {
    /// Names, the background first.
    pub objects: Vec<String>,
    /// Mattes of the reference, per object.
    pub reference: Vec<Plane>,
    /// Mattes of the picture, per object.
    pub image: Vec<Plane>,
}

/// Scores of a picture against a reference.
pub struct ComparedPictures {
    /// Scores and error maps of the picture. Scores that need more than is known are not
    /// applicable; the reason is what they need.
    pub measurement: Measurement,
    /// Scores of no blur: the sharp picture against the reference; none if that is not known.
    pub no_blur: Option<Scores>,
    /// Regions that scores are pooled over; those of motion mean nothing if it is not known.
    pub regions: Regions,
}

/// Returns the shutter that the moving pixels of a reference are marked with.
pub fn reference_shutter() -> Shutter {
    let shutter = Alignment::Centred.shutter(EXPOSURE);
    shutter.expect("a whole frame is an exposure")
}

/// Compares a picture with a reference.
///
/// # Errors
/// A picture is too large, or holds numbers that cannot be compared.
pub fn compare_pictures(pair: &PicturePair) -> Result<ComparedPictures, Error> {
    let (frame, truth) = (make_frame(pair), make_truth(pair)?);
    let reference = Reference::new(&frame, &truth, None, &pair.display.into())?;
    let mut measurement = reference.measure(&Picture {
        color: pair.image.clone(),
        coverage: coverage(pair, |mattes| &mattes.image),
    })?;
    take_out_unknown(&mut measurement.scores, pair);
    let mut no_blur = None;
    if pair.frame.is_some() {
        let mut scores = reference.measure(&frame.picture())?.scores;
        take_out_unknown(&mut scores, pair);
        no_blur = Some(scores);
    }
    Ok(ComparedPictures {
        measurement,
        no_blur,
        regions: reference.regions,
    })
}

/// Lists the scores that two pictures do not have by what they need.
pub fn missing_in_pair(scores: &Scores) -> Vec<(String, Vec<Metric>)> {
    let all = Metric::all();
    // Nobody asks two pictures for scores of a sequence or of a common shutter.
    let of_one = all
        .into_iter()
        .filter(|metric| !matches!(metric, Metric::Sequence(_) | Metric::CommonFlip));
    group_by_reason(of_one.filter_map(|metric| {
        let reason = match (metric, scores.get(metric)) {
            (_, Measured::Score(_)) => return None,
            (Metric::Object(_) | Metric::OccluderContamination | Metric::Bleed, _) => {
                NEEDS_TRUTH.to_owned()
            }
            (_, Measured::NotApplicable { reason }) => reason,
        };
        Some((metric, reason))
    }))
}

/// Replaces scores that would mean nothing by what they need.
fn take_out_unknown(scores: &mut Scores, pair: &PicturePair) {
    for region in [&mut scores.knowable, &mut scores.unknowable] {
        *region = ImageScores::not_applicable(NEEDS_TRUTH);
    }
    scores.frozen = FrozenScores::not_applicable(NEEDS_TRUTH);
    scores.skill = SkillScores::not_applicable(NEEDS_TRUTH);
    scores.equivalent_subframes = EquivalentScores::not_applicable(NEEDS_TRUTH);
    scores.probes = ProbeScores::not_applicable(NEEDS_FILTER);
    // Where an object was at the instant is not known.
    scores.objects.clear();
    if pair.moving.is_none() {
        for region in [&mut scores.moving, &mut scores.support, &mut scores.still] {
            *region = ImageScores::not_applicable(NEEDS_MOTION);
        }
    }
    if pair.moving.is_none() || pair.frame.is_none() {
        scores.static_contamination = Measured::not_applicable(NEEDS_FRAME);
    }
    if pair.moving.is_none() || pair.mattes.is_none() {
        scores.label_total_variation = LabelScores::not_applicable(NEEDS_MATTES);
    }
    if pair.display_referred {
        for region in [
            &mut scores.moving,
            &mut scores.support,
            &mut scores.still,
            &mut scores.full,
        ] {
            if region.flip.value().is_some() {
                region.flip_hdr = Measured::not_applicable(NEEDS_LINEAR);
            }
        }
    }
}

fn provenance() -> Provenance {
    Provenance {
        scene: "two pictures".to_owned(),
        program: PROGRAM.to_owned(),
        samples_per_pixel: 1,
        replicates: 1,
        traversal: "none".to_owned(),
        engine: Some("a reference picture".to_owned()),
        ..Provenance::default()
    }
}

fn objects(pair: &PicturePair) -> Vec<String> {
    let named = pair.mattes.map(|mattes| mattes.objects.clone());
    named.unwrap_or_else(|| vec!["background".to_owned()])
}

/// Copies the mattes of one picture; without any, the background has all.
fn coverage(pair: &PicturePair, of: impl Fn(&Mattes) -> &Vec<Plane>) -> Vec<Plane> {
    let all = || vec![pair.reference.map(|_| 1.0)];
    pair.mattes.map_or_else(all, |mattes| of(mattes).clone())
}

fn make_frame(pair: &PicturePair) -> Frame {
    Frame {
        provenance: provenance(),
        exposure: EXPOSURE,
        frames_per_second: None,
        options: FrameOptions {
            velocity: VelocityKind::PreviousFrame,
            ..FrameOptions::default()
        },
        guard_band: 0,
        reprojection: Reprojection::STILL,
        camera: None,
        display: pair.display,
        objects: objects(pair),
        color: pair.frame.unwrap_or(pair.reference).clone(),
        velocity: pair.reference.map(|_| [0.0; 2]),
        velocity_next: None,
        velocity_z: None,
        depth: pair.reference.map(|_| FAR_DEPTH),
        object_id: pair.reference.map(|_| 0),
        coverage: coverage(pair, |mattes| &mattes.reference),
        samples: None,
    }
}

/// Makes a truth without noise: both halves are the reference.
fn make_truth(pair: &PicturePair) -> Result<Truth, Error> {
    let (width, height) = (pair.reference.width, pair.reference.height);
    let still = || Raster::filled(width, height, false);
    let coverage = coverage(pair, |mattes| &mattes.reference);
    let objects = objects(pair);
    let half = |index| Replicate {
        provenance: provenance(),
        index,
        shutter: reference_shutter(),
        shutter_profile: ShutterProfile::default(),
        alignment: Alignment::Centred,
        moving: vec![false; objects.len()],
        objects: objects.clone(),
        picture: Picture {
            color: pair.reference.clone(),
            coverage: coverage.clone(),
        },
        at_instant: AtInstant::unknown(width, height),
        samples: Plane::filled(width, height, 1.0),
        support: Support {
            seen: (coverage.iter())
                .map(|matte| matte.map(|share| *share > 0.0))
                .collect(),
            moving: pair.moving.cloned().unwrap_or_else(still),
            unknowable: still(),
        },
    };
    Ok(Truth::of(&[half(0), half(1)])?)
}
