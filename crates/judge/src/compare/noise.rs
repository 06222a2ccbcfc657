//! Noise of a change between runs: both pictures against the truth without each pair of its
//! replicates.

use std::path::{Path, PathBuf};

use frame::{FileError, Frame, Ladder, Picture, Replicate, Truth, read_exr};
use measure::{Error, Groups, MIN_REPLICATES, RenderFile, SHARP, StoredRun, sharp_picture};
use metrics::{
    ImageMetric, LabelMetric, Metric, ObjectMetric, Reference, Region, Scores, Sharp, SkillMetric,
    jackknife, make_oracle,
};
use tracer::{Progress, Watch};

use crate::compare::change::{Change, Uncertainty};
use crate::compare::pairing::Pair;

/// Compared metrics.
const METRICS: [Metric; 9] = [
    Metric::Image(ImageMetric::Flip, Region::Moving),
    Metric::Skill(SkillMetric::Flip),
    Metric::Image(ImageMetric::Psnr, Region::Moving),
    Metric::Object(ObjectMetric::LateralGrowth),
    Metric::Object(ObjectMetric::RowLoss),
    Metric::Object(ObjectMetric::BleedLateral),
    Metric::Object(ObjectMetric::BleedLeading),
    Metric::Object(ObjectMetric::BleedTrailing),
    Metric::Label(LabelMetric::Mean),
];

/// Measures the change of every score of every pair.
pub fn measure_changes(
    sides: [&StoredRun; 2],
    pairs: &[Pair],
    watch: Watch,
) -> Result<Vec<Change>, Error> {
    let mut changes = Vec::new();
    let mut shared: Option<(String, Option<TruthParts>)> = None;
    for (done, pair) in pairs.iter().enumerate() {
        Progress::report(watch, done, pairs.len())?;
        let differs = (METRICS.iter())
            .any(|metric| pair.first.scores.get(*metric) != pair.second.scores.get(*metric));
        let mut scores = Vec::new();
        if differs {
            let hash = &pair.first.truth_hash;
            // Pairs of one truth follow one another.
            if shared.as_ref().is_none_or(|(previous, _)| previous != hash) {
                shared = Some((hash.clone(), TruthParts::read(sides, pair)?));
            }
            if let Some((_, Some(parts))) = &shared {
                scores = parts.compare(sides, pair)?;
            }
        }
        changes.extend(METRICS.iter().filter_map(|metric| {
            let weight = pair.first.weight(*metric, &sides[0].run.cases)?;
            Change::new(pair, *metric, weight, find_uncertainty(&scores, *metric))
        }));
    }
    Ok(changes)
}

/// A truth as a whole and without each pair of its replicates, with the frame of its scene.
struct TruthParts {
    frame: Frame,
    /// Sharp picture of the shutter's middle; none if its file is missing.
    sharp: Option<Sharp>,
    /// The one-frame oracle's picture of the frame.
    oracle: Picture,
    /// The whole truth, then the truth without each pair.
    truths: Vec<Truth>,
}

impl TruthParts {
    /// Reads the parts from the first run that still has all files of the truth; none if neither
    /// has.
    fn read(sides: [&StoredRun; 2], pair: &Pair) -> Result<Option<Self>, Error> {
        for side in sides {
            let folder = side.folder().join(pair.first.scene.folder());
            if let Some(parts) = Self::read_below(&folder, pair, side.run.render.replicates)? {
                return Ok(Some(parts));
            }
        }
        Ok(None)
    }

    fn read_below(folder: &Path, pair: &Pair, count: u32) -> Result<Option<Self>, Error> {
        let alignment = pair.first.alignment;
        let path = |file: RenderFile| folder.join(file.path());
        let truth = path(RenderFile::Truth(alignment));
        let frame = path(RenderFile::Frame);
        let replicates: Vec<PathBuf> = (0..count)
            .map(|index| path(RenderFile::Replicate(alignment, index)))
            .collect();
        let mut files = [&truth, &frame].into_iter().chain(&replicates);
        if !files.all(|file| file.is_file()) || count < MIN_REPLICATES {
            return Ok(None);
        }
        let whole = Truth::read(&truth)?;
        if whole.provenance.content_hash != pair.first.truth_hash {
            return Ok(None);
        }
        let replicates: Vec<Replicate> =
            (replicates.iter().map(|path| Replicate::read(path))).collect::<Result<_, _>>()?;
        let frame = Frame::read(&frame)?;
        let oracle = make_oracle(&frame, &whole);
        let frame = frame.cropped();
        let rung = path(RenderFile::Rung(alignment, SHARP));
        let read = || Ok::<_, FileError>(Ladder::read_rung(&rung, SHARP)?.rungs.remove(0));
        let sharp = sharp_picture(&frame, &whole, read).ok();
        let mut truths = vec![whole];
        let groups = Groups::of(count);
        for group in groups.list() {
            truths.push(groups.truth_without(group, &replicates)?);
        }
        Ok(Some(Self {
            sharp,
            oracle,
            frame,
            truths,
        }))
    }

    /// Scores both pictures against each of the truths; against none if one picture is missing.
    fn compare(&self, sides: [&StoredRun; 2], pair: &Pair) -> Result<Vec<[Scores; 2]>, Error> {
        let files = pair.files(sides, "output.exr");
        if !files.iter().all(|file| file.is_file()) {
            return Ok(Vec::new());
        }
        let [first, second] = files.map(|file| read_picture(&file, &self.truths[0].objects));
        let (first, second) = (first?, second?);
        let viewing = self.frame.display.into();
        // The first truth is the whole one.
        let scores = |(index, truth): (usize, &Truth)| {
            let mut reference = Reference::new(&self.frame, truth, None, &viewing)?;
            let sharp = self.sharp.as_ref().map(|sharp| match index.checked_sub(1) {
                None => sharp.clone(),
                Some(group) => sharp.without(group),
            });
            if let Some(sharp) = &sharp {
                reference = reference.with_ends(sharp, &self.oracle)?;
            }
            let [first, second] = [&first, &second].map(|picture| reference.measure(picture));
            Ok([first?.scores, second?.scores])
        };
        self.truths.iter().enumerate().map(scores).collect()
    }
}

/// Reads a filter's picture.
fn read_picture(path: &Path, objects: &[String]) -> Result<Picture, Error> {
    let mut file = read_exr(path)?;
    file.expect_finite()?;
    Ok(Picture::take_from(&mut file, "", objects)?)
}

/// Returns the uncertainty of a score's change, from both pictures' scores against a truth and its
/// parts; none if the score does not apply to one of them.
fn find_uncertainty(scores: &[[Scores; 2]], metric: Metric) -> Option<Uncertainty> {
    let interval = |value: &dyn Fn(&[Scores; 2]) -> Option<f64>| {
        let values: Vec<f64> = scores.iter().map(value).collect::<Option<_>>()?;
        let (whole, without) = values.split_first()?;
        jackknife(*whole, without)
    };
    let score = |side: usize| move |scores: &[Scores; 2]| scores[side].get(metric).value();
    let change = interval(&|scores| {
        let badness = |side| Some(metric.ideal().badness(score(side)(scores)?));
        Some(badness(1)? - badness(0)?)
    })?;
    Some(Uncertainty {
        interval: [change.low, change.high],
        standard_error: change.standard_error,
        estimates: [interval(&score(0))?.center, interval(&score(1))?.center],
    })
}
