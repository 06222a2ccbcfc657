//! OBJ and MTL text as statements with their lines.

use super::error::hidden;
use crate::limits::LARGEST_NUMBER;

/// One line of an OBJ or MTL file.
#[derive(Clone, Copy)]
pub(super) struct Statement<'a> {
    /// Counted from 1.
    pub(super) line: usize,
    /// `v`, `usemtl`, `map_Kd`.
    pub(super) keyword: &'a str,
    /// The rest, without the blanks around it.
    pub(super) rest: &'a str,
}

/// The lines that are neither empty nor comments.
pub(super) fn statements(text: &str) -> impl Iterator<Item = Statement<'_>> {
    text.lines().enumerate().filter_map(|(index, line)| {
        let line = line.trim();
        let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        let said = !keyword.is_empty() && !keyword.starts_with('#');
        said.then(|| Statement {
            line: index + 1,
            keyword,
            rest: rest.trim(),
        })
    })
}

/// The beginning of a text that is to be quoted.
pub(super) fn shown(text: &str) -> String {
    const MOST: usize = 80;
    match text.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}

impl Statement<'_> {
    /// Refuses a name that is more than it shows.
    pub(super) fn check_name(&self) -> Result<(), String> {
        match hidden(self.rest) {
            Some(reason) => Err(format!("the name after {} {reason}", self.keyword)),
            None => Ok(()),
        }
    }

    /// The rest as finite numbers, as many as `allowed` says; else what is wrong.
    pub(super) fn numbers(&self, allowed: &[usize]) -> Result<Vec<f32>, String> {
        let mut numbers = Vec::new();
        for word in self.rest.split_whitespace() {
            match word.parse::<f32>() {
                Ok(number) if f64::from(number).abs() <= LARGEST_NUMBER => numbers.push(number),
                _ => {
                    // Too large for 32 bits, or for a scene; else no number at all.
                    let large = word.parse::<f64>().is_ok_and(f64::is_finite);
                    let allowed = match large {
                        true => format!("numbers from -{LARGEST_NUMBER:e} to {LARGEST_NUMBER:e}"),
                        false => "finite numbers".to_owned(),
                    };
                    return Err(format!(
                        "{} holds \"{}\"; allowed: {allowed}",
                        self.keyword,
                        shown(word)
                    ));
                }
            }
        }
        if allowed.contains(&numbers.len()) {
            Ok(numbers)
        } else {
            let counts: Vec<String> = allowed.iter().map(usize::to_string).collect();
            Err(format!(
                "{} holds {} numbers; allowed: {}",
                self.keyword,
                numbers.len(),
                counts.join(" or ")
            ))
        }
    }
}
