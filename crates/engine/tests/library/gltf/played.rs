//! A player of exported scenes, written from the specification of glTF 2.0, for documents read by
//! the crate `gltf`.

use std::path::Path;

use glam::{DAffine3, DQuat, DVec3, DVec4};
use gltf::animation::{Interpolation, Property};
use gltf::{Gltf, Node};

/// An exported scene.
pub struct Played {
    document: Gltf,
    buffer: Vec<u8>,
    /// True for turns by components, as in Blender; false for turns at a constant angular velocity,
    /// as the format demands.
    by_components: bool,
}

/// Keys of one channel.
struct Keys {
    times: Vec<f64>,
    /// Numbers, as many per key as the property has; three times as many for cubic curves.
    values: Vec<f64>,
    interpolation: Interpolation,
}

impl Played {
    pub fn read(folder: &Path) -> Self {
        let text = std::fs::read(folder.join("scene.gltf")).unwrap();
        // Refuses what the format does not allow: indices beyond the end, missing limits, unknown
        // words.
        let document = Gltf::from_slice(&text).unwrap_or_else(|error| panic!("{error}"));
        Self {
            document,
            buffer: std::fs::read(folder.join("scene.bin")).unwrap(),
            by_components: false,
        }
    }

    /// Interpolates the components of quaternions one by one.
    pub fn by_components(self) -> Self {
        Self {
            by_components: true,
            ..self
        }
    }

    /// Returns the node with a number.
    pub fn node(&self, index: usize) -> Node<'_> {
        self.document.nodes().nth(index).expect("a node")
    }

    /// Returns whether a material cuts its texture's transparent parts out.
    pub fn has_holes(&self, material: &str) -> bool {
        let entry = (self.document.materials()).find(|entry| entry.name() == Some(material));
        entry.expect("a material of this name").alpha_mode() == gltf::material::AlphaMode::Mask
    }

    /// Returns the transform from a node's space to the world at a time in seconds.
    pub fn to_world(&self, node: usize, seconds: f64) -> DAffine3 {
        let local = self.pose(node, seconds);
        let is_parent = |other: &Node| other.children().any(|child| child.index() == node);
        match self.document.nodes().find(is_parent) {
            Some(parent) => self.to_world(parent.index(), seconds) * local,
            None => local,
        }
    }

    /// Returns the weights of a node's morph targets.
    pub fn weights(&self, node: usize, seconds: f64) -> Vec<f64> {
        let mesh = self.node(node).mesh().expect("a node with a mesh");
        let still = mesh.weights().unwrap_or_default();
        match self.keys(node, Property::MorphTargetWeights) {
            Some(keys) => keys.at(seconds, still.len(), false),
            None => still.iter().copied().map(f64::from).collect(),
        }
    }

    /// Returns the corners of all triangles of a node's mesh, in its space, with their morph
    /// targets.
    pub fn corners(&self, node: usize, seconds: f64) -> Vec<DVec3> {
        let mesh = self.node(node).mesh().expect("a node with a mesh");
        let weights = self.weights(node, seconds);
        let mut corners = Vec::new();
        for primitive in mesh.primitives() {
            let reader = primitive.reader(|_| Some(&self.buffer));
            let mut positions: Vec<DVec3> = (reader.read_positions().expect("positions"))
                .map(|position| glam::Vec3::from(position).as_dvec3())
                .collect();
            for ((moves, _, _), weight) in reader.read_morph_targets().zip(&weights) {
                for (position, by) in positions.iter_mut().zip(moves.expect("moved positions")) {
                    *position += *weight * glam::Vec3::from(by).as_dvec3();
                }
            }
            let indices = reader.read_indices().expect("indices").into_u32();
            corners.extend(indices.map(|index| positions[index as usize]));
        }
        corners
    }

    fn pose(&self, node: usize, seconds: f64) -> DAffine3 {
        let (translation, rotation, scale) = self.node(node).transform().decomposed();
        let vector = |property: Property, still: [f32; 3]| match self.keys(node, property) {
            Some(keys) => DVec3::from_slice(&keys.at(seconds, 3, false)),
            None => glam::Vec3::from(still).as_dvec3(),
        };
        let rotation = match self.keys(node, Property::Rotation) {
            Some(keys) => DVec4::from_slice(&keys.at(seconds, 4, !self.by_components)),
            None => glam::Vec4::from(rotation).as_dvec4(),
        };
        DAffine3::from_scale_rotation_translation(
            vector(Property::Scale, scale),
            DQuat::from_vec4(rotation).normalize(),
            vector(Property::Translation, translation),
        )
    }

    fn keys(&self, node: usize, property: Property) -> Option<Keys> {
        let mut channels = (self.document.animations()).flat_map(|animation| animation.channels());
        let channel = channels.find(|channel| {
            channel.target().node().index() == node && channel.target().property() == property
        })?;
        let sampler = channel.sampler();
        Some(Keys {
            times: self.floats(&sampler.input()),
            values: self.floats(&sampler.output()),
            interpolation: sampler.interpolation(),
        })
    }

    fn floats(&self, accessor: &gltf::Accessor) -> Vec<f64> {
        let view = accessor.view().expect("no sparse accessors");
        let count = accessor.count() * accessor.dimensions().multiplicity();
        let start = view.offset() + accessor.offset();
        (self.buffer[start..start + 4 * count].chunks(4))
            .map(|bytes| f64::from(f32::from_le_bytes(bytes.try_into().unwrap())))
            .collect()
    }
}

impl Keys {
    /// Appendix C of the specification: clamped at both ends; linear, spherical for rotations, or
    /// cubic Hermite curves.
    fn at(&self, seconds: f64, parts: usize, is_rotation: bool) -> Vec<f64> {
        let last = self.times.len() - 1;
        let seconds = seconds.clamp(self.times[0], self.times[last]);
        let after = self.times.partition_point(|time| *time <= seconds);
        let after = after.clamp(1, last.max(1)).min(last);
        let before = after.saturating_sub(1);
        let duration = self.times[after] - self.times[before];
        let part = if duration > 0.0 {
            (seconds - self.times[before]) / duration
        } else {
            0.0
        };
        let vector = |key: usize, which: usize, of: usize| {
            let start = (key * of + which) * parts;
            &self.values[start..start + parts]
        };
        match self.interpolation {
            Interpolation::Step => vector(before, 0, 1).to_vec(),
            Interpolation::Linear if is_rotation => {
                let [from, to] = [before, after].map(|key| DQuat::from_slice(vector(key, 0, 1)));
                from.slerp(to, part).to_array().to_vec()
            }
            Interpolation::Linear => {
                let ends = vector(before, 0, 1).iter().zip(vector(after, 0, 1));
                ends.map(|(from, to)| from + (to - from) * part).collect()
            }
            Interpolation::CubicSpline => {
                let (squared, cubed) = (part * part, part * part * part);
                let curve = |at: usize| {
                    let [from, to] = [before, after].map(|key| vector(key, 1, 3)[at]);
                    let [out, into] = [vector(before, 2, 3)[at], vector(after, 0, 3)[at]];
                    (2.0 * cubed - 3.0 * squared + 1.0) * from
                        + duration * (cubed - 2.0 * squared + part) * out
                        + (-2.0 * cubed + 3.0 * squared) * to
                        + duration * (cubed - squared) * into
                };
                (0..parts).map(curve).collect()
            }
        }
    }
}
