//! Layout of tables: columns as wide as their cells, rows that fit the terminal.

use crate::output::colors::{heading, width};
use crate::output::wrap::terminal_columns;

/// Columns between two cells: the more that fit.
const GAPS: [usize; 2] = [2, 1];
/// Indent of a row, below the headings.
const INDENT: usize = 2;

/// A table of text. The first column is aligned to the left, others as they say.
pub struct Table {
    columns: Vec<Align>,
    lines: Vec<TableLine>,
}

/// Alignment of a column.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Align {
    /// To the left: names.
    Left,
    /// To the right: numbers.
    Right,
}

/// A line of a table.
enum TableLine {
    /// Text across all columns.
    Text(String),
    /// Titles of the columns.
    Titles(Vec<String>),
    /// Cells, with the style of the whole row.
    Row(Vec<String>, fn(&str) -> String),
}

impl Table {
    /// Begins a table with the titles of its columns.
    pub fn new(titles: &[&str], columns: &[Align]) -> Self {
        assert_eq!(titles.len(), columns.len(), "every column has a title");
        let mut table = Self {
            columns: columns.to_vec(),
            lines: Vec::new(),
        };
        table.push_titles(titles);
        table
    }

    /// Adds titles once more.
    pub fn push_titles(&mut self, titles: &[&str]) {
        let titles = titles.iter().map(|title| (*title).to_owned()).collect();
        self.lines.push(TableLine::Titles(titles));
    }

    /// Adds a line of text that belongs to no column.
    pub fn push_text(&mut self, text: &str) {
        self.lines.push(TableLine::Text(text.to_owned()));
    }

    /// Adds a row.
    pub fn push(&mut self, cells: Vec<String>) {
        self.push_styled(cells, str::to_owned);
    }

    /// Adds a row in a style.
    pub fn push_styled(&mut self, cells: Vec<String>, style: fn(&str) -> String) {
        assert_eq!(cells.len(), self.columns.len(), "every column has a cell");
        self.lines.push(TableLine::Row(cells, style));
    }

    /// Lays out the table. Where a row does not fit the terminal, long names have a line of their own.
    pub fn text(&self) -> String {
        self.text_in(terminal_columns())
    }

    fn text_in(&self, columns: usize) -> String {
        let widths: Vec<usize> = (0..self.columns.len())
            .map(|column| self.width_of(column))
            .collect();
        let room = |gap: usize| {
            let others: usize = widths[1..].iter().map(|width| width + gap).sum();
            columns.saturating_sub(INDENT + others)
        };
        let gap = if room(GAPS[0]) >= widths[0] {
            GAPS[0]
        } else {
            GAPS[1]
        };
        let name = widths[0].min(room(gap));
        let row_text =
            |cells: &[String], name, indent| self.row_text(cells, (name, indent, gap), &widths);
        let mut text = String::new();
        for line in &self.lines {
            match line {
                TableLine::Text(line) => text += line,
                TableLine::Titles(titles) => {
                    let line = row_text(titles, INDENT + name, 0);
                    text += &heading(&line);
                }
                TableLine::Row(cells, style) => {
                    text += &style(&row_text(cells, name, INDENT));
                }
            }
            text += "\n";
        }
        text
    }

    fn width_of(&self, column: usize) -> usize {
        let cells = self.lines.iter().filter_map(|line| match line {
            TableLine::Text(_) => None,
            // The title of the first column stands further to the left than its cells.
            TableLine::Titles(titles) if column == 0 => {
                Some(width(&titles[0]).saturating_sub(INDENT))
            }
            TableLine::Titles(cells) | TableLine::Row(cells, _) => Some(width(&cells[column])),
        });
        cells.max().unwrap_or(0)
    }

    /// Lays out cells: the first in a width of its own behind an indent, the others behind gaps.
    fn row_text(
        &self,
        cells: &[String],
        (name, indent, gap): (usize, usize, usize),
        widths: &[usize],
    ) -> String {
        let mut text = " ".repeat(indent) + &cells[0];
        let own = width(&cells[0]);
        match own <= name {
            true => text += &" ".repeat(name - own),
            false => text += &format!("\n{}", " ".repeat(indent + name)),
        }
        for (column, cell) in cells.iter().enumerate().skip(1) {
            let space = " ".repeat(widths[column].saturating_sub(width(cell)));
            text += &" ".repeat(gap);
            match self.columns[column] {
                Align::Left => text += &(cell.clone() + &space),
                Align::Right => text += &(space + cell),
            }
        }
        text.truncate(text.trim_end_matches(' ').len());
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn make_table() -> Table {
        let mut table = Table::new(
            &["filter", "FLIP", "scene"],
            &[Align::Left, Align::Right, Align::Left],
        );
        table.push(vec!["a".into(), "-69.6".into(), "fan".into()]);
        table.push(vec!["b:c".into(), "28209.7".into(), "railing".into()]);
        table
    }

    #[test]
    fn columns_never_touch() {
        assert_eq!(
            make_table()
                .text_in(80)
                .replace("\u{1b}[1m", "")
                .replace("\u{1b}[0m", ""),
            "filter     FLIP  scene\n  a       -69.6  fan\n  b:c   28209.7  railing\n"
        );
    }

    #[test]
    fn a_name_that_does_not_fit_has_a_line_of_its_own() {
        let mut table = make_table();
        table.push(vec!["x".repeat(60), "0.1".into(), "fan".into()]);
        let text = table.text_in(40);
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[3].trim(), "x".repeat(60));
        assert!(lines[4].trim_start().starts_with("0.1"));
        assert!(lines[4].chars().count() <= 40, "{text}");
    }
}
