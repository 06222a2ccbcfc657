//! Options of the fuzzer: the words after `cargo test --test fuzz --`.

use std::path::PathBuf;

use clap::Parser;

use crate::target::{Target, find};
use crate::targets::ALL;

/// Changed inputs of all targets together, in the tests and in each round of a longer run.
const CASES: u64 = 1_000;

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
    /// Minutes to go on for, in rounds of so many cases
    #[arg(long)]
    pub minutes: Option<f64>,
    /// Seed of the inputs
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Tries this file only
    #[arg(long, requires = "targets", value_parser = |path: &str| std::fs::canonicalize(path))]
    pub input: Option<PathBuf>,
    /// First case of a worker process, and the one after its last.
    #[arg(long, hide = true, num_args = 2)]
    pub work: Vec<u64>,
    /// Folder of the [`fixture`](crate::fixture) that a worker uses.
    #[arg(long, hide = true, default_value = "none")]
    pub fixture: PathBuf,
    // Options that `cargo test` and cargo-nextest may pass to any test program.
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
    /// Returns the chosen targets, or all. Slow targets come first.
    pub fn chosen(&self) -> Vec<&'static Target> {
        let mut chosen = self.targets.clone();
        if chosen.is_empty() {
            chosen = ALL.iter().filter(|target| target.share > 0).collect();
        }
        chosen.sort_by_key(|target| target.share);
        chosen
    }

    /// Returns whether only other tests were requested; prints the name of this one for a list.
    pub fn asks_for_other_tests(&self) -> bool {
        let Self { list, names, .. } = self;
        if *list {
            println!("fuzz: test");
        }
        let is_own = names.is_empty() || names.iter().any(|name| "fuzz".contains(name.as_str()));
        *list || self.ignored || !is_own
    }
}
