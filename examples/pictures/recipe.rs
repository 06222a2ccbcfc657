//! The recipe of the pages' pictures, and the record of what they show.

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};

/// Recipe of every picture that a page shows.
const RECIPE: &str = include_str!("pictures.toml");
/// Record of every picture that a run makes, below the repository's top folder.
pub const RECORD: &str = "docs/pictures/shown.json";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Recipe {
    pub run: Vec<PictureRun>,
    pub by_hand: Vec<ByHand>,
}

/// Commands, and the pictures of what they write.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PictureRun {
    pub name: String,
    /// Time on two cores with nothing kept.
    pub seconds: u32,
    /// Folder where the commands run, and where the paths of their files begin.
    #[serde(default)]
    pub folder: String,
    pub commands: Vec<String>,
    pub picture: Vec<Picture>,
}

/// A picture of a page, made in one of five ways.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Picture {
    /// Path of the picture, or of a folder of pictures.
    pub file: String,
    /// File to copy.
    pub copy: Option<String>,
    /// Labels and files, side by side.
    pub strip: Option<Vec<(String, String)>>,
    /// Columns and rows of each file's middle that a strip shows; none for all.
    pub middle: Option<[u32; 2]>,
    /// Folder of a case, to show its truth, output and FLIP.
    pub case: Option<String>,
    pub screen: Option<Screen>,
    /// Folder of pictures that the commands made.
    pub folder: Option<String>,
    /// Folders of cases that a screen shows, or the folder of a run, if the pictures of `folder`
    /// are named after its cases.
    #[serde(default)]
    pub cases: Vec<String>,
}

/// Page in a browser.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Screen {
    pub page: String,
    /// Part of the page: `#roll/kino:default`.
    #[serde(default)]
    pub part: String,
    /// Columns and rows of the window.
    pub size: [u32; 2],
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ByHand {
    pub file: String,
    pub reason: String,
}

/// Content of a picture's file.
#[derive(Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shown {
    /// BLAKE3 of the file.
    pub hash: String,
    /// Scores of the cases, such as `fan / bevy:high 0.150`, and the text of a screen.
    pub text: Vec<String>,
}

/// Pictures by path.
pub type Record = BTreeMap<String, Shown>;

impl Recipe {
    pub fn read() -> Self {
        toml::from_str(RECIPE).expect("pictures.toml is a recipe")
    }
}

impl Picture {
    /// Lists the files and folders of a run that the picture shows.
    pub fn sources(&self) -> Vec<&str> {
        let strip = self.strip.iter().flatten().map(|(_, file)| file);
        let others = self.copy.iter().chain(&self.case).chain(&self.cases);
        strip.chain(others).map(String::as_str).collect()
    }
}

/// Reads the record below the repository's top folder.
pub fn read_record(top: &Path) -> Record {
    let text = std::fs::read_to_string(top.join(RECORD)).unwrap_or_else(|_| "{}".to_owned());
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{RECORD}: {error}"))
}

/// Hashes a picture's file.
pub fn hash(bytes: &[u8]) -> String {
    blake3::hash(bytes).to_hex()[..16].to_owned()
}

/// Returns whether a file's name is a picture's.
pub fn is_picture(path: &Path) -> bool {
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    ["png", "jpg", "jpeg", "svg", "gif", "webp", "avif"].contains(&&*ending)
}
