//! `engine audit --self`: consecutive frames, without a scene.

use std::path::{Path, PathBuf};

use measure::{Error, Sharing, lock_folder, printable_path};
use terminal::output::{Text, print, print_note};
use terminal::result::{Ending, write_json};

use super::capture::name_folder;
use crate::audit_self::{Sequence, audit_frames, sequence_table, write_map};

/// Frames to compare, and where to.
pub struct SelfAuditPlan<'a> {
    /// Folder that holds a capture per frame.
    pub frames: &'a Path,
    /// File of the convention; none for engine.toml in the folders.
    pub convention: Option<&'a Path>,
    /// Folder to write; none for the usual one.
    pub out: Option<&'a PathBuf>,
    /// True to print JSON.
    pub as_json: bool,
}

/// Compares consecutive frames with each other; fails if velocity does not lead from each to the
/// frame before, and is undecided if the pictures do not tell.
pub fn audit_frames_alone(plan: &SelfAuditPlan) -> Result<Ending, Error> {
    let sequence = Sequence::list(plan.frames, plan.convention)?;
    let out = name_folder(plan.frames, plan.out, "out/audit")?;
    let _lock = lock_folder(&out, [], Sharing::Alone)?;
    let mut read = |index: usize| {
        let capture = sequence.read(index)?;
        if index == 0 {
            for note in &capture.notes {
                print_note(note);
            }
        }
        Ok(capture)
    };
    let map_of = |index: usize| out.join(format!("map_{}.png", sequence.name(index)));
    let audit = audit_frames(sequence.count(), &mut read, &mut |index, map| {
        Ok(write_map(&map_of(index), map)?)
    })?;
    let path = out.join("audit.json");
    let json = write_json(&path, &audit)?;
    let mut text = sequence_table(&audit);
    text += format!("maps of the frames: {} ..\n", printable_path(&map_of(1)));
    text += format!("written: {}\n", printable_path(&path));
    print(if plan.as_json {
        Text::from(json) + "\n"
    } else {
        text
    })?;
    let place = printable_path(plan.frames);
    Ok(match (audit.findings.len(), audit.carries) {
        (0, true) => Ending::Done,
        (0, false) => Ending::Failed(Error::Refused(format!(
            "the frames in {place} tell nothing about velocity"
        ))),
        (count, _) => Ending::Failed(Error::Broken(format!("{count} findings in {place}"))),
    })
}
