//! Options of the fuzzer: the words after `cargo test --test fuzz --`.

use std::path::{Path, PathBuf};

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser};

use crate::target::{Target, find};
use crate::targets::ALL;

/// Changed inputs of all targets together when the tests run the fuzzer.
pub const CASES: u64 = 20_000;

/// Tries hostile and broken input.
#[derive(Clone, Parser)]
#[command(name = "fuzz")]
pub struct Options {
    /// Targets, with commas between them [default: all]
    #[arg(long, value_delimiter = ',', value_parser = find)]
    pub targets: Vec<&'static Target>,
    /// Changed inputs of all targets together
    #[arg(long, default_value_t = CASES)]
    pub cases: u64,
    /// Minutes to go on for, in rounds of a tenth of the cases
    #[arg(long)]
    pub minutes: Option<f64>,
    /// Seed of the inputs
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Tries this file only; the name of its folder is its target, or --targets names it
    #[arg(long, value_parser = |path: &str| std::fs::canonicalize(path))]
    pub input: Option<PathBuf>,
    /// First case of a worker process, and the one after its last.
    #[arg(long, hide = true, num_args = 2)]
    pub work: Vec<u64>,
    /// Folder of the [`fixture`](crate::fixture) that a worker uses.
    #[arg(long, hide = true, default_value = "none")]
    pub fixture: PathBuf,
    // What `cargo test` and cargo-nextest may pass to any test program.
    #[arg(hide = true)]
    names: Vec<String>,
    #[arg(long, hide = true)]
    list: bool,
    #[arg(long, hide = true)]
    ignored: bool,
    #[arg(long, hide = true, aliases = ["no-capture", "show-output", "exact", "include-ignored", "quiet"])]
    nocapture: bool,
    #[arg(long, hide = true, aliases = ["test-threads", "format", "color", "logfile"])]
    skip: Vec<String>,
}

impl Options {
    /// Returns the chosen targets, or the one of the only input, or all. Slow targets come first.
    pub fn chosen(&self) -> Vec<&'static Target> {
        let mut chosen = match &self.input {
            _ if !self.targets.is_empty() => self.targets.clone(),
            None => ALL.iter().filter(|target| target.share > 0).collect(),
            Some(path) => {
                let folder = path.parent().and_then(Path::file_name).unwrap_or_default();
                let found = find(&folder.to_string_lossy());
                let refuse = |reason| {
                    Self::command()
                        .error(ErrorKind::InvalidValue, reason)
                        .exit()
                };
                vec![found.unwrap_or_else(refuse)]
            }
        };
        chosen.sort_by_key(|target| target.share);
        chosen
    }

    /// Returns whether only other tests were asked for; prints the name of this one for a list.
    pub fn asks_for_other_tests(&self) -> bool {
        let Self { list, names, .. } = self;
        if *list {
            println!("fuzz: test");
        }
        let is_own = names.is_empty() || names.iter().any(|name| "fuzz".contains(name.as_str()));
        *list || self.ignored || !is_own
    }
}
