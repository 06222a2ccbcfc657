//! Layout of tables: columns as wide as their cells, rows that fit the terminal.

use measure::escape_markdown;

use super::markdown_table;
use crate::output::{Text, bold, faint, terminal_columns};

/// Spaces between two cells: the most that fit.
const GAPS: [usize; 2] = [2, 1];
/// Indent of a row, below the headings.
const INDENT: usize = 2;

/// A table of text: names, then numbers, which are aligned to the right.
pub struct Table {
    titles: Vec<Text>,
    /// Left-aligned columns of words.
    left: Vec<usize>,
    lines: Vec<Line>,
}

/// A line of a table.
enum Line {
    /// Text outside the columns.
    Text(Text),
    /// A name and its cells.
    Row { cells: Vec<Text>, dimmed: bool },
}

/// Places of the cells of a row.
#[derive(Clone)]
struct Columns {
    /// Indent of the name.
    indent: usize,
    /// Columns of the name; a longer one has a line of its own.
    name: usize,
    /// Spaces before every other cell.
    gap: usize,
    /// Columns of the cells.
    widths: Vec<usize>,
}

impl Table {
    /// Begins a table with the title of the names and the other columns' titles.
    pub fn new<T: Into<Text>>(name: impl Into<Text>, others: impl IntoIterator<Item = T>) -> Self {
        Self {
            titles: make_row(name, others),
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
    pub fn push_text(&mut self, text: impl Into<Text>) {
        self.lines.push(Line::Text(text.into().into_line()));
    }

    /// Adds a row.
    pub fn push<T: Into<Text>>(
        &mut self,
        name: impl Into<Text>,
        cells: impl IntoIterator<Item = T>,
    ) {
        self.push_row(false, name, cells);
    }

    /// Adds a row, dimmed or not.
    pub fn push_row<T: Into<Text>>(
        &mut self,
        dimmed: bool,
        name: impl Into<Text>,
        cells: impl IntoIterator<Item = T>,
    ) {
        let cells = make_row(name, cells);
        assert_eq!(cells.len(), self.titles.len(), "every column has a cell");
        self.lines.push(Line::Row { cells, dimmed });
    }

    /// Lays out the table. If a row does not fit the terminal, long names get a line of their own.
    pub fn text(&self) -> Text {
        self.text_in(terminal_columns())
    }

    /// Makes the table as Markdown; text outside the columns becomes a bold row.
    pub fn markdown(&self) -> String {
        let cell = |text: &Text| escape_markdown(&text.plain());
        let titles: Vec<String> = self.titles.iter().map(cell).collect();
        let titles: Vec<&str> = titles.iter().map(String::as_str).collect();
        let row = |line: &Line| match line {
            Line::Row { cells, .. } => cells.iter().map(cell).collect(),
            Line::Text(text) => {
                let mut cells = vec![String::new(); titles.len()];
                cells[0] = format!("**{}**", cell(text));
                cells
            }
        };
        markdown_table(&titles, self.lines.iter().map(row))
    }

    fn text_in(&self, terminal: usize) -> Text {
        let columns = self.lay_out(terminal);
        // The title of the names is not indented.
        let heading = Columns {
            indent: 0,
            name: INDENT + columns.name,
            ..columns.clone()
        };
        let titles = self.row_text(&self.titles, &heading);
        let mut text = bold(&titles.plain()) + "\n";
        for line in &self.lines {
            match line {
                Line::Text(line) => text += line,
                Line::Row { cells, dimmed } => {
                    let row = self.row_text(cells, &columns);
                    text += if *dimmed { faint(&row.plain()) } else { row };
                }
            }
            text += "\n";
        }
        text
    }

    /// Finds the places of the cells of rows.
    fn lay_out(&self, terminal: usize) -> Columns {
        let mut widths: Vec<usize> = self.titles.iter().map(Text::width).collect();
        // The title of the names is not indented.
        widths[0] = widths[0].saturating_sub(INDENT);
        for line in &self.lines {
            if let Line::Row { cells, .. } = line {
                for (widest, cell) in widths.iter_mut().zip(cells) {
                    *widest = cell.width().max(*widest);
                }
            }
        }
        let room = |gap: usize| {
            let others: usize = widths[1..].iter().map(|width| width + gap).sum();
            terminal.saturating_sub(INDENT + others)
        };
        let gap = if room(GAPS[0]) >= widths[0] {
            GAPS[0]
        } else {
            GAPS[1]
        };
        Columns {
            indent: INDENT,
            name: widths[0].min(room(gap)),
            gap,
            widths,
        }
    }

    /// Writes the cells of a row into their places.
    fn row_text(&self, cells: &[Text], columns: &Columns) -> Text {
        let mut text = Text::from(" ".repeat(columns.indent)) + &cells[0];
        let width = cells[0].width();
        // Spaces before the next word: none follow the last one.
        let mut gap = if width <= columns.name {
            " ".repeat(columns.name - width)
        } else {
            format!("\n{}", " ".repeat(columns.indent + columns.name))
        };
        for (column, cell) in cells.iter().enumerate().skip(1) {
            let space = " ".repeat(columns.widths[column].saturating_sub(cell.width()));
            gap += &" ".repeat(columns.gap);
            let (before, after) = if self.left.contains(&column) {
                (String::new(), space)
            } else {
                (space, String::new())
            };
            gap += &before;
            if cell.width() > 0 {
                text += std::mem::take(&mut gap);
                text += cell;
            }
            gap += &after;
        }
        text
    }
}

/// Makes the cells of a row, each of one line.
fn make_row<T: Into<Text>>(
    name: impl Into<Text>,
    others: impl IntoIterator<Item = T>,
) -> Vec<Text> {
    let others = others.into_iter().map(Into::into);
    let cells = std::iter::once(name.into()).chain(others);
    cells.map(Text::into_line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markdown_has_groups_as_bold_rows_and_escapes_names() {
        let mut table = Table::new("plate", ["FLIP", "grain"]);
        table.push_text("centred shutter");
        table.push(" 1-2 a|b", ["0.1", "0.2!"]);
        let due = "| plate | FLIP | grain |\n|---|---|---|\n| **centred shutter** |  |  |\n| 1-2 a\\|b | 0.1 | 0.2! |\n";
        assert_eq!(table.markdown(), due);
    }

    #[test]
    fn a_name_that_does_not_fit_has_a_line_of_its_own() {
        let mut table = Table::new("y".repeat(70), ["FLIP", "scene"]).with_words_in(2);
        table.push("x".repeat(60), ["0.1", "railing"]);
        let text = table.text_in(40).plain();
        let lines: Vec<&str> = text.lines().map(str::trim).collect();
        assert!(lines[0].ends_with(&"y".repeat(70)) && lines[1].starts_with("FLIP"));
        assert_eq!(lines[2..], [&"x".repeat(60)[..], "0.1 railing"]);
        assert!(text.lines().skip(3).all(|line| line.len() <= 40), "{text}");
    }
}
