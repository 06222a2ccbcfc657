//! glTF files in the making: JSON, and one buffer next to it.

use serde_json::{Value, json};

use crate::sandbox::Sandbox;

/// Name of the file.
pub const MODEL: &str = "models/model.gltf";

/// A file with one triangle, corners (0, 0, 0), (1, 0, 0) and (0, 1, 0), as its mesh 0 and its
/// node 0, and a camera at (0, 0, 5) as its node 1.
pub struct Model {
    pub json: Value,
    pub bytes: Vec<u8>,
}

impl Model {
    pub fn new() -> Self {
        let json = json!({
            "asset": { "version": "2.0" },
            "scene": 0,
            "scenes": [{ "nodes": [0, 1] }],
            "nodes": [
                { "name": "thing", "mesh": 0 },
                { "name": "eye", "camera": 0, "translation": [0, 0, 5] },
            ],
            "cameras": [{ "type": "perspective", "perspective": { "aspectRatio": 2.0, "yfov": 1.0, "znear": 0.1 } }],
            "accessors": [], "bufferViews": [],
            "materials": [], "meshes": [], "skins": [], "animations": [],
        });
        let mut model = Self {
            json,
            bytes: Vec::new(),
        };
        let positions = model.floats("VEC3", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
        let mesh = json!({ "primitives": [{ "attributes": { "POSITION": positions } }] });
        model.push("meshes", mesh);
        model
    }

    /// Adds an entry to a list, and returns its index.
    pub fn push(&mut self, list: &str, entry: Value) -> usize {
        let entries = self.json[list].as_array_mut().unwrap();
        entries.push(entry);
        entries.len() - 1
    }

    /// Adds an accessor of floats.
    pub fn floats(&mut self, kind: &str, values: &[f32]) -> usize {
        let bytes: Vec<u8> = values
            .iter()
            .flat_map(|value| value.to_le_bytes())
            .collect();
        let width = ["SCALAR", "VEC2", "VEC3", "VEC4"]
            .iter()
            .position(|name| *name == kind);
        let width = width.map_or(16, |at| at + 1);
        self.accessor(kind, 5126, values.len() / width, &bytes)
    }

    /// Adds an accessor of whole numbers from 0 to 255.
    pub fn bytes(&mut self, kind: &str, count: usize, values: &[u8]) -> usize {
        self.accessor(kind, 5121, count, values)
    }

    fn accessor(&mut self, kind: &str, component: u32, count: usize, bytes: &[u8]) -> usize {
        while !self.bytes.len().is_multiple_of(4) {
            self.bytes.push(0);
        }
        let view =
            json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        self.bytes.extend(bytes);
        let view = self.push("bufferViews", view);
        let accessor =
            json!({ "bufferView": view, "componentType": component, "count": count, "type": kind });
        self.push("accessors", accessor)
    }

    /// Adds a channel to the only animation: keys of a part of a node.
    pub fn animate(
        &mut self,
        node: usize,
        path: &str,
        interpolation: &str,
        times: &[f32],
        values: &[f32],
    ) {
        let input = self.floats("SCALAR", times);
        let kind = match path {
            "rotation" => "VEC4",
            "weights" => "SCALAR",
            _ => "VEC3",
        };
        let output = self.floats(kind, values);
        if self.json["animations"].as_array().unwrap().is_empty() {
            self.push(
                "animations",
                json!({ "name": "walk", "channels": [], "samplers": [] }),
            );
        }
        let animation = &mut self.json["animations"][0];
        let samplers = animation["samplers"].as_array_mut().unwrap();
        let sampler = samplers.len();
        samplers.push(json!({ "input": input, "output": output, "interpolation": interpolation }));
        let channel = json!({ "sampler": sampler, "target": { "node": node, "path": path } });
        animation["channels"].as_array_mut().unwrap().push(channel);
    }

    /// Slides the triangle along x, by a metre in a second.
    pub fn sliding() -> Self {
        let mut model = Self::new();
        model.animate(
            0,
            "translation",
            "LINEAR",
            &[0.0, 2.0],
            &[0.0, 0.0, 0.0, 2.0, 0.0, 0.0],
        );
        model
    }

    /// Writes the file and its buffer into a sandbox.
    pub fn write(&self, sandbox: &Sandbox) {
        let mut json = self.json.clone();
        json["buffers"] = json!([{ "uri": "model.bin", "byteLength": self.bytes.len() }]);
        sandbox.put("models/model.bin", &self.bytes);
        sandbox.put(MODEL, json.to_string());
    }

    /// Writes the file with its buffer inside, as `models/model.glb`.
    pub fn write_binary(&self, sandbox: &Sandbox) {
        let mut json = self.json.clone();
        json["buffers"] = json!([{ "byteLength": self.bytes.len() }]);
        let pad = |bytes: &[u8], with: u8| {
            let mut bytes = bytes.to_vec();
            bytes.resize(bytes.len().next_multiple_of(4), with);
            bytes
        };
        let chunks = [
            (b"JSON", pad(json.to_string().as_bytes(), b' ')),
            (b"BIN\0", pad(&self.bytes, 0)),
        ];
        let length: usize = 12
            + chunks
                .iter()
                .map(|(_, chunk)| 8 + chunk.len())
                .sum::<usize>();
        let mut file = b"glTF".to_vec();
        file.extend(2u32.to_le_bytes());
        file.extend((length as u32).to_le_bytes());
        for (name, chunk) in chunks {
            file.extend((chunk.len() as u32).to_le_bytes());
            file.extend(name);
            file.extend(chunk);
        }
        sandbox.put("models/model.glb", file);
    }
}
