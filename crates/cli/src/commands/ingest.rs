//! The command `ingest`.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use frame::{Display, Region};
use suite::{Capture, EngineScene, Error, Ingested, Sharing, claim, ingest, printable_path};
use tracer::load_scene;

use crate::arguments::IngestArgs;
use crate::output::print::{print, print_note};
use crate::output::progress::make_monitor;

/// Ingests a capture and prints what came of it, and what its truth can tell.
pub fn execute(args: &IngestArgs) -> Result<(), Error> {
    let capture = Capture::read(&args.capture, args.convention.as_deref())?;
    let out = choose_folder(args)?;
    for note in &capture.notes {
        print_note(note);
    }
    let display = find_display(&capture, &args.scenes_dir);
    let _claim = claim(&out, [], Sharing::Alone)?;
    let ingested =
        make_monitor().watch("sub-frames", |watch| ingest(&capture, display, &out, watch))?;
    print(&describe(&ingested, &out))
}

/// Names the folder to write: as the capture's own is named, if none is given.
fn choose_folder(args: &IngestArgs) -> Result<PathBuf, Error> {
    let capture = (args.capture.canonicalize())
        .map_err(|source| frame::FileError::io(&args.capture, "read", source))?;
    let out = match &args.out {
        Some(out) => out.clone(),
        None => Path::new("out/engine").join(capture.file_name().unwrap_or(capture.as_os_str())),
    };
    match out.canonicalize().is_ok_and(|out| out == capture) {
        true => Err(Error::Usage(format!(
            "--out {}: is the capture itself, whose files would be overwritten; name another folder",
            out.display()
        ))),
        false => Ok(out),
    }
}

/// Finds the exposures at which pictures are shown and compared: those of the scene that the capture names, if it is there.
fn find_display(capture: &Capture, scenes: &Path) -> Display {
    let description = &capture.description;
    let scene = description.scene.as_deref().and_then(|name| {
        let (folder, variant) = match name.split_once('@') {
            Some((folder, variant)) => (folder, Some(variant)),
            None => (name, None),
        };
        let found = load_scene(&scenes.join(folder), variant);
        if found.is_err() {
            print_note(&format!(
                "{} has no scene {name}; its display exposure is taken for {} stops: name the folder of scenes with \
                 --scenes-dir",
                scenes.display(),
                description.stops.unwrap_or(0.0)
            ));
        }
        found.ok()
    });
    let display = scene.map_or_else(Display::default, |scene| scene.display);
    Display {
        stops: description.stops.unwrap_or(display.stops),
        ..display
    }
}

fn describe(ingested: &Ingested, out: &Path) -> String {
    let scene = &ingested.scene;
    let [width, height] = scene.size;
    let folder = printable_path(out);
    let mut text = format!(
        "{}: {width}x{height}, drawn by {}\n",
        scene.name, scene.engine
    );
    if let Some(truth) = &ingested.truth {
        text += &describe_truth(scene);
        let floor = truth.noise_floors().into_iter();
        let floors: Vec<String> = (floor
            .filter(|(region, _)| matches!(region, Region::Moving | Region::Still | Region::Full)))
        .map(|(region, floor)| format!("{region} {floor:.2e}"))
        .collect();
        let _ = writeln!(
            text,
            "noise of the truth, from its halves: {}",
            floors.join(", ")
        );
    }
    if scene.has_picture {
        let _ = writeln!(text, "picture: the engine's own blur, {folder}/blurred.exr");
    }
    let _ = writeln!(text, "written: {folder}");
    let dot = if out.is_relative() { "./" } else { "" };
    match scene.check_truth() {
        Ok(()) => {
            let _ = writeln!(text, "next: shuttertruth run --scenes {dot}{folder}");
        }
        Err(_) => {
            let _ = writeln!(
                text,
                "no sub-frames, and so no truth: `run` needs one; `score` can compare the picture with a truth of ours"
            );
        }
    }
    text
}

/// Says what the truth is, and how far it can be trusted.
fn describe_truth(scene: &EngineScene) -> String {
    let length = scene.step * f64::from(scene.subframes);
    let most = scene.ladder.last().copied().unwrap_or(1);
    format!(
        "truth: mean of {} sub-frames, {} shutter, open for {} frames; not path traced\n\
         limit: the fastest pixel moves {length:.1} px while the shutter is open, {:.2} px between two sub-frames: so far apart \
         the truth's own copies of an edge can lie; it tells counts of equivalent sub-frames up to {most}\n",
        scene.subframes, scene.alignment, scene.exposure, scene.step
    )
}
