//! Files of a report: a page and, if that would be too large, parts of it in files next to it.

use std::path::{Path, PathBuf};

use frame::{FileError, write_atomically};

/// Largest page, in bytes, that contains its own numbers: it opens within seconds, and mail still
/// accepts it. A larger report's numbers are in files next to the page, and a browser opens one
/// scene at a time; so are the tables of its cases, if they alone are larger.
pub const LARGEST_PAGE: usize = 25_000_000;

/// Upper limit on the bytes of styles, scripts and the frame of the page.
const REST: usize = 130_000;

/// Texts of all scenes in order: in the page, or in files in a folder named like the page. Texts
/// are kept until they are too large for the page; from then on, each is written as it comes.
pub struct SceneTexts {
    /// Words before the number of a scene in the name of its file: `scene`.
    name: &'static str,
    html: PathBuf,
    largest: usize,
    bytes: usize,
    texts: Vec<String>,
    written: Vec<PathBuf>,
}

/// Place of the texts of all scenes.
pub enum Place {
    /// In the page, one per scene.
    Page(Vec<String>),
    /// In files next to it.
    Beside(Vec<PathBuf>),
}

impl Place {
    /// Lists the files next to the page.
    pub fn paths(self) -> Vec<PathBuf> {
        match self {
            Self::Page(_) => Vec::new(),
            Self::Beside(paths) => paths,
        }
    }
}

impl SceneTexts {
    /// Collects texts for the page at `html`, which has at most `largest` bytes.
    pub fn new(name: &'static str, html: &Path, largest: usize) -> Self {
        Self {
            name,
            html: html.to_owned(),
            largest,
            bytes: REST,
            texts: Vec::new(),
            written: Vec::new(),
        }
    }

    /// Returns the path of the page.
    pub fn html(&self) -> &Path {
        &self.html
    }

    /// Adds the text of the next scene.
    pub fn add(&mut self, text: String) -> Result<(), FileError> {
        self.bytes += text.len();
        self.texts.push(text);
        self.write_what_is_too_large()
    }

    /// Finds the place of all texts; `rest` is the number of bytes of everything else in the page.
    pub fn place(mut self, rest: usize) -> Result<Place, FileError> {
        self.bytes += rest;
        self.write_what_is_too_large()?;
        Ok(if self.bytes > self.largest {
            Place::Beside(self.written)
        } else {
            Place::Page(self.texts)
        })
    }

    fn write_what_is_too_large(&mut self) -> Result<(), FileError> {
        if self.bytes <= self.largest {
            return Ok(());
        }
        for text in self.texts.drain(..) {
            let name = format!("{}_{}", self.name, self.written.len());
            self.written.push(write_script(&self.html, &name, &text)?);
        }
        Ok(())
    }
}

/// Writes JSON to a file next to the page at `html`, which loads it as `name`; returns its path.
pub fn write_script(html: &Path, name: &str, json: &str) -> Result<PathBuf, FileError> {
    let folder = html.with_file_name(folder_name(html));
    let path = folder.join(format!("{name}.js"));
    let script = format!("shuttertruth.arrived(\"{name}\", {json});\n");
    write_atomically(&path, script.as_bytes())?;
    Ok(path)
}

/// Returns the name of the folder next to the page at `html`.
pub fn folder_name(html: &Path) -> String {
    format!(
        "{}_files",
        html.file_stem().unwrap_or_default().to_string_lossy()
    )
}

#[test]
fn texts_that_are_too_large_leave_the_page() {
    let folder = tempfile::tempdir().unwrap();
    let html = folder.path().join("a page.html");
    let place = |largest: usize, rest: usize| {
        let mut texts = SceneTexts::new("scene", &html, REST + largest);
        texts.add("[]".repeat(40)).unwrap();
        texts.add("[]".repeat(10)).unwrap();
        texts.place(rest).unwrap()
    };
    assert!(matches!(place(110, 10), Place::Page(texts) if texts[1] == "[]".repeat(10)));
    for (largest, rest) in [(110, 11), (90, 0), (10, 0)] {
        let paths = place(largest, rest).paths();
        let names = ["a page_files/scene_0.js", "a page_files/scene_1.js"];
        assert_eq!(paths, names.map(|name| folder.path().join(name)));
        let text = std::fs::read_to_string(&paths[1]).unwrap();
        let expected = "[]".repeat(10);
        assert_eq!(
            text,
            format!("shuttertruth.arrived(\"scene_1\", {expected});\n")
        );
    }
}
