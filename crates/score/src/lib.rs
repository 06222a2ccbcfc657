//! The command `score`: a finished picture from any source against a truth, or against any other
//! picture.

mod args;
mod pair;
mod picture;
mod sequence;

use measure::Error;

pub use args::ScoreArgs;

/// Scores a picture, two pictures or a sequence, and prints the scores.
///
/// # Errors
/// A file cannot be read, or does not fit the others.
pub fn execute(args: &ScoreArgs) -> Result<(), Error> {
    match &args.reference {
        Some(reference) => pair::execute(args, reference),
        None if args.frames > 1 => sequence::execute(args),
        None => picture::execute(args),
    }
}
