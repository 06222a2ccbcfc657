//! A scene that an engine drew: a folder that `ingest` wrote.

use std::path::{Path, PathBuf};

use filters::EXCLUSION;
use frame::{Alignment, Frame, Ladder, Picture, Plane, Provenance, Truth, read_bounded, read_exr};
use scene::SceneId;
use serde::{Deserialize, Serialize};
use store::{MAX_TAKEN_BYTES, RenderFile, read_text};

use crate::inputs::border::wide;
use crate::render::exclusion::EXCLUSION_FILE;
use crate::{Error, FilterChoice};

/// Name of the file that marks a folder as ingested.
pub const INGESTED_FILE: &str = "ingested.json";
/// Name of the engine's own blurred picture in that folder.
pub const BLURRED: &str = "blurred.exr";
/// Version of the layout of the file.
pub const INGESTED_FORMAT: u32 = 2;
/// Halves of a truth, each a picture of the whole shutter.
const HALVES: u32 = 2;

/// A frame that an engine drew, with the truth of its sub-frames and its own blurred picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EngineScene {
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
    /// Columns and rows of all pictures.
    pub size: [u32; 2],
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
    /// Hash of the capture.
    pub hash: String,
    /// The folder.
    #[serde(skip)]
    pub folder: PathBuf,
}

impl EngineScene {
    /// Returns whether `ingest` wrote a folder.
    pub fn is_in(folder: &Path) -> bool {
        folder.join(INGESTED_FILE).is_file()
    }

    /// Reads a folder that `ingest` wrote.
    pub fn read(folder: &Path) -> Result<Self, Error> {
        let path = folder.join(INGESTED_FILE);
        let reason = match serde_json::from_str::<Self>(&read_text(&path)?) {
            Err(error) => format!("no ingested capture: {error}"),
            Ok(scene) if scene.format != INGESTED_FORMAT => {
                format!("has format {}; allowed: {INGESTED_FORMAT}", scene.format)
            }
            Ok(scene) if !is_engine_scene(&scene.id) => format!(
                "name \"{}\"; allowed: names of a folder and of an engine, such as railing@three.js_0.187.0",
                scene.id
            ),
            Ok(mut scene) => {
                scene.folder = folder.to_owned();
                return Ok(scene);
            }
        };
        Err(Error::Usage(format!(
            "{}: {reason}; make the folder anew with `shuttertruth engine ingest`",
            path.display()
        )))
    }

    /// Finds what a filter reads and the frame lacks.
    pub fn find_lacking(&self, choice: &FilterChoice) -> Option<&'static str> {
        let is_there = |name: &&str| self.further_inputs.iter().any(|input| input == name);
        let mut further = choice.filter.further_inputs().into_iter();
        if choice.filter.reads_camera(&choice.settings) {
            Some("the camera")
        } else {
            further.find(|name| !is_there(name))
        }
    }

    /// Returns the content hash of the truth.
    pub(crate) fn truth_hash(&self) -> String {
        frame::truth_hash(&self.hash, HALVES)
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
            0 => Err(Error::Usage(format!(
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
    pub fn check_size(&self, (width, height): (u32, u32)) -> Result<(), Error> {
        if self.size == [width, height] {
            Ok(())
        } else {
            Err(Error::Usage(format!(
                "{}: was drawn at {}x{} pixels, and the pictures of this run are to have {width}x{height}; scenes of one run \
                 have one size: run it apart, or at its own size",
                self.folder.display(),
                self.size[0],
                self.size[1]
            )))
        }
    }

    /// Reads the frame, and copies its file into a scene's folder of a run.
    pub(crate) fn copy_frame(&self, folder: &Path) -> Result<Frame, Error> {
        let file = RenderFile::Frame;
        let frame = Frame::read(&self.copy(file, folder)?)?;
        self.check_file(file, &frame.provenance, &self.hash, frame.size())?;
        Ok(frame)
    }

    /// Reads the truth, and copies its file and its ladder's into a scene's folder of a run.
    pub(crate) fn copy_truth(&self, folder: &Path) -> Result<Truth, Error> {
        for rung in &self.ladder {
            self.copy(RenderFile::Rung(self.alignment, *rung), folder)?;
        }
        let file = RenderFile::Truth(self.alignment);
        let truth = Truth::read(&self.copy(file, folder)?)?;
        self.check_file(file, &truth.provenance, &self.truth_hash(), truth.size())?;
        Ok(truth)
    }

    /// Refuses a file that changed since it was ingested.
    fn check_file(
        &self,
        file: RenderFile,
        provenance: &Provenance,
        hash: &str,
        (width, height): (u32, u32),
    ) -> Result<(), Error> {
        if provenance.content_hash == hash && self.size == [width, height] {
            Ok(())
        } else {
            Err(Error::Usage(format!(
                "{}: comes from a different capture than {INGESTED_FILE}; run `ingest` again",
                self.folder.join(file.path()).display()
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
        Ok(Some(wide(&mask, frame.guard_band)))
    }

    /// Reads a rung of the ladder from a scene's folder of a run.
    pub(crate) fn read_rung(&self, folder: &Path, subframes: u32) -> Result<Ladder, Error> {
        let file = RenderFile::Rung(self.alignment, subframes);
        Ok(Ladder::read_rung(&folder.join(file.path()), subframes)?)
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

    /// Copies a file, unless the same bytes are there; returns its new path.
    fn copy(&self, file: RenderFile, folder: &Path) -> Result<PathBuf, Error> {
        let [from, to] = [&*self.folder, folder].map(|folder| folder.join(file.path()));
        let bytes = read_bounded(&from, MAX_TAKEN_BYTES)?;
        if read_bounded(&to, MAX_TAKEN_BYTES).ok().as_ref() != Some(&bytes) {
            frame::write_atomically(&to, &bytes)?;
        }
        Ok(to)
    }
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

/// Returns whether a text can be the name of an engine's scene: it names the scene's folder, and
/// its engine names the picture's subfolder.
fn is_engine_scene(id: &SceneId) -> bool {
    let is_word = |word: &str| !word.is_empty() && name_in_one_word(word) == word;
    let is_engine = |engine: &String| is_word(engine) && !engine.starts_with('.');
    is_word(&id.name) && id.variant.as_ref().is_some_and(is_engine) && id.rate.is_none()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_lead_elsewhere_are_no_engine_scenes() {
        let is_allowed = |name: &str| name.parse().is_ok_and(|id| is_engine_scene(&id));
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
