//! Settings of the working folder: values of options that the command line leaves out.

use std::path::Path;

use clap::parser::ValueSource;
use clap::{ArgMatches, Command};
use measure::{Error, read_text};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

use crate::arguments::{parse_samples, parse_size};

/// Name of the file.
pub const SETTINGS_FILE: &str = "shuttertruth.toml";

/// Values of shuttertruth.toml; none without that file.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// Scenes.
    scenes: Vec<String>,
    /// Picture size, such as `640x360`.
    #[serde(deserialize_with = "read_size")]
    size: Option<String>,
    /// Samples per pixel.
    #[serde(deserialize_with = "read_samples")]
    samples_per_pixel: Option<u32>,
    /// Filters.
    filters: Vec<String>,
    /// Folder for all files.
    out: Option<String>,
    /// Baseline of checks.
    baseline: Option<String>,
}

/// Arguments of a command that the file may give.
pub struct FromFile {
    /// Words of the command: `limits accept`.
    pub command: &'static str,
    /// Keys of the file, each with the argument if that has another name: `size`, `out:run`.
    pub keys: &'static str,
}

impl FromFile {
    /// Lists key and argument.
    fn pairs(&self) -> impl Iterator<Item = (&'static str, &'static str)> {
        let keys = self.keys.split(' ');
        keys.map(|key| key.split_once(':').unwrap_or((key, key)))
    }
}

impl Settings {
    /// Reads the file in the working folder.
    ///
    /// # Errors
    /// The file cannot be read, or has an unknown key or a value that its option refuses; shows the
    /// line.
    pub fn read() -> Result<Self, Error> {
        let path = Path::new(SETTINGS_FILE);
        if !path.exists() {
            return Ok(Self::default());
        }
        toml::from_str(&read_text(path)?)
            .map_err(|error| Error::Refused(format!("{SETTINGS_FILE}: {error}")))
    }

    /// Returns the values of a key; none if the file leaves the key out.
    fn values(&self, key: &str) -> Vec<String> {
        let one = |value: &Option<String>| value.iter().cloned().collect();
        match key {
            "scenes" => self.scenes.clone(),
            "size" => one(&self.size),
            "samples_per_pixel" => one(&self.samples_per_pixel.map(|samples| samples.to_string())),
            "filters" => self.filters.clone(),
            "out" => one(&self.out),
            "baseline" => one(&self.baseline),
            _ => unreachable!("no key {key}"),
        }
    }

    /// Formats a key and its values; none if the file leaves the key out.
    fn text(&self, key: &str) -> Option<String> {
        let values = self.values(key);
        (!values.is_empty()).then(|| format!("{key} {}", values.join(" ")))
    }

    /// Makes the file's values the defaults of commands; their help says so.
    pub fn give_defaults(&self, program: Command, commands: &[FromFile]) -> Command {
        commands.iter().fold(program, |program, command| {
            let words: Vec<&'static str> = command.command.split(' ').collect();
            self.give_to(program, &words, command)
        })
    }

    fn give_to(&self, program: Command, words: &[&'static str], from: &FromFile) -> Command {
        if let [first, rest @ ..] = words {
            return program.mut_subcommand(*first, |command| self.give_to(command, rest, from));
        }
        from.pairs().fold(program, |program, (key, id)| {
            let values = self.values(key);
            if values.is_empty() {
                return program;
            }
            program.mut_arg(id, |argument| {
                let help = argument.get_help().cloned().unwrap_or_default();
                let more = format!(" [{SETTINGS_FILE}: {}]", values.join(" "));
                let help = help.to_string() + &more;
                argument
                    .default_values(values)
                    .hide_default_value(true)
                    .long_help(help.clone())
                    .help(help)
            })
        })
    }

    /// Says which of a command's values are the file's: `size 640x360 (shuttertruth.toml)`; none if
    /// the command line gives all.
    pub fn used_text(&self, command: &ArgMatches, from: &FromFile) -> Option<String> {
        let is_given = |id: &str| {
            // Not every command has every option, and clap asserts that it has what is asked for.
            command.try_contains_id(id).is_ok()
                && command.value_source(id) == Some(ValueSource::CommandLine)
        };
        // Scenes have a second name, and a finished run has all but its baseline.
        let names = |id: &'static str| match id {
            "scenes" => vec!["scenes", "scenes_option", "finished"],
            "baseline" => vec![id],
            _ => vec![id, "finished"],
        };
        let used = from
            .pairs()
            .filter(|(_, id)| !names(id).into_iter().any(is_given));
        join(used.filter_map(|(key, _)| self.text(key)))
    }

    /// Says all values of the file; none without any.
    pub fn all_text(&self) -> Option<String> {
        let keys = "scenes size samples_per_pixel filters out baseline";
        join(keys.split(' ').filter_map(|key| self.text(key)))
    }
}

fn join(texts: impl Iterator<Item = String>) -> Option<String> {
    let texts: Vec<String> = texts.collect();
    (!texts.is_empty()).then(|| format!("{} ({SETTINGS_FILE})", texts.join(", ")))
}

fn read_size<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<String>, D::Error> {
    let text = String::deserialize(deserializer)?;
    parse_size(&text).map_err(D::Error::custom)?;
    Ok(Some(text))
}

fn read_samples<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<u32>, D::Error> {
    let samples = u32::deserialize(deserializer)?;
    let allowed = parse_samples(&samples.to_string()).map_err(D::Error::custom)?;
    Ok(Some(allowed))
}
