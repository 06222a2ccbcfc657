//! The imported model: its files in the scene's folder, and its box.

use std::fs;
use std::path::{Component, Path, PathBuf};

use frame::{FileError, read_bounded, write_atomically};
use glam::DVec3;
use measure::{Error, named};
use scene::{Mesh, Scene, SceneError, limits::LARGEST_MESH_FILE, load_scene_and_files};

use crate::files::{refusal, refuse};
use crate::import::framing::check_radius;
use crate::import::series::Series;

/// Name of the folder of the model's files, in the scene's folder.
const FOLDER: &str = "model";

/// Key of an object with materials that light passes through.
pub const BLENDED: &str = "alpha = \"blended\"\n";

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
    /// Keys of scene.toml that name the OBJ files, below the scene's folder, with slashes.
    pub keys: String,
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
    /// The OBJ files and the files that they name.
    files: Vec<PathBuf>,
}

impl Model {
    /// Copies the OBJ files of a series, and the files that they name, into the folder of a new
    /// scene.
    pub fn copy(series: &Series, plain: bool, up: Up, scene: &Path) -> Result<Self, Error> {
        let folder = scene.join(FOLDER);
        let mut names = Vec::new();
        let mut originals = Vec::new();
        for path in &series.files {
            let path =
                (path.canonicalize()).map_err(|source| FileError::io(path, "read", source))?;
            let Some(name) = path.file_name().unwrap_or_default().to_str() else {
                return refuse!(path, "the name is not Unicode; rename the file");
            };
            names.push(format!("{FOLDER}/{name}"));
            originals.push(path);
        }
        let first = originals[0].clone();
        let originals = Series {
            files: originals,
            ..series.clone()
        };
        let loaded = if plain {
            load_plain(&originals, &names, scene)?
        } else {
            let loaded = load(scene, &originals);
            let loaded = loaded.map_err(|error| suggest_plain(error, &originals, scene))?;
            copy_all(&loaded.files, &first, &folder)?;
            loaded
        };
        let upright = |p: DVec3| match up {
            Up::Y => p,
            Up::Z => DVec3::new(p.x, p.z, -p.y),
        };
        let mesh = &loaded.mesh;
        let mut corners = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let shapes = mesh.shapes.iter().map(|shape| &shape.positions);
        for positions in shapes.chain([&mesh.positions]) {
            for vertex in mesh.triangles.iter().flatten() {
                let place = upright(positions[*vertex as usize].as_dvec3());
                corners = [corners[0].min(place), corners[1].max(place)];
            }
        }
        let model = Self {
            keys: series.keys(&names),
            corners,
            up,
            is_translucent: loaded.is_translucent,
        };
        model.check_size(&first)?;
        Ok(model)
    }

    /// Refuses a model for which no stand, floor and camera can be made.
    fn check_size(&self, path: &Path) -> Result<(), Error> {
        check_radius(self.radius()).map_err(|reason| refusal(path, reason))
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

/// Copies the files without their materials, and loads the copies.
fn load_plain(series: &Series, names: &[String], scene: &Path) -> Result<Loaded, Error> {
    let files: Vec<PathBuf> = names.iter().map(|name| scene.join(name)).collect();
    for (file, copy) in series.files.iter().zip(&files) {
        write_plain(file, copy)?;
    }
    let copies = Series {
        files,
        ..series.clone()
    };
    let loaded = load(scene, &copies).map_err(|error| {
        // Line numbers are unchanged.
        let place = copies.files.iter().position(|copy| *copy == error.path);
        SceneError {
            path: series.files[place.unwrap_or(0)].clone(),
            ..error
        }
    });
    Ok(loaded?)
}

/// Loads the model as a scene of its own.
fn load(scene: &Path, series: &Series) -> Result<Loaded, SceneError> {
    let (loaded, files) = load_with(scene, series, "")?;
    let is_translucent = (loaded.materials.iter()).any(|material| material.opacity < 1.0);
    if is_translucent {
        // Materials that let light pass are checked further.
        load_with(scene, series, BLENDED)?;
    }
    let mut meshes = loaded.meshes;
    Ok(Loaded {
        mesh: meshes.remove(0),
        is_translucent,
        files,
    })
}

/// Loads a scene of the model with more keys; returns it with the paths of the model's files.
fn load_with(
    scene: &Path,
    series: &Series,
    keys: &str,
) -> Result<(Scene, Vec<PathBuf>), SceneError> {
    let files: Vec<String> = (series.files.iter())
        .map(|file| file.to_string_lossy().into_owned())
        .collect();
    let document = scene.join("scene.toml");
    let text = format!(
        "exposes = \"the model\"\nfamily = \"limits\"\nexposure = 0.5\nsize = [1, 1]\n\
         [camera]\nposition = [0, 0, 0]\nlook_at = [0, 0, -1]\nvertical_fov = 40\n\
         [background]\nconstant = [1, 1, 1]\n[object.model]\n{}{keys}",
        series.keys(&files)
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
                path: series.files[0].clone(),
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
fn suggest_plain(error: SceneError, series: &Series, scene: &Path) -> SceneError {
    let names: Vec<String> = (0..series.files.len())
        .map(|number| format!("plain_{number}.obj"))
        .collect();
    let helps = load_plain(series, &names, scene).is_ok();
    for name in names {
        let _ = fs::remove_file(scene.join(name));
    }
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
