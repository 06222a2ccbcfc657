//! The OBJ files that an object of a scene.toml names.

use std::ops::Range;
use std::path::{Path, PathBuf};

use toml::Spanned;

use super::error::Slip;
use super::keyed_motion::check_times;
use super::schema::ObjectTable;
use crate::limits::MAX_KEYS;

/// OBJ file with one shape of a mesh.
pub(super) struct MeshSource {
    pub(super) path: PathBuf,
    /// Time of the shape, in frames; without meaning for a mesh of one shape.
    pub(super) time: f64,
    /// Place in the scene.toml.
    pub(super) place: Range<usize>,
}

/// Sources of a mesh: paths, bits of the times, and the group. Equal keys, equal meshes.
pub(super) type MeshKey = (Vec<(PathBuf, u64)>, Option<String>);

pub(super) fn mesh_key(sources: &[MeshSource], group: Option<&str>) -> MeshKey {
    // Adding 0 turns -0 into 0.
    let file = |source: &MeshSource| (source.path.clone(), (source.time + 0.0).to_bits());
    (sources.iter().map(file).collect(), group.map(str::to_owned))
}

/// Reads the sources of an object's mesh: one file, or one for each key shape, at rising times.
pub(super) fn read_mesh_sources(
    folder: &Path,
    name: &Spanned<String>,
    table: &ObjectTable,
) -> Result<Vec<MeshSource>, Slip> {
    let what = format!("object \"{}\"", name.get_ref());
    let source = |time: f64, mesh: &Spanned<String>| MeshSource {
        path: folder.join(mesh.get_ref()),
        time,
        place: mesh.span(),
    };
    let shapes = match (&table.mesh, &table.shapes) {
        (Some(mesh), None) => return Ok(vec![source(0.0, mesh)]),
        (None, Some(shapes)) => shapes,
        (None, None) => {
            let reason = format!("{what} has no mesh; give it a mesh, or shapes if it deforms");
            return Err(Slip::new(name.span(), reason));
        }
        (Some(_), Some(shapes)) => {
            let reason = format!("{what} has both a mesh and shapes; give one or the other");
            return Err(Slip::new(shapes.span(), reason));
        }
    };
    let count = shapes.get_ref().len();
    if !(2..=MAX_KEYS).contains(&count) {
        let reason = format!(
            "{what} has {count} shapes; allowed: 2 to {MAX_KEYS}, or a mesh in their place"
        );
        return Err(Slip::new(shapes.span(), reason));
    }
    for pair in shapes.get_ref().windows(2) {
        let times = [0, 1].map(|index| *pair[index].time.get_ref());
        check_times(&what, "shape", times, pair[1].time.span())?;
    }
    let shapes = shapes.get_ref().iter();
    Ok(shapes
        .map(|shape| source(*shape.time.get_ref(), &shape.mesh))
        .collect())
}
