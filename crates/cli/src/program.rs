//! The command line: its words, and the work of each.

use std::ffi::OsString;

use clap::error::{ContextKind, ContextValue};
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use measure::Error;

use crate::commands::*;
use engine::command::{audit, blur, export, import, ingest};
use terminal::output::{OutputArgs, print_note};
use terminal::result::Ending;
use terminal::settings::{FromFile, Settings};

/// Version, commit and target of the program.
const VERSION: &str = env!("SHUTTERTRUTH_VERSION");

/// Measures real-time motion blur against true shutter blur
#[derive(Debug, Parser)]
#[command(name = "shuttertruth", version = VERSION, max_term_width = 100)]
pub struct Cli {
    /// The command.
    #[command(subcommand)]
    pub command: Command,
    #[command(flatten)]
    pub output: OutputArgs,
    /// Number of threads that the command is given.
    #[arg(skip)]
    pub threads: Option<usize>,
    /// Settings of the working folder.
    #[arg(skip)]
    pub settings: Settings,
    /// Values of the command that are the settings', in words.
    #[arg(skip)]
    pub from_file: Option<String>,
}

/// What the settings give each command.
const FROM_FILE: [FromFile; 8] = [
    FromFile {
        command: "run",
        keys: "scenes size samples_per_pixel filters out",
    },
    FromFile {
        command: "check",
        keys: "scenes size samples_per_pixel filters out baseline",
    },
    FromFile {
        command: "report",
        keys: "out:run",
    },
    FromFile {
        command: "compare",
        keys: "out:first",
    },
    FromFile {
        command: "bench",
        keys: "filters out",
    },
    FromFile {
        command: "truths render",
        keys: "scenes size samples_per_pixel out",
    },
    FromFile {
        command: "limits accept",
        keys: "out baseline",
    },
    FromFile {
        command: "limits calibrate",
        keys: "scenes size samples_per_pixel filters out",
    },
];

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Begin a filter of your own: write an engine's example, and try it
    New(new::NewArgs),
    /// Render scenes, run filters, measure and rank them
    ///
    /// Prints a ranking; writes report.html, run.json, EXR and PNG.
    Run(run::RunArgs),
    /// Run, and compare every score with its bound: pass or fail
    Check(gate::CheckArgs),
    /// Measure a finished picture from any source
    Score(score::ScoreArgs),
    /// Write a finished run or tuning as one HTML page
    Report(report::ReportArgs),
    /// Compare two runs: which scores changed by more than noise
    Compare(run::CompareArgs),
    /// List scenes, filters, parameters, presets, inputs and adapters
    List(list::ListArgs),
    /// Time filters pass by pass, and against their blur length
    ///
    /// Prints tables; writes bench.json.
    Bench(bench::BenchArgs),
    /// Search, study and compare the parameters of a filter
    #[command(subcommand, disable_help_subcommand = true)]
    Tune(tune::TuneCommand),
    /// Exchange scenes and frames with engines
    #[command(subcommand, disable_help_subcommand = true)]
    Engine(EngineCommand),
    /// Render truths; join truths and runs
    #[command(subcommand, disable_help_subcommand = true)]
    Truths(TruthsCommand),
    /// Accept scores as a baseline, or propose bounds
    #[command(subcommand, disable_help_subcommand = true)]
    Limits(LimitsCommand),
    /// Print completions for a shell
    Completions(description::CompletionsArgs),
    /// Write the pages of the manual
    Man(description::ManArgs),
}

/// The commands of `engine`.
#[derive(Debug, Subcommand)]
pub enum EngineCommand {
    /// Make a scene from a model: an OBJ file with a motion, a folder of OBJ files, or an animated glTF file
    Import(import::ImportArgs),
    /// Write scenes as glTF 2.0, so that an engine can draw them
    Export(export::ExportArgs),
    /// Make a frame, a truth and a picture from an engine's images, so that `run` and `score` can
    /// measure them
    Ingest(ingest::IngestArgs),
    /// Compare an engine's velocity and depth with the scene's, and name what is wrong
    Audit(audit::AuditArgs),
    /// Run a filter on a frame file
    Blur(blur::BlurArgs),
}

/// The commands of `truths`.
#[expect(clippy::large_enum_variant, reason = "a process has one")]
#[derive(Debug, Subcommand)]
pub enum TruthsCommand {
    /// Render frames and truths only, or some replicates of them
    Render(run::RenderArgs),
    /// Join what several machines made: replicates of truths, or runs of some of the cases
    Merge(merge::MergeArgs),
}

/// The commands of `limits`.
#[expect(clippy::large_enum_variant, reason = "a process has one")]
#[derive(Debug, Subcommand)]
pub enum LimitsCommand {
    /// Make the scores of a finished run the baseline of later checks
    Accept(gate::AcceptArgs),
    /// Run several times, measure how scores scatter, and propose bounds
    Calibrate(gate::CalibrateArgs),
}

impl Cli {
    /// Makes the command line with help that lists the commands for beginners.
    pub fn command_line(settings: &Settings) -> clap::Command {
        let mut program = settings.give_defaults(Self::command(), &FROM_FILE);
        program.build();
        // The commands have headings, and say more about colours; a screen has 24 lines.
        (program.mut_subcommand("help", |help| help.hide(true)))
            .mut_args(|argument| {
                let is_color = argument.get_id() == "color";
                argument.help_heading(None::<&str>).hide(is_color)
            })
            .help_template("{about-with-newline}{usage-heading} {usage}\n\n{all-args}")
    }

    /// Parses the words of a command line.
    ///
    /// # Errors
    /// The words are wrong, or ask for help.
    pub fn parse_words<W: Into<OsString> + Clone>(
        words: impl IntoIterator<Item = W>,
        settings: &Settings,
    ) -> Result<Self, clap::Error> {
        let mut program = Self::command_line(settings);
        let matches = program.try_get_matches_from_mut(words)?;
        let parsed =
            Self::from_arg_matches(&matches).map_err(|error| error.format(&mut program))?;
        let mut command = &matches;
        let mut names = Vec::new();
        while let Some((name, inner)) = command.subcommand() {
            command = inner;
            names.push(name);
        }
        let from = FROM_FILE
            .iter()
            .find(|from| from.command == names.join(" "));
        let from_file = from.and_then(|from| settings.used_text(command, from));
        let threads = command.try_get_one("threads").unwrap_or(None).copied();
        Ok(Self {
            threads,
            settings: settings.clone(),
            from_file,
            ..parsed
        })
    }
}

/// Names the new place of a command that moved into a group; none for other errors.
pub fn find_new_place(error: &clap::Error) -> Option<String> {
    let program = Cli::command();
    match error.get(ContextKind::InvalidSubcommand) {
        Some(ContextValue::String(word)) => program.get_subcommands().find_map(|group| {
            let command = group.find_subcommand(word)?.get_name();
            Some(format!(
                "{word}: use shuttertruth {} {command}",
                group.get_name()
            ))
        }),
        // An option without the command of `tune`.
        _ if error.get(ContextKind::InvalidArg).is_some() => {
            let mut words = std::env::args().skip_while(|word| word != "tune").skip(1);
            let is_option = words.next()?.starts_with("--");
            is_option.then(|| "tune: use shuttertruth tune search".to_owned())
        }
        _ => None,
    }
}

/// Does a command's work on the requested number of threads.
pub fn execute(program: &Cli) -> Result<Ending, Error> {
    if let Some(threads) = program.threads {
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build_global()
            .map_err(|error| Error::Refused(format!("cannot start the threads: {error}")))?;
    }
    program.from_file.iter().for_each(|text| print_note(text));
    let done = match &program.command {
        Command::New(args) => new::execute(args),
        Command::Run(args) => run::execute(args, &report::ADDITIONS),
        Command::Check(args) => return gate::execute_check(args, &report::ADDITIONS),
        Command::Score(args) => score::execute(args),
        Command::Report(args) => report::execute(args),
        Command::Compare(args) => run::execute_compare(args),
        Command::List(args) => list::execute(args, &program.settings),
        Command::Bench(args) => bench::execute(args),
        Command::Tune(command) => tune::execute(command),
        Command::Engine(EngineCommand::Import(args)) => import::execute(args),
        Command::Engine(EngineCommand::Export(args)) => export::execute(args),
        Command::Engine(EngineCommand::Ingest(args)) => ingest::execute(args),
        Command::Engine(EngineCommand::Audit(args)) => return audit::execute(args),
        Command::Engine(EngineCommand::Blur(args)) => blur::execute(args),
        Command::Truths(TruthsCommand::Render(args)) => run::execute_render(args),
        Command::Truths(TruthsCommand::Merge(args)) => merge::execute(args),
        Command::Limits(LimitsCommand::Accept(args)) => gate::execute_accept(args),
        Command::Limits(LimitsCommand::Calibrate(args)) => gate::execute_calibrate(args),
        Command::Completions(args) => description::print_completions(args, Cli::command()),
        Command::Man(args) => description::write_manual(args, Cli::command()),
    };
    done.map(|()| Ending::Done)
}
