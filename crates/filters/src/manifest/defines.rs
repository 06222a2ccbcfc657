//! `defines` of a pass.

use std::collections::BTreeMap;

use shader_import::Language;

use super::file::MAX_ENTRIES;

/// Upper limit on the characters of a value.
const MAX_DEFINE_CHARACTERS: usize = 200;

/// Reads macros, each as `NAME=value`.
pub(super) fn read_defines(
    defines: &BTreeMap<String, toml::Value>,
    language: Language,
) -> Result<Vec<String>, String> {
    let instead = match language {
        Language::Glsl | Language::Hlsl | Language::Slang => None,
        Language::Wesl => Some("conditions"),
        Language::Spirv | Language::Wgsl => Some("constants"),
    };
    if let (false, Some(instead)) = (defines.is_empty(), instead) {
        return Err(format!(
            "are for GLSL, HLSL and Slang; {} has no macros; use `{instead}`",
            language.name()
        ));
    }
    if defines.len() > MAX_ENTRIES {
        return Err(format!(
            "{} of them; allowed: at most {MAX_ENTRIES}",
            defines.len()
        ));
    }
    let read = |(name, value): (&String, &toml::Value)| {
        let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let begins = name.starts_with(|c| is_part(c) && !c.is_ascii_digit());
        if !begins || !name.chars().all(is_part) {
            return Err(format!(
                "\"{name}\" is no name; allowed: letters, digits and _, and no digit first"
            ));
        }
        let text = match value {
            toml::Value::Integer(number) => number.to_string(),
            toml::Value::Float(number) if number.is_finite() => format!("{number:?}"),
            toml::Value::String(text) if text.chars().count() <= MAX_DEFINE_CHARACTERS => {
                text.clone()
            }
            value => {
                return Err(format!(
                    "{name} is a {}; allowed: a number, or a text of at most {MAX_DEFINE_CHARACTERS} characters",
                    value.type_str()
                ));
            }
        };
        // A compiler would read the second line as code.
        if text.contains(['\n', '\r']) {
            return Err(format!("{name} = {text:?} has several lines; allowed: one"));
        }
        Ok(format!("{name}={text}"))
    };
    defines.iter().map(read).collect()
}
