//! Arguments of `ask`.

use std::path::PathBuf;

use clap::Args;
use glob::Pattern;
use study::Question;

use super::parse::{parse_glob, parse_named, parse_whole};

/// `shuttertruth ask`
#[derive(Debug, Args)]
pub struct AskArgs {
    /// run.json of a finished run, or its folder, with the pictures. Clips need a run with --frames.
    #[arg(value_name = "RUN", default_value = "out")]
    pub run: PathBuf,
    /// New or empty folder for the page and its pictures.
    #[arg(short, long, value_name = "DIR", default_value = "out/ask")]
    pub out: PathBuf,
    /// Questions that the page offers, of which a session asks one; repeatable, or separated by commas.
    #[arg(
        long,
        value_name = "QUESTION",
        value_delimiter = ',',
        value_parser = parse_named(Question::ALL, Question::name, Question::help),
        default_value = "truth,better"
    )]
    pub question: Vec<Question>,
    /// Scenes of the run, by name or pattern such as 'rail*'; repeatable, or separated by commas [default: all].
    #[arg(long, visible_alias = "scene", value_name = "SCENES", value_delimiter = ',', value_parser = parse_glob)]
    pub scenes: Vec<Pattern>,
    /// Filters of the run, by name or pattern such as 'kino' or 'mcguire:*'; repeatable, or separated by commas [default: all].
    #[arg(long, visible_alias = "filter", value_name = "FILTERS", value_delimiter = ',', value_parser = parse_glob)]
    pub filters: Vec<Pattern>,
    /// Largest number of pairs in a session; a few checks come on top.
    #[arg(long, value_name = "N", default_value_t = 60, value_parser = parse_whole::<usize>)]
    pub pairs: usize,
    /// Print what was written as JSON.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}
