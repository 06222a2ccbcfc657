//! The imported model: its files in the scene's folder, and its box.

use std::fs;
use std::ops::RangeInclusive;
use std::path::{Component, Path, PathBuf};

use frame::{FileError, read_bounded, write_atomically};
use glam::DVec3;
use measure::{Error, named};
use scene::{Mesh, Scene, SceneError, limits::LARGEST_MESH_FILE, load_scene_and_files};

use crate::files::refuse;

/// Name of the folder of the model's files, in the scene's folder.
const FOLDER: &str = "model";

/// Key of an object with materials that light passes through.
pub const BLENDED: &str = "alpha = \"blended\"\n";

/// Radii of models that can be imported, in metres.
const RADII: RangeInclusive<f64> = 1e-6..=1e9;

named! {
    /// An axis that points up.
    pub enum Up {
        /// As in scenes.
        Y = "y",
        /// As in many CAD programs.
        Z = "z",
    }
}

/// A model in a scene's folder.
pub struct Model {
    /// The OBJ file, below the scene's folder, with slashes.
    pub mesh: String,
    /// Smallest and largest x, y and z with `up` pointing up, in metres.
    pub corners: [DVec3; 2],
    /// The axis of the file that points up.
    pub up: Up,
    /// True if light passes through some of its materials: their opacity is below 1.
    pub is_translucent: bool,
}

/// A model that has been loaded.
struct Loaded {
    mesh: Mesh,
    is_translucent: bool,
    /// The OBJ file and the files that it names.
    files: Vec<PathBuf>,
}

impl Model {
    /// Copies the OBJ file and the files that it names into the folder of a new scene.
    pub fn copy(path: &Path, plain: bool, up: Up, scene: &Path) -> Result<Self, Error> {
        let folder = scene.join(FOLDER);
        let path = (path.canonicalize()).map_err(|source| FileError::io(path, "read", source))?;
        let name = path.file_name().unwrap_or_default();
        let copy = folder.join(name);
        let loaded = if plain {
            write_plain(&path, &copy)?;
            // Line numbers are unchanged.
            load(scene, &copy).map_err(|error| SceneError {
                path: path.clone(),
                ..error
            })?
        } else {
            load(scene, &path).map_err(|error| suggest_plain(error, &path, scene))?
        };
        if !plain {
            copy_all(&loaded.files, &path, &folder)?;
        }
        let Some(name) = name.to_str() else {
            return refuse!(path, "the name is not Unicode; rename the file");
        };
        let upright = |p: DVec3| match up {
            Up::Y => p,
            Up::Z => DVec3::new(p.x, p.z, -p.y),
        };
        let mesh = &loaded.mesh;
        let vertices = mesh.triangles.iter().flatten();
        let used = vertices.map(|vertex| upright(mesh.positions[*vertex as usize].as_dvec3()));
        let model = Self {
            mesh: format!("{FOLDER}/{name}"),
            corners: [
                used.clone().fold(DVec3::INFINITY, DVec3::min),
                used.fold(DVec3::NEG_INFINITY, DVec3::max),
            ],
            up,
            is_translucent: loaded.is_translucent,
        };
        model.check_size(&path)?;
        Ok(model)
    }

    /// Refuses a model for which no stand, floor and camera can be made.
    fn check_size(&self, path: &Path) -> Result<(), Error> {
        let radius = self.radius();
        if RADII.contains(&radius) {
            return Ok(());
        }
        let [least, greatest] = [RADII.start(), RADII.end()];
        refuse!(
            path,
            "the model's radius is {radius:e} m; allowed: {least:e} to {greatest:e}; scale it"
        )
    }

    /// Returns half of the size along each axis, in metres.
    pub fn half_size(&self) -> DVec3 {
        let [low, high] = self.corners;
        0.5 * (high - low)
    }

    /// Returns the radius of the ball around the model's box, in metres.
    pub fn radius(&self) -> f64 {
        let DVec3 { x, y, z } = self.half_size();
        x.hypot(y).hypot(z)
    }
}

/// Loads the model as a scene of its own.
fn load(scene: &Path, obj: &Path) -> Result<Loaded, SceneError> {
    let (loaded, files) = load_with(scene, obj, "")?;
    let is_translucent = (loaded.materials.iter()).any(|material| material.opacity < 1.0);
    if is_translucent {
        // Materials that let light pass are checked further.
        load_with(scene, obj, BLENDED)?;
    }
    let mut meshes = loaded.meshes;
    Ok(Loaded {
        mesh: meshes.remove(0),
        is_translucent,
        files,
    })
}

/// Loads a scene of the model with more keys; returns it with the paths of the model's files.
fn load_with(scene: &Path, obj: &Path, keys: &str) -> Result<(Scene, Vec<PathBuf>), SceneError> {
    let document = scene.join("scene.toml");
    let text = format!(
        "exposes = \"the model\"\nfamily = \"limits\"\nexposure = 0.5\nsize = [1, 1]\n\
         [camera]\nposition = [0, 0, 0]\nlook_at = [0, 0, -1]\nvertical_fov = 40\n\
         [background]\nconstant = [1, 1, 1]\n[object.model]\nmesh = {}\n{keys}",
        toml::Value::from(obj.to_string_lossy().into_owned())
    );
    write_atomically(&document, text.as_bytes()).map_err(|error| SceneError {
        path: document.clone(),
        line: None,
        reason: error.to_string(),
    })?;
    let (scene, mut files) = load_scene_and_files(scene, None).map_err(|error| {
        if error.path == document {
            // The scene names the model and nothing else that could be wrong.
            SceneError {
                path: obj.to_owned(),
                line: None,
                ..error
            }
        } else {
            error
        }
    })?;
    files.retain(|file| *file != document);
    Ok((scene, files))
}

/// Adds to an error that the model can be imported without materials, if it can.
fn suggest_plain(error: SceneError, path: &Path, scene: &Path) -> SceneError {
    let copy = scene.join("plain.obj");
    let helps = write_plain(path, &copy).is_ok() && load(scene, &copy).is_ok();
    let _ = fs::remove_file(&copy);
    if helps {
        SceneError {
            reason: format!(
                "{}; or import the model plain: the shape alone, in grey",
                error.reason
            ),
            ..error
        }
    } else {
        error
    }
}

/// Copies an OBJ file line by line, without its materials.
fn write_plain(path: &Path, copy: &Path) -> Result<(), FileError> {
    let bytes = read_bounded(path, LARGEST_MESH_FILE)?;
    let mut plain = String::new();
    let text = String::from_utf8_lossy(&bytes);
    for line in text.trim_start_matches('\u{feff}').lines() {
        let is_left_out = matches!(line.split_whitespace().next(), Some("mtllib" | "usemtl"));
        plain += if is_left_out { "" } else { line };
        plain += "\n";
    }
    write_atomically(copy, plain.as_bytes())
}

/// Copies files to the same paths below `folder` as below the model's folder.
fn copy_all(files: &[PathBuf], model: &Path, folder: &Path) -> Result<(), Error> {
    let home = model.parent().unwrap_or(Path::new(""));
    for file in files {
        let below = file.strip_prefix(home).ok().filter(|below| {
            let mut parts = below.components();
            parts.all(|part| matches!(part, Component::Normal(_) | Component::CurDir))
        });
        let Some(below) = below else {
            return refuse!(
                model,
                "{} lies outside of the model's folder; move it there and mend the file that names it, or import the model \
                     plain: the shape alone, in grey",
                file.display()
            );
        };
        let bytes = fs::read(file).map_err(|source| FileError::io(file, "read", source))?;
        write_atomically(&folder.join(below), &bytes)?;
    }
    Ok(())
}
