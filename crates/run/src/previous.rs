//! The run before the last one, kept below its folder for `compare`.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use frame::FileError;
use measure::{Error, RenderFile, Run, RunPlan, StoredRun};
use terminal::refuse;

/// Folder of the previous run, below that of the last one.
pub const PREVIOUS: &str = "previous";

/// The same folder until the new run is finished.
const KEPT: &str = "previous.tmp";

/// Keeps the finished run in the folder of a plan aside, before a new one replaces its files. After
/// an interrupted run the finished one is aside already.
///
/// # Errors
/// A file cannot be kept, or a scene of the plan would share the folder.
pub fn keep_aside(plan: &RunPlan) -> Result<(), Error> {
    let rendered = plan.scenes.iter().map(|scene| &scene.id);
    let drawn = plan.ingested.iter().map(|scene| &scene.id);
    if rendered.chain(drawn).any(|id| id.name == PREVIOUS) {
        refuse!(
            "scenes: {PREVIOUS} is the folder of the run before the last one in --out; rename the scene's folder"
        );
    }
    let out = &plan.out;
    let kept = out.join(KEPT);
    // What cannot be read cannot be compared either.
    let Ok(stored) = StoredRun::read(out) else {
        return Ok(());
    };
    if kept.exists() {
        return Ok(());
    }
    let fail = |source| FileError::io(&kept, "write", source);
    let whole = tempfile::Builder::new()
        .prefix(".shuttertruth-")
        .suffix(".tmp")
        .tempdir_in(out)
        .map_err(fail)?;
    for below in list_compared(&stored.run) {
        let file = out.join(&below);
        if file.is_file() {
            link(&file, &whole.path().join(&below)).map_err(fail)?;
        }
    }
    Ok(fs::rename(whole.keep(), &kept).map_err(fail)?)
}

/// Makes the run that was kept aside the previous one, after the new one is written.
pub fn finish(out: &Path) -> Result<(), Error> {
    let (kept, previous) = (out.join(KEPT), out.join(PREVIOUS));
    if !kept.exists() {
        return Ok(());
    }
    let fail = |source| FileError::io(&previous, "replace", source);
    if previous.exists() {
        fs::remove_dir_all(&previous).map_err(fail)?;
    }
    Ok(fs::rename(&kept, &previous).map_err(fail)?)
}

/// Lists the files that a comparison of two runs of one truth reads.
fn list_compared(run: &Run) -> BTreeSet<PathBuf> {
    let mut files = BTreeSet::from([PathBuf::from("run.json")]);
    for case in &run.cases {
        let outputs = ["output.exr", "output.png", "errors.exr"];
        files.extend(outputs.map(|name| case.folder.join(name)));
        let truth = RenderFile::Truth(case.alignment);
        let scene = case.scene.folder();
        files.insert(scene.join(RenderFile::Frame.path()));
        files.insert(scene.join(truth.path()));
        files.insert(scene.join(truth.picture()));
    }
    files
}

/// Makes a second name for a file, which needs no space; copies where that is impossible. Later runs
/// replace files, and do not change them.
fn link(file: &Path, name: &Path) -> std::io::Result<()> {
    fs::create_dir_all(name.parent().unwrap_or(Path::new(".")))?;
    fs::hard_link(file, name).or_else(|_| fs::copy(file, name).map(drop))
}
