//! Statements of OBJ and MTL text, with their lines.

use super::error::check_visible;
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

impl Statement<'_> {
    /// Refuses invisible characters in the name after the keyword.
    pub(super) fn check_name(&self) -> Result<(), String> {
        check_visible(self.rest)
            .map_err(|reason| format!("the name after {} {reason}", self.keyword))
    }

    /// Reads the numbers after the keyword; `allowed` lists how many there may be.
    pub(super) fn read_numbers(&self, allowed: &[usize]) -> Result<Vec<f32>, String> {
        let words = self.rest.split_whitespace();
        let numbers = words
            .map(|word| self.read_number(word))
            .collect::<Result<Vec<f32>, _>>()?;
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

    fn read_number(&self, word: &str) -> Result<f32, String> {
        if let Ok(number) = word.parse::<f32>()
            && f64::from(number).abs() <= LARGEST_NUMBER
        {
            return Ok(number);
        }
        // A number that is too large, or no number at all.
        let allowed = match word.parse::<f64>().is_ok_and(f64::is_finite) {
            true => format!("numbers from -{LARGEST_NUMBER:e} to {LARGEST_NUMBER:e}"),
            false => "finite numbers".to_owned(),
        };
        Err(format!(
            "{} holds \"{}\"; allowed: {allowed}",
            self.keyword,
            shorten(word)
        ))
    }
}
