//! The document that grows while a scene is exported, and its binary buffer.

use std::collections::BTreeMap;
use std::path::Path;

use frame::{FileError, write_atomically};
use serde_json::{Value, json};

use crate::files::write_json;

/// Name of the document.
const DOCUMENT: &str = "scene.gltf";
/// Name of the file that holds vertices and keys.
const BUFFER: &str = "scene.bin";

/// Use of a buffer's part.
#[derive(Clone, Copy)]
pub enum Target {
    /// Vertices.
    Vertices = 34962,
    /// Corners of triangles.
    Indices = 34963,
}

/// Type of a number.
#[derive(Clone, Copy)]
enum Component {
    U32 = 5125,
    F32 = 5126,
}

/// Lists of a document, and the bytes of its one buffer.
#[derive(Debug, Default)]
pub struct Document {
    /// The lists by their names, such as `nodes` and `meshes`.
    lists: BTreeMap<&'static str, Vec<Value>>,
    bytes: Vec<u8>,
}

impl Document {
    /// Adds an entry to a list, and returns its index. Fields that are null are left out.
    pub fn push(&mut self, list: &'static str, mut entry: Value) -> usize {
        remove_nulls(&mut entry);
        let entries = self.lists.entry(list).or_default();
        entries.push(entry);
        entries.len() - 1
    }

    /// Returns the entries of a list.
    pub fn list(&self, list: &str) -> &[Value] {
        self.lists.get(list).map_or(&[], Vec::as_slice)
    }

    /// Adds vectors of vertices, or times, with the limits that the format asks for there.
    pub fn push_limited<const N: usize>(
        &mut self,
        values: &[[f32; N]],
        target: Option<Target>,
    ) -> usize {
        let limit = |pick: fn(f32, f32) -> f32| -> Vec<f32> {
            let part = |part: usize| values.iter().map(move |value| value[part]);
            (0..N)
                .map(|at| part(at).reduce(pick).unwrap_or(0.0))
                .collect()
        };
        let limits = json!({ "min": limit(f32::min), "max": limit(f32::max) });
        self.push_vectors(values, target, limits)
    }

    /// Adds vectors of one to four floats.
    pub fn push_floats<const N: usize>(
        &mut self,
        values: &[[f32; N]],
        target: Option<Target>,
    ) -> usize {
        self.push_vectors(values, target, json!({}))
    }

    /// Adds corners of triangles.
    pub fn push_indices(&mut self, indices: &[u32]) -> usize {
        let bytes = indices.iter().flat_map(|index| index.to_le_bytes());
        let view = self.push_view(bytes, Some(Target::Indices));
        self.push(
            "accessors",
            json!({
                "bufferView": view,
                "componentType": Component::U32 as u32,
                "count": indices.len(),
                "type": "SCALAR",
            }),
        )
    }

    fn push_vectors<const N: usize>(
        &mut self,
        values: &[[f32; N]],
        target: Option<Target>,
        limits: Value,
    ) -> usize {
        let bytes = values
            .iter()
            .flatten()
            .flat_map(|value| value.to_le_bytes());
        let view = self.push_view(bytes, target);
        let kind = ["SCALAR", "VEC2", "VEC3", "VEC4"][N - 1];
        self.push(
            "accessors",
            json!({
                "bufferView": view,
                "componentType": Component::F32 as u32,
                "count": values.len(),
                "type": kind,
                "min": limits["min"],
                "max": limits["max"],
            }),
        )
    }

    fn push_view(&mut self, bytes: impl Iterator<Item = u8>, target: Option<Target>) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(bytes);
        let view = json!({
            "buffer": 0,
            "byteLength": self.bytes.len() - start,
            "byteOffset": start,
            "target": target.map(|target| target as u32),
        });
        self.push("bufferViews", view)
    }

    /// Writes the document, whose other fields are given, and its buffer.
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

/// Widens a number so that its text keeps the few digits that it has.
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
