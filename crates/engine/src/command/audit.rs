//! The command `engine audit`.

use std::path::PathBuf;

use clap::Args;
use measure::{Error, Sharing, lock_folder, printable_path};
use scene::SceneId;
use terminal::arguments::RootArgs;
use terminal::output::{Text, print, print_note};
use terminal::refuse;
use terminal::result::{Ending, write_json};

use super::audit_self::{SelfAuditPlan, audit_frames_alone};
use super::capture::{load_drawn_scene, name_folder};
use crate::audit::{audit_capture, audit_table, write_audit_picture};
use crate::capture::folder::Capture;

/// Arguments of `engine audit`.
#[derive(Debug, Args)]
pub struct AuditArgs {
    /// Folder of a capture, as for `engine ingest`: capture.toml, color.exr, velocity.exr,
    /// depth.exr; object.exr makes the audit sharper. With --self, a folder 0000, 0001 .. of them
    /// per frame.
    #[arg(value_name = "DIR")]
    pub capture: PathBuf,
    /// Compare consecutive frames with each other instead of a scene: does velocity lead from each
    /// to the frame before?
    #[arg(long = "self", conflicts_with_all = ["scene", "scenes_dir"])]
    pub frames_alone: bool,
    /// TOML file with a table [convention] that says which velocity and depth the engine has
    /// [default: engine.toml in DIR].
    #[arg(long, value_name = "FILE")]
    pub convention: Option<PathBuf>,
    /// Scene that the engine drew, with @VARIANT [default: the one that capture.toml names].
    #[arg(long, value_name = "SCENE")]
    pub scene: Option<String>,
    /// Folder of scenes.
    #[command(flatten)]
    pub root: RootArgs,
    /// Folder for audit.json, and for a picture of the worst place of each object that is wrong;
    /// with --self, a map of each frame [default: out/audit/<name of DIR>].
    #[arg(short, long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Print the audit as JSON.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}

/// Compares what an engine drew with the scene; fails if anything is wrong, and is undecided if the
/// engine drew something else.
pub fn execute(args: &AuditArgs) -> Result<Ending, Error> {
    if args.frames_alone {
        return audit_frames_alone(&SelfAuditPlan {
            frames: &args.capture,
            convention: args.convention.as_deref(),
            out: args.out.as_ref(),
            as_json: args.json,
        });
    }
    let capture = Capture::read(&args.capture, args.convention.as_deref())?;
    capture.require_buffers()?;
    for note in &capture.notes {
        print_note(note);
    }
    let described = capture.description.scene.as_ref().map(SceneId::to_string);
    let Some(name) = args.scene.clone().or(described) else {
        refuse!(
            "{}: names no scene; an audit needs the scene that the engine drew: add scene = \"railing\", or give --scene",
            args.capture.join("capture.toml").display()
        );
    };
    let scene = load_drawn_scene(&args.root.scenes_dir, &name)?;
    let (audit, expected) = audit_capture(&capture, &scene)?;
    let out = name_folder(&args.capture, args.out.as_ref(), "out/audit")?;
    let _lock = lock_folder(&out, [], Sharing::Alone)?;
    let path = out.join("audit.json");
    let json = write_json(&path, &audit)?;
    let mut text = audit_table(&audit);
    for object in audit.velocity.iter().filter(|object| !object.is_right) {
        let picture = out.join(format!("worst_{}.png", object.object));
        let right = &expected.right.velocity;
        write_audit_picture(&picture, &capture.velocity, right, object.worst_at)?;
        let picture = printable_path(&picture);
        text += format!("worst place of {}: {picture}\n", object.object);
    }
    text += format!("written: {}\n", printable_path(&path));
    print(if args.json {
        Text::from(json) + "\n"
    } else {
        text
    })?;
    let count = audit.findings.len();
    let place = printable_path(&args.capture);
    Ok(match (count, audit.shows_scene) {
        (0, _) => Ending::Done,
        (_, true) => Ending::Failed(Error::Broken(format!("{count} findings in {place}"))),
        (_, false) => Ending::Failed(Error::Refused(format!(
            "{place} does not show {} as it is at the instant",
            audit.scene
        ))),
    })
}
