//! `capture.toml`: the subject of an engine's pictures.

use std::collections::BTreeMap;
use std::path::Path;

use frame::{Alignment, MAX_STOPS, is_hidden};
use measure::{Error, read_text};
use scene::SceneId;
use serde::Deserialize;

use crate::capture::raw::RawLayout;
use crate::files::refuse;

/// Name of the file.
pub const CAPTURE_FILE: &str = "capture.toml";
/// Upper limit on the characters of an engine's name.
const LONGEST_ENGINE: usize = 160;
/// Names of the buffers that can be raw dumps.
const RAW_BUFFERS: [&str; 6] = [
    "color",
    "velocity",
    "velocity_next",
    "velocity_z",
    "depth",
    "object",
];

/// Contents of `capture.toml`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CaptureDescription {
    /// Engine and version, such as `three.js 0.187.0`, followed by other details in brackets.
    pub engine: String,
    /// Scene of the suite that the engine drew.
    #[serde(default)]
    pub scene: Option<SceneId>,
    /// Exposure of the blurred picture and of the sub-frames, in frames.
    pub exposure: Option<f64>,
    /// Alignment of their shutter: `trailing`, `centred` or `leading`.
    #[serde(default)]
    pub alignment: Option<Alignment>,
    /// Time of the frame, in frames after the exported manifest's instant.
    #[serde(default)]
    pub instant: f64,
    /// Number of sub-frames, if stated.
    pub subframes: Option<usize>,
    /// Display exposure of the pictures, in stops; by default the scene's, or 0.
    pub stops: Option<f32>,
    /// Layouts of raw dumps by buffer; that of `color` is for the blurred picture and the
    /// sub-frames too.
    #[serde(default)]
    pub raw: BTreeMap<String, RawLayout>,
}

impl CaptureDescription {
    /// Reads the file in a capture's folder.
    pub fn read(folder: &Path) -> Result<Self, Error> {
        let path = folder.join(CAPTURE_FILE);
        if !path.is_file() {
            return refuse!(
                path,
                "there is no such file; a capture has one that names its engine: engine = \"my engine 1.0\""
            );
        }
        let text = read_text(&path)?;
        let description: Self = toml::from_str(&text).map_err(|error| {
            let before = error.span().map_or("", |span| &text[..span.start]);
            let line = 1 + before.matches('\n').count();
            let reason = error.message().replace('\n', "; ");
            Error::Refused(format!("{}:{line}: {reason}", path.display()))
        })?;
        match description.check() {
            Ok(()) => Ok(description),
            Err(reason) => refuse!(path, "{}", reason),
        }
    }

    /// Refuses texts that would disturb a terminal or a page, and numbers that make no sense.
    fn check(&self) -> Result<(), String> {
        let length = self.engine.trim().chars().count();
        let refuse_engine =
            |allowed: String| Err(format!("engine = {:?}; allowed: {allowed}", self.engine));
        if !(1..=LONGEST_ENGINE).contains(&length) || self.engine.contains(is_hidden) {
            return refuse_engine(format!(
                "a name of 1 to {LONGEST_ENGINE} characters on one line"
            ));
        }
        // Its first word becomes a folder.
        if !self.engine.trim().starts_with(char::is_alphanumeric) {
            return refuse_engine("a name that begins with a letter or a digit".to_owned());
        }
        if let Some(exposure) = self.exposure {
            (Alignment::Trailing.shutter(exposure))
                .map_err(|error| format!("exposure = {exposure}: {error}"))?;
        }
        if !self.instant.is_finite() {
            return Err(format!(
                "instant = {}; allowed: a finite number of frames",
                self.instant
            ));
        }
        let range = -MAX_STOPS..=MAX_STOPS;
        if let Some(stops) = self.stops.filter(|stops| !range.contains(stops)) {
            return Err(format!(
                "stops = {stops}; allowed: -{MAX_STOPS} to {MAX_STOPS}"
            ));
        }
        for (buffer, layout) in &self.raw {
            if !RAW_BUFFERS.contains(&buffer.as_str()) {
                return Err(format!(
                    "[raw.{buffer}]; allowed: {}",
                    RAW_BUFFERS.join(", ")
                ));
            }
            (layout.check()).map_err(|error| format!("[raw.{buffer}] {error}"))?;
        }
        Ok(())
    }
}
