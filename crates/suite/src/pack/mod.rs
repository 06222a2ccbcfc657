//! Packs: a run's frames, truths and ladders in one archive, with a list of contents that is checked before use.

mod contents;
pub mod unpacked;

use std::path::Path;

use store::{Manifest, write_archive};

use self::contents::list_contents;
use crate::run::Run;
use crate::{Error, Monitor, PROGRAM};

/// Packs the frames, truths and ladders of the chosen scenes of a finished run in `folder` into the archive `pack`. The same files give the
/// same bytes.
pub fn write_pack(
    run: &Run,
    folder: &Path,
    scenes: &[String],
    pack: &Path,
    monitor: Monitor,
) -> Result<Manifest, Error> {
    let files = list_contents(run, folder, scenes)?;
    let written = monitor.watch("packing", |watch| {
        write_archive(files, folder, pack, PROGRAM, watch)
    });
    Ok(written?)
}
