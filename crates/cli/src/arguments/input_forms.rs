//! Arguments on the forms in which filters get their frames.

use clap::Args;
use suite::{InputForm, InputFormat, InputKind};

use crate::selection::suggest_names;

/// Forms to try on every filter beside the full one.
#[derive(Clone, Debug, Args)]
pub struct InputFormArgs {
    /// Form of the input to try on every filter, beside the full one and apart from others: velocity=float16; repeatable, and
    /// velocity=float16,linear8 are two. shuttertruth list inputs prints the kinds and their forms.
    #[arg(help_heading = "Filters", long, value_name = "KIND=FORM", value_parser = parse_input)]
    pub input: Vec<InputForms>,
}

/// The forms of one option.
#[derive(Clone, Debug)]
pub struct InputForms(Vec<InputFormat>);

impl InputFormArgs {
    /// Lists the full form, and then each of the others alone, so that a change of scores has one cause.
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
                kind = Some(find_kind(&kinds, name)?);
                form
            }
        };
        let kind = kind.ok_or("allowed: KIND=FORM, such as velocity=float16")?;
        formats.push(find_form(&kinds[kind], form)?.format);
    }
    Ok(InputForms(formats))
}

fn find_kind(kinds: &[InputKind], name: &str) -> Result<usize, String> {
    (kinds.iter().position(|kind| kind.name == name)).ok_or_else(|| {
        let known: Vec<String> = kinds.iter().map(|kind| kind.name.to_owned()).collect();
        format!(
            "no kind of input \"{name}\"; {}",
            suggest_names(name, &known)
        )
    })
}

fn find_form<'a>(kind: &'a InputKind, name: &str) -> Result<&'a InputForm, String> {
    (kind.forms.iter().find(|form| form.name == name)).ok_or_else(|| {
        let known: Vec<String> = kind.forms.iter().map(|form| form.name.to_owned()).collect();
        format!(
            "no form \"{name}\" of {}; {}",
            kind.name,
            suggest_names(name, &known)
        )
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
        let input = words
            .iter()
            .map(|text| parse_input(text).unwrap())
            .collect();
        let formats = InputFormArgs { input }.one_by_one();
        let changes: Vec<_> = formats.iter().filter_map(InputFormat::change).collect();
        assert_eq!(formats[0], InputFormat::default());
        assert_eq!(
            changes,
            ["velocity=linear8", "border=clamp", "depth=float16"]
        );
    }

    #[test]
    fn what_is_no_form_gets_a_suggestion() {
        for (text, expected) in [
            ("float16", "allowed: KIND=FORM"),
            ("velocty=float16", "did you mean velocity?"),
            ("depth=flaot16", "did you mean float16?"),
            (
                "depth=float16,",
                "no form \"\" of depth; allowed: float32, float16",
            ),
        ] {
            let error = parse_input(text).unwrap_err();
            assert!(error.contains(expected), "{error}");
        }
    }
}
