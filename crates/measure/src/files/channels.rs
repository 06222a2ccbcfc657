//! Channels of a picture that another program wrote, found by the names that programs give them.

use std::path::Path;

use filters::Convention;
use frame::{ExrFile, FileError, Plane, Vectors, read_passes};

use crate::{Error, printable};

/// Reads the screen motion of an OpenEXR file, in pixels per frame, by the convention. Velocity
/// per shutter is of one that is open for `exposure` frames.
///
/// # Errors
/// As of [`take_velocity`]; or the convention needs what the file does not say.
pub fn read_motion(path: &Path, convention: &Convention, exposure: f64) -> Result<Vectors, Error> {
    let stored = take_velocity(&read_passes(path)?, "velocity")?;
    let motion = convention.restore_velocity(&stored, exposure);
    Ok(motion.map_err(|reason| FileError::foreign(path, reason))?)
}

/// Takes the screen motion of a buffer as its program stores it.
///
/// # Errors
/// No pair of channels has a known name, or one of them holds NaN or infinity.
pub fn take_velocity(file: &ExrFile, buffer: &str) -> Result<Vectors, Error> {
    let channels = ["X", "Y"].map(|axis| format!("{buffer}.{axis}"));
    let pairs = [
        channels.each_ref().map(String::as_str),
        ["velocity.X", "velocity.Y"],
        ["X", "Y"],
        ["R", "G"],
    ];
    // A file with half of a pair lacks the other half, and no other pair is meant.
    let has_any = |pair: &&[&str; 2]| pair.iter().any(|name| file.has_channel(name));
    let Some(names) = pairs.iter().find(has_any) else {
        return refuse_channels(file, "velocity.X and velocity.Y, X and Y, or R and G");
    };
    check_finite(file, names)?;
    let [x, y] = names.map(|name| file.plane(name));
    Ok(x?.zip(&y?, |x, y| [*x, *y]))
}

/// Finds the first of some channels in a file.
///
/// # Errors
/// The file has none of them.
pub fn find_channel<'a>(file: &ExrFile, names: &[&'a str]) -> Result<&'a str, Error> {
    match names.iter().find(|name| file.has_channel(name)) {
        Some(name) => Ok(name),
        None => refuse_channels(file, &format!("one of {}", names.join(", "))),
    }
}

fn refuse_channels<T>(file: &ExrFile, allowed: &str) -> Result<T, Error> {
    let names: Vec<&str> = (file.channels.iter())
        .map(|channel| channel.name.as_str())
        .collect();
    Err(Error::Refused(format!(
        "{}: has the channels {}; needed: {allowed}",
        file.path.display(),
        printable(&names.join(", "))
    )))
}

/// Refuses a channel with NaN or infinity, and names the pixel.
///
/// # Errors
/// There is one.
pub fn check_finite(file: &ExrFile, names: &[&str]) -> Result<(), Error> {
    let allowed = "every number must be finite: look for a division by 0 in the engine, or for a half float that overflowed";
    let mut names = names.iter();
    names.try_for_each(|name| {
        check_values(
            file,
            name,
            &file.plane(name)?,
            |value| value.is_finite(),
            allowed,
        )
    })
}

/// Refuses a channel with a disallowed number, and names the pixel.
///
/// # Errors
/// There is one.
pub fn check_values(
    file: &ExrFile,
    name: &str,
    plane: &Plane,
    is_allowed: impl Fn(&f32) -> bool,
    allowed: &str,
) -> Result<(), Error> {
    let Some(at) = plane.pixels.iter().position(|value| !is_allowed(value)) else {
        return Ok(());
    };
    let (value, width) = (plane.pixels[at], plane.width as usize);
    let (x, y) = (at % width, at / width);
    let finding = format!("channel \"{name}\" holds {value} at pixel ({x}, {y})");
    Err(Error::Refused(format!(
        "{}: {finding}; {allowed}",
        file.path.display()
    )))
}
