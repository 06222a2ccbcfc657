//! The imported model: its files in the scene's folder, and its box.

use std::fs;
use std::ops::RangeInclusive;
use std::path::{Component, Path, PathBuf};

use frame::{FileError, read_bounded, write_atomically};
use suite::{Error, named};
use tracer::limits::LARGEST_MESH_FILE;
use tracer::{SceneError, load_scene_and_files};

use crate::files::refuse;

/// Name of the folder of the model's files, in the scene's folder.
const FOLDER: &str = "model";

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
    /// Smallest and largest x, y and z once `up` points up, in metres.
    pub corners: [[f64; 3]; 2],
    /// The axis of the file that points up.
    pub up: Up,
}

impl Model {
    /// Copies the OBJ file and what it names into the folder of a new scene.
    pub fn copy(path: &Path, plain: bool, up: Up, scene: &Path) -> Result<Self, Error> {
        let folder = scene.join(FOLDER);
        let path = (path.canonicalize()).map_err(|source| FileError::io(path, "read", source))?;
        let name = path.file_name().unwrap_or_default();
        let copy = folder.join(name);
        let loaded = match plain {
            true => {
                write_plain(&path, &copy)?;
                // Lines are where they were.
                load(scene, &copy).map_err(|error| SceneError {
                    path: path.clone(),
                    ..error
                })?
            }
            false => {
                let loaded =
                    load(scene, &path).map_err(|error| suggest_plain(error, &path, scene))?;
                copy_all(&loaded.files, &path, &folder)?;
                loaded
            }
        };
        let Some(name) = name.to_str() else {
            return refuse(&path, "the name is not Unicode; rename the file");
        };
        let upright = |p: [f64; 3]| match up {
            Up::Y => p,
            Up::Z => [p[0], p[2], -p[1]],
        };
        let mut corners = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for position in loaded.positions.into_iter().map(upright) {
            for axis in 0..3 {
                corners[0][axis] = corners[0][axis].min(position[axis]);
                corners[1][axis] = corners[1][axis].max(position[axis]);
            }
        }
        let model = Self {
            mesh: format!("{FOLDER}/{name}"),
            corners,
            up,
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
        refuse(
            path,
            &format!(
                "the model's radius is {radius:e} m; allowed: {least:e} to {greatest:e}; scale it"
            ),
        )
    }

    /// Returns half of the size along each axis, in metres.
    pub fn half_size(&self) -> [f64; 3] {
        let [low, high] = self.corners;
        std::array::from_fn(|axis| 0.5 * (high[axis] - low[axis]))
    }

    /// Returns the radius of the ball around the model's box, in metres.
    pub fn radius(&self) -> f64 {
        let [x, y, z] = self.half_size();
        x.hypot(y).hypot(z)
    }
}

/// Contents of a scene with nothing but the model.
struct LoadedModel {
    /// Positions of the triangles' corners, in metres.
    positions: Vec<[f64; 3]>,
    /// The OBJ file and what it names.
    files: Vec<PathBuf>,
}

/// Loads the model as a scene of its own.
fn load(scene: &Path, obj: &Path) -> Result<LoadedModel, SceneError> {
    let document = scene.join("scene.toml");
    let text = format!(
        "exposes = \"the model\"\nfamily = \"limits\"\nexposure = 0.5\nsize = [1, 1]\n\
         [camera]\nposition = [0, 0, 0]\nlook_at = [0, 0, -1]\nvertical_fov = 40\n\
         [background]\nconstant = [1, 1, 1]\n[object.model]\nmesh = {}\n",
        toml::Value::from(obj.to_string_lossy().into_owned())
    );
    write_atomically(&document, text.as_bytes()).map_err(|error| SceneError {
        path: document.clone(),
        line: None,
        reason: error.to_string(),
    })?;
    let (scene, files) =
        load_scene_and_files(scene, None).map_err(|error| match error.path == document {
            // It names the model and nothing else that could be wrong.
            true => SceneError {
                path: obj.to_owned(),
                line: None,
                ..error
            },
            false => error,
        })?;
    let mesh = &scene.meshes[0];
    let corners = mesh.triangles.iter().flatten();
    Ok(LoadedModel {
        positions: corners
            .map(|index| mesh.positions[*index as usize].as_dvec3().to_array())
            .collect(),
        files: files.into_iter().filter(|file| *file != document).collect(),
    })
}

/// Adds to an error that the model can be imported without materials, if it can.
fn suggest_plain(error: SceneError, path: &Path, scene: &Path) -> SceneError {
    let copy = scene.join("plain.obj");
    let helps = write_plain(path, &copy).is_ok() && load(scene, &copy).is_ok();
    let _ = fs::remove_file(&copy);
    match helps {
        true => SceneError {
            reason: format!(
                "{}; or import the model plain: the shape alone, in grey",
                error.reason
            ),
            ..error
        },
        false => error,
    }
}

/// Copies an OBJ file line by line, without its materials.
fn write_plain(path: &Path, copy: &Path) -> Result<(), FileError> {
    let bytes = read_bounded(path, LARGEST_MESH_FILE)?;
    let text = String::from_utf8_lossy(&bytes);
    let mut plain = String::with_capacity(text.len());
    for line in text.lines() {
        let keyword = line.split_whitespace().next();
        if !matches!(keyword, Some("mtllib" | "usemtl")) {
            plain += line;
        }
        plain += "\n";
    }
    write_atomically(copy, plain.as_bytes())
}

/// Copies files to the same places below `folder` that they have below the model's folder.
fn copy_all(files: &[PathBuf], model: &Path, folder: &Path) -> Result<(), Error> {
    let home = model.parent().unwrap_or(Path::new(""));
    for file in files {
        let below = file.strip_prefix(home).ok().filter(|below| {
            let mut parts = below.components();
            parts.all(|part| matches!(part, Component::Normal(_) | Component::CurDir))
        });
        let Some(below) = below else {
            return refuse(
                model,
                &format!(
                    "{} lies outside of the model's folder; move it there and mend the file that names it, or import the model \
                     plain: the shape alone, in grey",
                    file.display()
                ),
            );
        };
        let bytes = fs::read(file).map_err(|source| FileError::io(file, "read", source))?;
        write_atomically(&folder.join(below), &bytes)?;
    }
    Ok(())
}
