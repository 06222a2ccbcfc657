//! The command `truths render`.

use std::ops::Range;
use terminal::refuse;

use clap::Args;
use frame::{Alignment, Size, Truth};
use measure::{
    Error, LADDER, MAX_REPLICATES, Rendering, Sharing, deciding_floor, estimate_render_seconds,
    lock_folder, printable_path, scene_folder,
};
use scene::Scene;
use tracer::{RenderSettings, check_next_frame};

use terminal::arguments::{
    Replicates, SceneArgs, above_zero, frame_count, parse_replicates, parse_size, within,
};
use terminal::expected::print_expected_time;
use terminal::output::{count_text, make_monitor, print, print_scene_notes};
use terminal::selection::select_scenes;

/// Arguments of `truths render`.
#[derive(Debug, Args)]
pub struct RenderArgs {
    /// Scenes.
    #[command(flatten)]
    pub scenes: SceneArgs,
    /// Picture size in pixels [default: each scene's own].
    #[arg(help_heading = "Scenes and files", long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<Size>,
    /// Consecutive frames to render of every scene. Later frames go to numbered folders below the
    /// scene's own.
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
    /// Independent renders per truth: an even number, or a part A..B (A to B-1) that `truths merge`
    /// joins with others. Each has an eighth of --samples-per-pixel. The part with replicate 0
    /// renders the frame too.
    #[arg(help_heading = "Truths", long, value_name = "N|A..B", default_value = "8", value_parser = parse_replicates)]
    pub replicates: Replicates,
    /// Render more replicates until the noise of each truth (root mean square radiance, where
    /// anything moves) is at most this. Exit code 4 if --most-replicates do not suffice.
    #[arg(help_heading = "Truths", long, value_name = "TARGET", value_parser = above_zero(f64::MAX))]
    pub noise: Option<f64>,
    /// Render the ladder of sub-frames of each truth too, which `run` measures with.
    #[arg(help_heading = "Truths", long)]
    pub ladders: bool,
    /// Write velocity_next, velocity_z and exclusion to frame.exr too, for `engine blur` with
    /// filters that read them.
    #[arg(help_heading = "Truths", long)]
    pub further_velocities: bool,
    /// Upper limit on replicates for --noise.
    #[arg(
        help_heading = "Truths",
        long,
        value_name = "N",
        default_value_t = 64,
        requires = "noise",
        value_parser = within::<u32>(0..=u64::from(MAX_REPLICATES))
    )]
    pub most_replicates: u32,
}

/// Renders each scene's frame and truths, or a part of them, and prints their folders and noise.
pub fn execute(args: &RenderArgs) -> Result<(), Error> {
    let whole = [
        ("--ladders", args.ladders),
        ("--noise", args.noise.is_some()),
    ];
    let asked = whole.iter().find(|(_, is_asked)| *is_asked);
    if let (Replicates::Part(_), Some((option, _))) = (&args.replicates, asked) {
        refuse!("{option} needs whole truths: give --replicates a number, not a part A..B");
    }
    let choices = select_scenes(&args.scenes.root.scenes_dir, &args.scenes.names()?)?;
    let scenes: Vec<Scene> = choices.into_iter().map(|choice| choice.scene).collect();
    print_scene_notes(&scenes);
    let mut seconds = 0.0;
    let mut settings = Vec::new();
    for scene in &scenes {
        let full = scene_settings(args, scene)?;
        let timed = match &args.replicates {
            Replicates::All(_) => full,
            Replicates::Part(some) => full.with_replicates((some.len() as u32).next_multiple_of(2)),
        };
        seconds += f64::from(args.frames) * estimate_render_seconds(&timed, args.alignments.len());
        settings.push(full);
    }
    print_expected_time(seconds, &count_text(scenes.len(), "scene", "scenes"));
    let mut noisy = Vec::new();
    for (scene, settings) in scenes.iter().zip(&settings) {
        for frame in 0..args.frames {
            let scene = scene.at_frame(frame);
            let _lock = lock_folder(&args.scenes.out, [&scene], Sharing::Together)?;
            let rendering = Rendering {
                scene: (&scene).into(),
                settings: *settings,
                out: &args.scenes.out,
                monitor: make_monitor(),
            };
            let text = match &args.replicates {
                Replicates::All(_) => render_whole(args, rendering, &mut noisy)?,
                Replicates::Part(indices) => render_some(args, rendering, indices)?,
            };
            let folder = printable_path(&scene_folder(&args.scenes.out, &scene));
            print(format!("{folder}\n{text}"))?;
        }
    }
    match noisy.as_slice() {
        [] => Ok(()),
        _ => Err(Error::TooNoisy(noisy.join("\n"))),
    }
}

/// Makes a scene's render settings. Refuses frames that the scene does not define.
fn scene_settings(args: &RenderArgs, scene: &Scene) -> Result<RenderSettings, Error> {
    let size = args.size.unwrap_or(Size::new(scene.width, scene.height));
    let count = match &args.replicates {
        Replicates::All(count) => *count,
        Replicates::Part(_) => RenderSettings::default().replicates,
    };
    let settings = args.scenes.render_settings(size, count);
    for frame in 0..args.frames {
        let later = scene.at_frame(frame);
        if args.further_velocities {
            check_next_frame(&later)?;
        }
        for alignment in &args.alignments {
            settings.check_truth(&later, *alignment)?;
        }
    }
    Ok(settings)
}

/// Renders a scene's frame, with the velocities that are asked for.
fn render_frame(args: &RenderArgs, rendering: Rendering) -> Result<(), Error> {
    if args.further_velocities {
        rendering.write_further_inputs()
    } else {
        rendering.frame().map(drop)
    }
}

/// Renders some replicates of a scene's truths, and the frame together with replicate 0. Reports no
/// noise.
fn render_some(
    args: &RenderArgs,
    rendering: Rendering,
    indices: &Range<u32>,
) -> Result<String, Error> {
    if indices.start == 0 {
        render_frame(args, rendering)?;
    }
    rendering.shared(&args.alignments, indices.clone())?;
    for alignment in &args.alignments {
        rendering.part(*alignment, indices.clone())?;
    }
    Ok(String::new())
}

/// Renders a scene's frame and truths; returns a line per truth. Adds one to `noisy` for each truth
/// that exceeds the requested noise.
fn render_whole(
    args: &RenderArgs,
    rendering: Rendering,
    noisy: &mut Vec<String>,
) -> Result<String, Error> {
    render_frame(args, rendering)?;
    let (target, most) = (args.noise.unwrap_or(f64::INFINITY), args.most_replicates);
    let mut report = String::new();
    let ended = |truth: &Truth, is_reached: bool| {
        if !is_reached {
            noisy.push(too_noisy_line(truth, target, most));
        }
        if args.ladders {
            let replicates = truth.provenance.replicates;
            let rendering = Rendering {
                settings: rendering.settings.with_replicates(replicates),
                ..rendering
            };
            rendering.ladder(truth).ensure(&LADDER)?;
        }
        report += &floors_line(truth);
        Ok(())
    };
    rendering.truths_until(&args.alignments, target, most, ended)?;
    Ok(report)
}

/// Formats a line: `  trailing: 8 replicates, noise: moving 0.0021, static 0.0009, full 0.0012`
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
