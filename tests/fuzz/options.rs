//! Options of the fuzzer: the words behind `cargo test --test fuzz --`.

use std::ops::Range;
use std::path::PathBuf;
use std::time::Duration;

use crate::target::{Target, find};

/// Cases of one pass of the tests, over all targets.
pub const CASES: u64 = 20_000;

/// Task of this process.
pub enum Options {
    /// The words ask for other tests.
    Nothing,
    /// Fuzz.
    Campaign(RunPlan),
    /// Try one input.
    Try(Input),
    /// Be the process that cases run in.
    Work(Work),
}

/// Settings of a campaign.
pub struct RunPlan {
    /// Names of the targets.
    pub targets: Vec<&'static Target>,
    /// Cases of all targets together, were all of them chosen.
    pub cases: u64,
    /// Goes on so long instead.
    pub time: Option<Duration>,
    /// Chooses the inputs.
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
    /// Which inputs.
    pub inputs: Inputs,
}

/// Inputs of a worker.
pub enum Inputs {
    /// Inputs that the seed makes.
    Made {
        /// Chooses the inputs.
        seed: u64,
        /// Their numbers.
        cases: Range<u64>,
        /// The file that each is kept in while it is tried.
        kept: PathBuf,
    },
    /// Input of a file.
    File(PathBuf),
}

impl Options {
    /// Reads the words; those that are for libtest's kind of test are passed over.
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

/// Failing inputs and the corpus lie in folders named after their targets.
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
        .map_err(|_| format!("{word} {text}: allowed is a whole number"))
}

fn minutes(text: &str) -> Result<Duration, String> {
    match text.parse::<f64>() {
        Ok(minutes) if minutes > 0.0 && minutes < 1e5 => {
            Ok(Duration::from_secs_f64(60.0 * minutes))
        }
        _ => Err(format!("--minutes {text}: allowed is a number above 0")),
    }
}
