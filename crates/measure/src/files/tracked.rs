//! Files in an output folder that came with a checkout.

use std::io::{self, Read, Seek};
use std::path::Path;
use std::process::Command;
use std::time::Duration;

use frame::FileError;
use process::{End, Limits, half_of_memory};
use tracer::TraceError;

use crate::Error;

/// Variables that would point git to a repository other than the folder's.
const ELSEWHERE: [&str; 4] = [
    "GIT_DIR",
    "GIT_WORK_TREE",
    "GIT_INDEX_FILE",
    "GIT_CEILING_DIRECTORIES",
];

/// Longest time that git may take.
const TIME_LIMIT: Duration = Duration::from_secs(60);

/// Refuses a file that git tracks, and a folder with such files: a change may not bring its own
/// evidence. The error ends with `way_out`, which says what to do instead.
///
/// A folder that does not exist or is in no work tree has none, and needs no git. Refuses the
/// folder if git fails.
pub fn refuse_tracked(out: &Path, way_out: &str) -> Result<(), Error> {
    if !out.exists() || !is_in_work_tree(out)? {
        return Ok(());
    }
    let name = out.display();
    // Git runs in a folder, and lists all of it or one file.
    let (folder, file) = match (out.is_dir(), out.parent()) {
        (false, Some(parent)) if !parent.as_os_str().is_empty() => (parent, out.file_name()),
        (false, _) => (Path::new("."), out.file_name()),
        (true, _) => (out, None),
    };
    let cannot_tell = |reason: String| {
        Error::Refused(format!(
            "{name}: cannot find out whether files came with the checkout: {reason}; {way_out}"
        ))
    };
    let mut git = Command::new("git");
    // A checkout may contain what looks like a repository with settings that name programs.
    git.args(["--literal-pathspecs", "-c", "safe.bareRepository=explicit"])
        .args(["-c", "core.fsmonitor=false"])
        .args(["ls-files", "-z", "--cached", "--"])
        .args(file)
        .current_dir(folder);
    for name in ELSEWHERE {
        git.env_remove(name);
    }
    let names = match list_names(git) {
        Ok(Listing::Names(names)) => names,
        Ok(Listing::Failed(reason)) => return Err(cannot_tell(reason)),
        Ok(Listing::Stopped) => return Err(TraceError::Cancelled.into()),
        Err(error) => return Err(cannot_tell(format!("git: {error}"))),
    };
    let mut names = names.split(|byte| *byte == 0);
    match names.next().filter(|name| !name.is_empty()) {
        None => Ok(()),
        Some(name) => Err(Error::Refused(format!(
            "{} is tracked by git: it came with the checkout, and a check does not count what a change brings along; {way_out}",
            folder.join(&*String::from_utf8_lossy(name)).display()
        ))),
    }
}

/// What git lists.
enum Listing {
    /// Names, each with a zero byte behind it.
    Names(Vec<u8>),
    /// Why git failed.
    Failed(String),
    /// The caller interrupted the work.
    Stopped,
}

/// Runs a git that lists names.
fn list_names(mut git: Command) -> io::Result<Listing> {
    let mut stdout = tempfile::tempfile()?;
    let mut stderr = tempfile::tempfile()?;
    git.stdout(stdout.try_clone()?).stderr(stderr.try_clone()?);
    let limits = Limits {
        time: TIME_LIMIT,
        memory: half_of_memory(),
        output: None,
        whole_tree: false,
    };
    match process::run(git, &limits)? {
        End::Exited(status) if status.success() => Ok(Listing::Names(read_all(&mut stdout)?)),
        End::Stopped => Ok(Listing::Stopped),
        End::Exited(_) => {
            let stderr = read_all(&mut stderr)?;
            let reason = String::from_utf8_lossy(&stderr).trim_end().to_owned();
            Ok(Listing::Failed(reason))
        }
        End::OutOfTime | End::TooLarge => {
            let seconds = TIME_LIMIT.as_secs();
            let reason = format!("git took longer than {seconds} s and was stopped");
            Ok(Listing::Failed(reason))
        }
    }
}

/// Reads a file from its start.
fn read_all(file: &mut std::fs::File) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    file.rewind()?;
    file.read_to_end(&mut bytes)?;
    Ok(bytes)
}

fn is_in_work_tree(out: &Path) -> Result<bool, FileError> {
    let folder = (out.canonicalize()).map_err(|source| FileError::io(out, "read", source))?;
    let mut above = folder.ancestors();
    Ok(above.any(|folder| folder.join(".git").exists()))
}
