//! Arguments that choose scenes and say how they are rendered.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use frame::{ColorSampling, FrameOptions, Size, VelocityKind};
use measure::Error;
use scene::SceneId;
use tracer::RenderSettings;

use super::{FrameRateArgs, RootArgs, parse_exposure, parse_samples, scene_names, thread_count};
use crate::selection::split_scene;

/// On or off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Switch {
    /// The background moves as the camera turns.
    On,
    /// The background has no velocity.
    Off,
}

/// Choice of scenes, and how they are rendered.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Scenes and files")]
pub struct SceneArgs {
    /// Scenes: names, folders or patterns such as 'rail*', each with an optional @variant or @all
    /// [default: all].
    #[arg(value_delimiter = ',', value_name = "SCENES", help_heading = None, value_parser = scene_names(), hide_possible_values = true)]
    pub scenes: Vec<String>,
    /// The same as an option: earlier commands, in run.json and in bounds.toml, have it.
    #[arg(
        long = "scenes",
        alias = "scene",
        hide = true,
        value_delimiter = ',',
        conflicts_with = "scenes"
    )]
    pub scenes_option: Vec<String>,
    /// Use the sealed variant SCENE@sealS of every scene. It has other speeds, directions, places,
    /// times and colours.
    #[arg(long, value_name = "S")]
    pub seal: Option<u64>,
    /// Frame rates and shutter times.
    #[command(flatten)]
    pub rates: FrameRateArgs,
    /// Folder of scenes.
    #[command(flatten)]
    pub root: RootArgs,
    /// Mean samples per pixel of a truth with 8 replicates, a multiple of 8. Noisy parts of the
    /// picture get more, quiet ones fewer [default: 256; for `run` and `check`, of scenes that are
    /// not built in as many as --noise 0.005 takes].
    #[arg(long, value_name = "N", value_parser = parse_samples)]
    pub samples_per_pixel: Option<u32>,
    /// Exposure in frames; 0.5 is a shutter of 180 degrees [default: each scene's own].
    #[arg(long, value_name = "E", value_parser = parse_exposure)]
    pub exposure: Option<f64>,
    /// Content of the velocity buffer: instantaneous, previous_frame, or camera_only (rebuilt from
    /// depth and the last frame's camera).
    #[arg(long, value_name = "KIND", default_value_t = VelocityKind::Instantaneous)]
    pub velocity: VelocityKind,
    /// Sampling of the frame's colour: antialiased, or point (at pixel centres).
    #[arg(long, value_name = "SAMPLING", default_value_t = ColorSampling::Antialiased)]
    pub frame_sampling: ColorSampling,
    /// Velocity of the background.
    #[arg(long, value_enum, value_name = "SWITCH", default_value_t = Switch::On)]
    pub sky_velocity: Switch,
    /// Pixels of the frame beyond the picture on every side. Filters see them; their output there
    /// is cropped.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub guard_band: u32,
    /// Threads that render [default: one per core].
    #[arg(long, value_name = "N", value_parser = thread_count())]
    pub threads: Option<usize>,
    /// Seed of all random numbers.
    #[arg(long, value_name = "S", default_value_t = RenderSettings::default().seed)]
    pub seed: u64,
    /// Folder for all files. Truths and cases in it are reused if their inputs have not changed.
    #[arg(short, long, value_name = "DIR", default_value = "out")]
    pub out: PathBuf,
}

impl SceneArgs {
    /// Returns the scenes as written; none for all.
    pub fn written(&self) -> &[String] {
        if self.scenes_option.is_empty() {
            &self.scenes
        } else {
            &self.scenes_option
        }
    }

    /// Names the scenes: sealed if --seal is given, and at the requested frame rates.
    pub fn names(&self) -> Result<Vec<String>, Error> {
        let names = self.rates.add_to(self.variant_names()?)?;
        let has_shutter_time = |name: &&String| {
            let rate = split_scene(name).1.rate;
            rate.is_some_and(|rate| rate.shutters_per_second.is_some())
        };
        match names.iter().find(has_shutter_time) {
            Some(name) if self.exposure.is_some() => refuse!(
                "--exposure: {name} has its shutter time in its name; allowed: one of the two; leave --exposure or the shutter time out"
            ),
            _ => Ok(names),
        }
    }

    fn variant_names(&self) -> Result<Vec<String>, Error> {
        let Some(seed) = self.seal else {
            return Ok(self.written().to_vec());
        };
        if let Some(name) =
            (self.written().iter()).find(|name| !split_scene(name).1.choice().is_empty())
        {
            refuse!(
                "--seal: {name} is a variant; allowed: scenes in their default variant, which sealed ones are made of"
            );
        }
        Ok(if self.written().is_empty() {
            vec![sealed("*", seed)]
        } else {
            (self.written().iter().map(|name| sealed(name, seed))).collect()
        })
    }

    /// Makes the settings of renders, for pictures of one size.
    pub fn render_settings(&self, size: Size, replicates: u32) -> RenderSettings {
        RenderSettings {
            exposure: self.exposure,
            options: self.frame_options(),
            guard_band: self.guard_band,
            samples_per_pixel: (self.samples_per_pixel)
                .unwrap_or(RenderSettings::default().samples_per_pixel),
            seed: self.seed,
            ..RenderSettings::default()
        }
        .with_size(size)
        .with_replicates(replicates)
    }

    /// Makes the options of a frame.
    pub fn frame_options(&self) -> FrameOptions {
        FrameOptions {
            velocity: self.velocity,
            color: self.frame_sampling,
            sky_velocity: self.sky_velocity == Switch::On,
        }
    }
}

/// Names the sealed variant of a scene.
fn sealed(scene: &str, seed: u64) -> String {
    let id = SceneId {
        seal: Some(seed),
        ..SceneId::default()
    };
    scene.trim_end_matches(['/', '\\']).to_owned() + &id.choice()
}
