//! Text of an OBJ file in the form that tobj reads.
//!
//! tobj takes each line alone, and as it is. Here comments after numbers, colours of vertices and
//! statements of other subjects are left out. Vertices come before all faces, so that these may
//! name any. Faces with other kinds of indices than those before them begin a group of the same
//! name, since tobj gives all faces of a group the same kinds.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::io::{BufRead, Read};

use super::statements::Statement;
use super::statements::split_statements;
use crate::limits::MAX_VERTICES;

/// Name of a material that no file defines, for `usemtl` without a name. Names have no control
/// characters.
const NO_MATERIAL: &str = "\u{1}";

/// Text for tobj, and what the text refers to.
#[derive(Default)]
pub(super) struct ObjText<'a> {
    /// Statements of vertices, texture coordinates and normals.
    elements: String,
    /// Statements of groups, materials and faces.
    faces: String,
    /// Statements that name material libraries.
    pub(super) libraries: Vec<Statement<'a>>,
    /// First statement of each material that faces use.
    pub(super) materials: BTreeMap<&'a str, Statement<'a>>,
    /// Numbers of vertices, texture coordinates and normals.
    counts: [usize; 3],
    /// Kinds that faces refer to.
    is_used: [bool; 3],
    group: &'a str,
    /// Kinds of indices of the last face: texture coordinates and normals.
    kinds: Option<[bool; 2]>,
}

impl<'a> ObjText<'a> {
    /// Prepares a text; returns none if tobj must not get it.
    pub(super) fn prepare(text: &'a str) -> Option<Self> {
        let mut prepared = Self::default();
        split_statements(text).try_for_each(|statement| prepared.add(statement))?;
        // tobj forgets indices into nothing.
        let mut kinds = prepared.is_used.iter().zip(prepared.counts);
        kinds
            .all(|(is_used, count)| !is_used || count > 0)
            .then_some(prepared)
    }

    /// Reader of the whole text. It begins with a `mtllib`, for the materials of all libraries.
    pub(super) fn reader(&self) -> impl BufRead {
        let elements = self.elements.as_bytes();
        b"mtllib all\n".chain(elements).chain(self.faces.as_bytes())
    }

    fn add(&mut self, statement: Statement<'a>) -> Option<()> {
        match statement.keyword {
            "v" => self.add_element(0, statement),
            "vt" => self.add_element(1, statement),
            "vn" => self.add_element(2, statement),
            "f" => self.add_face(statement),
            "o" | "g" => {
                statement.check_name().ok()?;
                self.group = statement.rest;
                writeln!(self.faces, "g {}", self.group).ok()
            }
            "usemtl" if statement.rest.is_empty() => {
                writeln!(self.faces, "usemtl {NO_MATERIAL}").ok()
            }
            "usemtl" => {
                statement.check_name().ok()?;
                self.materials.entry(statement.rest).or_insert(statement);
                writeln!(self.faces, "usemtl {}", statement.rest).ok()
            }
            "mtllib" => {
                statement.check_name().ok()?;
                self.libraries.push(statement);
                Some(())
            }
            _ => Some(()),
        }
    }

    fn add_element(&mut self, kind: usize, statement: Statement) -> Option<()> {
        self.counts[kind] += 1;
        self.elements.push_str(statement.keyword);
        let words = statement.words();
        // Six numbers are a position and a colour, which is not used.
        let is_colored = kind == 0 && words.clone().count() == 6;
        for word in words.take(if is_colored { 3 } else { usize::MAX }) {
            self.elements.push(' ');
            self.elements.push_str(word);
        }
        self.elements.push('\n');
        (self.counts[kind] <= MAX_VERTICES).then_some(())
    }

    fn add_face(&mut self, statement: Statement) -> Option<()> {
        let first = statement.words().next()?;
        let mut indices = first.split('/').skip(1);
        let kinds = [(); 2].map(|()| indices.next().is_some_and(|index| !index.is_empty()));
        if self.kinds.is_some_and(|before| before != kinds) {
            writeln!(self.faces, "g {}", self.group).ok()?;
        }
        self.kinds = Some(kinds);
        self.faces.push('f');
        for corner in statement.words() {
            self.faces.push(' ');
            for (kind, index) in corner.split('/').enumerate() {
                if kind > 0 {
                    self.faces.push('/');
                }
                if !index.is_empty() {
                    *self.is_used.get_mut(kind)? = true;
                    self.add_index(index, self.counts[kind])?;
                }
            }
        }
        self.faces.push('\n');
        Some(())
    }

    /// Adds an index as one from 1. tobj takes 0 for none, and computes with any number.
    fn add_index(&mut self, index: &str, count: usize) -> Option<()> {
        let number: i64 = index.parse().ok()?;
        let from_start = if number < 0 {
            count as i64 + 1 + number
        } else {
            number
        };
        if !(1..=MAX_VERTICES as i64).contains(&from_start) {
            return None;
        }
        if number < 0 {
            write!(self.faces, "{from_start}").ok()
        } else {
            self.faces.push_str(index);
            Some(())
        }
    }
}
