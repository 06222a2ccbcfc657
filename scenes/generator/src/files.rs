//! Generated files that belong together.

use crate::mesh::Mesh;

/// Names and contents of files.
pub(crate) type Files = Vec<(String, Vec<u8>)>;

/// Writes a mesh as an OBJ file and its materials as an MTL file.
pub(crate) fn model_files(name: &str, mesh: &Mesh, materials: &str) -> Files {
    let library = format!("{name}.mtl");
    vec![
        (format!("{name}.obj"), mesh.to_obj(&library).into_bytes()),
        (library, materials.into()),
    ]
}

/// Puts files into a scene's folder.
pub(crate) fn scene_files(name: &str, parts: &[Files]) -> Files {
    parts
        .concat()
        .into_iter()
        .map(|(file, bytes)| (format!("{name}/{file}"), bytes))
        .collect()
}
