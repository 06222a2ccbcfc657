//! Files in an output folder that came with a checkout.

use std::path::Path;
use std::process::{Command, Stdio};

use frame::FileError;

use crate::Error;

/// Variables that would point git to a repository other than the folder's.
const ELSEWHERE: [&str; 4] = [
    "GIT_DIR",
    "GIT_WORK_TREE",
    "GIT_INDEX_FILE",
    "GIT_CEILING_DIRECTORIES",
];

/// Refuses a file that git tracks, and a folder with such files: a change may not bring its own evidence. The error ends with
/// `way_out`, which says what to do instead.
///
/// A folder that does not exist or is in no work tree has none, and needs no git. Refuses the folder if git fails.
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
        .current_dir(folder)
        .stdin(Stdio::null());
    for name in ELSEWHERE {
        git.env_remove(name);
    }
    let output = (git.output()).map_err(|error| cannot_tell(format!("git: {error}")))?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr);
        return Err(cannot_tell(said.trim_end().to_owned()));
    }
    let mut names = output.stdout.split(|byte| *byte == 0);
    match names.next().filter(|name| !name.is_empty()) {
        None => Ok(()),
        Some(name) => Err(Error::Refused(format!(
            "{} is tracked by git: it came with the checkout, and a check does not count what a change brings along; {way_out}",
            folder.join(&*String::from_utf8_lossy(name)).display()
        ))),
    }
}

fn is_in_work_tree(out: &Path) -> Result<bool, FileError> {
    let folder = (out.canonicalize()).map_err(|source| FileError::io(out, "read", source))?;
    let mut above = folder.ancestors();
    Ok(above.any(|folder| folder.join(".git").exists()))
}
