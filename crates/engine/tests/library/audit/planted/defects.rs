//! Defects of motion vectors that people report, planted into an engine.

use glam::{DAffine3, DVec3};
use scene::{Parent, Scene};

use super::wrong_engine::{Draw, LAST, THIS, WrongEngine, shape_at};
use super::{DrawnScene, id_of};

/// Jitter of the last frame and of this one, in pixels: two places of a Halton sequence.
const JITTER: [[f64; 2]; 2] = [[-0.25, 0.056], [0.125, -0.389]];
/// Bias of one object, in pixels: more than jitter.
const BIAS: [f64; 2] = [2.4, -1.6];
/// Way of a teleported object, relative to its distance.
const WAY: DVec3 = DVec3::new(0.11, 0.05, -0.07);

/// A scene and the objects whose vectors go wrong.
pub struct Case<'a> {
    /// Name in the table.
    pub name: &'static str,
    /// Scene in a size in which every object has pixels enough.
    pub drawn: &'a DrawnScene<'a>,
    /// Object of defects of one object.
    pub target: &'static str,
    /// Object whose previous matrix it takes.
    pub donor: &'static str,
}

/// A defect that people report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlantedDefect {
    DeformationMissing,
    RestPose,
    OwnMotionMissing,
    ObjectMotionMissing,
    CameraMissing,
    TodaysViewProjection,
    CameraTurnAlone,
    MatrixOfAnother,
    InstancesShareMatrix,
    JitterInOnePass,
    JitterLeftIn,
    JitterTwice,
    Bias,
    ZoomMissing,
    Teleport,
    MatrixNeverSet,
    FrameLate,
    TwoFrames,
}

impl PlantedDefect {
    /// All of them.
    pub const ALL: [Self; 18] = [
        Self::DeformationMissing,
        Self::RestPose,
        Self::OwnMotionMissing,
        Self::ObjectMotionMissing,
        Self::CameraMissing,
        Self::TodaysViewProjection,
        Self::CameraTurnAlone,
        Self::MatrixOfAnother,
        Self::InstancesShareMatrix,
        Self::JitterInOnePass,
        Self::JitterLeftIn,
        Self::JitterTwice,
        Self::Bias,
        Self::ZoomMissing,
        Self::Teleport,
        Self::MatrixNeverSet,
        Self::FrameLate,
        Self::TwoFrames,
    ];

    /// What the engine does.
    pub fn sentence(self) -> &'static str {
        match self {
            Self::DeformationMissing => "a deforming mesh is projected with today's vertices",
            Self::RestPose => "a deforming mesh comes from its rest pose",
            Self::OwnMotionMissing => "a child has its parent's motion alone",
            Self::ObjectMotionMissing => "an object has the camera's motion alone",
            Self::CameraMissing => "the camera stands still",
            Self::TodaysViewProjection => "one object takes today's view and projection twice",
            Self::CameraTurnAlone => "objects are not drawn, and have the background's vectors",
            Self::MatrixOfAnother => "an object comes from another one's matrix",
            Self::InstancesShareMatrix => "instances come from the first one's matrix",
            Self::JitterInOnePass => "jitter is left in in the pass of one object",
            Self::JitterLeftIn => "jitter of both frames is left in",
            Self::JitterTwice => "jitter is removed twice",
            Self::Bias => "one object has a constant bias",
            Self::ZoomMissing => "today's projection serves both frames",
            Self::Teleport => "an object comes from elsewhere",
            Self::MatrixNeverSet => "the last matrix of an object is the identity",
            Self::FrameLate => "an object's matrices and vertices are one frame late",
            Self::TwoFrames => "all comes from two frames ago",
        }
    }

    /// Words that name it: one is enough.
    pub fn words(self) -> &'static [&'static str] {
        match self {
            Self::DeformationMissing => &["lacks the deformation"],
            Self::RestPose => &["comes from the rest pose"],
            Self::OwnMotionMissing => &["lacks its own motion"],
            Self::ObjectMotionMissing => &["lacks its motion", "lacks its own motion"],
            Self::CameraMissing => &["lacks the motion of the camera"],
            Self::TodaysViewProjection => &["lacks the motion of the camera"],
            Self::CameraTurnAlone => &["the camera's turn alone"],
            Self::MatrixOfAnother | Self::InstancesShareMatrix => {
                &["comes from the last matrix of `"]
            }
            Self::JitterInOnePass => &["jitter in the pass that draws it"],
            Self::JitterLeftIn => &["jitter is left in", "jitter in the pass that draws it"],
            Self::JitterTwice => &["removed twice"],
            Self::Bias => &["bias"],
            Self::ZoomMissing => &["lacks the zoom"],
            Self::Teleport => &["comes from elsewhere"],
            Self::MatrixNeverSet => &["never set"],
            Self::FrameLate => &["one frame late"],
            Self::TwoFrames => &["two frames ago"],
        }
    }

    /// Makes the engine wrong, and returns the ids of the wrong draws; none if the scene has
    /// nothing that can go wrong so.
    pub fn plant(self, engine: &mut WrongEngine, case: &Case) -> Option<Vec<usize>> {
        let scene = engine.scene;
        let target = id_of(scene, case.target) as usize;
        let everything: Vec<usize> = (0..engine.draws.len()).collect();
        let object = &scene.objects[target - 1];
        let deforms = scene.meshes[object.mesh].deforms();
        let wrong = match self {
            Self::DeformationMissing | Self::RestPose if !deforms => return None,
            Self::OwnMotionMissing if object.parent == Parent::World => return None,
            Self::ZoomMissing if scene.camera.vertical_fov.len() < 2 => return None,
            Self::CameraTurnAlone if !turns_and_moves(scene) => return None,
            Self::CameraTurnAlone => everything[1..].to_vec(),
            Self::MatrixOfAnother if case.donor.is_empty() => return None,
            Self::InstancesShareMatrix => instances(scene, target)?,
            Self::CameraMissing
            | Self::JitterLeftIn
            | Self::JitterTwice
            | Self::ZoomMissing
            | Self::TwoFrames => everything,
            _ => vec![target],
        };
        let memory = Memory::of(engine, case, self);
        for id in &wrong {
            self.change(&mut engine.draws[*id], *id, &memory, scene);
        }
        Some(wrong)
    }

    /// Changes what a draw call remembers.
    fn change(self, draw: &mut Draw, id: usize, memory: &Memory, scene: &Scene) {
        let object = id.checked_sub(1);
        let shape = |time: f64| object.map_or(Vec::new(), |at| shape_at(scene, at, time));
        let matrix =
            |time: f64| object.map_or(DAffine3::IDENTITY, |at| scene.object_to_world(at, time));
        match self {
            Self::DeformationMissing => draw.shapes[LAST] = shape(0.0),
            Self::RestPose => draw.shapes[LAST] = shape(memory.first_shape),
            Self::OwnMotionMissing => {
                draw.shapes[LAST] = shape(0.0);
                let at = id - 1;
                draw.matrices[LAST] = scene.object_to_world_within(at, 0.0, -1.0);
            }
            Self::ObjectMotionMissing => {
                draw.shapes[LAST] = shape(0.0);
                draw.matrices[LAST] = matrix(0.0);
            }
            Self::CameraMissing | Self::TodaysViewProjection => {
                draw.cameras[LAST] = draw.cameras[THIS];
                draw.fields_of_view[LAST] = draw.fields_of_view[THIS];
            }
            Self::CameraTurnAlone => {
                draw.shapes[LAST] = shape(0.0);
                draw.matrices[LAST] = matrix(0.0);
                draw.cameras[LAST].translation = draw.cameras[THIS].translation;
            }
            Self::MatrixOfAnother | Self::InstancesShareMatrix => {
                draw.matrices[LAST] = memory.matrix;
            }
            Self::JitterInOnePass | Self::JitterLeftIn => draw.jitter = JITTER,
            Self::JitterTwice => draw.jitter = JITTER.map(|places| places.map(|place| -place)),
            Self::Bias => draw.jitter[THIS] = BIAS,
            Self::ZoomMissing => draw.fields_of_view[LAST] = draw.fields_of_view[THIS],
            Self::Teleport => draw.matrices[LAST].translation += memory.way,
            Self::MatrixNeverSet => draw.matrices[LAST] = DAffine3::IDENTITY,
            Self::FrameLate => {
                draw.shapes = [shape(-2.0), shape(-1.0)];
                draw.matrices = [matrix(-2.0), matrix(-1.0)];
            }
            Self::TwoFrames => {
                draw.shapes[LAST] = shape(-2.0);
                draw.matrices[LAST] = matrix(-2.0);
                draw.cameras[LAST] = scene.camera.motion.at(-2.0);
                draw.fields_of_view[LAST] = scene.camera.vertical_fov_at(-2.0);
            }
        }
    }
}

/// Returns whether the background's vectors differ from right ones and from none.
fn turns_and_moves(scene: &Scene) -> bool {
    let [before, now] = [-1.0, 0.0].map(|time| scene.camera.motion.at(time));
    before.matrix3 != now.matrix3 && before.translation != now.translation
}

/// What an engine takes for an object's own.
struct Memory {
    /// Last matrix of another object: the donor's, or the first instance's.
    matrix: DAffine3,
    /// Time of the target's first shape.
    first_shape: f64,
    /// Way of a teleport in metres.
    way: DVec3,
}

impl Memory {
    fn of(engine: &WrongEngine, case: &Case, defect: PlantedDefect) -> Self {
        let scene = engine.scene;
        let id = |name| id_of(scene, name) as usize;
        let target = id(case.target);
        let mesh = |id: usize| scene.objects[id - 1].mesh;
        let first = (1..engine.draws.len()).find(|id| mesh(*id) == mesh(target));
        let other = match defect {
            PlantedDefect::MatrixOfAnother => id(case.donor),
            _ => first.unwrap_or(target),
        };
        let draw = &engine.draws[target];
        let distance = (draw.matrices[THIS].translation).distance(draw.cameras[THIS].translation);
        Self {
            matrix: engine.draws[other].matrices[LAST],
            first_shape: scene.meshes[mesh(target)]
                .shape_times()
                .next()
                .unwrap_or(0.0),
            way: distance.max(1.0) * WAY,
        }
    }
}

/// Ids of the target's further instances; none without any.
fn instances(scene: &Scene, target: usize) -> Option<Vec<usize>> {
    let mesh = scene.objects[target - 1].mesh;
    let same = (scene.objects.iter().enumerate()).filter(|(_, object)| object.mesh == mesh);
    let further: Vec<usize> = same.skip(1).map(|(at, _)| at + 1).collect();
    (!further.is_empty()).then_some(further)
}
