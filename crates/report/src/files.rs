//! A report as files: one, or where that would be too large, a page with its numbers beside it.

use std::path::{Path, PathBuf};

use frame::{FileError, write_atomically};

use super::precision::Precision;
use super::shelf::Shelf;

/// A page up to so many bytes opens within seconds, and mails still carry it. Larger reports keep halves for floats, then what
/// a screen shows; what is too large still becomes halves beside the page, of which a browser opens one scene at a time.
pub const LARGEST_PAGE: usize = 25_000_000;

/// Styles, scripts and the frame of the page take less.
const REST: usize = 100_000;

/// A finished report.
pub struct Report {
    /// The page's own file.
    pub html: PathBuf,
    /// Its text.
    pub page: String,
    /// What lies beside it, by path: all of it belongs in one folder named like the page.
    pub siblings: Vec<(PathBuf, String)>,
}

impl Report {
    /// Bytes of all files.
    pub fn bytes(&self) -> usize {
        self.page.len()
            + self
                .siblings
                .iter()
                .map(|(_, text)| text.len())
                .sum::<usize>()
    }

    /// Writes all files, the page last.
    pub fn write(&self) -> Result<(), FileError> {
        for (path, text) in &self.siblings {
            write_atomically(path, text.as_bytes())?;
        }
        write_atomically(&self.html, self.page.as_bytes())
    }
}

/// The shelves of all scenes as JSON, in every precision until it is known which fits.
pub struct Packed {
    /// What a page may hold, in bytes.
    largest: usize,
    /// How many scenes there are.
    scenes: usize,
    /// By falling precision; empty as soon as they are too many for a page, but for those that may lie beside it.
    tried: [(Precision, Vec<String>); 3],
}

/// Where the numbers of a page are.
pub struct Shelves {
    /// Of every number.
    pub precision: Precision,
    /// One per scene.
    pub texts: Vec<String>,
    /// The folder beside the page; none where the page holds all.
    pub folder: Option<String>,
}

impl Packed {
    /// For a page of up to `largest` bytes.
    pub fn new(largest: usize) -> Self {
        let tried = [Precision::Float, Precision::Half, Precision::Screen];
        Self {
            largest,
            scenes: 0,
            tried: tried.map(|precision| (precision, Vec::new())),
        }
    }

    /// Adds the next scene's.
    pub fn add(&mut self, shelf: &Shelf) {
        for (precision, texts) in &mut self.tried {
            let whole = texts.len() == self.scenes;
            if whole && (fit(self.largest, texts, 0) || *precision == BESIDE) {
                texts.push(shelf.json(*precision));
            } else {
                texts.clear();
            }
        }
        self.scenes += 1;
    }

    /// In the page beside so many bytes of text, as precisely as they fit, else beside it: in a folder named like the page at
    /// `html`.
    pub fn shelves(self, html: &Path, text: usize) -> Shelves {
        let Self {
            largest,
            scenes,
            tried,
        } = self;
        let whole = |texts: &[String]| texts.len() == scenes && fit(largest, texts, text);
        let folder = || {
            let stem = html.file_stem().unwrap_or_default();
            format!("{}_files", stem.to_string_lossy())
        };
        let fitting = tried.iter().position(|(_, texts)| whole(texts));
        let beside = tried.iter().position(|(precision, _)| *precision == BESIDE);
        let chosen = fitting.or(beside).expect("one of them is kept beside");
        let (precision, texts) = (tried.into_iter().nth(chosen)).expect("it was found there");
        Shelves {
            precision,
            texts,
            folder: fitting.is_none().then(folder),
        }
    }
}

/// What is kept beside a page, where room is no matter.
const BESIDE: Precision = Precision::Half;

/// Whether they have room beside so much text.
fn fit(largest: usize, texts: &[String], beside: usize) -> bool {
    texts.iter().map(String::len).sum::<usize>() + beside + REST <= largest
}

impl Shelves {
    /// The files beside the page at `html`.
    pub fn siblings(&self, html: &Path) -> Vec<(PathBuf, String)> {
        let Some(folder) = &self.folder else {
            return Vec::new();
        };
        let texts = self.texts.iter().enumerate();
        texts
            .map(|(scene, text)| {
                let path = html
                    .with_file_name(folder)
                    .join(format!("scene_{scene}.js"));
                (path, format!("shuttertruth.arrived({scene}, {text});\n"))
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use frame::Raster;

    use super::super::precision::Nature;
    use super::*;

    /// Numbers that no compression makes much smaller, on so many planes: each takes 260 kB as floats, 150 kB as halves, 100 kB
    /// for the screen.
    fn shelf(planes: u32) -> Shelf {
        let mut shelf = Shelf::default();
        let mut state = 1_u32;
        for _ in 0..planes {
            let plane = Raster::from_fn(256, 256, |_, _| {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                (state >> 9) as f32 / (1 << 23) as f32
            });
            shelf.plane("R", Nature::Number, &plane);
        }
        shelf
    }

    #[test]
    fn what_is_too_large_loses_digits_first_and_leaves_the_page_next() {
        let html = Path::new("out/a page.html");
        for (planes, precision, beside) in [
            (1, Precision::Float, false),
            (6, Precision::Half, false),
            (11, Precision::Screen, false),
            (20, Precision::Half, true),
        ] {
            let mut packed = Packed::new(1_600_000 + REST);
            packed.add(&shelf(planes));
            packed.add(&shelf(1));
            let shelves = packed.shelves(html, 100_000);
            assert_eq!(shelves.precision, precision, "{planes} planes");
            assert_eq!(shelves.texts.len(), 2);
            let paths: Vec<PathBuf> = shelves
                .siblings(html)
                .into_iter()
                .map(|(path, _)| path)
                .collect();
            let due = ["out/a page_files/scene_0.js", "out/a page_files/scene_1.js"];
            assert_eq!(
                paths,
                due[..2 * usize::from(beside)]
                    .iter()
                    .map(PathBuf::from)
                    .collect::<Vec<_>>()
            );
        }
    }
}
