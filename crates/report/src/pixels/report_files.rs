//! Files of a report: a page, and where that would be too large, its numbers beside it.

use std::path::{Path, PathBuf};

use frame::{FileError, write_atomically};

/// Largest page, in bytes, that holds its own numbers: it opens within seconds, and mails still carry it. The numbers of a
/// larger report lie beside the page, and a browser opens one scene at a time.
pub const LARGEST_PAGE: usize = 25_000_000;

/// Upper limit on the bytes of styles, scripts and the frame of the page.
const REST: usize = 100_000;

/// A finished report.
pub struct Report {
    /// The page's own file.
    pub html: PathBuf,
    /// Its text.
    pub page: String,
    /// Files that lie beside it in one folder named like the page, by path.
    pub siblings: Vec<(PathBuf, String)>,
}

impl Report {
    /// Counts the bytes of all files.
    pub fn bytes(&self) -> usize {
        let beside = self.siblings.iter().map(|(_, text)| text.len());
        self.page.len() + beside.sum::<usize>()
    }

    /// Writes all files, the page last.
    pub fn write(&self) -> Result<(), FileError> {
        for (path, text) in &self.siblings {
            write_atomically(path, text.as_bytes())?;
        }
        write_atomically(&self.html, self.page.as_bytes())
    }
}

/// Numbers of all scenes.
pub struct SceneNumbers {
    /// JSON, one text per scene.
    pub texts: Vec<String>,
    /// Folder beside the page; none where the page holds all.
    pub folder: Option<String>,
}

impl SceneNumbers {
    /// Puts the numbers into the page at `html` if it stays below `largest` bytes; `text` is what else it holds.
    pub fn new(texts: Vec<String>, text: usize, html: &Path, largest: usize) -> Self {
        let bytes = texts.iter().map(String::len).sum::<usize>() + text + REST;
        let stem = html.file_stem().unwrap_or_default();
        let folder = (bytes > largest).then(|| format!("{}_files", stem.to_string_lossy()));
        Self { texts, folder }
    }

    /// Lists the files beside the page at `html`.
    pub fn siblings(&self, html: &Path) -> Vec<(PathBuf, String)> {
        let Some(folder) = &self.folder else {
            return Vec::new();
        };
        let files = self.texts.iter().enumerate().map(|(scene, text)| {
            let name = format!("scene_{scene}.js");
            let path = html.with_file_name(folder).join(name);
            (path, format!("shuttertruth.arrived({scene}, {text});\n"))
        });
        files.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_are_too_large_leave_the_page() {
        let html = Path::new("out/a page.html");
        let texts = || vec!["[]".repeat(400_000), "[]".repeat(100_000)];
        let inside = SceneNumbers::new(texts(), 100_000, html, 1_100_000 + REST);
        assert_eq!(inside.siblings(html), []);
        let beside = SceneNumbers::new(texts(), 100_001, html, 1_100_000 + REST);
        let paths: Vec<PathBuf> = (beside.siblings(html).into_iter())
            .map(|(path, _)| path)
            .collect();
        let due = ["out/a page_files/scene_0.js", "out/a page_files/scene_1.js"];
        assert_eq!(paths, due.map(PathBuf::from));
    }
}
