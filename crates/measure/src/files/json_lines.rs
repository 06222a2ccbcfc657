//! JSON with a line for each entry of the outer lists, so that large files stay small, and two of
//! them differ in few lines.

use serde::Serialize;

/// Depth down to which every value has a line of its own: the keys of the outer object, and the
/// entries of their lists.
const LINES: usize = 2;

/// Writes plain data: an object with a line per key, and a line per entry of a key's list or
/// object.
///
/// # Panics
/// A map has keys that are not strings.
pub fn to_lines(value: &impl Serialize) -> String {
    let compact = serde_json::to_string(value).expect("plain data can be written");
    let mut text = String::with_capacity(2 * compact.len());
    let (mut is_in_string, mut is_escaped) = (false, false);
    let (mut depth, mut before) = (0, ' ');
    for letter in compact.chars() {
        if is_in_string {
            is_in_string = letter != '"' || is_escaped;
            is_escaped = letter == '\\' && !is_escaped;
        } else {
            let closes = matches!(letter, ']' | '}');
            depth -= usize::from(closes);
            let begins_line = match before {
                '[' | '{' => !closes && depth <= LINES,
                ',' => depth <= LINES,
                _ => closes && depth < LINES,
            };
            if begins_line {
                text.push('\n');
                text.extend(std::iter::repeat_n(' ', depth));
            } else if matches!(before, ',' | ':') {
                text.push(' ');
            }
            depth += usize::from(matches!(letter, '[' | '{'));
            is_in_string = letter == '"';
        }
        text.push(letter);
        before = letter;
    }
    text
}

#[test]
fn entries_of_outer_lists_have_a_line_each() {
    let value = serde_json::json!({
        "cases": [{ "scene": "fan \"[1,2]", "at": [1, 2] }, {}],
        "none": [],
        "width": 160,
    });
    let text = to_lines(&value);
    let expected = r#"{
 "cases": [
  {"at": [1, 2], "scene": "fan \"[1,2]"},
  {}
 ],
 "none": [],
 "width": 160
}"#;
    assert_eq!(text, expected);
    assert_eq!(
        serde_json::from_str::<serde_json::Value>(&text).unwrap(),
        value
    );
}
