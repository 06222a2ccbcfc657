//! A scene that an engine drew: a folder that `ingest` wrote.
//!
//! Frame, truth and ladder have the names and headers of rendered ones, so that a run finds them by
//! the hash of their inputs. A record next to them holds what only an engine's pictures have.

use std::path::{Path, PathBuf};

use scene::SceneId;

use crate::{Error, FilterChoice, RenderFile, hash_inputs, put, read_record, read_text};
use filters::{EXCLUSION, Layer};
use frame::{Alignment, Frame, Picture, Plane, Size, read_exr};
use serde::{Deserialize, Serialize};
use tracer::RenderSettings;

use super::exclusion::EXCLUSION_FILE;

/// Name of the record that marks a folder as ingested.
pub const INGESTED_FILE: &str = "ingested.json";
/// Name of the engine's own blurred picture in that folder.
pub const BLURRED: &str = "blurred.exr";
/// Version of the layout of the record.
pub const INGESTED_FORMAT: u32 = 3;
/// Reason why scores of motion mean nothing.
pub const NO_VELOCITY: &str = "the capture has no velocity, which says how objects move";
/// Halves of a truth, each a picture of the whole shutter.
const HALVES: u32 = 2;

/// A frame that an engine drew, with the truth of its sub-frames and its own blurred picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct IngestedScene {
    /// Version of the layout.
    pub format: u32,
    /// Program that ingested the capture.
    pub program: String,
    /// Name of the folder, and the engine as its variant: `railing@three.js_0.187.0`.
    #[serde(rename = "name")]
    pub id: SceneId,
    /// Engine and version.
    pub engine: String,
    /// Scene of the suite that the engine drew.
    pub scene: Option<SceneId>,
    /// Size of all pictures.
    pub size: Size,
    /// Time that the shutter is open, in frames.
    pub exposure: f64,
    /// Alignment of the shutter.
    pub alignment: Alignment,
    /// Number of sub-frames in the truth's mean; 0 without a truth.
    pub subframes: u32,
    /// 99th percentile of the moving pixels' motion between two sub-frames, in pixels.
    pub step: f64,
    /// Numbers of sub-frames in the ladder that errors are compared with.
    pub ladder: Vec<u32>,
    /// True if the folder has the engine's own blurred picture.
    pub has_picture: bool,
    /// Inputs of the frame that few filters read: `velocity_next`, `velocity_z`, `exclusion`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub further_inputs: Vec<String>,
    /// Inputs that most filters read and the capture does not have: `velocity`, `depth`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lacks: Vec<String>,
    /// Hash of the capture: the inputs of the record.
    #[serde(skip)]
    pub hash: String,
    /// The folder.
    #[serde(skip)]
    pub folder: PathBuf,
}

/// What a case or a picture takes from an ingested scene, wherever its folder is.
#[derive(Serialize)]
struct DrawnDescription<'a> {
    capture: &'a str,
    scene: &'a IngestedScene,
}

/// Engine that drew a frame and a truth, as a case names it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Drawn {
    /// Engine and version.
    pub engine: String,
    /// Scene of the suite that it drew.
    pub scene: Option<SceneId>,
    /// Number of sub-frames in the truth's mean.
    pub subframes: u32,
    /// 99th percentile of the moving pixels' motion between two of them, in pixels.
    pub step: f64,
}

impl Drawn {
    /// Describes the truth: `mean of 32 sub-frames that three.js 0.187.0 drew`.
    pub fn truth_text(&self) -> String {
        format!(
            "mean of {} sub-frames that {} drew",
            self.subframes,
            engine_name(&self.engine)
        )
    }
}

/// Layout of records before they held hashes of the files.
#[derive(Deserialize)]
struct OldRecord {
    format: u32,
}

impl IngestedScene {
    /// Returns whether `ingest` wrote a folder.
    pub fn is_in(folder: &Path) -> bool {
        folder.join(INGESTED_FILE).is_file()
    }

    /// Reads a folder that `ingest` wrote.
    ///
    /// # Errors
    /// The record is altered or of another format, or a file differs from the ingested one.
    pub fn read(folder: &Path) -> Result<Self, Error> {
        let path = folder.join(INGESTED_FILE);
        let text = read_text(&path)?;
        let refuse = |reason: String| {
            Err(Error::Refused(format!(
                "{}: {reason}; make the folder anew with `shuttertruth engine ingest`",
                path.display()
            )))
        };
        let other = |format| refuse(format!("has format {format}; allowed: {INGESTED_FORMAT}"));
        let Some(record) = read_record::<Self>(&path) else {
            return match serde_json::from_str::<OldRecord>(&text) {
                Ok(old) => other(old.format),
                Err(_) => refuse("no ingested capture, or an altered one".to_owned()),
            };
        };
        let scene = Self {
            hash: record.inputs,
            folder: folder.to_owned(),
            ..record.made
        };
        if scene.format != INGESTED_FORMAT {
            return other(scene.format);
        }
        if !has_ingested_name(&scene.id) {
            return refuse(format!(
                "name \"{}\"; allowed: names of a folder and of an engine, such as railing@three.js_0.187.0",
                scene.id
            ));
        }
        match record.altered.first() {
            Some(file) => Err(refuse_file(file)),
            None => Ok(scene),
        }
    }

    /// Writes the record of a folder after its `files`.
    pub fn write(&self, files: &[String]) -> Result<(), Error> {
        let path = self.folder.join(INGESTED_FILE);
        Ok(put(&path, self.hash.clone(), files, self)?)
    }

    /// Explains why a filter cannot run on the frame; none if it can.
    pub fn leaves_out(&self, choice: &FilterChoice) -> Option<String> {
        if choice.filter.alignment != self.alignment {
            return Some(format!(
                "of another shutter than the {} one that the engine drew",
                self.alignment
            ));
        }
        let is_there = |name: &&str| self.further_inputs.iter().any(|input| input == name);
        let further = choice.filter.further_inputs().into_iter();
        let mut further = further.map(Layer::name);
        let mut lacks = self.lacks.iter().map(String::as_str);
        let lacking = if let Some(name) = lacks.find(|name| choice.filter.reads(name)) {
            name
        } else if choice.filter.reads_camera(&choice.settings) {
            "the camera"
        } else {
            further.find(|name| !is_there(name))?
        };
        Some(format!("because the capture does not have {lacking}"))
    }

    /// Returns whether the motion of what it shows is not known.
    pub fn lacks_velocity(&self) -> bool {
        self.lacks.iter().any(|name| name == Layer::Velocity.name())
    }

    /// Names the engine as a case does.
    pub(crate) fn drawn(&self) -> Drawn {
        Drawn {
            engine: self.engine.clone(),
            scene: self.scene.clone(),
            subframes: self.subframes,
            step: self.step,
        }
    }

    /// Returns the settings of the scene's files. Two halves are too few replicates for intervals:
    /// sub-frames are no random samples, and a truth without some of them has holes.
    pub(crate) fn settings(&self, run: RenderSettings) -> RenderSettings {
        run.with_replicates(HALVES)
    }

    /// Returns the hash of the inputs of a file.
    pub(crate) fn content_hash(&self, file: RenderFile) -> String {
        match file {
            RenderFile::Truth(_) => frame::truth_hash(&self.hash, HALVES),
            RenderFile::Frame | RenderFile::Replicate(..) | RenderFile::Rung(..) => {
                self.hash.clone()
            }
        }
    }

    /// Hashes the description, wherever the folder is.
    pub(crate) fn description_hash(&self) -> String {
        hash_inputs(&DrawnDescription {
            capture: &self.hash,
            scene: self,
        })
    }

    /// Names the engine in one word, like filters: `three.js_0.187.0`.
    pub fn filter_name(&self) -> &str {
        self.id.variant.as_deref().unwrap_or_default()
    }

    /// Describes the pictures.
    pub fn exposes(&self) -> String {
        match &self.scene {
            Some(scene) => format!("what {} draws of {scene}", engine_name(&self.engine)),
            None => format!("what {} drew", engine_name(&self.engine)),
        }
    }

    /// Refuses a folder without a truth, since pictures cannot be measured without one.
    pub fn check_truth(&self) -> Result<(), Error> {
        match self.subframes {
            0 => Err(Error::Refused(format!(
                "{}: {} drew no sub-frames, and there is no truth to measure against; capture sub-frames and ingest them, or \
                 score its picture against a truth of ours: {}",
                self.folder.display(),
                engine_name(&self.engine),
                self.folder.join(BLURRED).display()
            ))),
            _ => Ok(()),
        }
    }

    /// Refuses a run with pictures of another size.
    pub fn check_size(&self, size: Size) -> Result<(), Error> {
        if self.size == size {
            Ok(())
        } else {
            Err(Error::Refused(format!(
                "{}: was drawn at {} pixels, and the pictures of this run are to have {size}; scenes of one run \
                 have one size: run it apart, or at its own size",
                self.folder.display(),
                self.size
            )))
        }
    }

    /// Reads the mask of what a blur leaves alone, as wide as a frame with a border; none if the
    /// capture had none.
    pub(crate) fn read_exclusion(&self, frame: &Frame) -> Result<Option<Plane>, Error> {
        if !self.further_inputs.iter().any(|name| name == EXCLUSION) {
            return Ok(None);
        }
        let mask = read_exr(&self.folder.join(EXCLUSION_FILE))?.plane(EXCLUSION)?;
        Ok(Some(mask.widened(frame.guard_band)))
    }

    /// Reads the engine's own blurred picture, with the frame's mattes.
    pub(crate) fn read_picture(&self, frame: &Frame) -> Result<Picture, Error> {
        let file = read_exr(&self.folder.join(BLURRED))?;
        file.expect_kind("output")?;
        Ok(Picture {
            color: file.color("")?,
            coverage: frame.coverage.clone(),
        })
    }
}

/// Refuses a file that is not the ingested one.
pub(crate) fn refuse_file(path: &Path) -> Error {
    Error::Refused(format!(
        "{}: was altered, or comes from a different capture than {INGESTED_FILE}; run `ingest` again",
        path.display()
    ))
}

/// Shortens an engine's name: removes what follows in brackets, such as its driver.
pub fn engine_name(engine: &str) -> &str {
    engine.split(" (").next().unwrap_or(engine).trim()
}

/// Makes one word of a text for folders, tables and addresses: `three.js 0.187.0` becomes
/// `three.js_0.187.0`.
pub fn name_in_one_word(text: &str) -> String {
    let letters = text.trim().chars().map(|letter| {
        let is_kept = letter.is_ascii_alphanumeric() || "._-+".contains(letter);
        if is_kept { letter } else { '_' }
    });
    letters.collect()
}

/// Returns whether a name can be an ingested scene's: it names the scene's folder, and
/// its engine names the picture's subfolder.
fn has_ingested_name(id: &SceneId) -> bool {
    let is_word = |word: &str| !word.is_empty() && name_in_one_word(word) == word;
    let is_engine = |engine: &String| is_word(engine) && !engine.starts_with('.');
    is_word(&id.name) && id.variant.as_ref().is_some_and(is_engine) && id.rate.is_none()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_lead_elsewhere_are_no_ingested_scenes() {
        let is_allowed = |name: &str| name.parse().is_ok_and(|id| has_ingested_name(&id));
        assert!(is_allowed("railing@three.js_0.187.0"));
        for name in [
            "plate@..",
            "plate@.",
            "plate@",
            "@engine",
            "plate",
            "../plate@engine",
            "plate/0001@engine",
            "plate@a@b",
        ] {
            assert!(!is_allowed(name), "{name}");
        }
        let word = name_in_one_word(" Godot 4.5 (Vulkan) ../up ");
        assert_eq!(word, "Godot_4.5__Vulkan__.._up");
    }
}
