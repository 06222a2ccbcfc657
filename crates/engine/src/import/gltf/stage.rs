//! The nodes of a file at any time: their places, their morph weights and their skins.

use glam::{DMat4, DQuat, DVec3};

use super::animation::{Animation, Part, quaternion};
use super::file::File;
use super::geometry::Meshes;
use super::schema;
use super::tree::Tree;

/// Joints of a skin, and the transforms from the mesh's space to each joint's.
#[derive(Debug)]
pub struct Skin {
    pub joints: Vec<usize>,
    pub inverse_bind: Vec<DMat4>,
}

/// Everything of a file that moves.
#[derive(Debug)]
pub struct Stage {
    pub file: File,
    pub tree: Tree,
    pub meshes: Meshes,
    pub animation: Animation,
    /// Skins, as many as the file has.
    pub skins: Vec<Skin>,
    /// Channels of each node, as indices into those of the animation.
    channels: Vec<Vec<usize>>,
    /// Places of nodes that do not move, and of the others without animation.
    still: Vec<DMat4>,
    /// True for nodes that move, by themselves or with a parent.
    pub is_moving: Vec<bool>,
}

impl Stage {
    /// Reads the meshes and skins of the nodes that are shown.
    pub fn read(file: File, tree: Tree, animation: Animation) -> Result<Self, String> {
        let nodes = &file.json.nodes;
        let mut meshes = Meshes::default();
        for node in &tree.shown {
            check_numbers(&nodes[*node]).map_err(|reason| format!("nodes[{node}] {reason}"))?;
            if let Some(mesh) = nodes[*node].mesh {
                meshes.read(&file, mesh)?;
            }
        }
        let skins = (0..file.json.skins.len()).map(|skin| read_skin(&file, skin));
        let skins: Vec<Skin> = skins.collect::<Result<_, String>>()?;
        let mut channels = vec![Vec::new(); nodes.len()];
        for (index, channel) in animation.channels.iter().enumerate() {
            channels[channel.node].push(index);
        }
        let mut stage = Self {
            still: vec![DMat4::IDENTITY; nodes.len()],
            is_moving: vec![false; nodes.len()],
            file,
            tree,
            meshes,
            animation,
            skins,
            channels,
        };
        for at in 0..stage.tree.order.len() {
            let node = stage.tree.order[at];
            let parent = stage.tree.parents[node];
            let above = parent.map_or(DMat4::IDENTITY, |parent| stage.still[parent]);
            stage.still[node] = above * stage.local(node, None);
            stage.is_moving[node] = parent.is_some_and(|parent| stage.is_moving[parent])
                || stage.channel_of(node, Part::Translation).is_some()
                || stage.channel_of(node, Part::Rotation).is_some()
                || stage.channel_of(node, Part::Scale).is_some();
        }
        stage.check_skins()?;
        Ok(stage)
    }

    fn channel_of(&self, node: usize, part: Part) -> Option<usize> {
        let mut channels = self.channels[node].iter().copied();
        channels.find(|channel| self.animation.channels[*channel].part == part)
    }

    /// Returns whether a node's morph weights are animated.
    pub fn is_morphing(&self, node: usize) -> bool {
        self.channel_of(node, Part::Weights).is_some()
    }

    /// Returns a node's transform to its parent's space, at a time or without animation.
    fn local(&self, node: usize, seconds: Option<f64>) -> DMat4 {
        let entry = &self.file.json.nodes[node];
        let value = |part: Part| -> Option<Vec<f64>> {
            let channel = self.channel_of(node, part)?;
            Some(self.animation.channels[channel].value(seconds?))
        };
        let (translation, rotation, scale) = (
            value(Part::Translation),
            value(Part::Rotation),
            value(Part::Scale),
        );
        if let (Some(matrix), None, None, None) = (&entry.matrix, &translation, &rotation, &scale) {
            return DMat4::from_cols_array(matrix);
        }
        let vector = |value: Option<Vec<f64>>, fixed: Option<[f64; 3]>, default: DVec3| {
            let animated = value.map(|value| DVec3::from_slice(&value));
            animated.or(fixed.map(DVec3::from)).unwrap_or(default)
        };
        let turn = match (rotation, entry.rotation) {
            (Some(value), _) => quaternion(&value),
            (None, Some(fixed)) => quaternion(&fixed),
            (None, None) => DQuat::IDENTITY,
        };
        DMat4::from_scale_rotation_translation(
            vector(scale, entry.scale, DVec3::ONE),
            turn,
            vector(translation, entry.translation, DVec3::ZERO),
        )
    }

    /// Returns a node's transform to the world at a time in seconds.
    pub fn world(&self, node: usize, seconds: f64) -> DMat4 {
        let mut world = DMat4::IDENTITY;
        let mut at = Some(node);
        while let Some(node) = at {
            if !self.is_moving[node] {
                return self.still[node] * world;
            }
            world = self.local(node, Some(seconds)) * world;
            at = self.tree.parents[node];
        }
        world
    }

    /// Returns the transforms of a skin's joints, from the mesh's space to the world.
    pub fn joints(&self, skin: usize, seconds: f64) -> Vec<DMat4> {
        let Skin {
            joints,
            inverse_bind,
        } = &self.skins[skin];
        let pairs = joints.iter().zip(inverse_bind);
        pairs
            .map(|(joint, inverse)| self.world(*joint, seconds) * *inverse)
            .collect()
    }

    /// Returns the weights of a node's morph targets; missing ones are 0.
    pub fn weights(&self, node: usize, seconds: f64) -> Vec<f64> {
        if let Some(channel) = self.channel_of(node, Part::Weights) {
            return self.animation.channels[channel].value(seconds);
        }
        let entry = &self.file.json.nodes[node];
        let mesh = entry.mesh.map(|mesh| &self.file.json.meshes[mesh]);
        let weights = entry.weights.as_ref();
        let weights = weights.or_else(|| mesh?.weights.as_ref());
        weights.map(|weights| weights.to_vec()).unwrap_or_default()
    }

    /// Refuses nodes whose skin is not there, and vertices that follow a joint that is not there.
    fn check_skins(&self) -> Result<(), String> {
        for node in &self.tree.shown {
            let entry = &self.file.json.nodes[*node];
            let (Some(skin), Some(mesh)) = (entry.skin, entry.mesh) else {
                continue;
            };
            let count = File::entry(&self.skins, "skins", skin)?.joints.len();
            let primitives = self.meshes.primitives[&mesh].iter();
            let mut joints = primitives.flat_map(|primitive| primitive.influences.iter().flatten());
            if let Some((joint, _)) = joints.find(|(joint, _)| *joint as usize >= count) {
                return Err(format!(
                    "meshes[{mesh}]: a vertex follows joint {joint}, and skins[{skin}] of nodes[{node}] has {count} joints; \
                     export the file again"
                ));
            }
        }
        Ok(())
    }
}

fn read_skin(file: &File, index: usize) -> Result<Skin, String> {
    let entry = &file.json.skins[index];
    for joint in &*entry.joints {
        File::entry(&file.json.nodes, "nodes", *joint)?;
    }
    let count = entry.joints.len();
    let inverse_bind = match entry.inverse_bind_matrices {
        None => vec![DMat4::IDENTITY; count],
        Some(accessor) => {
            let matrices = file.floats::<16>(accessor, "inverse bind matrices")?;
            let matrices = matrices
                .iter()
                .map(|matrix| DMat4::from_cols_array(&matrix.map(f64::from)));
            matrices.collect()
        }
    };
    if inverse_bind.len() < count {
        return Err(format!(
            "skins[{index}] has {count} joints and {} inverse bind matrices; allowed: one per joint; export the file again",
            inverse_bind.len()
        ));
    }
    Ok(Skin {
        joints: entry.joints.to_vec(),
        inverse_bind,
    })
}

/// Refuses places that are no numbers of a scene.
fn check_numbers(node: &schema::Node) -> Result<(), String> {
    let numbers = (node.matrix.iter().flatten())
        .chain(node.translation.iter().flatten())
        .chain(node.rotation.iter().flatten())
        .chain(node.scale.iter().flatten())
        .chain(node.weights.iter().flat_map(|weights| weights.iter()));
    let largest = scene::limits::LARGEST_NUMBER;
    for number in numbers {
        if number.abs() > largest {
            return Err(format!(
                "has the number {number:e} in its place or its weights; allowed: up to {largest:e}; scale the scene"
            ));
        }
    }
    Ok(())
}
