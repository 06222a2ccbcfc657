//! Faces of OBJ files.

use super::statements::{Statement, shorten};
use crate::limits::MAX_CORNERS;

/// Face with three corners or more.
pub(super) struct Face {
    /// Line number, counted from 1.
    pub(super) line: usize,
    pub(super) corners: Vec<Corner>,
}

/// Corner of a face, as indices from 0.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct Corner {
    pub(super) position: u32,
    pub(super) texcoord: Option<u32>,
    pub(super) normal: Option<u32>,
}

impl Face {
    /// Reads a face; `lengths` are the numbers of positions, texture coordinates and normals above it.
    pub(super) fn read(statement: &Statement, lengths: [usize; 3]) -> Result<Self, String> {
        let words = statement.rest.split_whitespace();
        let corners = words.map(|word| Corner::read(word, lengths));
        let corners = corners.collect::<Result<Vec<Corner>, String>>()?;
        let line = statement.line;
        let face = Self { line, corners };
        match face.corners.len() {
            count @ ..3 => Err(format!("f has {count} corners; allowed: 3 or more")),
            3..=MAX_CORNERS
                if face
                    .corners
                    .iter()
                    .all(|corner| corner.kinds() == face.kinds()) =>
            {
                Ok(face)
            }
            3..=MAX_CORNERS => Err(format!(
                "f has corners with different kinds of indices: \"{}\"; write all as v, v/vt, v//vn or v/vt/vn",
                shorten(statement.rest)
            )),
            count => Err(format!(
                "f has {count} corners; allowed: 3 to {MAX_CORNERS}; cut the face into triangles"
            )),
        }
    }

    /// Numbers of the vertices, counted from 1.
    pub(super) fn vertices(&self) -> impl Iterator<Item = u32> {
        self.corners.iter().map(|corner| corner.position + 1)
    }

    /// Returns whether its corners have texture coordinates, and whether they have normals.
    pub(super) fn kinds(&self) -> [bool; 2] {
        self.corners[0].kinds()
    }
}

impl Corner {
    fn kinds(self) -> [bool; 2] {
        [self.texcoord.is_some(), self.normal.is_some()]
    }

    fn read(text: &str, lengths: [usize; 3]) -> Result<Self, String> {
        let mut words = text.split('/');
        let mut read = |what: &str, length: usize| match words.next() {
            None | Some("") => Ok(None),
            Some(word) => read_index(word, what, length).map(Some),
        };
        let position = read("vertex", lengths[0])?;
        let texcoord = read("texture coordinate", lengths[1])?;
        let normal = read("normal", lengths[2])?;
        match (position, words.next()) {
            (Some(position), None) => Ok(Self {
                position,
                texcoord,
                normal,
            }),
            _ => Err(format!(
                "f has the corner \"{}\"; allowed: v, v/vt, v//vn or v/vt/vn",
                shorten(text)
            )),
        }
    }
}

/// Reads an index, 1 for the first element or -1 for the latest above the line, as one from 0.
fn read_index(word: &str, what: &str, count: usize) -> Result<u32, String> {
    let index: i64 = word.parse().map_err(|_| {
        let word = shorten(word);
        format!("f has the {what} index \"{word}\"; allowed: whole numbers")
    })?;
    let from_zero = match index {
        ..0 => count as i64 + index,
        _ => index - 1,
    };
    match u32::try_from(from_zero) {
        Ok(number) if (number as usize) < count => Ok(number),
        _ if count == 0 => Err(format!(
            "f has the {what} index {index}, but no {what} comes before it"
        )),
        _ => Err(format!(
            "f has the {what} index {index}; allowed: 1 to {count}, or -{count} to -1"
        )),
    }
}
