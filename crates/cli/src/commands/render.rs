//! The command `truths render`.

use clap::Args;
use frame::{Alignment, Truth};
use store::{LADDER, MAX_REPLICATES, Sharing, claim, printable_path, scene_folder};
use suite::{Error, Rendering, deciding_floor, estimate_render_seconds};
use tracer::{RenderSettings, Scene};

use super::expected::print_expected_time;
use super::render_settings::make_render_settings;
use crate::arguments::{
    Replicates, SceneArgs, above_zero, frame_count, parse_replicates, parse_size,
};
use crate::output::{count_text, make_monitor, print, print_scene_notes};
use crate::selection::{SceneChoice, select_scenes};

#[derive(Debug, Args)]
pub struct RenderArgs {
    #[command(flatten)]
    pub scenes: SceneArgs,
    /// Picture size in pixels [default: each scene's own].
    #[arg(help_heading = "Scenes and files", long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<(u32, u32)>,
    /// Consecutive frames to render of every scene. Later frames lie in numbered folders below the scene's own.
    #[arg(help_heading = "Sequences", long, value_name = "N", default_value_t = 1, value_parser = frame_count())]
    pub frames: u32,
    /// Shutter alignments of the truths, separated by commas.
    #[arg(
        help_heading = "Truths",
        long,
        value_delimiter = ',',
        default_value = "trailing",
        value_name = "ALIGNMENTS"
    )]
    pub alignments: Vec<Alignment>,
    /// Independent renders per truth: an even number, or a part A..B (A to B-1) that `truths merge` joins with others. Each has an
    /// eighth of --samples-per-pixel. The part with replicate 0 renders the frame too.
    #[arg(help_heading = "Truths", long, value_name = "N|A..B", default_value = "8", value_parser = parse_replicates)]
    pub replicates: Replicates,
    /// Render more replicates until the noise of each truth (root mean square radiance, where anything moves) is at most
    /// this. Exit code 4 if --most-replicates do not suffice.
    #[arg(help_heading = "Truths", long, value_name = "TARGET", value_parser = above_zero(f64::MAX))]
    pub noise: Option<f64>,
    /// Render the ladder of sub-frames of each truth too, which `run` measures with.
    #[arg(help_heading = "Truths", long)]
    pub ladders: bool,
    /// Upper limit on replicates for --noise.
    #[arg(
        help_heading = "Truths",
        long,
        value_name = "N",
        default_value_t = 64,
        requires = "noise"
    )]
    pub most_replicates: u32,
}

/// Renders each scene's frame and truths, or a part of them, and prints their folders and noise.
pub fn execute(args: &RenderArgs) -> Result<(), Error> {
    if args.most_replicates > MAX_REPLICATES {
        refuse!(
            "--most-replicates {}; allowed: up to {MAX_REPLICATES}",
            args.most_replicates
        );
    }
    let mut noisy = Vec::new();
    let choices = select_scenes(&args.scenes.root.scenes_dir, &args.scenes.names()?)?;
    print_scene_notes(choices.iter().map(|choice| &choice.scene));
    check_frames(args, &choices)?;
    print_expected_renders(args, &choices)?;
    let frames = choices.iter().flat_map(|choice| {
        let frames = 0..args.frames;
        frames.map(|frame| choice.scene.at_frame(frame))
    });
    for scene in frames {
        match &args.replicates {
            Replicates::All(count) => noisy.extend(render_whole(args, &scene, *count)?),
            Replicates::Part(_) if args.ladders => {
                refuse!(
                    "--ladders needs whole truths: give --replicates a number, not a part A..B"
                );
            }
            Replicates::Part(indices) if args.noise.is_none() => {
                let settings = scene_settings(args, &scene, RenderSettings::default().replicates)?;
                let out = &args.scenes.out;
                let rendering = make_rendering(args, &scene, settings);
                let _claim = claim(out, [&scene], Sharing::Together)?;
                if indices.start == 0 {
                    rendering.frame()?;
                }
                rendering.shared(&args.alignments, indices.clone())?;
                for alignment in &args.alignments {
                    rendering.part(*alignment, indices.clone())?;
                }
                print(&format!("{}\n", printable_path(&scene_folder(out, &scene))))?;
            }
            Replicates::Part(_) => {
                refuse!(
                    "--noise needs whole truths: give --replicates a number to start from, not a part A..B"
                );
            }
        }
    }
    match noisy.as_slice() {
        [] => Ok(()),
        _ => Err(Error::TooNoisy(noisy.join("\n"))),
    }
}

/// Refuses frames at which a scene is not defined, before anything is rendered.
fn check_frames(args: &RenderArgs, choices: &[SceneChoice]) -> Result<(), Error> {
    for SceneChoice { scene, .. } in choices {
        let settings = scene_settings(args, scene, RenderSettings::default().replicates)?;
        for frame in 1..args.frames {
            let later = scene.at_frame(frame);
            for alignment in &args.alignments {
                settings.check_truth(&later, *alignment)?;
            }
        }
    }
    Ok(())
}

/// Prints the expected time of all scenes, none of which is rendered yet.
fn print_expected_renders(args: &RenderArgs, choices: &[SceneChoice]) -> Result<(), Error> {
    let count = match &args.replicates {
        Replicates::All(count) => *count,
        Replicates::Part(indices) => (indices.len() as u32).next_multiple_of(2),
    };
    let mut seconds = 0.0;
    for choice in choices {
        let settings = scene_settings(args, &choice.scene, count)?;
        seconds += estimate_render_seconds(&settings, args.alignments.len());
    }
    seconds *= f64::from(args.frames);
    let scenes = count_text(choices.len(), "scene", "scenes");
    print_expected_time(seconds, &scenes);
    Ok(())
}

/// Renders a scene's frame and truths; returns a line for each truth that stayed noisier than asked for.
fn render_whole(args: &RenderArgs, scene: &Scene, count: u32) -> Result<Vec<String>, Error> {
    let settings = scene_settings(args, scene, count)?;
    let out = &args.scenes.out;
    let rendering = make_rendering(args, scene, settings);
    let _claim = claim(out, [scene], Sharing::Together)?;
    rendering.frame()?;
    let mut noisy = Vec::new();
    let mut report = format!("{}\n", printable_path(&scene_folder(out, scene)));
    let mut ended = |truth: &Truth| {
        if args.ladders {
            let settings = settings.with_replicates(truth.provenance.replicates);
            let rendering = make_rendering(args, scene, settings);
            rendering.ladder(truth).ensure(&LADDER)?;
        }
        report += &floors_line(truth);
        Ok(())
    };
    match args.noise {
        None => {
            rendering.shared(&args.alignments, 0..count)?;
            for &alignment in &args.alignments {
                ended(&rendering.truth(alignment)?)?;
            }
        }
        Some(target) => {
            let most = args.most_replicates;
            rendering.truths_until(&args.alignments, (target, most), |truth, reached| {
                if !reached {
                    noisy.push(too_noisy_line(truth, target, most));
                }
                ended(truth)
            })?;
        }
    }
    print(&report)?;
    Ok(noisy)
}

fn make_rendering<'a>(
    args: &'a RenderArgs,
    scene: &'a Scene,
    settings: RenderSettings,
) -> Rendering<'a> {
    Rendering {
        scene,
        settings,
        out: &args.scenes.out,
        monitor: make_monitor(),
    }
}

fn scene_settings(args: &RenderArgs, scene: &Scene, count: u32) -> Result<RenderSettings, Error> {
    let size = args.size.unwrap_or((scene.width, scene.height));
    make_render_settings(&args.scenes, size, count)
}

/// Makes a line: `  trailing: 8 replicates, noise: moving 0.0021, static 0.0009, full 0.0012`
fn floors_line(truth: &Truth) -> String {
    let floors: Vec<String> = (truth.noise_floors().iter())
        .map(|(region, floor)| format!("{region} {floor:.2e}"))
        .collect();
    format!(
        "  {}: {} replicates, noise: {}\n",
        truth.alignment,
        truth.provenance.replicates,
        floors.join(", ")
    )
}

fn too_noisy_line(truth: &Truth, target: f64, most: u32) -> String {
    let (region, floor) = deciding_floor(truth);
    format!(
        "{} {}: the noise ({region}) is {floor:.2e} with {} replicates, above the {target:e} asked for; allow more than \
         {most} with --most-replicates, or raise --samples-per-pixel",
        truth.provenance.scene, truth.alignment, truth.provenance.replicates
    )
}
