//! `engine audit --self`: consecutive frames, without a scene.

use measure::{Error, Sharing, lock_folder, printable_path};
use terminal::output::{Text, print, print_note};
use terminal::result::{Ending, write_json};

use super::audit::AuditArgs;
use super::capture::name_folder;
use crate::audit_self::{Sequence, audit_frames, sequence_table, write_map};

/// Compares consecutive frames with each other; fails if velocity does not lead from each to the
/// frame before, and is undecided if the pictures do not tell.
pub fn execute(args: &AuditArgs) -> Result<Ending, Error> {
    let sequence = Sequence::list(&args.capture, args.convention.as_deref())?;
    let out = name_folder(&args.capture, args.out.as_ref(), "out/audit")?;
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
    print(if args.json {
        Text::from(json) + "\n"
    } else {
        text
    })?;
    let place = printable_path(&args.capture);
    Ok(match (audit.findings.len(), audit.carries) {
        (0, true) => Ending::Done,
        (0, false) => Ending::Failed(Error::Refused(format!(
            "the frames in {place} tell nothing about velocity"
        ))),
        (count, _) => Ending::Failed(Error::Broken(format!("{count} findings in {place}"))),
    })
}
