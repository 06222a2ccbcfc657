//! The command `audit`.

use std::path::{Path, PathBuf};

use suite::{
    Capture, CaptureAudit, Error, Sharing, audit_capture, claim, printable_path,
    write_audit_picture,
};

use super::ending::Ending;
use crate::arguments::AuditArgs;
use crate::output::print::{print, print_note};
use crate::selection::select_scenes;
use crate::tables::audit::audit_table;

/// Compares an engine's velocity and depth with the scene's; fails if anything is wrong.
pub fn execute(args: &AuditArgs) -> Result<Ending, Error> {
    let capture = Capture::read(&args.capture, args.convention.as_deref())?;
    for note in &capture.notes {
        print_note(note);
    }
    let Some(name) = args.scene.as_ref().or(capture.description.scene.as_ref()) else {
        return Err(Error::Usage(format!(
            "{}: names no scene; an audit needs the scene that the engine drew: add scene = \"railing\", or give --scene",
            args.capture.join("capture.toml").display()
        )));
    };
    let mut choices = select_scenes(&args.scenes_dir, std::slice::from_ref(name))?;
    let choice = match choices.len() {
        1 => choices.remove(0),
        count => {
            return Err(Error::Usage(format!(
                "--scene {name}: matches {count} scenes; a capture shows one"
            )));
        }
    };
    let (audit, expected) = audit_capture(&capture, &choice.scene)?;
    let out = name_folder(args)?;
    let _claim = claim(&out, [], Sharing::Alone)?;
    let json = serde_json::to_string_pretty(&audit).expect("an audit is plain data");
    let path = out.join("audit.json");
    frame::write_atomically(&path, json.as_bytes())?;
    for object in audit.velocity.iter().filter(|object| !object.is_right) {
        let picture = picture_path(&out, &object.object);
        let right = &expected.right.velocity;
        write_audit_picture(&picture, &capture.velocity, right, object.worst_at)?;
    }
    match args.json {
        true => print(&format!("{json}\n"))?,
        false => print(&describe(&audit, &out))?,
    }
    Ok(match audit.findings.len() {
        0 => Ending::Done,
        count => Ending::Failed(Error::Broken(format!(
            "{count} findings in {}",
            printable_path(&args.capture)
        ))),
    })
}

/// Names the folder of the results: as the capture's own is named, if none is given.
fn name_folder(args: &AuditArgs) -> Result<PathBuf, Error> {
    let capture = (args.capture.canonicalize())
        .map_err(|source| frame::FileError::io(&args.capture, "read", source))?;
    Ok(match &args.out {
        Some(out) => out.clone(),
        None => Path::new("out/audit").join(capture.file_name().unwrap_or(capture.as_os_str())),
    })
}

fn picture_path(out: &Path, object: &str) -> PathBuf {
    let word = object.replace(|letter: char| !letter.is_alphanumeric(), "_");
    out.join(format!("worst_{word}.png"))
}

fn describe(audit: &CaptureAudit, out: &Path) -> String {
    let mut text = audit_table(audit);
    for object in audit.velocity.iter().filter(|object| !object.is_right) {
        let path = picture_path(out, &object.object);
        text += &format!(
            "worst place of {}: {}\n",
            object.object,
            printable_path(&path)
        );
    }
    text += &format!("written: {}\n", printable_path(&out.join("audit.json")));
    text
}
