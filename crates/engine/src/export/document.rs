//! The document of an export in progress, and its binary buffer.

use std::collections::BTreeMap;
use std::path::Path;

use frame::{FileError, write_atomically};
use serde_json::{Value, json};

use crate::files::write_json;

/// Name of the document.
const DOCUMENT: &str = "scene.gltf";
/// Name of the file with vertices and keys.
const BUFFER: &str = "scene.bin";
/// Name of the list of buffer views as numbers.
const ACCESSORS: &str = "accessors";

/// Use of a part of the buffer, by its number in glTF: vertices.
pub const VERTICES: Option<u32> = Some(34962);
/// Corners of triangles.
const INDICES: Option<u32> = Some(34963);

/// Lists of a document, and the bytes of its one buffer.
#[derive(Debug, Default)]
pub struct Document {
    /// The lists by their names, such as `nodes` and `meshes`.
    lists: BTreeMap<&'static str, Vec<Value>>,
    bytes: Vec<u8>,
}

impl Document {
    /// Adds an entry to a list, and returns its index. Leaves out null fields.
    pub fn push(&mut self, list: &'static str, mut entry: Value) -> usize {
        remove_nulls(&mut entry);
        let entries = self.lists.entry(list).or_default();
        entries.push(entry);
        entries.len() - 1
    }

    pub fn list(&self, list: &str) -> &[Value] {
        self.lists.get(list).map_or(&[], Vec::as_slice)
    }

    /// Adds vectors of vertices, or times, with the limits that the format requires there.
    pub fn push_limited<const N: usize>(
        &mut self,
        values: &[[f32; N]],
        target: Option<u32>,
    ) -> usize {
        let limit = |pick: fn(f32, f32) -> f32| -> Vec<f32> {
            let part = |part: usize| values.iter().map(move |value| value[part]);
            let limits = (0..N).map(|at| part(at).reduce(pick).unwrap_or(0.0));
            limits.collect()
        };
        let index = self.push_floats(values, target);
        let accessor = &mut self.lists.get_mut(ACCESSORS).expect("one was just added")[index];
        accessor["min"] = limit(f32::min).into();
        accessor["max"] = limit(f32::max).into();
        index
    }

    /// Adds vectors of one to four floats.
    pub fn push_floats<const N: usize>(
        &mut self,
        values: &[[f32; N]],
        target: Option<u32>,
    ) -> usize {
        let kind = ["SCALAR", "VEC2", "VEC3", "VEC4"][N - 1];
        let numbers = values.as_flattened().iter();
        let bytes = numbers.flat_map(|value| value.to_le_bytes());
        let float = 5126;
        let accessor = json!({ "componentType": float, "count": values.len(), "type": kind });
        self.push_accessor(bytes, target, accessor)
    }

    /// Adds corners of triangles.
    pub fn push_indices(&mut self, indices: &[u32]) -> usize {
        let bytes = indices.iter().flat_map(|index| index.to_le_bytes());
        let unsigned = 5125;
        let accessor =
            json!({ "componentType": unsigned, "count": indices.len(), "type": "SCALAR" });
        self.push_accessor(bytes, INDICES, accessor)
    }

    fn push_accessor(
        &mut self,
        bytes: impl Iterator<Item = u8>,
        target: Option<u32>,
        mut accessor: Value,
    ) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(bytes);
        let view = json!({
            "buffer": 0,
            "byteLength": self.bytes.len() - start,
            "byteOffset": start,
            "target": target,
        });
        accessor["bufferView"] = self.push("bufferViews", view).into();
        self.push(ACCESSORS, accessor)
    }

    /// Writes the document, with the given other fields, and its buffer.
    pub fn write(self, mut fields: Value, folder: &Path) -> Result<(), FileError> {
        fields["buffers"] = json!([{ "byteLength": self.bytes.len(), "uri": BUFFER }]);
        for (name, list) in self.lists {
            fields[name] = list.into();
        }
        remove_nulls(&mut fields);
        write_atomically(&folder.join(BUFFER), &self.bytes)?;
        write_json(&folder.join(DOCUMENT), &fields)
    }
}

/// Widens a number so that its text keeps its few digits.
pub fn widen(value: f32) -> f64 {
    let text = value.to_string();
    text.parse().expect("what was written as a number")
}

fn remove_nulls(value: &mut Value) {
    match value {
        Value::Object(fields) => {
            fields.retain(|_, field| !field.is_null());
            fields.values_mut().for_each(remove_nulls);
        }
        Value::Array(entries) => entries.iter_mut().for_each(remove_nulls),
        _ => {}
    }
}
