//! The pictures of a run that a study shows.

use std::path::{Path, PathBuf};

use frame::{Alignment, Image, read_bounded, read_png};
use glob::Pattern;
use store::RenderFile;
use suite::{Error, Run};

use crate::study::{Study, StudyShutter};

/// What to ask about.
#[derive(Clone, Debug)]
pub struct StudyChoice {
    /// Patterns of scenes, such as `fan`; empty for all.
    pub scenes: Vec<Pattern>,
    /// Patterns of filters, such as `kino:*`; empty for all.
    pub filters: Vec<Pattern>,
    /// Largest number of pairs in a session.
    pub most_pairs: usize,
}

/// Paths of the pictures of a clip, one per frame.
pub type ClipFiles = Vec<PathBuf>;

/// A filter's pictures on one scene.
struct Item {
    scene: String,
    filter: String,
    alignment: Alignment,
    frames: Vec<ItemFrame>,
}

/// One picture of them.
struct ItemFrame {
    scene: PathBuf,
    folder: PathBuf,
    truth_hash: String,
}

/// Makes the study of a run whose pictures lie below `folder`; returns it with the files of each clip: scene by scene the
/// sharp frames, then per shutter the truth and the filters.
///
/// # Errors
/// A pattern fits nothing, the filters of a shutter are too few or lack a scene, a picture is missing or has another size, or the truth is
/// asked for and nothing moves.
pub fn make_study(
    run: &Run,
    folder: &Path,
    choice: &StudyChoice,
) -> Result<(Study, Vec<ClipFiles>), Error> {
    let items = choose_items(run, choice)?;
    let scenes = list_once(items.iter().map(|item| item.scene.clone()));
    let mut shutters = Vec::new();
    let mut clips: Vec<Vec<ClipFiles>> = Vec::new();
    for scene in &scenes {
        let own = items
            .iter()
            .find(|item| item.scene == *scene)
            .expect("it is that of an item");
        let sharp = own
            .frames
            .iter()
            .map(|frame| folder.join(&frame.scene).join("frame.png"));
        clips.push(vec![sharp.collect()]);
    }
    for alignment in list_once(items.iter().map(|item| item.alignment)) {
        let own: Vec<&Item> = items
            .iter()
            .filter(|item| item.alignment == alignment)
            .collect();
        let filters = list_once(own.iter().map(|item| item.filter.clone()));
        let mut truth_hashes = Vec::new();
        for (scene, clips) in scenes.iter().zip(&mut clips) {
            let found = filters.iter().map(|filter| find_item(&own, scene, filter));
            let found = found.collect::<Result<Vec<&Item>, Error>>()?;
            let frames = &found[0].frames;
            let truth = RenderFile::Truth(alignment).picture();
            clips.push(
                frames
                    .iter()
                    .map(|frame| folder.join(&frame.scene).join(&truth))
                    .collect(),
            );
            for item in &found {
                let files = item.frames.iter().map(|frame| folder.join(&frame.folder));
                clips.push(files.map(|own| own.join("output.png")).collect());
            }
            truth_hashes.push(
                frames
                    .iter()
                    .map(|frame| frame.truth_hash.clone())
                    .collect(),
            );
        }
        shutters.push(StudyShutter {
            alignment,
            filters,
            truth_hashes,
            telling_scenes: Vec::new(),
        });
    }
    let mut study = Study {
        width: run.render.width,
        height: run.render.height,
        frames: run.frames,
        scenes,
        shutters,
        most_pairs: choice.most_pairs,
        pictures: hash_pictures(&clips, run)?,
    };
    find_telling_scenes(&mut study, &clips)?;
    study.check().map_err(|reason| {
        Error::Usage(format!(
            "{}: the page {reason}; choose other scenes, filters or another number of pairs",
            folder.join("run.json").display()
        ))
    })?;
    Ok((study, clips.into_iter().flatten().collect()))
}

impl Study {
    /// Number of clips of one scene: the sharp frames, and per shutter the truth and the filters.
    pub fn clips_per_scene(&self) -> usize {
        let clips = self
            .shutters
            .iter()
            .map(|shutter| 1 + shutter.filters.len());
        1 + clips.sum::<usize>()
    }

    /// Upper limit on the bytes of one of its pictures.
    pub fn most_picture_bytes(&self) -> u64 {
        most_bytes(self.width, self.height)
    }

    /// Numbers of the truths' clips on the first scene, by shutter. The filters follow each.
    pub fn truth_clips(&self) -> Vec<usize> {
        let starts = self.shutters.iter().scan(1, |next, shutter| {
            let own = *next;
            *next += 1 + shutter.filters.len();
            Some(own)
        });
        starts.collect()
    }
}

/// Lists the filters' pictures that were chosen, in the order of the run.
fn choose_items(run: &Run, choice: &StudyChoice) -> Result<Vec<Item>, Error> {
    let all = list_items(run);
    let choose = |option: &str, patterns: &[Pattern], name: fn(&Item) -> &String| {
        let fits = |pattern: &Pattern| all.iter().any(|item| matches(pattern, name(item)));
        match patterns.iter().find(|pattern| !fits(pattern)) {
            None => Ok(()),
            Some(pattern) => Err(Error::Usage(format!(
                "{option}: \"{pattern}\" fits nothing in the run; it has {}",
                list_once(all.iter().map(|item| name(item).as_str())).join(", ")
            ))),
        }
    };
    choose("scenes", &choice.scenes, |item| &item.scene)?;
    choose("filters", &choice.filters, |item| &item.filter)?;
    let fits = |patterns: &[Pattern], name: &str| {
        patterns.is_empty() || patterns.iter().any(|pattern| matches(pattern, name))
    };
    let chosen = all
        .into_iter()
        .filter(|item| fits(&choice.scenes, &item.scene) && fits(&choice.filters, &item.filter));
    Ok(chosen.collect())
}

/// Tells whether a pattern fits a name, or a filter's name without its preset.
fn matches(pattern: &Pattern, name: &str) -> bool {
    let own = name.split(':').next().unwrap_or(name);
    pattern.matches(name) || pattern.matches(own)
}

/// Lists the pictures of all filters; no references.
fn list_items(run: &Run) -> Vec<Item> {
    if !run.frames.is_one() {
        let own = run
            .sequences
            .iter()
            .filter(|sequence| !sequence.is_reference);
        return own
            .map(|sequence| Item {
                scene: sequence.scene.to_string(),
                filter: sequence.filter.clone(),
                alignment: sequence.alignment,
                frames: (sequence.frames.iter())
                    .map(|frame| ItemFrame {
                        scene: frame.scene.clone(),
                        folder: frame.folder.clone(),
                        truth_hash: frame.truth_hash.clone(),
                    })
                    .collect(),
            })
            .collect();
    }
    let own = run.cases.iter().filter(|case| !case.is_reference);
    own.map(|case| Item {
        scene: case.scene.to_string(),
        filter: case.name(),
        alignment: case.alignment,
        frames: vec![ItemFrame {
            scene: case.scene.folder(),
            folder: case.folder.clone(),
            truth_hash: case.truth_hash.clone(),
        }],
    })
    .collect()
}

/// Finds the pictures of a filter on a scene: every filter has a clip of every scene, or the scale would be of other scenes for some.
fn find_item<'a>(items: &[&'a Item], scene: &str, filter: &str) -> Result<&'a Item, Error> {
    let mut found = items
        .iter()
        .filter(|item| item.scene == scene && item.filter == filter);
    found.next().copied().ok_or_else(|| {
        Error::Usage(format!(
            "{filter} has no picture on {scene}: every filter needs one on every scene; run it there, or leave one of both out"
        ))
    })
}

/// Hashes all pictures, and refuses those of another size than the run's.
fn hash_pictures(clips: &[Vec<ClipFiles>], run: &Run) -> Result<String, Error> {
    let (width, height) = (run.render.width, run.render.height);
    let mut hasher = blake3::Hasher::new();
    for path in clips.iter().flatten().flatten() {
        let bytes = read_bounded(path, most_bytes(width, height))?;
        hasher.update(&(bytes.len() as u64).to_le_bytes());
        hasher.update(&bytes);
    }
    Ok(hasher.finalize().to_hex().to_string())
}

/// Upper limit on the bytes of a PNG of this size.
fn most_bytes(width: u32, height: u32) -> u64 {
    (1 << 16) + 16 * u64::from(width) * u64::from(height)
}

/// Finds the scenes on which truth and sharp frame differ by half as much as where they differ most, or by more.
fn find_telling_scenes(study: &mut Study, clips: &[Vec<ClipFiles>]) -> Result<(), Error> {
    let size = (study.width, study.height);
    for (shutter, truth) in study.truth_clips().into_iter().enumerate() {
        let differences = clips
            .iter()
            .map(|own| difference(&own[0], &own[truth], size));
        let differences = differences.collect::<Result<Vec<f64>, Error>>()?;
        let largest = differences.iter().fold(0.0_f64, |most, own| most.max(*own));
        let telling = (0..differences.len())
            .filter(|scene| largest > 0.0 && differences[*scene] >= largest / 2.0);
        study.shutters[shutter].telling_scenes = telling.collect();
    }
    Ok(())
}

/// Mean absolute difference between two clips, in display values.
fn difference(one: &ClipFiles, other: &ClipFiles, size: (u32, u32)) -> Result<f64, Error> {
    let mut sum = 0.0;
    for (one, other) in one.iter().zip(other) {
        let [one, other] = [read_picture(one, size)?, read_picture(other, size)?];
        let pixels = one
            .pixels
            .as_flattened()
            .iter()
            .zip(other.pixels.as_flattened());
        sum += pixels.map(|(a, b)| f64::from((a - b).abs())).sum::<f64>();
    }
    Ok(sum)
}

fn read_picture(path: &Path, (width, height): (u32, u32)) -> Result<Image, Error> {
    let picture = read_png(path)?;
    match (picture.width, picture.height) == (width, height) {
        true => Ok(picture),
        false => Err(Error::Usage(format!(
            "{}: has {}x{} pixels, those of the run have {width}x{height}; run again",
            path.display(),
            picture.width,
            picture.height
        ))),
    }
}

/// Lists each name once, in order.
fn list_once<T: PartialEq>(names: impl Iterator<Item = T>) -> Vec<T> {
    let mut listed: Vec<T> = Vec::new();
    for name in names {
        if !listed.contains(&name) {
            listed.push(name);
        }
    }
    listed
}
