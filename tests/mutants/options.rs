//! Options: the words after `cargo test -p tests --test mutants --`.

use std::path::{Path, PathBuf};
use std::time::Duration;

/// Settings of a run.
pub struct Options {
    /// Filters with their presets: `mcguire:paper`.
    pub filters: Vec<String>,
    /// Names of the scenes; all shipped ones if there is none.
    pub scenes: Vec<String>,
    /// Columns and rows of the pictures; none for the size that the shipped limits hold for.
    pub size: Option<(u32, u32)>,
    /// Samples per pixel of the truths.
    pub samples: u32,
    /// Mutants of each filter, at most.
    pub count: usize,
    /// Time after which no work is begun; none to measure everything.
    pub time: Option<Duration>,
    /// Folder of truths and measured mutants.
    pub out: PathBuf,
}

impl Options {
    /// Parses the words.
    pub fn parse(words: &[String]) -> Result<Self, String> {
        let mut options = Self {
            filters: [
                "jump_flood:corrected",
                "mcguire:paper",
                "guertin:paper",
                "kino:default",
            ]
            .map(str::to_owned)
            .to_vec(),
            scenes: Vec::new(),
            size: None,
            samples: tracer::RenderSettings::default().samples_per_pixel,
            count: 100,
            time: None,
            out: Path::new(env!("CARGO_TARGET_TMPDIR")).join("mutants"),
        };
        let mut words = words.iter();
        while let Some(word) = words.next() {
            let value = words.next().ok_or(format!("{word} needs a value"))?;
            let list = || value.split(',').map(str::to_owned).collect();
            match word.as_str() {
                "--filters" => options.filters = list(),
                "--scenes" => options.scenes = list(),
                "--size" => options.size = Some(parse_size(value)?),
                "--samples-per-pixel" => options.samples = number(word, value)?,
                "--count" => options.count = number(word, value)?,
                "--minutes" => {
                    let minutes: u64 = number(word, value)?;
                    options.time = Some(Duration::from_secs(60 * minutes));
                }
                "--out" => options.out = value.into(),
                _ => {
                    return Err(format!(
                        "unknown option {word}; allowed: --filters, --scenes, --size, --samples-per-pixel, --count, --minutes, --out"
                    ));
                }
            }
        }
        Ok(options)
    }
}

fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let sides = text.split_once('x');
    let parsed =
        sides.and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
    parsed.ok_or(format!(
        "--size {text}; allowed: columns x rows, such as 160x90"
    ))
}

fn number<T: std::str::FromStr>(word: &str, text: &str) -> Result<T, String> {
    text.parse()
        .map_err(|_| format!("{word} {text}; allowed: a whole number"))
}
