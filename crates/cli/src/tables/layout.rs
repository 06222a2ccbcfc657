//! Layout of tables: columns as wide as their cells, rows that fit the terminal.

use store::printable;

use crate::output::{faint, heading, terminal_columns, width};

/// Columns between two cells: the more that fit.
const GAPS: [usize; 2] = [2, 1];
/// Indent of a row, below the headings.
const INDENT: usize = 2;

/// A table of text: names, then numbers, which are aligned to the right.
pub struct Table {
    titles: Vec<String>,
    /// Columns that hold words, aligned to the left.
    left: Vec<usize>,
    lines: Vec<TableLine>,
}

/// A line of a table.
enum TableLine {
    /// Text across all columns.
    Text(String),
    /// A name and its cells; dimmed or not.
    Row(Vec<String>, bool),
}

impl Table {
    /// Begins a table with the title of its names and those of the other columns.
    pub fn new<T: Into<String>>(
        name: impl Into<String>,
        others: impl IntoIterator<Item = T>,
    ) -> Self {
        let others = others.into_iter().map(Into::into);
        Self {
            titles: std::iter::once(name.into()).chain(others).collect(),
            left: vec![0],
            lines: Vec::new(),
        }
    }

    /// Aligns a column to the left.
    pub fn with_words_in(mut self, column: usize) -> Self {
        self.left.push(column);
        self
    }

    /// Adds a line of text that belongs to no column.
    pub fn push_text(&mut self, text: impl Into<String>) {
        let text = printable(&text.into()).into_owned();
        self.lines.push(TableLine::Text(text));
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
        self.lines.push(TableLine::Row(row, dimmed));
    }

    /// Lays out the table. Where a row does not fit the terminal, long names have a line of their own.
    pub fn text(&self) -> String {
        self.text_in(terminal_columns())
    }

    fn text_in(&self, columns: usize) -> String {
        let widths: Vec<usize> = (0..self.titles.len())
            .map(|column| self.width_of(column))
            .collect();
        let room = |gap: usize| {
            let others: usize = widths[1..].iter().map(|width| width + gap).sum();
            columns.saturating_sub(INDENT + others)
        };
        let gap = match room(GAPS[0]) >= widths[0] {
            true => GAPS[0],
            false => GAPS[1],
        };
        let name = widths[0].min(room(gap));
        let mut text =
            heading(&self.row_text(&self.titles, (INDENT + name, 0, gap), &widths)) + "\n";
        for line in &self.lines {
            text += &match line {
                TableLine::Text(line) => line.clone(),
                TableLine::Row(cells, dimmed) => {
                    let row = self.row_text(cells, (name, INDENT, gap), &widths);
                    if *dimmed { faint(&row) } else { row }
                }
            };
            text += "\n";
        }
        text
    }

    fn width_of(&self, column: usize) -> usize {
        // The title of the names is further to the left than they are.
        let indent = if column == 0 { INDENT } else { 0 };
        let cells = self.lines.iter().filter_map(|line| match line {
            TableLine::Text(_) => None,
            TableLine::Row(cells, _) => Some(width(&cells[column])),
        });
        let title = width(&self.titles[column]).saturating_sub(indent);
        cells.fold(title, usize::max)
    }

    /// Lays out cells: the first in a width of its own after an indent, the others after gaps.
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
            match self.left.contains(&column) {
                true => text += &(cell.clone() + &space),
                false => text += &(space + cell),
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
        let mut table = Table::new("filter", ["FLIP", "scene"]).with_words_in(2);
        table.push("a", ["-69.6".into(), "fan".into()]);
        table.push("b:c", ["28209.7".into(), "railing".into()]);
        table
    }

    #[test]
    fn a_name_that_does_not_fit_has_a_line_of_its_own() {
        let mut table = make_table();
        table.push("x".repeat(60), ["0.1".into(), "fan".into()]);
        let text = table.text_in(40);
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[3].trim(), "x".repeat(60));
        assert!(lines[4].trim_start().starts_with("0.1"));
        assert!(lines[4].chars().count() <= 40, "{text}");
    }
}
