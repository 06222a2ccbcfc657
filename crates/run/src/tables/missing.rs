//! Notes below a table that say why scores are `n/a`.

use metrics::Measured;
use terminal::output::Text;

use super::legend_text;

/// Scores that a table lacks, by their reasons.
#[derive(Default)]
pub struct Missing(Vec<Reason>);

/// A reason, with the scores and rows that it excludes.
#[derive(Default)]
struct Reason {
    text: String,
    titles: Vec<String>,
    /// Headings of the rows.
    groups: Vec<String>,
    rows: Vec<String>,
}

/// Rows that a note names; the rest are counted.
const MAX_NAMED: usize = 3;

impl Missing {
    /// Adds a score of a row below a heading, if it does not apply.
    pub fn note(&mut self, title: &str, measured: &Measured, [group, row]: [&str; 2]) {
        let Measured::NotApplicable { reason } = measured else {
            return;
        };
        let known = self.0.iter().position(|known| known.text == *reason);
        let index = known.unwrap_or(self.0.len());
        if known.is_none() {
            self.0.push(Reason {
                text: reason.clone(),
                ..Reason::default()
            });
        }
        let known = &mut self.0[index];
        let lists = [&mut known.titles, &mut known.groups, &mut known.rows];
        for (names, name) in lists.into_iter().zip([title, group, row]) {
            if !names.iter().any(|known| known == name) {
                names.push(name.to_owned());
            }
        }
    }

    /// Formats one note for each reason: `grow, loss n/a on fan: no object translates`.
    pub fn text(&self) -> Text {
        let note = |reason: &Reason| {
            let place = match reason.rows.len() {
                0..=MAX_NAMED => format!("{} on {}", reason.rows.join(", "), list(&reason.groups)),
                rows => format!("{rows} rows on {}", list(&reason.groups)),
            };
            let text = format!(
                "n/a: {} of {place}: {}",
                reason.titles.join(", "),
                reason.text
            );
            legend_text(&text)
        };
        self.0.iter().map(note).sum()
    }
}

fn list(names: &[String]) -> String {
    match names.len() {
        0..=MAX_NAMED => names.join(", "),
        count => format!(
            "{} and {} more",
            names[..MAX_NAMED].join(", "),
            count - MAX_NAMED
        ),
    }
}
