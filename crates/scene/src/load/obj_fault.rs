//! The first fault of an OBJ file that cannot be read: its line, what is wrong and what is allowed.

use std::path::Path;

use super::error::SceneError;
use super::statements::{Statement, shorten, split_statements};
use crate::limits::{LARGEST_NUMBER, MAX_CORNERS, MAX_TRIANGLES, MAX_VERTICES};

/// Statements that faces refer to: keyword, one, and many.
const ELEMENTS: [(&str, &str, &str); 3] = [
    ("v", "vertex", "vertices"),
    ("vt", "texture coordinate", "texture coordinates"),
    ("vn", "normal", "normals"),
];

/// Numbers of elements.
#[derive(Default)]
struct Counts {
    /// Elements of each kind in the whole file.
    total: [usize; 3],
    /// Elements of each kind above the statement.
    above: [usize; 3],
    /// Triangles down to the statement.
    triangles: usize,
}

/// Finds the first fault. Runs only after tobj or a check of what it read has failed, neither of
/// which knows lines.
pub(super) fn find_fault(path: &Path, text: &str) -> SceneError {
    let kind = |statement: &Statement| ELEMENTS.iter().position(|(k, ..)| *k == statement.keyword);
    let mut counts = Counts::default();
    for kind in split_statements(text).filter_map(|statement| kind(&statement)) {
        counts.total[kind] += 1;
    }
    for statement in split_statements(text) {
        let checked = match kind(&statement) {
            Some(kind) => {
                counts.above[kind] += 1;
                let (.., many) = ELEMENTS[kind];
                check_numbers(&statement)
                    .and_then(|()| check_count(counts.above[kind], MAX_VERTICES, many))
            }
            None if statement.keyword == "f" => counts.check_face(&statement),
            None if ["o", "g", "usemtl", "mtllib"].contains(&statement.keyword) => {
                statement.check_name()
            }
            None => Ok(()),
        };
        if let Err(reason) = checked {
            return SceneError::at_line(path, statement.line, reason);
        }
    }
    SceneError::in_file(
        path,
        "is no OBJ file that can be read; export the mesh again",
    )
}

/// Refuses more elements than are allowed.
fn check_count(count: usize, most: usize, what: &str) -> Result<(), String> {
    if count <= most {
        return Ok(());
    }
    Err(format!(
        "the file has more than {most} {what}, as many as are allowed; simplify the mesh, or split it into several files"
    ))
}

/// Checks the numbers of a vertex, texture coordinate or normal.
fn check_numbers(statement: &Statement) -> Result<(), String> {
    let numbers = match statement.keyword {
        "v" => statement.read_numbers(&[3, 4, 6])?,
        "vt" => statement.read_first_numbers(2)?,
        _ => statement.read_first_numbers(3)?,
    };
    match &numbers[..] {
        [_, _, _, 0.0] => {
            Err("v has the weight 0, which puts it at infinity; leave the weight out".into())
        }
        [x, y, z, weight]
            if [x, y, z]
                .into_iter()
                .any(|number| f64::from(number / weight).abs() > LARGEST_NUMBER) =>
        {
            Err(format!(
                "v has the weight {weight:e}, which puts it beyond {LARGEST_NUMBER:e}; leave the weight out"
            ))
        }
        _ => Ok(()),
    }
}

impl Counts {
    fn check_face(&mut self, statement: &Statement) -> Result<(), String> {
        let mut corners = 0;
        let mut first_kinds = None;
        for corner in statement.words() {
            let kinds = self.check_corner(corner)?;
            if kinds != *first_kinds.get_or_insert(kinds) {
                return Err(format!(
                    "f has corners with different kinds of indices: \"{}\"; write all as v, v/vt, v//vn or v/vt/vn",
                    shorten(statement.rest)
                ));
            }
            corners += 1;
        }
        match corners {
            ..3 => return Err(format!("f has {corners} corners; allowed: 3 or more")),
            3..=MAX_CORNERS => self.triangles += corners - 2,
            _ => {
                return Err(format!(
                    "f has {corners} corners; allowed: 3 to {MAX_CORNERS}; cut the face into triangles"
                ));
            }
        }
        check_count(self.triangles, MAX_TRIANGLES, "triangles")
    }

    /// Returns which kinds of indices a corner has.
    fn check_corner(&self, corner: &str) -> Result<[bool; 3], String> {
        let mut kinds = [false; 3];
        let mut too_many = false;
        for (kind, index) in corner.split('/').enumerate() {
            match kinds.get_mut(kind) {
                Some(_) if index.is_empty() => {}
                Some(is_given) => {
                    self.check_index(index, kind)?;
                    *is_given = true;
                }
                None => too_many = true,
            }
        }
        if kinds[0] && !too_many {
            return Ok(kinds);
        }
        Err(format!(
            "f has the corner \"{}\"; allowed: v, v/vt, v//vn or v/vt/vn",
            shorten(corner)
        ))
    }

    /// Checks an index: 1 for the first element of the file, or -1 for the latest above the line.
    fn check_index(&self, word: &str, kind: usize) -> Result<(), String> {
        let (_, what, _) = ELEMENTS[kind];
        let [total, above] = [self.total[kind], self.above[kind]];
        let index: i64 = word.parse().map_err(|_| {
            let word = shorten(word);
            format!("f has the {what} index \"{word}\"; allowed: whole numbers")
        })?;
        let most = if index < 0 { above } else { total };
        if index != 0 && index.unsigned_abs() <= most as u64 {
            return Ok(());
        }
        Err(match (total, above) {
            (0, _) => format!("f has the {what} index {index}, but the file has no {what}"),
            (_, 0) => format!("f has the {what} index {index}; allowed: 1 to {total}"),
            _ => {
                format!("f has the {what} index {index}; allowed: 1 to {total}, or -{above} to -1")
            }
        })
    }
}
