//! Values of accessors: floats and whole numbers, quantised and sparse ones too.

use scene::limits::MAX_VERTICES;

use super::file::File;
use super::schema::{Accessor, Sparse};

/// Type of a component.
#[derive(Clone, Copy)]
struct Component {
    size: usize,
    read: ReadNumber,
}

/// Reads a number, and divides it by the largest of its type if it is normalised.
type ReadNumber = fn(&[u8], bool) -> f32;

impl Component {
    fn of(number: u32) -> Result<Self, String> {
        let (size, read): (usize, ReadNumber) = match number {
            5120 => (1, |bytes, scaled| {
                scale(f32::from(i8::from_le_bytes([bytes[0]])), 127.0, scaled)
            }),
            5121 => (1, |bytes, scaled| scale(f32::from(bytes[0]), 255.0, scaled)),
            5122 => (2, |bytes, scaled| {
                let value = i16::from_le_bytes([bytes[0], bytes[1]]);
                scale(f32::from(value), 32767.0, scaled)
            }),
            5123 => (2, |bytes, scaled| {
                let value = u16::from_le_bytes([bytes[0], bytes[1]]);
                scale(f32::from(value), 65535.0, scaled)
            }),
            5126 => (4, |bytes, _| {
                f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])
            }),
            _ => {
                return Err(format!(
                    "has the componentType {number}; allowed: 5120 to 5123, and 5126 (float)"
                ));
            }
        };
        Ok(Self { size, read })
    }
}

fn scale(value: f32, largest: f32, is_normalized: bool) -> f32 {
    if is_normalized {
        (value / largest).max(-1.0)
    } else {
        value
    }
}

/// Size of a whole number that counts vertices.
fn index_size(component_type: u32) -> Result<usize, String> {
    match component_type {
        5121 => Ok(1),
        5123 => Ok(2),
        5125 => Ok(4),
        other => Err(format!(
            "has the componentType {other}; allowed for indices: 5121, 5123 and 5125"
        )),
    }
}

fn read_index(bytes: &[u8]) -> u32 {
    let digits = bytes.iter().rev();
    digits.fold(0, |value, byte| value << 8 | u32::from(*byte))
}

impl File {
    /// Reads vectors of `N` floats; `what` names them in errors.
    pub fn floats<const N: usize>(
        &self,
        index: usize,
        what: &str,
    ) -> Result<Vec<[f32; N]>, String> {
        let flat = self.flat_floats(index, N, what)?;
        let (vectors, _) = flat.as_chunks();
        Ok(vectors.to_vec())
    }

    /// Reads vectors of so many floats, one after the other.
    pub fn flat_floats(&self, index: usize, width: usize, what: &str) -> Result<Vec<f32>, String> {
        let fail = |reason: String| format!("accessors[{index}] ({what}) {reason}");
        let accessor = File::entry(&self.json.accessors, "accessors", index)?;
        check(accessor, width).map_err(fail)?;
        let component = Component::of(accessor.component_type).map_err(fail)?;
        let size = width * component.size;
        let read = |element: &[u8]| -> Vec<f32> {
            let parts = element.chunks_exact(component.size);
            parts
                .map(|bytes| (component.read)(bytes, accessor.normalized))
                .collect()
        };
        let mut values: Vec<f32> = match accessor.buffer_view {
            Some(view) => {
                let elements = self.elements(view, accessor.byte_offset, accessor.count, size);
                elements.map_err(fail)?.flat_map(read).collect()
            }
            None => vec![0.0; width * accessor.count],
        };
        if let Some(sparse) = &accessor.sparse {
            let places = self.sparse_places(sparse, accessor.count).map_err(fail)?;
            let replacements = &sparse.values;
            let elements = self.elements(
                replacements.buffer_view,
                replacements.byte_offset,
                sparse.count,
                size,
            );
            for (place, element) in places.iter().zip(elements.map_err(fail)?) {
                let start = *place as usize * width;
                values[start..start + width].copy_from_slice(&read(element));
            }
        }
        match values.iter().position(|value| !value.is_finite()) {
            None => Ok(values),
            Some(at) => Err(fail(format!(
                "holds {} at element {}; allowed: finite numbers; export the file again",
                values[at],
                at / width
            ))),
        }
    }

    /// Reads indices of vertices.
    pub fn indices(&self, index: usize) -> Result<Vec<u32>, String> {
        let fail = |reason: String| format!("accessors[{index}] (indices) {reason}");
        let accessor = File::entry(&self.json.accessors, "accessors", index)?;
        check(accessor, 1).map_err(fail)?;
        let size = index_size(accessor.component_type).map_err(fail)?;
        let (Some(view), None) = (accessor.buffer_view, &accessor.sparse) else {
            return Err(fail(
                "has no values of its own; export the file again".into(),
            ));
        };
        let elements = self.elements(view, accessor.byte_offset, accessor.count, size);
        Ok(elements.map_err(fail)?.map(read_index).collect())
    }

    /// Reads which elements a sparse accessor replaces.
    fn sparse_places(&self, sparse: &Sparse, count: usize) -> Result<Vec<u32>, String> {
        if sparse.count > count {
            return Err(format!(
                "replaces {} of its {count} elements; export the file again",
                sparse.count
            ));
        }
        let at = &sparse.indices;
        let size = index_size(at.component_type)?;
        let elements = self.elements(at.buffer_view, at.byte_offset, sparse.count, size)?;
        let places: Vec<u32> = elements.map(read_index).collect();
        match places.iter().find(|place| **place as usize >= count) {
            None => Ok(places),
            Some(place) => Err(format!(
                "replaces element {place} of {count}; export the file again"
            )),
        }
    }

    /// Cuts a view into elements of so many bytes.
    fn elements(
        &self,
        view: usize,
        offset: usize,
        count: usize,
        size: usize,
    ) -> Result<impl Iterator<Item = &[u8]>, String> {
        let (bytes, view) = self.view(view)?;
        let stride = view.byte_stride.unwrap_or(size).max(1);
        let needed = (count.saturating_sub(1).checked_mul(stride))
            .and_then(|bytes| bytes.checked_add(if count == 0 { 0 } else { size }))
            .and_then(|bytes| bytes.checked_add(offset));
        match needed {
            Some(needed) if needed <= bytes.len() && stride >= size => {
                let start = move |element: usize| offset + element * stride;
                Ok((0..count).map(move |element| &bytes[start(element)..start(element) + size]))
            }
            _ => Err(format!(
                "takes {count} elements of {size} bytes, {stride} apart, from byte {offset} of a bufferView of {} bytes; \
                 the file is broken, so export it again",
                bytes.len()
            )),
        }
    }
}

/// Checks type and length of an accessor.
fn check(accessor: &Accessor, width: usize) -> Result<(), String> {
    let expected = match width {
        1 => "SCALAR",
        2 => "VEC2",
        3 => "VEC3",
        4 => "VEC4",
        _ => "MAT4",
    };
    if accessor.kind != expected {
        return Err(format!(
            "has the type {:.20}; allowed: {expected}",
            accessor.kind
        ));
    }
    if accessor.count > MAX_VERTICES {
        return Err(format!(
            "has {} elements; allowed: {MAX_VERTICES}; export less at once",
            accessor.count
        ));
    }
    Ok(())
}
