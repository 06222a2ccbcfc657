//! Names that shells complete. Others are allowed too: paths, patterns and variants.

use std::ffi::OsStr;

use clap::builder::{PossibleValue, StringValueParser, TypedValueParser};
use clap::{Arg, Command, Error};
use filters::Filter;

/// Parser of any text, with names for completions.
#[derive(Clone)]
pub struct Hinted(fn() -> Vec<String>);

/// Parses names of scenes; shells complete the built-in ones.
pub fn scene_names() -> Hinted {
    Hinted(list_scenes)
}

/// Parses what `list` shows; shells complete built-in scenes and filters.
pub fn listed_names() -> Hinted {
    Hinted(|| {
        let kinds = ["scenes", "filters", "inputs", "adapters"].map(str::to_owned);
        [&kinds[..], &list_scenes(), &Filter::builtin_names()].concat()
    })
}

fn list_scenes() -> Vec<String> {
    let files = (catalogue::SCENES.list)().into_iter();
    let scenes = files.filter_map(|file| file.strip_suffix("/scene.toml"));
    scenes.map(str::to_owned).collect()
}

/// Parses names of filters; shells complete the built-in ones.
pub fn filter_names() -> Hinted {
    Hinted(Filter::builtin_names)
}

impl TypedValueParser for Hinted {
    type Value = String;

    fn parse_ref(
        &self,
        command: &Command,
        argument: Option<&Arg>,
        value: &OsStr,
    ) -> Result<String, Error> {
        StringValueParser::new().parse_ref(command, argument, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new((self.0)().into_iter().map(PossibleValue::new)))
    }
}
