//! Failures that the fuzzer found.

use std::fmt::{self, Display};
use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::target::Target;

/// Failure of a case.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum How {
    /// A panic: its place and message.
    Panic(String),
    /// A worker that a signal ended, or that ended itself: how it ended, and its last words.
    Ended(String),
    /// A case that took longer than this.
    Hang(Duration),
}

impl Display for How {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            How::Panic(text) => write!(f, "panic at {text}"),
            How::Ended(text) => write!(f, "ended by {text}"),
            How::Hang(limit) => write!(f, "no end after {} s", limit.as_secs()),
        }
    }
}

impl How {
    /// Returns a text that is equal for failures of one kind: the place of a panic, or the words without their numbers.
    pub fn kind(&self) -> String {
        let text = match self {
            How::Panic(text) => {
                let place = text.split(": ").next().unwrap_or_default();
                return format!("panic at {place}");
            }
            other => other.to_string(),
        };
        text.chars().filter(|c| !c.is_ascii_digit()).collect()
    }
}

/// First input that failed in one way.
pub struct Failure {
    /// Name of the target.
    pub target: &'static Target,
    /// Kind of failure.
    pub how: How,
    /// File that keeps the input.
    pub path: PathBuf,
    /// Number of the case.
    pub case: u64,
    /// Number of inputs that failed the same way.
    pub count: u64,
}

impl Failure {
    /// Describes the failure, and how to reproduce it.
    pub fn text(&self, seed: u64) -> String {
        format!(
            "fuzz: {target}: {how} ({count} inputs; the first is case {case} of seed {seed})\n  input: {path}\n  \
             again: cargo test --locked -p cli --test fuzz -- --input {path}\n",
            target = self.target.name,
            how = self.how,
            count = self.count,
            case = self.case,
            path = self.path.display(),
        )
    }
}

/// Keeps an input below the build folder, under the hash of its bytes.
pub fn save(target: &Target, input: &[u8]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("fuzz")
        .join(target.name);
    let name = blake3::hash(input).to_hex();
    let path = folder.join(&name[..16]);
    std::fs::create_dir_all(&folder)
        .and_then(|()| std::fs::write(&path, input))
        .unwrap_or_else(|error| panic!("{} cannot be written: {error}", path.display()));
    path
}
