//! Pieces of a scene: the part of a node's mesh that becomes one object, and its path.

use glam::{DMat4, DQuat, DVec2, DVec3};

use super::geometry::Primitive;
use super::keys::Path;
use super::moment::{Mark, Moment};
use super::pose::{Placement, pose_positions};
use super::stage::Stage;
use super::view::{Camera, Film};

/// Largest part of a transform that may be shear, for a pose of turn and scale.
const SHEAR: f64 = 1e-6;

/// A part of a node's mesh.
#[derive(Clone, Debug)]
pub struct Piece {
    /// Name of the object.
    pub name: String,
    pub node: usize,
    pub mesh: usize,
    /// Primitives of the mesh.
    pub primitives: Vec<usize>,
    /// True if its materials let light through.
    pub is_blended: bool,
}

/// A pose without shear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    pub translation: DVec3,
    pub rotation: DQuat,
    pub scale: DVec3,
}

impl Pose {
    /// Splits a transform; returns none if it has shear or flattens.
    pub fn of(matrix: &DMat4) -> Option<Self> {
        let (scale, rotation, translation) = matrix.to_scale_rotation_translation();
        let pose = Self {
            translation,
            rotation,
            scale,
        };
        let is_usual = scale.is_finite() && rotation.is_finite() && scale.abs().min_element() > 0.0;
        let largest = scale.abs().max_element();
        let again = pose.matrix();
        let is_same = [
            again.x_axis - matrix.x_axis,
            again.y_axis - matrix.y_axis,
            again.z_axis - matrix.z_axis,
        ]
        .iter()
        .all(|off| off.length() <= SHEAR * largest);
        (is_usual && is_same).then_some(pose)
    }

    pub fn matrix(&self) -> DMat4 {
        DMat4::from_scale_rotation_translation(self.scale, self.rotation, self.translation)
    }
}

impl Piece {
    /// Lists the primitives of the piece.
    pub fn primitives<'a>(&self, stage: &'a Stage) -> Vec<&'a Primitive> {
        let mesh = &stage.meshes.primitives[&self.mesh];
        self.primitives.iter().map(|index| &mesh[*index]).collect()
    }

    /// Returns the skin, if vertices follow its joints.
    fn skin(&self, stage: &Stage) -> Option<usize> {
        let skin = stage.file.json.nodes[self.node].skin?;
        let primitives = self.primitives(stage);
        primitives
            .iter()
            .all(|primitive| !primitive.influences.is_empty())
            .then_some(skin)
    }

    /// Returns whether vertices move against one another.
    pub fn is_deforming(&self, stage: &Stage, marks: &[Mark]) -> bool {
        if let Some(skin) = self.skin(stage) {
            let mut joints = stage.skins[skin].joints.iter();
            return stage.is_morphing(self.node) || joints.any(|joint| stage.is_moving[*joint]);
        }
        let is_sheared =
            |mark: &Mark| Pose::of(&stage.world(self.node, mark.moment.seconds)).is_none();
        stage.is_morphing(self.node) || stage.is_moving[self.node] && marks.iter().any(is_sheared)
    }

    /// Returns the way of the mesh into the world.
    pub fn placement(&self, stage: &Stage, seconds: f64) -> Placement {
        match self.skin(stage) {
            Some(skin) => Placement::Joints(stage.joints(skin, seconds)),
            None => Placement::Whole(stage.world(self.node, seconds)),
        }
    }

    /// Returns the vertices in the world.
    pub fn positions(&self, stage: &Stage, seconds: f64) -> Vec<DVec3> {
        let (placement, weights) = (
            self.placement(stage, seconds),
            stage.weights(self.node, seconds),
        );
        let primitives = self.primitives(stage).into_iter();
        primitives
            .flat_map(|primitive| pose_positions(primitive, &weights, &placement))
            .collect()
    }

    /// Returns whether the whole piece moves by poses that scenes have.
    pub fn is_posed(&self, stage: &Stage, moment: Moment) -> bool {
        self.skin(stage).is_none() && Pose::of(&stage.world(self.node, moment.seconds)).is_some()
    }
}

/// The path of a piece that keeps its shape.
pub struct RigidPath<'a> {
    pub stage: &'a Stage,
    pub node: usize,
    pub film: Film,
    pub camera: Camera,
    /// In the mesh's space.
    pub points: Vec<DVec3>,
}

impl Path for RigidPath<'_> {
    type Key = Pose;

    fn key(&self, moment: Moment) -> Pose {
        let world = self.stage.world(self.node, moment.seconds);
        Pose::of(&world).unwrap_or(Pose {
            // Between keys, a shear comes and goes; the measure of straying shows it.
            translation: world.w_axis.truncate(),
            rotation: DQuat::IDENTITY,
            scale: DVec3::ONE,
        })
    }

    fn mix(&self, [from, to]: [&Pose; 2], part: f64) -> Pose {
        Pose {
            translation: from.translation.lerp(to.translation, part),
            rotation: from.rotation.slerp(to.rotation, part),
            scale: from.scale.lerp(to.scale, part),
        }
    }

    fn pixels(&self, pose: &Pose, moment: Moment) -> Vec<Option<DVec2>> {
        let view = self.camera.view(self.stage, moment);
        let matrix = pose.matrix();
        let points = self.points.iter();
        points
            .map(|point| self.film.pixel(&view, matrix.transform_point3(*point)))
            .collect()
    }
}

/// The path of a piece that changes its shape.
pub struct ShapePath<'a> {
    pub stage: &'a Stage,
    pub piece: &'a Piece,
    pub film: Film,
    pub camera: Camera,
}

impl Path for ShapePath<'_> {
    type Key = Vec<DVec3>;

    fn key(&self, moment: Moment) -> Vec<DVec3> {
        self.piece.positions(self.stage, moment.seconds)
    }

    fn mix(&self, [from, to]: [&Vec<DVec3>; 2], part: f64) -> Vec<DVec3> {
        let pairs = from.iter().zip(to);
        pairs.map(|(from, to)| from.lerp(*to, part)).collect()
    }

    fn pixels(&self, positions: &Vec<DVec3>, moment: Moment) -> Vec<Option<DVec2>> {
        let view = self.camera.view(self.stage, moment);
        let positions = positions.iter();
        positions
            .map(|position| self.film.pixel(&view, *position))
            .collect()
    }
}
