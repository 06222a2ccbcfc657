//! bench.json: its check, and the files of cards that are kept.

use std::path::{Path, PathBuf};

use filters::Clock;
use measure::{Error, SIDES, read_text};

use super::{BENCH_FORMAT, Bench, REACHES};

/// Longest duration in a bench, in seconds: a day.
const LONGEST: f64 = 86_400.0;
/// Shortest duration of a whole filter, in seconds: the unit of a GPU's clock. A pass of it may
/// take no time.
const SHORTEST: f64 = 1e-9;

impl Bench {
    /// Reads a file. Refuses another version, impossible times and sizes, and reaches that were not
    /// timed: charts take logarithms.
    pub fn read(path: &Path) -> Result<Self, Error> {
        Self::parse(&read_text(path)?).map_err(|reason| {
            Error::Refused(format!(
                "{}: {reason}; `shuttertruth bench` writes one, and so do reports; leave it out, or delete it",
                path.display()
            ))
        })
    }

    /// Reads every file in a folder, in the order of their names.
    pub fn read_all(folder: &Path) -> Result<Vec<Self>, Error> {
        let refuse = |error| Error::Refused(format!("{}: {error}", folder.display()));
        let files = folder.read_dir().map_err(refuse)?.flatten();
        let mut paths: Vec<PathBuf> = files.map(|file| file.path()).collect();
        paths.sort();
        paths.iter().map(|path| Self::read(path)).collect()
    }

    fn parse(text: &str) -> Result<Self, String> {
        let parsed = serde_json::from_str(text);
        let bench: Self = parsed.map_err(|error| format!("no bench of this program: {error}"))?;
        if bench.format != BENCH_FORMAT {
            let format = bench.format;
            return Err(format!("has format {format}; allowed: {BENCH_FORMAT}"));
        }
        let (width, height) = (bench.width, bench.height);
        if ![width, height].iter().all(|side| SIDES.contains(side)) {
            return Err(format!(
                "has pictures of {width}x{height} pixels; allowed: {SIDES:?} columns and rows"
            ));
        }
        let cases = bench.cases.iter();
        let passes = (cases.clone().flat_map(|case| &case.passes)).map(|pass| (&pass.seconds, 0.0));
        let points = bench.reaches.iter().flat_map(|reach| &reach.points);
        let points = points.filter_map(|point| Some((point.seconds.as_ref()?, 0.0)));
        let whole = cases.map(|case| (&case.seconds, SHORTEST));
        for (spread, shortest) in whole.chain(passes).chain(points) {
            let times = [spread.median, spread.lower_quartile, spread.upper_quartile];
            let is_possible = |seconds: &&f64| (shortest..=LONGEST).contains(*seconds);
            if let Some(seconds) = times.iter().find(|seconds| !is_possible(seconds)) {
                return Err(format!(
                    "holds a time of {seconds} s; allowed: {shortest} to {LONGEST}"
                ));
            }
        }
        for reach in &bench.reaches {
            let pixels: Vec<u32> = reach.points.iter().map(|point| point.pixels).collect();
            if pixels != REACHES {
                return Err(format!(
                    "{}:{} was timed at the reaches {pixels:?}; allowed: {REACHES:?}",
                    reach.filter, reach.preset
                ));
            }
        }
        Ok(bench)
    }

    /// Describes the clock of the durations: `the GPU's own clock`.
    pub fn clock_text(&self) -> String {
        let clock = match self.clock {
            Clock::Timestamps => "the GPU's own clock",
            Clock::WallClock => "wall clock around each pass: the adapter has no timestamps",
        };
        let step = self.clock_step.map(|step| {
            let step = 1e3 * step;
            format!(", which the browser reads in steps of {step:.3} ms; short passes are repeated")
        });
        clock.to_owned() + &step.unwrap_or_default()
    }

    /// Describes the frame that the filters blurred: `panels that move 32 pixels`.
    pub fn frame_text(&self) -> String {
        let speed = (self.speed).map(|speed| format!("panels that move {speed} pixels"));
        let scene = (self.scene.as_ref()).map(|scene| format!("the scene {scene}"));
        speed.or(scene).unwrap_or("an unknown frame".to_owned())
    }

    /// Puts the bench into its card's file in a folder, where it replaces older times of the same
    /// presets. Returns the file's path.
    ///
    /// # Errors
    /// The adapter is a processor, or the file's times were measured in another way.
    pub fn keep(mut self, folder: &Path) -> Result<PathBuf, Error> {
        let name = &self.adapter.name;
        if self.adapter.kind == "software" {
            return Err(Error::Refused(format!(
                "{name} is a processor; only times of graphics cards are kept"
            )));
        }
        let size = format!("{}x{}", self.width, self.height);
        let scene = self.scene.as_deref().unwrap_or_default();
        let words = format!("{size} {name} {scene}").to_lowercase();
        let words = words.split(|letter: char| !letter.is_ascii_alphanumeric());
        let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
        let path = folder.join(words.join("_") + ".json");
        if path.exists() {
            let place = |reason| Error::Refused(format!("{}: {reason}", path.display()));
            self.join(Self::read(&path)?).map_err(place)?;
        }
        let text = serde_json::to_string(&self).expect("a bench is JSON");
        frame::write_atomically(&path, text.as_bytes())?;
        Ok(path)
    }

    /// Adds an older bench's times of other presets.
    fn join(&mut self, older: Self) -> Result<(), String> {
        let how = |bench: &Self| {
            let (rounds, frame) = (bench.rounds, bench.frame_text());
            format!("{rounds} rounds on {frame} by {}", bench.clock_text())
        };
        let [old, new] = [how(&older), how(self)];
        if old != new {
            return Err(format!(
                "holds times of {old}, not of {new}; keep it elsewhere, or delete it"
            ));
        }
        let timed: Vec<_> = (self.cases.iter())
            .map(|case| (case.filter.clone(), case.preset.clone()))
            .collect();
        let is_other = |filter: &String, preset: &String| {
            timed
                .iter()
                .all(|pair| (&pair.0, &pair.1) != (filter, preset))
        };
        let cases = older
            .cases
            .into_iter()
            .filter(|case| is_other(&case.filter, &case.preset));
        self.cases.splice(0..0, cases);
        let reaches = older
            .reaches
            .into_iter()
            .filter(|reach| is_other(&reach.filter, &reach.preset));
        self.reaches.splice(0..0, reaches);
        Ok(())
    }
}
