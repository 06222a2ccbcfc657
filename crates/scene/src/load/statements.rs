//! Statements of OBJ and MTL text, with their lines.

use std::borrow::Cow;

use super::error::{allowed_numbers, check_visible};
use crate::limits::LARGEST_NUMBER;

/// Line of an OBJ or MTL file.
#[derive(Clone, Copy)]
pub(super) struct Statement<'a> {
    /// Line number, counted from 1.
    pub(super) line: usize,
    /// First word: `v`, `usemtl`, `map_Kd`.
    pub(super) keyword: &'a str,
    /// Text after the keyword, without surrounding blanks.
    pub(super) rest: &'a str,
}

/// Removes a byte order mark, and joins each line that ends in `\` with the next. Empty lines
/// follow the joined ones, so that all lines keep their numbers. A line with a comment ends it:
/// paths in comments end in `\` too.
pub(super) fn clean_text(text: &str) -> Cow<'_, str> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let continued = |line: &'_ str| -> Option<usize> {
        let joined = line.trim_end().strip_suffix('\\')?;
        (!line.contains('#')).then_some(joined.len())
    };
    if !text.contains('\\') || text.lines().all(|line| continued(line).is_none()) {
        return Cow::Borrowed(text);
    }
    let mut cleaned = String::with_capacity(text.len());
    let mut joined_lines = 0;
    for line in text.lines() {
        if let Some(length) = continued(line) {
            cleaned.push_str(&line[..length]);
            cleaned.push(' ');
            joined_lines += 1;
        } else {
            cleaned.push_str(line);
            cleaned.extend(std::iter::repeat_n('\n', 1 + joined_lines));
            joined_lines = 0;
        }
    }
    Cow::Owned(cleaned)
}

/// Splits a text into statements; skips blank lines and comments.
pub(super) fn split_statements(text: &str) -> impl Iterator<Item = Statement<'_>> {
    text.lines().enumerate().filter_map(|(index, line)| {
        let line = line.trim();
        let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        let is_statement = !keyword.is_empty() && !keyword.starts_with('#');
        is_statement.then(|| Statement {
            line: index + 1,
            keyword,
            rest: rest.trim(),
        })
    })
}

/// Shortens a text for a quotation.
pub(super) fn shorten(text: &str) -> String {
    const MOST: usize = 80;
    match text.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}

impl<'a> Statement<'a> {
    /// Splits the text after the keyword into words, up to a comment. Names may contain a `#`;
    /// numbers do not.
    pub(super) fn words(&self) -> impl Iterator<Item = &'a str> + Clone + use<'a> {
        let end = self.rest.find('#').unwrap_or(self.rest.len());
        self.rest[..end].split_whitespace()
    }

    /// Refuses invisible characters in the name after the keyword.
    pub(super) fn check_name(&self) -> Result<(), String> {
        check_visible(self.rest)
            .map_err(|reason| format!("the name after {} {reason}", self.keyword))
    }

    /// Reads the numbers after the keyword; `allowed` lists how many there may be.
    pub(super) fn read_numbers(&self, allowed: &[usize]) -> Result<Vec<f32>, String> {
        let numbers = self
            .words()
            .map(|word| self.read_number(word))
            .collect::<Result<Vec<f32>, _>>()?;
        self.check_count(numbers, allowed)
    }

    fn check_count(&self, numbers: Vec<f32>, allowed: &[usize]) -> Result<Vec<f32>, String> {
        if allowed.contains(&numbers.len()) {
            return Ok(numbers);
        }
        let counts: Vec<String> = allowed.iter().map(usize::to_string).collect();
        Err(format!(
            "{} holds {} numbers; allowed: {}",
            self.keyword,
            numbers.len(),
            counts.join(" or ")
        ))
    }

    /// Reads the first numbers after the keyword, as many as `count`.
    pub(super) fn read_first_numbers(&self, count: usize) -> Result<Vec<f32>, String> {
        let words = self.words().take(count);
        let numbers = words
            .map(|word| self.read_number(word))
            .collect::<Result<Vec<f32>, _>>()?;
        self.check_count(numbers, &[count])
    }

    fn read_number(&self, word: &str) -> Result<f32, String> {
        if let Ok(number) = word.parse::<f32>()
            && f64::from(number).abs() <= LARGEST_NUMBER
        {
            return Ok(number);
        }
        // A number that is too large, or no number at all.
        let allowed = allowed_numbers(word.parse::<f64>().is_ok_and(f64::is_finite));
        Err(format!(
            "{} holds \"{}\"; allowed: {allowed}",
            self.keyword,
            shorten(word)
        ))
    }
}
