//! Faces of an OBJ text that has been read, with their lines, for messages and comparisons of key
//! shapes.

use super::statements::{Statement, split_statements};

/// Face in the text.
pub(super) struct FaceLine {
    /// Line number, counted from 1.
    pub(super) line: usize,
    /// Vertices, counted from 1.
    pub(super) vertices: Vec<usize>,
}

/// Lists the faces of a text.
pub(super) fn list_faces(text: &str) -> impl Iterator<Item = FaceLine> {
    let mut above = 0;
    split_statements(text).filter_map(move |statement| {
        above += usize::from(statement.keyword == "v");
        (statement.keyword == "f").then(|| FaceLine {
            line: statement.line,
            vertices: read_vertices(&statement, above),
        })
    })
}

/// Reads the vertices of a face; negative indices count from the latest vertex above.
fn read_vertices(statement: &Statement, above: usize) -> Vec<usize> {
    let vertex = |corner: &str| {
        let index = corner.split('/').next().unwrap_or_default();
        let index: isize = index.parse().expect("tobj has read the text");
        match index {
            ..0 => (above + 1).saturating_add_signed(index),
            _ => index.unsigned_abs(),
        }
    };
    statement.words().map(vertex).collect()
}
