//! Identity of a scene: its name, variant, rate and frame.

use std::cmp::Ordering;
use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

use frame::is_hidden;
use serde::{Deserialize, Serialize};

use crate::frame_rate::FrameRate;

/// The word before the seed in the name of a sealed variant: `fan@seal7`.
const SEAL: &str = "seal";

/// Identity of a scene, also as a text: `fan`, `sliding_panel@64px_45deg`, `fan@seal7@24fps/0003`.
/// Ordered by that text.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct SceneId {
    /// Name of the scene's folder.
    pub name: String,
    /// Variant of its file, or `unlit`; for a scene that an engine drew, the engine.
    pub variant: Option<String>,
    /// Seed of a sealed variant; there is no other variant then.
    pub seal: Option<u64>,
    /// Frame rate; none for the file's.
    pub rate: Option<FrameRate>,
    /// Frame of the scene's own clock.
    pub frame: u32,
}

impl SceneId {
    /// Makes the identity of a scene from its name and the part after it: `seal7@24fps`. Any other
    /// variant is one of its file.
    pub fn new(name: impl Into<String>, choice: Option<&str>) -> Self {
        let mut id = Self {
            name: name.into(),
            ..Self::default()
        };
        let Some(choice) = choice else { return id };
        let (variant, last) = match choice.rsplit_once('@') {
            Some((variant, last)) => (Some(variant), last),
            None => (None, choice),
        };
        id.rate = FrameRate::in_word(last);
        let variant = match id.rate {
            Some(_) => variant,
            None => Some(choice),
        };
        id.seal = variant.and_then(seed_in);
        if id.seal.is_none() {
            id.variant = variant.map(str::to_owned);
        }
        id
    }

    /// Returns the same scene at a frame of its own clock.
    pub fn at_frame(&self, frame: u32) -> Self {
        Self {
            frame,
            ..self.clone()
        }
    }

    /// Returns the name of the variant, sealed or not.
    pub fn variant_name(&self) -> Option<String> {
        let sealed = self.seal.map(|seed| format!("{SEAL}{seed}"));
        sealed.or_else(|| self.variant.clone())
    }

    /// Writes the part after the name, without the frame: `@seal7@24fps`.
    pub fn choice(&self) -> String {
        let rate = self.rate.as_ref().map(FrameRate::word);
        let words = self.variant_name().into_iter().chain(rate);
        words.map(|word| format!("@{word}")).collect()
    }

    /// Returns the folder of its files, below an output folder.
    pub fn folder(&self) -> PathBuf {
        self.to_string().into()
    }
}

fn seed_in(variant: &str) -> Option<u64> {
    let seed: u64 = variant.strip_prefix(SEAL)?.parse().ok()?;
    // One seed has one name.
    (format!("{SEAL}{seed}") == variant).then_some(seed)
}

impl fmt::Display for SceneId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut text = self.name.clone() + &self.choice();
        if self.frame > 0 {
            text += &format!("/{:04}", self.frame);
        }
        f.pad(&text)
    }
}

impl FromStr for SceneId {
    type Err = String;

    /// Reads the text. A name leads into no other folder than one of its own.
    fn from_str(text: &str) -> Result<Self, String> {
        let (first, frame) = match text.split_once('/') {
            Some((first, frame)) => (first, frame.parse().unwrap_or(0)),
            None => (text, 0),
        };
        let id = match first.split_once('@') {
            Some((name, choice)) => Self::new(name, Some(choice)),
            None => Self::new(first, None),
        };
        let id = id.at_frame(frame);
        let is_name = !["", ".", ".."].contains(&id.name.as_str())
            && !text.contains(|letter| letter == '\\' || is_hidden(letter));
        let written = id.to_string();
        if is_name && written == text {
            Ok(id)
        } else {
            Err(format!(
                "scene \"{text}\": allowed: names of a folder, such as fan, fan@fast, fan@seal7@24fps or fan/0003"
            ))
        }
    }
}

impl TryFrom<String> for SceneId {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl From<SceneId> for String {
    fn from(id: SceneId) -> String {
        id.to_string()
    }
}

impl Ord for SceneId {
    fn cmp(&self, other: &Self) -> Ordering {
        self.to_string().cmp(&other.to_string())
    }
}

impl PartialOrd for SceneId {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq<&str> for SceneId {
    fn eq(&self, text: &&str) -> bool {
        text.parse::<Self>().is_ok_and(|other| other == *self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_names_one_scene() {
        let rate = FrameRate::in_word("24fps_1-48s");
        let id = |variant: Option<&str>, seal, rate, frame| SceneId {
            name: "fan".to_owned(),
            variant: variant.map(str::to_owned),
            seal,
            rate,
            frame,
        };
        for (text, expected) in [
            ("fan", id(None, None, None, 0)),
            ("fan@20deg", id(Some("20deg"), None, None, 0)),
            ("fan@seal7", id(None, Some(7), None, 0)),
            ("fan@seal07", id(Some("seal07"), None, None, 0)),
            ("fan@sealed7", id(Some("sealed7"), None, None, 0)),
            ("fan@24fps_1-48s", id(None, None, rate, 0)),
            (
                "fan@unlit@24fps_1-48s/0003",
                id(Some("unlit"), None, rate, 3),
            ),
            (
                "fan@seal7@24fps_1-48s/12345",
                id(None, Some(7), rate, 12345),
            ),
            ("fan@024fps", id(Some("024fps"), None, None, 0)),
        ] {
            assert_eq!(text.parse(), Ok(expected.clone()), "{text}");
            assert_eq!(expected.to_string(), text);
        }
    }

    #[test]
    fn a_text_that_leads_elsewhere_names_no_scene() {
        for text in [
            "",
            ".",
            "..",
            "../fan",
            "/fan",
            "fan/",
            "fan/0000",
            "fan/3",
            "fan/up",
            "fan@a/b",
            "a\\b",
            "fan/0003/0003",
            "@fast",
            "../@fast",
        ] {
            assert!(text.parse::<SceneId>().is_err(), "{text}");
        }
    }
}
