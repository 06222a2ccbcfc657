//! The document that grows while a scene is exported, and its binary buffer.

use gltf_json::accessor::{ComponentType, GenericComponentType, Type};
use gltf_json::buffer::{Target, View};
use gltf_json::validation::{Checked, USize64};
use gltf_json::{Accessor, Index, Root};

/// Name of the file that holds vertices and keys.
pub const BUFFER: &str = "scene.bin";

/// A document and the bytes of its one buffer.
#[derive(Debug, Default)]
pub struct Document {
    /// Everything but the bytes.
    pub root: Root,
    /// Content of [`BUFFER`].
    pub bytes: Vec<u8>,
}

impl Document {
    /// Adds vectors of vertices, or times, with the limits that the format asks for there.
    pub fn push_limited<const N: usize>(
        &mut self,
        values: &[[f32; N]],
        target: Option<Target>,
    ) -> Index<Accessor> {
        let limit = |pick: fn(f32, f32) -> f32| -> Vec<f32> {
            (0..N)
                .map(|part| {
                    values
                        .iter()
                        .map(|value| value[part])
                        .reduce(pick)
                        .unwrap_or(0.0)
                })
                .collect()
        };
        let limits = [limit(f32::min), limit(f32::max)];
        let index = self.push_floats(values, target);
        let accessor = &mut self.root.accessors[index.value()];
        let [least, greatest] = limits.map(|limit| Some(serde_json::json!(limit)));
        accessor.min = least;
        accessor.max = greatest;
        index
    }

    /// Adds vectors of one to four floats.
    pub fn push_floats<const N: usize>(
        &mut self,
        values: &[[f32; N]],
        target: Option<Target>,
    ) -> Index<Accessor> {
        let kind = [Type::Scalar, Type::Vec2, Type::Vec3, Type::Vec4][N - 1];
        let start = self.bytes.len();
        let bytes = values
            .iter()
            .flatten()
            .flat_map(|value| value.to_le_bytes());
        self.bytes.extend(bytes);
        self.push_accessor(start, values.len(), (ComponentType::F32, kind), target)
    }

    /// Adds corners of triangles.
    pub fn push_indices(&mut self, indices: &[u32]) -> Index<Accessor> {
        let start = self.bytes.len();
        let bytes = indices.iter().flat_map(|index| index.to_le_bytes());
        self.bytes.extend(bytes);
        let kind = (ComponentType::U32, Type::Scalar);
        self.push_accessor(start, indices.len(), kind, Some(Target::ElementArrayBuffer))
    }

    fn push_accessor(
        &mut self,
        start: usize,
        count: usize,
        (component, kind): (ComponentType, Type),
        target: Option<Target>,
    ) -> Index<Accessor> {
        let view = self.root.push(View {
            buffer: Index::new(0),
            byte_length: USize64::from(self.bytes.len() - start),
            byte_offset: Some(USize64::from(start)),
            byte_stride: None,
            name: None,
            target: target.map(Checked::Valid),
            extensions: None,
            extras: None,
        });
        self.root.push(Accessor {
            buffer_view: Some(view),
            byte_offset: None,
            count: USize64::from(count),
            component_type: Checked::Valid(GenericComponentType(component)),
            extensions: None,
            extras: None,
            type_: Checked::Valid(kind),
            min: None,
            max: None,
            name: None,
            normalized: false,
            sparse: None,
        })
    }
}
