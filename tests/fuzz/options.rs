//! Options of the fuzzer: the words after `cargo test --test fuzz --`.

use std::ops::Range;
use std::path::PathBuf;
use std::time::Duration;

use crate::target::{Target, find};

/// Cases over all targets when the tests run the fuzzer.
pub const CASES: u64 = 20_000;

/// Task of this process.
pub enum Options {
    /// Nothing: the words ask for other tests.
    Nothing,
    /// Fuzz.
    Campaign(RunPlan),
    /// Trial of one input.
    Try(Input),
    /// Work in the process that runs cases.
    Work(Work),
}

/// Settings of a campaign.
pub struct RunPlan {
    /// Names of the targets.
    pub targets: Vec<&'static Target>,
    /// Cases of all targets together, if all were chosen.
    pub cases: u64,
    /// Time to go on for instead.
    pub time: Option<Duration>,
    /// Seed of the inputs.
    pub seed: u64,
}

/// One input to try.
pub struct Input {
    /// Name of the target.
    pub target: &'static Target,
    /// Its file.
    pub path: PathBuf,
}

/// Task of a worker.
pub struct Work {
    /// Name of the target.
    pub target: &'static Target,
    /// Folder of the [`fixture`](crate::fixture).
    pub fixture: PathBuf,
    /// Inputs to try.
    pub inputs: Inputs,
}

/// Inputs of a worker.
pub enum Inputs {
    /// Inputs that the seed makes.
    Made {
        /// Seed of the inputs.
        seed: u64,
        /// Numbers of the cases.
        cases: Range<u64>,
        /// File that keeps each input during its trial.
        kept: PathBuf,
    },
    /// Input of a file.
    File(PathBuf),
}

impl Options {
    /// Parses the words, and ignores those for libtest.
    pub fn parse(words: &[String]) -> Result<Self, String> {
        let mut plan = RunPlan {
            targets: Target::all(),
            cases: CASES,
            time: None,
            seed: 1,
        };
        let mut input: Option<PathBuf> = None;
        let mut named = false;
        let mut words = words.iter();
        while let Some(word) = words.next() {
            let mut value = || (words.next().cloned()).ok_or(format!("{word} needs a value"));
            match word.as_str() {
                "--work" => return work(&mut value).map(Options::Work),
                "--cases" => plan.cases = number(word, &value()?)?,
                "--seed" => plan.seed = number(word, &value()?)?,
                "--minutes" => plan.time = Some(minutes(&value()?)?),
                "--targets" => {
                    (plan.targets, named) = (targets(&value()?)?, true);
                }
                "--input" => input = Some(value()?.into()),
                "--list" => {
                    println!("fuzz: test");
                    return Ok(Options::Nothing);
                }
                "--ignored" => return Ok(Options::Nothing),
                "--skip" | "--test-threads" | "--format" | "--color" | "--logfile" => {
                    value()?;
                }
                flag if flag.starts_with('-') => {}
                name if "fuzz".contains(name) => {}
                _ => return Ok(Options::Nothing),
            }
        }
        match input {
            None => Ok(Options::Campaign(plan)),
            Some(path) => Ok(Options::Try(Input {
                target: match named {
                    true => plan.targets[0],
                    false => target_of(&path)?,
                },
                path,
            })),
        }
    }
}

/// Finds the target that a path belongs to: failing inputs and the corpus lie in folders with targets' names.
fn target_of(path: &std::path::Path) -> Result<&'static Target, String> {
    let folder = path.parent().and_then(|folder| folder.file_name());
    find(&folder.unwrap_or_default().to_string_lossy())
}

fn work(value: &mut impl FnMut() -> Result<String, String>) -> Result<Work, String> {
    let target = find(&value()?)?;
    let fixture = value()?.into();
    let inputs = match value()?.as_str() {
        "file" => Inputs::File(value()?.into()),
        seed => Inputs::Made {
            seed: number("--work", seed)?,
            cases: number("--work", &value()?)?..number("--work", &value()?)?,
            kept: value()?.into(),
        },
    };
    Ok(Work {
        target,
        fixture,
        inputs,
    })
}

fn targets(names: &str) -> Result<Vec<&'static Target>, String> {
    names.split(',').map(find).collect()
}

fn number(word: &str, text: &str) -> Result<u64, String> {
    text.parse()
        .map_err(|_| format!("{word} {text}; allowed: a whole number"))
}

fn minutes(text: &str) -> Result<Duration, String> {
    match text.parse::<f64>() {
        Ok(minutes) if minutes > 0.0 && minutes < 1e5 => {
            Ok(Duration::from_secs_f64(60.0 * minutes))
        }
        _ => Err(format!("--minutes {text}; allowed: a number above 0")),
    }
}
