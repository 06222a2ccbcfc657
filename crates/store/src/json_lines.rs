//! JSON with a line for each entry of the outer lists, so that large files stay small, and two of them differ in few lines.

use std::io::{self, Write};

use serde::Serialize;
use serde_json::Serializer;
use serde_json::ser::{CompactFormatter, Formatter};

/// Depth down to which every value has a line of its own: the keys of the outer object, and the entries of their lists.
const LINES: usize = 2;

/// Writes plain data: an object with a line per key, and where the value of a key is a list or an object, a line per entry.
///
/// # Panics
/// A map has keys that are no strings.
pub fn to_lines(value: &impl Serialize) -> String {
    let mut bytes = Vec::new();
    let mut serializer = Serializer::with_formatter(&mut bytes, LineFormatter::default());
    value
        .serialize(&mut serializer)
        .expect("plain data can be written");
    String::from_utf8(bytes).expect("JSON is UTF-8")
}

/// Breaks lines at the outer levels.
#[derive(Default)]
struct LineFormatter {
    /// Number of lists and objects that are open.
    depth: usize,
    /// True where the innermost open list or object holds nothing yet.
    is_empty: bool,
}

impl LineFormatter {
    /// Begins a line for an entry of the innermost open list or object, or puts a space behind the entry before.
    fn begin_entry<W: ?Sized + Write>(&mut self, writer: &mut W, is_first: bool) -> io::Result<()> {
        self.is_empty = false;
        if !is_first {
            writer.write_all(b",")?;
        }
        match self.depth <= LINES {
            true => self.begin_line(writer),
            false if is_first => Ok(()),
            false => writer.write_all(b" "),
        }
    }

    fn begin_line<W: ?Sized + Write>(&self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b"\n")?;
        (0..self.depth).try_for_each(|_| writer.write_all(b" "))
    }

    fn open<W: ?Sized + Write>(&mut self, writer: &mut W, bracket: &[u8]) -> io::Result<()> {
        self.depth += 1;
        self.is_empty = true;
        writer.write_all(bracket)
    }

    fn close<W: ?Sized + Write>(&mut self, writer: &mut W, bracket: &[u8]) -> io::Result<()> {
        self.depth -= 1;
        if self.depth < LINES && !self.is_empty {
            self.begin_line(writer)?;
        }
        self.is_empty = false;
        writer.write_all(bracket)
    }
}

impl Formatter for LineFormatter {
    fn begin_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.open(writer, b"[")
    }

    fn end_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.close(writer, b"]")
    }

    fn begin_array_value<W: ?Sized + Write>(
        &mut self,
        writer: &mut W,
        first: bool,
    ) -> io::Result<()> {
        self.begin_entry(writer, first)
    }

    fn begin_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.open(writer, b"{")
    }

    fn end_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.close(writer, b"}")
    }

    fn begin_object_key<W: ?Sized + Write>(
        &mut self,
        writer: &mut W,
        first: bool,
    ) -> io::Result<()> {
        self.begin_entry(writer, first)
    }

    fn begin_object_value<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        CompactFormatter.begin_object_value(writer)?;
        writer.write_all(b" ")
    }
}

#[test]
fn entries_of_outer_lists_have_a_line_each() {
    let value = serde_json::json!({
        "cases": [{ "scene": "fan", "at": [1, 2] }, {}],
        "none": [],
        "width": 160,
    });
    let text = to_lines(&value);
    let expected = r#"{
 "cases": [
  {"at": [1, 2], "scene": "fan"},
  {}
 ],
 "none": [],
 "width": 160
}"#;
    assert_eq!(text, expected);
    assert_eq!(
        serde_json::from_str::<serde_json::Value>(&text).unwrap(),
        value
    );
}
