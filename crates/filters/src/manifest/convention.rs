//! `[convention]`, in filter.toml and in a file of its own.

use std::path::Path;

use serde::Deserialize;
use toml::Spanned;

use super::file::File;
use crate::{Convention, FilterError};

/// A file with a convention alone.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ConventionFile {
    convention: Spanned<Convention>,
}

impl Convention {
    /// Parses a TOML file that holds the table `[convention]` and nothing else.
    pub fn parse(path: &Path, text: &str) -> Result<Self, FilterError> {
        let file = File { path, text };
        let read: ConventionFile = file.read("; allowed: the table [convention] alone")?;
        check(&file, &read.convention)
    }
}

/// Reads the form in which the shaders of a filter expect the frame.
pub(super) fn read_convention(
    file: &File,
    convention: Option<&Spanned<Convention>>,
    is_command: bool,
) -> Result<Convention, FilterError> {
    match convention {
        None => Ok(Convention::default()),
        Some(convention) if is_command => Err(file.at(
            convention,
            "convention: is for shaders; a command gets the file that it is given".into(),
        )),
        Some(convention) => check(file, convention),
    }
}

fn check(file: &File, convention: &Spanned<Convention>) -> Result<Convention, FilterError> {
    match convention.get_ref().check() {
        Ok(()) => Ok(*convention.get_ref()),
        Err(reason) => Err(file.at(convention, format!("convention: {reason}"))),
    }
}
