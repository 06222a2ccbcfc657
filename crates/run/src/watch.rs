//! Repeats work when files change.

use std::path::PathBuf;
use std::time::{Duration, SystemTime};

use measure::{Case, Error, ReferencePicture, printable_path};
use metrics::Metric;
use terminal::output::{INTERRUPTED_TEXT, print_error, print_failure, was_interrupted};
use walkdir::WalkDir;

/// Time between two looks at the files. A change counts when two looks see the same: programs write
/// a file in steps.
const BETWEEN_LOOKS: Duration = Duration::from_millis(200);

/// Files below the watched folders, each with the time of its last change and its size.
type State = Vec<(PathBuf, Option<SystemTime>, u64)>;

/// Does the work now, and again after each change of a file below the folders. A failure is printed
/// and waits for the next change; a signal ends the loop.
pub fn repeat_on_change(
    folders: &[PathBuf],
    mut work: impl FnMut() -> Result<(), Error>,
) -> Result<(), Error> {
    let names: Vec<String> = folders
        .iter()
        .map(|folder| printable_path(folder))
        .collect();
    while !was_interrupted() {
        let before = read_state(folders);
        match work() {
            Err(error) if error.is_interruption() => return Err(error),
            Err(error) => print_failure(&error),
            Ok(()) => {}
        }
        print_error(&format!("watching {}; Ctrl-C ends", names.join(", ")));
        wait_for_change(folders, before);
    }
    print_error(INTERRUPTED_TEXT);
    Ok(())
}

/// Describes a finished scene: `fan: no blur 0.238, my_blur:default 0.143 (FLIP)`.
pub fn finished_text(cases: &[Case]) -> String {
    let Some(scene) = cases.first().map(|case| &case.scene) else {
        return String::new();
    };
    let is_shown =
        |case: &&Case| !case.is_reference || case.reference() == Some(ReferencePicture::Identity);
    let texts = cases.iter().filter(is_shown).map(|case| {
        let name = if case.is_reference {
            "no blur".to_owned()
        } else {
            case.name()
        };
        match case.scores.get(Metric::FLIP).value() {
            Some(flip) => format!("{name} {flip:.3}"),
            None => format!("{name} n/a"),
        }
    });
    format!("{scene}: {} (FLIP)", texts.collect::<Vec<_>>().join(", "))
}

/// Returns when the files differ from `before` and have settled, or after a signal.
fn wait_for_change(folders: &[PathBuf], before: State) {
    let mut last = before.clone();
    while !was_interrupted() {
        std::thread::sleep(BETWEEN_LOOKS);
        let now = read_state(folders);
        if now != before && now == last {
            return;
        }
        last = now;
    }
}

fn read_state(folders: &[PathBuf]) -> State {
    let entries = (folders.iter()).flat_map(|folder| WalkDir::new(folder).sort_by_file_name());
    let files = entries
        .flatten()
        .filter(|entry| entry.file_type().is_file());
    let state = files.map(|entry| {
        let metadata = entry.metadata().ok();
        let changed = metadata.as_ref().and_then(|file| file.modified().ok());
        let size = metadata.map_or(0, |file| file.len());
        (entry.into_path(), changed, size)
    });
    state.collect()
}
