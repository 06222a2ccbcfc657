//! `[convention]`, in filter.toml and in a file of its own.

use std::path::Path;

use serde::Deserialize;
use toml::Spanned;

use super::file::File;
use crate::filter::{Holds, Origin};
use crate::{Convention, Filter, FilterError};

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
        if read.convention.get_ref().origin() == Origin::BottomLeft {
            let reason = "convention: origin is for the shaders of a filter.toml; the first row of a file is the top of its \
                          picture; leave origin out, and write velocity_y = \"up\" if +y points up";
            return Err(file.at(&read.convention, reason.into()));
        }
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

/// Refuses the bottom left as the origin of what counts from the top left: kernels with
/// common.wgsl, and places.
pub(super) fn check_origin(
    file: &File,
    convention: Option<&Spanned<Convention>>,
    filter: &Filter,
) -> Result<(), FilterError> {
    let Some(convention) =
        convention.filter(|convention| convention.get_ref().origin() == Origin::BottomLeft)
    else {
        return Ok(());
    };
    let refuse = |what: &str| {
        let reason = format!(
            "convention: origin = \"bottom_left\" is for shaders that their passes name; {what} from the top left"
        );
        Err(file.at(convention, reason))
    };
    if filter.passes.iter().any(|pass| pass.shader.is_none()) {
        return refuse(&format!("kernels of {}.wgsl count rows", filter.name));
    }
    match filter
        .textures
        .iter()
        .find(|texture| texture.holds == Some(Holds::Places))
    {
        None => Ok(()),
        Some(texture) => refuse(&format!("the places in texture \"{}\" are", texture.name)),
    }
}

fn check(file: &File, convention: &Spanned<Convention>) -> Result<Convention, FilterError> {
    match convention.get_ref().check() {
        Ok(()) => Ok(*convention.get_ref()),
        Err(reason) => Err(file.at(convention, format!("convention: {reason}"))),
    }
}
