//! Arguments on the forms in which filters get their frames.

use clap::Args;
use measure::InputFormat;

use crate::selection::suggest_names;

/// Forms to try on every filter in addition to the full one.
#[derive(Clone, Debug, Args)]
pub struct InputFormArgs {
    /// Form of the input to try on every filter, in addition to the full one: velocity=float16.
    /// Repeatable; each form is tried alone; velocity=float16,linear8 are two. shuttertruth list
    /// inputs prints all.
    #[arg(help_heading = "Filters", long, value_name = "KIND=FORM", value_parser = parse_input)]
    pub input: Vec<InputForms>,
}

/// The forms of one option.
#[derive(Clone, Debug)]
pub struct InputForms(Vec<InputFormat>);

impl InputFormArgs {
    /// Lists the full form, then each of the others alone, so that each change of scores has one
    /// cause.
    pub fn one_by_one(&self) -> Vec<InputFormat> {
        let mut formats = vec![InputFormat::default()];
        for format in self.input.iter().flat_map(|forms| &forms.0) {
            if !formats.contains(format) {
                formats.push(*format);
            }
        }
        formats
    }
}

/// Parses `velocity=float16,linear8` or `velocity=float16,depth=float16`.
fn parse_input(text: &str) -> Result<InputForms, String> {
    let kinds = InputFormat::kinds();
    let mut kind = None;
    let mut formats = Vec::new();
    for part in text.split(',') {
        let form = match part.split_once('=') {
            None => part,
            Some((name, form)) => {
                let what = format!("kind of input \"{name}\"");
                kind = Some(find_named(&kinds, |kind| kind.name, name, &what)?);
                form
            }
        };
        let kind = kind.ok_or("allowed: KIND=FORM, such as velocity=float16")?;
        let what = format!("form \"{form}\" of {}", kind.name);
        formats.push(find_named(&kind.forms, |form| form.name, form, &what)?.format);
    }
    Ok(InputForms(formats))
}

fn find_named<'a, T>(
    all: &'a [T],
    name_of: fn(&T) -> &'static str,
    name: &str,
    what: &str,
) -> Result<&'a T, String> {
    (all.iter().find(|form| name_of(form) == name)).ok_or_else(|| {
        let known: Vec<String> = all.iter().map(|form| name_of(form).to_owned()).collect();
        format!("no {what}; {}", suggest_names(name, &known))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_form_is_tried_alone_and_once() {
        let words = [
            "velocity=float32,linear8,border=clamp",
            "depth=float16",
            "border=leave,clamp",
        ];
        let input = words.map(|text| parse_input(text).unwrap()).to_vec();
        let formats = InputFormArgs { input }.one_by_one();
        let changes: Vec<_> = formats.iter().filter_map(InputFormat::change).collect();
        assert_eq!(formats[0], InputFormat::default());
        assert_eq!(
            changes,
            ["velocity=linear8", "border=clamp", "depth=float16"]
        );
        for (text, expected) in [
            ("float16", "allowed: KIND=FORM"),
            ("velocty=float16", "did you mean velocity?"),
            ("depth=float16,", "no form \"\" of depth; allowed: float32"),
        ] {
            let error = parse_input(text).unwrap_err();
            assert!(error.contains(expected), "{error}");
        }
    }
}
