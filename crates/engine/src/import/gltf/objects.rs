//! Objects of a scene: their OBJ files, and their tables in scene.toml.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

use frame::write_atomically;
use glam::{DMat4, DVec3};
use measure::Error;

use super::keys::{Keys, Tolerance, find_keys};
use super::look::Look;
use super::moment::{Clip, Mark};
use super::obj::obj_text;
use super::piece::{Piece, Pose, RigidPath, ShapePath};
use super::pose::{Placement, pose_positions};
use super::stage::Stage;
use super::view::{Camera, Film};

/// Folder of the model's files, in the scene's folder.
pub const FOLDER: &str = "model";

/// Most vertices of all key shapes of a scene together; one takes about 100 bytes of text.
const MAX_SHAPE_VERTICES: usize = 30_000_000;

/// Part of the tolerance that the camera's keys do not use: a tenth of a pixel together.
const TOLERANCE: Tolerance = Tolerance {
    stray: 0.08,
    velocity: 0.08,
};

/// What objects are written from.
pub struct Shot<'a> {
    pub stage: &'a Stage,
    pub clip: Clip,
    pub marks: Vec<Mark>,
    pub film: Film,
    pub camera: Camera,
}

/// Objects written so far.
#[derive(Default)]
pub struct Objects {
    /// Tables of scene.toml.
    pub toml: String,
    pub rigid: usize,
    pub deforming: usize,
    /// Key shapes of all objects together.
    pub shapes: usize,
    /// Farthest that a vertex strays, in pixels.
    pub stray: f64,
    pub is_turning: bool,
    pub is_moving: bool,
    /// OBJ files of pieces that keep their shape, by what they hold.
    known: BTreeMap<(usize, Vec<usize>, Vec<u64>), String>,
    shape_vertices: usize,
}

impl Objects {
    /// Writes a piece, whose primitives look like `looks`.
    pub fn push(
        &mut self,
        shot: &Shot,
        piece: &Piece,
        looks: &[Look],
        folder: &Path,
    ) -> Result<(), Error> {
        writeln!(self.toml, "\n[object.{}]", piece.name).expect("text takes text");
        if piece.is_blended {
            self.toml += "alpha = \"blended\"\n";
        }
        if piece.is_deforming(shot.stage, &shot.marks) {
            self.push_shapes(shot, piece, looks, folder)
        } else if piece.is_posed(shot.stage, shot.clip.moment(0.0)) {
            self.push_rigid(shot, piece, looks, folder)
        } else {
            let mesh = format!("{FOLDER}/{}.obj", piece.name);
            let moment = shot.clip.moment(0.0);
            write_piece(
                shot.stage,
                piece,
                looks,
                moment.seconds,
                &folder.join(&mesh),
            )?;
            self.toml += &format!("mesh = \"{mesh}\"\n");
            self.rigid += 1;
            Ok(())
        }
    }

    fn push_rigid(
        &mut self,
        shot: &Shot,
        piece: &Piece,
        looks: &[Look],
        folder: &Path,
    ) -> Result<(), Error> {
        let stage = shot.stage;
        let moment = shot.clip.moment(0.0);
        let weights = stage.weights(piece.node, moment.seconds);
        let bits = weights.iter().map(|weight| weight.to_bits());
        let key = (piece.mesh, piece.primitives.clone(), bits.collect());
        let whole = Placement::Whole(DMat4::IDENTITY);
        let primitives = piece.primitives(stage);
        if !self.known.contains_key(&key) {
            let mesh = format!("{FOLDER}/{}.obj", piece.name);
            let dressed: Vec<_> = primitives
                .iter()
                .copied()
                .zip(looks.iter().cloned())
                .collect();
            let text = obj_text(&dressed, &weights, &whole);
            write_atomically(&folder.join(&mesh), text.as_bytes())?;
            self.known.insert(key.clone(), mesh);
        }
        self.toml += &format!("mesh = \"{}\"\n", self.known[&key]);
        let path = RigidPath {
            stage,
            node: piece.node,
            film: shot.film,
            camera: shot.camera,
            points: (primitives.iter())
                .flat_map(|primitive| pose_positions(primitive, &weights, &whole))
                .collect(),
        };
        let keys = if stage.is_moving[piece.node] {
            self.find(&path, piece, shot)?
        } else {
            let pose = Pose::of(&stage.world(piece.node, moment.seconds));
            Keys::still(moment, pose.expect("a piece that is posed"))
        };
        self.write_poses(&keys);
        self.rigid += 1;
        Ok(())
    }

    fn find<P: super::keys::Path>(
        &mut self,
        path: &P,
        piece: &Piece,
        shot: &Shot,
    ) -> Result<Keys<P::Key>, Error> {
        let keys = find_keys(path, &shot.marks, TOLERANCE);
        let keys =
            keys.map_err(|reason| Error::Refused(format!("object {} {reason}", piece.name)))?;
        self.stray = self.stray.max(keys.stray);
        Ok(keys)
    }

    fn write_poses(&mut self, keys: &Keys<Pose>) {
        let first = keys.list[0].1;
        let moved = keys.list.iter().any(|(_, pose)| *pose != first);
        self.is_moving |= moved;
        if !moved {
            let words = pose_words(&first);
            self.toml += &(words.join("\n") + "\n");
            return;
        }
        self.is_turning |= keys
            .list
            .iter()
            .any(|(_, pose)| pose.rotation.dot(first.rotation).abs() < 0.9999);
        self.toml += "keys = [\n";
        for (moment, pose) in &keys.list {
            let words = pose_words(pose).join(", ");
            writeln!(self.toml, "    {{ time = {:?}, {words} }},", moment.frame)
                .expect("text takes text");
        }
        self.toml += "]\n";
    }

    fn push_shapes(
        &mut self,
        shot: &Shot,
        piece: &Piece,
        looks: &[Look],
        folder: &Path,
    ) -> Result<(), Error> {
        let path = ShapePath {
            stage: shot.stage,
            piece,
            film: shot.film,
            camera: shot.camera,
        };
        let keys = self.find(&path, piece, shot)?;
        self.shape_vertices += keys.list.len() * keys.list[0].1.len();
        if self.shape_vertices > MAX_SHAPE_VERTICES {
            return Err(Error::Refused(format!(
                "object {}: {} key shapes of {} vertices make {} vertices with those before; allowed: {MAX_SHAPE_VERTICES}; \
                 raise --fps, import fewer frames, or simplify the mesh",
                piece.name,
                keys.list.len(),
                keys.list[0].1.len(),
                self.shape_vertices
            )));
        }
        self.toml += "shapes = [\n";
        for (number, (moment, _)) in keys.list.iter().enumerate() {
            let mesh = format!("{FOLDER}/{}_{number:03}.obj", piece.name);
            write_piece(
                shot.stage,
                piece,
                looks,
                moment.seconds,
                &folder.join(&mesh),
            )?;
            writeln!(
                self.toml,
                "    {{ time = {:?}, mesh = \"{mesh}\" }},",
                moment.frame
            )
            .expect("text takes text");
        }
        self.toml += "]\n";
        self.is_moving = true;
        self.deforming += 1;
        self.shapes += keys.list.len();
        Ok(())
    }
}

/// Writes a piece in the world at a time.
fn write_piece(
    stage: &Stage,
    piece: &Piece,
    looks: &[Look],
    seconds: f64,
    path: &Path,
) -> Result<(), Error> {
    let primitives = piece.primitives(stage).into_iter();
    let dressed: Vec<_> = primitives.zip(looks.iter().cloned()).collect();
    let weights = stage.weights(piece.node, seconds);
    let text = obj_text(&dressed, &weights, &piece.placement(stage, seconds));
    Ok(write_atomically(path, text.as_bytes())?)
}

/// Writes the parts of a pose that are not those of rest.
fn pose_words(pose: &Pose) -> Vec<String> {
    let [x, y, z, w] = pose.rotation.to_array();
    let mut words = vec![format!("translation = {}", vector_text(pose.translation))];
    if w.abs() < 1.0 {
        words.push(format!("rotation = [{x:?}, {y:?}, {z:?}, {w:?}]"));
    }
    if pose.scale != DVec3::ONE {
        words.push(format!("scale = {}", vector_text(pose.scale)));
    }
    words
}

pub fn vector_text(vector: DVec3) -> String {
    let DVec3 { x, y, z } = vector;
    format!("[{x:?}, {y:?}, {z:?}]")
}
