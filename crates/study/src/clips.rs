//! The pictures of a run that a study shows.

use std::path::{Path, PathBuf};

use frame::{Alignment, Image, read_bounded, read_png};
use glob::Pattern;
use store::RenderFile;
use suite::{Error, Run, Sequence, SequenceFrame};
use tracer::SceneId;

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
    scene: SceneId,
    filter: String,
    alignment: Alignment,
    frames: Vec<SequenceFrame>,
}

/// Makes the study of a run with pictures below `folder`; returns it with the files of each clip: scene by scene the
/// sharp frames, then per shutter the truth and the filters.
///
/// # Errors
/// A pattern matches nothing, the filters of a shutter are too few or lack a scene, a picture is missing or has another size, or the
/// question is about the truth and nothing moves.
pub fn make_study(
    run: &Run,
    folder: &Path,
    choice: &StudyChoice,
) -> Result<(Study, Vec<ClipFiles>), Error> {
    let items = choose_items(run, choice)?;
    let scenes = list_once(items.iter().map(|item| item.scene.clone()));
    let mut shutters = Vec::new();
    let mut clips: Vec<Vec<ClipFiles>> = (scenes.iter())
        .map(|scene| vec![sharp_frames(&items, scene, folder)])
        .collect();
    for alignment in list_once(items.iter().map(|item| item.alignment)) {
        let own: Vec<&Item> = (items.iter())
            .filter(|item| item.alignment == alignment)
            .collect();
        let filters = list_once(own.iter().map(|item| item.filter.clone()));
        let truth = RenderFile::Truth(alignment).picture();
        let mut truth_hashes = Vec::new();
        for (scene, clips) in scenes.iter().zip(&mut clips) {
            let found = filters.iter().map(|filter| find_item(&own, scene, filter));
            let found = found.collect::<Result<Vec<&Item>, Error>>()?;
            let frames = &found[0].frames;
            clips.push(list_files(frames, |own| {
                folder.join(&own.scene).join(&truth)
            }));
            for item in &found {
                let output = |own: &SequenceFrame| folder.join(&own.folder).join("output.png");
                clips.push(list_files(&item.frames, output));
            }
            truth_hashes.push(frames.iter().map(|own| own.truth_hash.clone()).collect());
        }
        shutters.push(StudyShutter {
            alignment,
            filters,
            truth_hashes,
            blurred_scenes: Vec::new(),
        });
    }
    let mut study = Study {
        width: run.render.width,
        height: run.render.height,
        frames: run.frames,
        scenes,
        shutters,
        most_pairs: choice.most_pairs,
        pictures: String::new(),
    };
    study.pictures = hash_pictures(&study, &clips)?;
    find_blurred_scenes(&mut study, &clips)?;
    study.check().map_err(|reason| {
        Error::Usage(format!(
            "{}: the page {reason}; choose other scenes, filters or another number of pairs",
            folder.join("run.json").display()
        ))
    })?;
    Ok((study, clips.into_iter().flatten().collect()))
}

fn sharp_frames(items: &[Item], scene: &SceneId, folder: &Path) -> ClipFiles {
    let own = items.iter().find(|item| item.scene == *scene);
    let frames = &own.expect("the scene is an item's").frames;
    list_files(frames, |own| folder.join(&own.scene).join("frame.png"))
}

fn list_files(frames: &[SequenceFrame], file: impl Fn(&SequenceFrame) -> PathBuf) -> ClipFiles {
    frames.iter().map(file).collect()
}

impl Study {
    /// Number of clips of one scene: the sharp frames, and per shutter the truth and the filters.
    pub fn clips_per_scene(&self) -> usize {
        let clips = self.shutters.iter().map(|own| 1 + own.filters.len());
        1 + clips.sum::<usize>()
    }

    /// Upper limit on the bytes of one of its PNG files.
    pub fn most_picture_bytes(&self) -> u64 {
        (1 << 16) + 16 * u64::from(self.width) * u64::from(self.height)
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
    let choose = |option: &str, patterns: &[Pattern], name: fn(&Item) -> String| {
        let fits = |pattern: &Pattern| all.iter().any(|item| matches(pattern, &name(item)));
        match patterns.iter().find(|pattern| !fits(pattern)) {
            None => Ok(()),
            Some(pattern) => Err(Error::Usage(format!(
                "{option}: \"{pattern}\" fits nothing in the run; it has {}",
                list_once(all.iter().map(name)).join(", ")
            ))),
        }
    };
    choose("scenes", &choice.scenes, |item| item.scene.to_string())?;
    choose("filters", &choice.filters, |item| item.filter.clone())?;
    let fits = |patterns: &[Pattern], name: &str| {
        patterns.is_empty() || patterns.iter().any(|pattern| matches(pattern, name))
    };
    let is_chosen = |item: &Item| {
        fits(&choice.scenes, &item.scene.to_string()) && fits(&choice.filters, &item.filter)
    };
    Ok(all.into_iter().filter(is_chosen).collect())
}

/// Returns whether a pattern fits a name, or a filter's name without its preset.
fn matches(pattern: &Pattern, name: &str) -> bool {
    let own = name.split(':').next().unwrap_or(name);
    pattern.matches(name) || pattern.matches(own)
}

/// Lists the pictures of all filters; no references.
fn list_items(run: &Run) -> Vec<Item> {
    if !run.frames.is_one() {
        let own = run.sequences.iter().filter(|own| !own.is_reference);
        let item = |own: &Sequence| Item {
            scene: own.scene.clone(),
            filter: own.name.clone(),
            alignment: own.alignment,
            frames: own.frames.clone(),
        };
        return own.map(item).collect();
    }
    let own = run.cases.iter().filter(|case| !case.is_reference);
    own.map(|case| Item {
        scene: case.scene.clone(),
        filter: case.name(),
        alignment: case.alignment,
        frames: vec![SequenceFrame {
            scene: case.scene.folder(),
            folder: case.folder.clone(),
            truth_hash: case.truth_hash.clone(),
            error: None,
            flicker: None,
        }],
    })
    .collect()
}

/// Finds the pictures of a filter on a scene. Every filter needs a clip of every scene, or scales would cover different scenes.
fn find_item<'a>(items: &[&'a Item], scene: &SceneId, filter: &str) -> Result<&'a Item, Error> {
    let found = (items.iter()).find(|item| item.scene == *scene && item.filter == filter);
    found.copied().ok_or_else(|| {
        Error::Usage(format!(
            "{filter} has no picture on {scene}: every filter needs one on every scene; run it there, or leave one of both out"
        ))
    })
}

fn hash_pictures(study: &Study, clips: &[Vec<ClipFiles>]) -> Result<String, Error> {
    let mut hasher = blake3::Hasher::new();
    for path in clips.iter().flatten().flatten() {
        let bytes = read_bounded(path, study.most_picture_bytes())?;
        hasher.update(&(bytes.len() as u64).to_le_bytes());
        hasher.update(&bytes);
    }
    Ok(hasher.finalize().to_hex().to_string())
}

/// Finds the scenes on which truth and sharp frame differ by at least half the largest such difference.
fn find_blurred_scenes(study: &mut Study, clips: &[Vec<ClipFiles>]) -> Result<(), Error> {
    let size = (study.width, study.height);
    for (shutter, truth) in study.truth_clips().into_iter().enumerate() {
        let differences = (clips.iter())
            .map(|own| difference(&own[0], &own[truth], size))
            .collect::<Result<Vec<f64>, Error>>()?;
        let largest = differences.iter().fold(0.0_f64, |most, own| most.max(*own));
        study.shutters[shutter].blurred_scenes = (0..differences.len())
            .filter(|scene| largest > 0.0 && differences[*scene] >= largest / 2.0)
            .collect();
    }
    Ok(())
}

/// Sums the absolute differences of two clips, in display values.
fn difference(one: &ClipFiles, other: &ClipFiles, size: (u32, u32)) -> Result<f64, Error> {
    let mut sum = 0.0;
    for (one, other) in one.iter().zip(other) {
        let [one, other] = [read_picture(one, size)?, read_picture(other, size)?];
        let [one, other] = [&one, &other].map(|own| own.pixels.as_flattened());
        let values = one.iter().zip(other);
        sum += values.map(|(a, b)| f64::from((a - b).abs())).sum::<f64>();
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
