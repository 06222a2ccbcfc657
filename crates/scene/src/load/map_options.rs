//! Options of textures in MTL files, between the keyword and the name of the file.

use glam::Vec2;

use super::statements::shorten;
use crate::limits::LARGEST_NUMBER;

/// Options with a fixed number of words after them, and the words that change nothing; none if no
/// words change the texture.
const OPTIONS: [(&str, usize, Option<&str>); 10] = [
    ("-blendu", 1, None),
    ("-blendv", 1, None),
    ("-bm", 1, None),
    ("-boost", 1, Some("0")),
    ("-cc", 1, Some("off")),
    ("-clamp", 1, Some("off")),
    ("-imfchan", 1, Some("")),
    ("-mm", 2, Some("0 1")),
    ("-texres", 1, None),
    ("-type", 1, None),
];

/// What an MTL file says of a texture.
#[derive(Debug)]
pub(super) struct Map<'a> {
    pub(super) file: &'a str,
    pub(super) mapping: Mapping,
    /// Options that would change the picture, and are not read.
    pub(super) unread: Vec<&'a str>,
}

/// Change of texture coordinates: scale by the option `-s`, then offset by `-o`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Mapping {
    scale: Vec2,
    offset: Vec2,
}

impl Mapping {
    pub(super) const NONE: Self = Self {
        scale: Vec2::ONE,
        offset: Vec2::ZERO,
    };

    pub(super) fn apply(self, texcoords: &mut [Vec2]) {
        // Adding 0 would turn -0 into 0.
        if self != Self::NONE {
            for texcoord in texcoords {
                *texcoord = *texcoord * self.scale + self.offset;
            }
        }
    }
}

/// Reads the text after `map_Kd`: options, then the name of a file. The error follows the keyword.
pub(super) fn read_map(text: &str) -> Result<Map<'_>, String> {
    let mut map = Map {
        file: text,
        mapping: Mapping::NONE,
        unread: Vec::new(),
    };
    while map.file.starts_with('-') {
        let (option, rest) = split_word(map.file);
        map.file = match option {
            "-s" => read_vector(option, rest, &mut map.mapping.scale)?,
            "-o" => read_vector(option, rest, &mut map.mapping.offset)?,
            "-t" => {
                map.unread.push(option);
                read_vector(option, rest, &mut Vec2::default())?
            }
            _ => {
                let known = OPTIONS.iter().find(|(name, ..)| *name == option);
                let (_, count, neutral) = known.ok_or_else(|| unknown_option(option))?;
                let after = (0..*count).fold(rest, |rest, _| split_word(rest).1);
                let words = rest[..rest.len() - after.len()].trim_end();
                if neutral
                    .is_some_and(|neutral| words.split_whitespace().ne(neutral.split_whitespace()))
                {
                    map.unread.push(option);
                }
                after
            }
        };
    }
    if map.file.is_empty() {
        return Err("names no file; give it one".into());
    }
    Ok(map)
}

fn unknown_option(option: &str) -> String {
    let known = OPTIONS.map(|(name, ..)| name).join(", ");
    format!(
        "has the option \"{}\"; allowed: -s, -o, -t, {known}, and then the name of a file",
        shorten(option)
    )
}

/// Reads up to three numbers, of which a texture has two, and returns the text after them.
fn read_vector<'a>(option: &str, text: &'a str, vector: &mut Vec2) -> Result<&'a str, String> {
    let mut rest = text;
    for index in 0..3 {
        let (word, after) = split_word(rest);
        match word.parse::<f32>() {
            Ok(number) if f64::from(number.abs()) <= LARGEST_NUMBER => {
                if index < 2 {
                    vector[index] = number;
                }
            }
            _ if index == 0 => {
                return Err(format!(
                    "has {option} before \"{}\"; allowed: 1 to 3 numbers",
                    shorten(word)
                ));
            }
            _ => break,
        }
        rest = after;
    }
    Ok(rest)
}

/// Splits off the first word.
fn split_word(text: &str) -> (&str, &str) {
    let (word, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    (word, rest.trim_start())
}
