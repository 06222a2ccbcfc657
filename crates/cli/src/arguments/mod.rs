//! The words of the command line.

mod check;
mod render;
mod report;
mod tune;
pub mod values;

use std::path::PathBuf;

use crate::selection::Programs;
use clap::{Args, Parser, Subcommand, ValueEnum};
use frame::{ColorSampling, VelocityKind};
use suite::{Border, DepthFormat, Up, VelocityFormat};

pub use check::{AcceptArgs, CalibrateArgs, CheckArgs};
pub use render::{MergeArgs, RenderArgs, Replicates};
pub use report::{CompareArgs, ReportArgs};
pub use tune::{CandidateArgs, EvaluateArgs, ServeArgs, TuneArgs};

use crate::arguments::values::{degrees_per_frame, jitter_frames, pixels_per_frame, rounds, size};

/// How good is a real-time motion blur? Renders the truth of moving scenes, runs filters on one frame of each, and
/// measures how far they are from it.
#[derive(Debug, Parser)]
#[command(name = "shuttertruth", version, max_term_width = 100)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Option<Command>,
    /// List the adapters that filters can run on, and end.
    #[arg(long)]
    pub list_adapters: bool,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Render, filter, measure: the main job. Prints a table; writes run.json, EXR and PNG.
    Run(RunArgs),
    /// Run, and hold every score to its bound: pass or fail, by the exit code.
    Check(CheckArgs),
    /// Make the scores of a finished run the baseline that later ones are compared with.
    Accept(AcceptArgs),
    /// Run several times, measure how scores scatter, and propose limits.
    Calibrate(CalibrateArgs),
    /// Render frames and truths alone, or some replicates of them.
    Render(RenderArgs),
    /// Join the replicates that several machines rendered.
    Merge(MergeArgs),
    /// Run a filter on a frame file.
    Blur(BlurArgs),
    /// Measure a finished picture, wherever it comes from.
    Score(ScoreArgs),
    /// Show a finished run, or a tuning, as one page that opens in a browser, without a network.
    Report(ReportArgs),
    /// Compare two finished runs of the same cases: what changed, and is it more than noise?
    Compare(CompareArgs),
    /// Time filters pass by pass, and against their reach. Prints tables; writes bench.json.
    Bench(BenchArgs),
    /// Find parameters that bring a filter nearer to the truth. Writes journal.jsonl and tune.json.
    Tune(TuneArgs),
    /// Score one set of parameters. Prints JSON.
    Evaluate(EvaluateArgs),
    /// Score sets of parameters as they come: JSON lines on standard input and output.
    Serve(ServeArgs),
    /// Make a scene folder of an OBJ file: camera, floor, wall, and motion as asked.
    Import(ImportArgs),
    /// List scenes, filters, parameters and presets.
    List(ListArgs),
}

/// `shuttertruth run`
#[derive(Debug, Args)]
pub struct RunArgs {
    #[command(flatten)]
    pub measure: MeasureArgs,
    #[command(flatten)]
    pub adapter: AdapterArgs,
    /// Write the run as one page, as `report` does.
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Print run.json to standard output instead of the table.
    #[arg(long)]
    pub json: bool,
}

/// What is measured by `run`, `check` and `calibrate`.
#[derive(Clone, Debug, Args)]
pub struct MeasureArgs {
    #[command(flatten)]
    pub scenes: SceneArgs,
    /// Filters: names or folders, each with an optional :preset, separated by commas [default: every built-in one].
    #[arg(long, value_delimiter = ',', value_name = "FILTERS")]
    pub filters: Vec<String>,
    /// A filter folder of your own; may be repeated. Runs beside those of --filters.
    #[arg(long, value_name = "FOLDER")]
    pub filter: Vec<String>,
    /// The preset of every filter [default: each preset in turn].
    #[arg(long, value_name = "NAME")]
    pub preset: Option<String>,
    /// Override a parameter; may be repeated.
    #[arg(long, value_name = "FILTER.PARAMETER=VALUE")]
    pub set: Vec<String>,
    /// Presets keep their constants in pixels as published; otherwise they are scaled from the width that their author had in
    /// mind to the picture's.
    #[arg(long)]
    pub as_written: bool,
    /// Picture size in pixels [default: 320x180; of `check`, the size that its bounds hold at].
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<(u32, u32)>,
    /// Independent renders behind each truth, an even number; each has an eighth of --samples-per-pixel.
    #[arg(long, value_name = "N", default_value_t = 8)]
    pub replicates: u32,
    /// Forms of the velocity buffer, separated by commas, to be tried on every filter beside 32-bit floats.
    #[arg(long, value_enum, value_delimiter = ',', value_name = "FORMATS")]
    pub velocity_format: Vec<VelocityFormat>,
    /// Forms of the depth buffer to be tried beside 32-bit floats.
    #[arg(long, value_enum, value_delimiter = ',', value_name = "FORMATS")]
    pub depth_format: Vec<DepthFormat>,
    /// What lies beyond the border, to be tried beside what each filter makes of it; see also --guard-band.
    #[arg(long, value_enum, value_delimiter = ',', value_name = "POLICIES")]
    pub border: Vec<Border>,
    /// Frames of its noise that a noisy filter is tried with, to tell its noise from its other errors; 0 for none.
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = jitter_frames)]
    pub jitter_frames: u32,
    /// Use no truth and no case that --out holds: remove them, and make all anew.
    #[arg(long)]
    pub no_cache: bool,
    #[command(flatten)]
    pub programs: ProgramArgs,
}

/// What filters may do beside running on the adapter.
#[derive(Clone, Copy, Debug, Args)]
pub struct ProgramArgs {
    /// Run filters that are programs. They may do whatever you may do: read their filter.toml first.
    #[arg(long)]
    pub allow_commands: bool,
}

impl ProgramArgs {
    /// Whether filters that are programs may be selected.
    pub fn programs(self) -> Programs {
        match self.allow_commands {
            true => Programs::Allowed,
            false => Programs::Refused,
        }
    }
}

/// On or off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Switch {
    /// It is there.
    On,
    /// It is not.
    Off,
}

/// What `render` shares with the commands that measure.
#[derive(Clone, Debug, Args)]
pub struct SceneArgs {
    /// Scenes: names or folders, each with an optional @variant or @all, separated by commas [default: every one].
    #[arg(long, value_delimiter = ',', value_name = "SCENES")]
    pub scenes: Vec<String>,
    /// Folder that holds the scenes.
    #[arg(long, value_name = "FOLDER", default_value = "scenes")]
    pub scenes_dir: PathBuf,
    /// Samples per pixel of 8 replicates of a truth: 8 times a power of two.
    #[arg(long, value_name = "N", default_value_t = 256)]
    pub samples_per_pixel: u32,
    /// Exposure in frames; 0.5 is a shutter of 180 degrees [default: each scene's own].
    #[arg(long, value_name = "E")]
    pub exposure: Option<f64>,
    /// What the velocity buffer holds: instantaneous, previous_frame, or camera_only (rebuilt from depth and the last
    /// frame's camera).
    #[arg(long, value_name = "KIND", default_value_t = VelocityKind::Instantaneous)]
    pub velocity: VelocityKind,
    /// How the frame's colour is sampled: antialiased or point (at pixel centres).
    #[arg(long, value_name = "SAMPLING", default_value_t = ColorSampling::Antialiased)]
    pub color: ColorSampling,
    /// Whether the background has a velocity.
    #[arg(long, value_enum, value_name = "SWITCH", default_value_t = Switch::On)]
    pub sky_velocity: Switch,
    /// Pixels by which the frame reaches beyond the picture on every side. Filters see them; what they make there is
    /// cropped before it is measured.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub guard_band: u32,
    /// Threads that render [default: one per core].
    #[arg(long, value_name = "N")]
    pub threads: Option<usize>,
    /// Seed of all randomness.
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub seed: u64,
    /// Folder for all files. Truths and cases found there are used again if nothing about them has changed.
    #[arg(long, value_name = "DIR", default_value = "out")]
    pub out: PathBuf,
    /// No progress bars.
    #[arg(long)]
    pub quiet: bool,
}

/// `shuttertruth blur`
#[derive(Debug, Args)]
pub struct BlurArgs {
    /// Filter: a name or a folder, with an optional :preset.
    #[arg(long, value_name = "FILTER")]
    pub filter: String,
    /// The preset [default: the filter's first].
    #[arg(long, value_name = "NAME")]
    pub preset: Option<String>,
    /// Override a parameter; may be repeated.
    #[arg(long, value_name = "FILTER.PARAMETER=VALUE")]
    pub set: Vec<String>,
    /// Presets keep their constants in pixels as published; otherwise they are scaled from the width that their author had in
    /// mind to the picture's.
    #[arg(long)]
    pub as_written: bool,
    /// OpenEXR file with the channels R G B, Z, velocity.X, velocity.Y.
    #[arg(long, value_name = "FILE")]
    pub frame: PathBuf,
    /// Exposure in frames [default: the file's attribute "exposure"].
    #[arg(long, value_name = "E")]
    pub exposure: Option<f64>,
    /// Frame number that the filter's noise starts from.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub frame_index: u32,
    /// OpenEXR file to write.
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    #[command(flatten)]
    pub programs: ProgramArgs,
    #[command(flatten)]
    pub adapter: AdapterArgs,
}

/// `shuttertruth score`
#[derive(Debug, Args)]
pub struct ScoreArgs {
    /// What an open shutter sees: truth_<alignment>.exr of `render` or `run`.
    #[arg(long, value_name = "FILE")]
    pub truth: PathBuf,
    /// The frame that the picture was made from: frame.exr of the same scene.
    #[arg(long, value_name = "FILE")]
    pub frame: PathBuf,
    /// The picture: OpenEXR with scene-linear R G B and, if it has them, coverage.<object>; or PNG, as a display shows it.
    #[arg(long, value_name = "FILE")]
    pub image: PathBuf,
    /// ladder_<alignment>.exr of `run` [default: no equivalent sub-frames].
    #[arg(long, value_name = "FILE")]
    pub ladder: Option<PathBuf>,
    /// Print all scores as JSON instead of the table.
    #[arg(long)]
    pub json: bool,
}

/// `shuttertruth bench`
#[derive(Debug, Args)]
pub struct BenchArgs {
    /// Filters: names or folders, each with an optional :preset, separated by commas [default: every built-in one].
    #[arg(long, value_delimiter = ',', value_name = "FILTERS")]
    pub filters: Vec<String>,
    /// Picture size in pixels [default: 1920x1080, or 320x180 on a software adapter].
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<(u32, u32)>,
    /// How often each filter is timed, in turns with the others; 20 or more.
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = rounds)]
    pub rounds: u32,
    /// Presets keep their constants in pixels as published; otherwise they are scaled from the width that their author had in
    /// mind to the picture's.
    #[arg(long)]
    pub as_written: bool,
    #[command(flatten)]
    pub adapter: AdapterArgs,
    /// Folder for bench.json.
    #[arg(long, value_name = "DIR", default_value = "out")]
    pub out: PathBuf,
    /// Print bench.json to standard output instead of the tables.
    #[arg(long)]
    pub json: bool,
    /// No progress bar.
    #[arg(long)]
    pub quiet: bool,
}

/// `shuttertruth import`
#[derive(Debug, Args)]
pub struct ImportArgs {
    /// The OBJ file. It is copied, with the MTL and PNG files that it names.
    #[arg(value_name = "MODEL.OBJ")]
    pub model: PathBuf,
    /// The scene's folder: new, named as the scene is to be called.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Turn the model on its stand.
    #[arg(long, value_name = "SPEED", value_parser = degrees_per_frame, allow_hyphen_values = true)]
    pub spin: Option<f64>,
    /// Slide it to the right, in pixels at 640x360.
    #[arg(long, value_name = "SPEED", value_parser = pixels_per_frame, allow_hyphen_values = true)]
    pub slide: Option<f64>,
    /// Lead the camera around it.
    #[arg(long, value_name = "SPEED", value_parser = degrees_per_frame, allow_hyphen_values = true)]
    pub orbit: Option<f64>,
    /// The model's axis that points up.
    #[arg(long, value_enum, value_name = "AXIS", default_value = "y")]
    pub up: Up,
    /// Import the shape alone, in grey, without materials.
    #[arg(long)]
    pub plain: bool,
    /// Exposure in frames; 0.5 is a shutter of 180 degrees.
    #[arg(long, value_name = "E", default_value_t = 0.5)]
    pub exposure: f64,
}

/// `shuttertruth list`
#[derive(Debug, Args)]
pub struct ListArgs {
    /// Folder that holds the scenes.
    #[arg(long, value_name = "FOLDER", default_value = "scenes")]
    pub scenes_dir: PathBuf,
    /// A filter folder of your own to list as well, and to try out with every preset and at both ends of every range; may be
    /// repeated.
    #[arg(long, value_name = "FOLDER")]
    pub filter: Vec<String>,
    #[command(flatten)]
    pub adapter: AdapterArgs,
    /// Print JSON.
    #[arg(long)]
    pub json: bool,
}

/// What filters run on.
#[derive(Debug, Args)]
pub struct AdapterArgs {
    /// Adapter: its number in --list-adapters or a part of its name [default: the fastest].
    #[arg(long, value_name = "ADAPTER")]
    pub adapter: Option<String>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    /// Every page that shows commands.
    const PAGES: [&str; 9] = [
        include_str!("../../../../README.md"),
        include_str!("../../../../docs/reading-a-report.md"),
        include_str!("../../../../docs/conventions.md"),
        include_str!("../../../../docs/add-a-filter.md"),
        include_str!("../../../../docs/add-a-scene.md"),
        include_str!("../../../../docs/ci.md"),
        include_str!("../../../../docs/fidelity.md"),
        include_str!("../../../../docs/not-measured.md"),
        include_str!("../../../../scenes/README.md"),
    ];

    /// The commands of a page, each in its words; those with a shell's variables are left out.
    fn commands(page: &str) -> Vec<Vec<String>> {
        let joined = page.replace("\\\n", " ");
        let lines = joined
            .lines()
            .filter(|line| line.starts_with("    shuttertruth "));
        let plain = lines.filter(|line| !line.contains('$'));
        plain.map(words).collect()
    }

    /// As a shell splits them, which knows quotes and comments.
    fn words(line: &str) -> Vec<String> {
        let command = line.split(" #").next().unwrap_or_default();
        let parts = command.split(['"', '\'']).enumerate();
        let words = parts.flat_map(|(index, part)| match index % 2 {
            0 => part.split_whitespace().map(str::to_owned).collect(),
            _ => vec![part.to_owned()],
        });
        words.collect()
    }

    #[test]
    fn every_command_that_the_guides_show_is_one() {
        let all: Vec<Vec<String>> = PAGES.into_iter().flat_map(commands).collect();
        assert!(all.len() > 40, "only {} commands were found", all.len());
        for command in all {
            if let Err(error) = Cli::try_parse_from(&command) {
                panic!("{}: {error}", command.join(" "));
            }
        }
    }
}
