//! Pixels that a file has in common with another: it leaves them out, and they are read from there.

use std::path::Path;

use super::file::{Channel, ExrFile, Samples};
use super::reading::read_alone;
use crate::FileError;
use crate::raster::mean_plane;

/// The frame of a scene, as the folder of a case sees it.
pub const FRAME_OF_CASE: &str = "../frame.exr";
/// The first rung of a ladder, as the others see it.
pub(crate) const FIRST_RUNG: &str = "n1.exr";
/// Attribute that names one of these files.
const OTHER: &str = "left_out_equals";
/// Bits in the place of a pixel that was left out: a NaN that no operation yields.
const LEFT_OUT: u32 = 0x7fc5_1e57;

impl ExrFile {
    /// Leaves out the floats that equal, bit for bit, those of another file. `name` is [`FRAME_OF_CASE`], [`FIRST_RUNG`], or a rung as the
    /// folder of a case sees it, whose halves' mean is meant: `../ladder_trailing/n4.exr`.
    pub(crate) fn leave_out(&mut self, name: &str, other: &ExrFile) {
        if !self.has_size_of(other) || self.channels.iter().any(has_left_out) {
            return;
        }
        self.visit_common(other, |own, other| {
            if own.to_bits() == other.to_bits() {
                *own = f32::from_bits(LEFT_OUT);
            }
        });
        self.set(OTHER, name);
    }

    /// Reads what was left out.
    ///
    /// # Errors
    /// The other file is missing, or is not the one that this file was written with.
    pub(crate) fn fill_in(&mut self) -> Result<(), FileError> {
        let Some(name) = self.attributes.remove(OTHER) else {
            return Ok(());
        };
        let path = self.path.with_file_name(&name);
        let other = match name.as_str() {
            FRAME_OF_CASE | FIRST_RUNG => read_alone(&path)?,
            _ if is_rung(&name) => read_mean(&path)?,
            _ => {
                return Err(self.foreign(format!(
                    "attribute \"{OTHER}\" holds \"{name}\"; allowed: {FRAME_OF_CASE}, {FIRST_RUNG}, and rungs of ladders"
                )));
            }
        };
        if self.has_size_of(&other) {
            self.visit_common(&other, |own, other| {
                if own.to_bits() == LEFT_OUT {
                    *own = other;
                }
            });
        }
        self.expect_checksum().map_err(|_| {
            self.foreign(format!(
                "lacks pixels that it had in common with {name}, which is another file now, of {}x{} pixels, or one of both is \
                 damaged; make both again",
                other.width, other.height
            ))
        })
    }

    fn has_size_of(&self, other: &ExrFile) -> bool {
        (self.width, self.height) == (other.width, other.height)
    }

    /// Visits every float with the one in its place in the other file.
    fn visit_common(&mut self, other: &ExrFile, visit: impl Fn(&mut f32, f32)) {
        for own in &mut self.channels {
            let name = without_rung(&own.name);
            let twin = (other.channels.iter()).find(|channel| without_rung(&channel.name) == name);
            if let (Samples::F32(own), Some(Samples::F32(twin))) =
                (&mut own.samples, twin.map(|twin| &twin.samples))
            {
                own.iter_mut()
                    .zip(twin)
                    .for_each(|(own, twin)| visit(own, *twin));
            }
        }
    }
}

/// Returns whether a name is of a rung as the folder of a case sees it.
fn is_rung(name: &str) -> bool {
    let parts = name
        .strip_prefix("../ladder_")
        .and_then(|rest| rest.split_once('/'));
    parts.is_some_and(|(alignment, file)| {
        let count = file
            .strip_prefix('n')
            .and_then(|rest| rest.strip_suffix(".exr"));
        alignment.chars().all(|c| c.is_ascii_lowercase())
            && count.is_some_and(|count| count.parse::<u32>().is_ok())
    })
}

/// Reads the mean of a rung's halves.
fn read_mean(path: &Path) -> Result<ExrFile, FileError> {
    let mut rung = read_alone(path)?;
    if rung.attributes.get(OTHER).map(String::as_str) == Some(FIRST_RUNG) {
        rung.fill_in()?;
    }
    let mut mean = ExrFile::new(rung.width, rung.height);
    for channel in &rung.channels {
        if let Some((layer, name)) = channel.name.split_once(".A.") {
            let twin = rung.plane(&format!("{layer}.B.{name}"))?;
            let both = rung.plane(&channel.name)?;
            mean.push_owned_plane(name, mean_plane([&both, &twin]));
        }
    }
    Ok(mean)
}

fn has_left_out(channel: &Channel) -> bool {
    match &channel.samples {
        Samples::F32(samples) => samples.iter().any(|value| value.to_bits() == LEFT_OUT),
        Samples::U32(_) => false,
    }
}

/// Names a channel of a rung as in any other: `A.R` for `n64.A.R`.
fn without_rung(name: &str) -> &str {
    let rest = name
        .strip_prefix('n')
        .map(|rest| rest.trim_start_matches(|c: char| c.is_ascii_digit()));
    rest.and_then(|rest| rest.strip_prefix('.')).unwrap_or(name)
}
