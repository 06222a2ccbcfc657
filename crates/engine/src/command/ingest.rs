//! The command `engine ingest`.

use std::path::{Path, PathBuf};

use clap::Args;
use frame::{Display, Region, Truth};
use measure::{Error, IngestedScene, printable_path};
use scene::{Location, Scene};
use terminal::arguments::RootArgs;
use terminal::output::{make_monitor, print, print_note};
use terminal::refuse;

use super::capture::{load_drawn_scene, name_folder};
use crate::capture::folder::Capture;
use crate::ingest::{IngestPlan, Ingested, ingest};

/// Arguments of `engine ingest`.
#[derive(Debug, Args)]
pub struct IngestArgs {
    /// Folder of a capture: capture.toml, color.exr, velocity.exr, depth.exr; optionally
    /// subframes/0000.exr and on, and blurred.exr.
    #[arg(value_name = "DIR")]
    pub capture: PathBuf,
    /// TOML file with a table [convention] that says which velocity, depth and colour the engine
    /// has [default: engine.toml in DIR].
    #[arg(long, value_name = "FILE")]
    pub convention: Option<PathBuf>,
    /// Folder to write, which gives the scene its name [default: out/engine/<name of DIR>].
    #[arg(short, long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Folder of scenes.
    #[command(flatten)]
    pub root: RootArgs,
}

/// Largest motion between two sub-frames before more sub-frames are advised, in pixels.
const LONG_STEP: f64 = 0.5;
/// Smallest change of the mean radiance to report.
const LEAST_GAIN: f64 = 0.01;
/// Smallest part of pixels that change without velocity to report; shadows and disocclusions are
/// few.
const LEAST_RESTLESS: f64 = 0.03;

/// Ingests a capture, prints the result, and says how far its truth can be trusted.
pub fn execute(args: &IngestArgs) -> Result<(), Error> {
    let capture = Capture::read(&args.capture, args.convention.as_deref())?;
    let out = choose_folder(args)?;
    for note in &capture.notes {
        print_note(note);
    }
    let traced = find_scene(&capture, &args.root.scenes_dir);
    let mut display = traced
        .as_ref()
        .map_or_else(Display::default, |scene| scene.display);
    display.stops = capture.description.stops.unwrap_or(display.stops);
    let names = traced.as_ref().map(Scene::object_names);
    let plan = IngestPlan {
        capture: &capture,
        display,
        names,
        out: &out,
    };
    let ingested = make_monitor().watch("sub-frames", |watch| ingest(plan, watch))?;
    print(describe(&ingested, &out, traced.as_ref()))
}

/// Names the folder to write: the given one, or one with the capture's name.
fn choose_folder(args: &IngestArgs) -> Result<PathBuf, Error> {
    let out = name_folder(&args.capture, args.out.as_ref(), "out/engine")?;
    let capture = args.capture.canonicalize().ok();
    if out.canonicalize().is_ok_and(|out| Some(out) == capture) {
        refuse!(
            "--out {}: is the capture itself, and its files would be overwritten; name another folder",
            out.display()
        )
    } else {
        Ok(out)
    }
}

/// Loads the scene that the capture names; none if it names none, or there is no such scene.
fn find_scene(capture: &Capture, scenes: &Location) -> Option<Scene> {
    let name = capture.description.scene.as_ref()?.to_string();
    let scene = load_drawn_scene(scenes, &name).ok();
    if scene.is_none() {
        print_note(&format!(
            "{} has no scene {name}, whose display exposure the pictures would have; name the folder of scenes with \
             --scenes-dir",
            scenes
        ));
    }
    scene
}

/// Describes the truth, the picture, and what is wrong with them.
fn describe(ingested: &Ingested, out: &Path, traced: Option<&Scene>) -> String {
    let scene = &ingested.scene;
    let folder = printable_path(out);
    let mut lines = vec![format!(
        "{}: {}, drawn by {}",
        scene.id, scene.size, scene.engine
    )];
    if let Some(truth) = &ingested.truth {
        push_truth(&mut lines, scene, truth);
    }
    if let Some(moving) = ingested.moving {
        let [moving, restless] = [moving, ingested.restless].map(|part| 100.0 * part);
        lines.push(format!(
            "moving: {moving:.1} % of the pixels; {restless:.1} % change between sub-frames though no velocity reaches them"
        ));
        if ingested.restless > LEAST_RESTLESS {
            lines.push(format!(
                "FOUND: the moving region has {restless:.1} % of the pixels too many if nothing moves there, and its scores are diluted; \
                 draw all sub-frames with one seed, without grain and temporal effects; if things do move there, `engine audit` says whether \
                 velocity is right"
            ));
        }
    }
    if let Some(truth) = &ingested.truth {
        let objects = match truth.objects.len() {
            1 => "none: the sub-frames have no ids, and there are no scores of objects".to_owned(),
            _ => truth.objects[1..].join(", "),
        };
        lines.push(format!("objects: {objects}"));
    }
    if scene.has_picture {
        lines.push(format!(
            "picture: the engine's own blur, {folder}/blurred.exr"
        ));
    }
    match ingested.gain {
        Some(gain) if (gain - 1.0).abs() > LEAST_GAIN => {
            let change = if gain > 1.0 { "brighter" } else { "darker" };
            lines.push(format!(
                "FOUND: the engine's blur makes the picture {change}, {gain:.4} times where no velocity reaches; its weights should \
                 add up to 1"
            ));
        }
        None if scene.has_picture => lines.push(
            "the gain of the engine's blur is not judged: velocity reaches every lit pixel"
                .to_owned(),
        ),
        _ => {}
    }
    lines.push(format!("written: {folder}"));
    let dot = if out.is_relative() { "./" } else { "" };
    let ours = traced.map_or(String::new(), |scene| format!("{},", scene.id));
    lines.push(match scene.check_truth() {
        Ok(()) => format!("next: shuttertruth run {ours}{dot}{folder}"),
        Err(_) => "no sub-frames, and so no truth: `run` needs one; `score` can compare the picture with a truth of ours".to_owned(),
    });
    lines.join("\n") + "\n"
}

/// Adds the kind of truth, and how far it can be trusted.
fn push_truth(lines: &mut Vec<String>, scene: &IngestedScene, truth: &Truth) {
    let length = scene.step * f64::from(scene.subframes);
    let most = scene.ladder.last().copied().unwrap_or(1);
    lines.push(format!(
        "truth: mean of {} sub-frames, {} shutter, open for {} frames; not path traced\n\
         limit: 99 % of what moves goes at most {length:.1} px while the shutter is open, {:.2} px between two sub-frames; a smear has \
         steps of that length, and equivalent sub-frames are told up to {most}",
        scene.subframes, scene.alignment, scene.exposure, scene.step
    ));
    if scene.step > LONG_STEP {
        let wanted = ((length / LONG_STEP).ceil() as u32).next_multiple_of(2);
        lines.push(format!(
            "advice: {wanted} sub-frames would have steps of half a pixel"
        ));
    }
    let floors: Vec<String> = (truth.noise_floors().iter())
        .filter(|(region, _)| matches!(region, Region::Moving | Region::Still | Region::Full))
        .map(|(region, floor)| format!("{region} {floor:.2e}"))
        .collect();
    lines.push(format!(
        "noise of the truth, from its halves: {}",
        floors.join(", ")
    ));
}
