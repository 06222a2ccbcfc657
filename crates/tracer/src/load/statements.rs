//! OBJ and MTL text as statements with their lines.

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

impl Statement<'_> {
    /// The rest as finite numbers, as many as `allowed` says; else what is wrong.
    pub(super) fn numbers(&self, allowed: &[usize]) -> Result<Vec<f32>, String> {
        let mut numbers = Vec::new();
        for word in self.rest.split_whitespace() {
            match word.parse::<f32>() {
                Ok(number) if number.is_finite() => numbers.push(number),
                _ => {
                    return Err(format!(
                        "{} holds \"{word}\"; allowed: finite numbers",
                        self.keyword
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
