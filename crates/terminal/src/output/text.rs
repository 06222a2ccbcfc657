//! Text with styles.

use std::iter::Sum;
use std::ops::{Add, AddAssign};

use anstyle::{AnsiColor, Reset, Style};
use measure::printable;

/// Text for a terminal, of parts with one style each. Printing makes terminal codes of the styles
/// alone; codes in names and files become escapes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Text {
    spans: Vec<Span>,
}

/// A part with one style.
#[derive(Clone, Debug, PartialEq)]
struct Span {
    style: Style,
    text: String,
}

/// Makes a title of one line.
pub fn heading(text: &str) -> Text {
    bold(&printable(text))
}

/// Makes the titles of columns.
pub fn bold(text: &str) -> Text {
    Text::styled(Style::new().bold(), text)
}

/// Makes less important text.
pub fn faint(text: &str) -> Text {
    Text::styled(Style::new().dimmed(), text)
}

/// Shows a success.
pub fn good(text: &str) -> Text {
    Text::styled(AnsiColor::Green.on_default(), text)
}

/// Shows a failure.
pub fn bad(text: &str) -> Text {
    Text::styled(AnsiColor::Red.on_default().bold(), text)
}

/// Shows an undecided result.
pub fn doubtful(text: &str) -> Text {
    Text::styled(AnsiColor::Yellow.on_default(), text)
}

impl Text {
    fn styled(style: Style, text: &str) -> Self {
        let mut styled = Self::default();
        styled.push(style, text);
        styled
    }

    fn push(&mut self, style: Style, text: &str) {
        match self.spans.last_mut() {
            _ if text.is_empty() => {}
            Some(last) if last.style == style => last.text += text,
            _ => self.spans.push(Span {
                style,
                text: text.to_owned(),
            }),
        }
    }

    /// Counts the columns on the screen.
    pub fn width(&self) -> usize {
        (self.spans.iter())
            .map(|span| span.text.chars().count())
            .sum()
    }

    /// Returns the letters without styles.
    pub fn plain(&self) -> String {
        self.spans.iter().map(|span| span.text.as_str()).collect()
    }

    /// Returns the letters with terminal codes for styles, and escapes for control characters
    /// except line breaks.
    pub fn terminal_codes(&self) -> String {
        let mut codes = String::new();
        for Span { style, text } in &self.spans {
            let lines: Vec<_> = text.split('\n').map(printable).collect();
            let text = lines.join("\n");
            if style.is_plain() {
                codes += &text;
            } else {
                codes += &format!("{style}{text}{Reset}");
            }
        }
        codes
    }

    /// Replaces control characters, line breaks too, by escapes.
    pub fn into_line(self) -> Self {
        let mut line = Self::default();
        for span in self.spans {
            line.push(span.style, &printable(&span.text));
        }
        line
    }

    /// Splits the text at its spaces.
    pub(super) fn words(&self) -> Vec<Self> {
        let mut words = vec![Self::default()];
        for span in &self.spans {
            for (index, part) in span.text.split(' ').enumerate() {
                if index > 0 {
                    words.push(Self::default());
                }
                let word = words.last_mut().expect("a text has a first word");
                word.push(span.style, part);
            }
        }
        words
    }

    /// Adds the gap before a word, in the style on both sides of it.
    pub(super) fn push_gap(&mut self, gap: &str, word: &Self) {
        let before = self.spans.last().map(|span| span.style);
        let after = word.spans.first().map(|span| span.style);
        let style = before.filter(|_| before == after).unwrap_or_default();
        self.push(style, gap);
    }
}

impl From<&str> for Text {
    fn from(text: &str) -> Self {
        Self::styled(Style::new(), text)
    }
}

impl From<&String> for Text {
    fn from(text: &String) -> Self {
        text.as_str().into()
    }
}

impl From<String> for Text {
    fn from(text: String) -> Self {
        text.as_str().into()
    }
}

impl From<&Text> for Text {
    fn from(text: &Text) -> Self {
        text.clone()
    }
}

impl<T: Into<Text>> AddAssign<T> for Text {
    fn add_assign(&mut self, other: T) {
        for span in other.into().spans {
            self.push(span.style, &span.text);
        }
    }
}

impl<T: Into<Text>> Add<T> for Text {
    type Output = Self;

    fn add(mut self, other: T) -> Self {
        self += other;
        self
    }
}

impl Sum for Text {
    fn sum<I: Iterator<Item = Self>>(texts: I) -> Self {
        texts.fold(Self::default(), Self::add)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn styles_take_no_columns_and_alone_become_codes() {
        let text = Text::from("a ") + bad("§5") + " c\u{1b}[2J\n";
        assert_eq!(
            Text::from("a §5 c").width(),
            (Text::from("a ") + bad("§5") + " c").width()
        );
        assert_eq!(
            text.terminal_codes(),
            "a \u{1b}[1m\u{1b}[31m§5\u{1b}[0m c\\u001b[2J\n"
        );
        assert_eq!(text.plain(), "a §5 c\u{1b}[2J\n");
        assert_eq!(heading(""), Text::default());
    }

    #[test]
    fn words_keep_their_styles() {
        let text = Text::from("a ") + good("b c") + "d";
        let words = [Text::from("a"), good("b"), good("c") + "d"];
        assert_eq!(text.words(), words);
    }
}
