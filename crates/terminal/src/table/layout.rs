//! Layout of tables: columns as wide as their cells, rows that fit the terminal.

use measure::printable;

use crate::output::{bold, faint, terminal_columns, width};

/// Spaces between two cells: the most that fit.
const GAPS: [usize; 2] = [2, 1];
/// Indent of a row, below the headings.
const INDENT: usize = 2;

/// A table of text: names, then numbers, which are aligned to the right.
pub struct Table {
    titles: Vec<String>,
    /// Left-aligned columns of words.
    left: Vec<usize>,
    /// A line of text as its only cell, or a name and its cells; dimmed or not.
    lines: Vec<(Vec<String>, bool)>,
}

impl Table {
    /// Begins a table with the title of the names and the other columns' titles.
    pub fn new<T: Into<String>>(
        name: impl Into<String>,
        others: impl IntoIterator<Item = T>,
    ) -> Self {
        let others = others.into_iter().map(Into::into);
        let titles = std::iter::once(name.into()).chain(others);
        Self {
            titles: titles.map(|title| printable(&title).into_owned()).collect(),
            left: vec![0],
            lines: Vec::new(),
        }
    }

    /// Aligns a column to the left.
    pub fn with_words_in(mut self, column: usize) -> Self {
        self.left.push(column);
        self
    }

    /// Adds a line of text outside the columns.
    pub fn push_text(&mut self, text: impl Into<String>) {
        let text = printable(&text.into()).into_owned();
        self.lines.push((vec![text], false));
    }

    /// Adds a row.
    pub fn push(&mut self, name: impl Into<String>, cells: impl IntoIterator<Item = String>) {
        self.push_row(false, name, cells);
    }

    /// Adds a row, dimmed or not.
    pub fn push_row(
        &mut self,
        dimmed: bool,
        name: impl Into<String>,
        cells: impl IntoIterator<Item = String>,
    ) {
        let row = std::iter::once(name.into()).chain(cells);
        let row: Vec<String> = row.map(|cell| printable(&cell).into_owned()).collect();
        assert_eq!(row.len(), self.titles.len(), "every column has a cell");
        self.lines.push((row, dimmed));
    }

    /// Lays out the table. If a row does not fit the terminal, long names get a line of their own.
    pub fn text(&self) -> String {
        self.text_in(terminal_columns())
    }

    fn text_in(&self, columns: usize) -> String {
        let mut widths: Vec<usize> = self.titles.iter().map(|title| width(title)).collect();
        // The title of the names is not indented.
        widths[0] = widths[0].saturating_sub(INDENT);
        for (cells, _) in self.lines.iter().filter(|(cells, _)| cells.len() > 1) {
            for (widest, cell) in widths.iter_mut().zip(cells) {
                *widest = width(cell).max(*widest);
            }
        }
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
        let titles = self.row_text(&self.titles, (INDENT + name, 0, gap), &widths);
        let mut text = bold(&titles) + "\n";
        for (cells, dimmed) in &self.lines {
            text += &match cells.as_slice() {
                [line] => line.clone(),
                cells => {
                    let row = self.row_text(cells, (name, INDENT, gap), &widths);
                    if *dimmed { faint(&row) } else { row }
                }
            };
            text += "\n";
        }
        text
    }

    /// Lays out cells: the first with its own width after an indent, the others after gaps.
    fn row_text(
        &self,
        cells: &[String],
        (name, indent, gap): (usize, usize, usize),
        widths: &[usize],
    ) -> String {
        let mut text = " ".repeat(indent) + &cells[0];
        let columns = width(&cells[0]);
        if columns <= name {
            text += &" ".repeat(name - columns)
        } else {
            text += &format!("\n{}", " ".repeat(indent + name))
        }
        for (column, cell) in cells.iter().enumerate().skip(1) {
            let space = " ".repeat(widths[column].saturating_sub(width(cell)));
            text += &" ".repeat(gap);
            if self.left.contains(&column) {
                text += &(cell.clone() + &space)
            } else {
                text += &(space + cell)
            }
        }
        text.truncate(text.trim_end_matches(' ').len());
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_that_does_not_fit_has_a_line_of_its_own() {
        let mut table = Table::new("y".repeat(70), ["FLIP", "scene"]).with_words_in(2);
        table.push("x".repeat(60), ["0.1".into(), "railing".into()]);
        let text = table.text_in(40);
        let lines: Vec<&str> = text.lines().map(str::trim).collect();
        assert!(lines[0].ends_with(&"y".repeat(70)) && lines[1].starts_with("FLIP"));
        assert_eq!(lines[2..], [&"x".repeat(60)[..], "0.1 railing"]);
        assert!(text.lines().skip(3).all(|line| line.len() <= 40), "{text}");
    }
}
