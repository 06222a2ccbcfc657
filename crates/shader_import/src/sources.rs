//! Texts that a compiler gets.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::fault::FileFault;
use crate::language::Language;

/// Largest shader or module that is read, in bytes.
pub const MAX_MODULE_BYTES: u64 = 4 << 20;

/// Function that reads a regular file of at most so many bytes, or says why it cannot.
pub type ReadFile = fn(&Path, u64) -> Result<Vec<u8>, String>;

/// Texts of a shader and of what it includes or imports.
pub struct Sources<'a> {
    /// The filter's folder.
    pub folder: &'a Path,
    /// Language of all texts.
    pub language: Language,
    /// Reader of the folder's files and of what compilers write.
    pub read_file: ReadFile,
    /// The shader itself.
    pub shader: PathBuf,
    /// Texts by their paths in the folder.
    pub texts: BTreeMap<PathBuf, String>,
}

impl Sources<'_> {
    /// Returns the text of the shader itself.
    pub fn text(&self) -> &str {
        &self.texts[&self.shader]
    }

    /// Makes the fault of a file of the filter's folder.
    pub fn fault(
        &self,
        file: &Path,
        line: impl Into<Option<usize>>,
        reason: impl Into<String>,
    ) -> FileFault {
        FileFault::new(&self.folder.join(file), line, reason)
    }

    /// Writes all files below a folder.
    pub fn write(&self, below: &Path) -> std::io::Result<()> {
        self.texts.iter().try_for_each(|(path, text)| {
            let path = below.join(path);
            path.parent().map_or(Ok(()), std::fs::create_dir_all)?;
            std::fs::write(path, text)
        })
    }
}

/// Finds the first of these words in a plain text, and its line, from 1.
pub fn find_word<'t>(text: &'t str, words: &[&str]) -> Option<(usize, &'t str)> {
    find_word_if(text, |word| words.contains(&word))
}

/// Finds the first word of a plain text that is wanted, and its line, from 1.
pub fn find_word_if(text: &str, is_wanted: impl Fn(&str) -> bool) -> Option<(usize, &str)> {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let lines = text.lines().zip(1..);
    lines
        .flat_map(|(line, number)| {
            let words = line.split(move |c| !is_part(c));
            words.map(move |word| (number, word))
        })
        .find(|(_, word)| is_wanted(word))
}
