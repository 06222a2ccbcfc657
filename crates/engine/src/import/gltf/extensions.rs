//! Extensions of glTF: those that are read, and the way out of the others.

use std::path::Path;

use super::schema::Gltf;

/// Extensions that a file may require. What some of them add has no counterpart, which is noted.
const READ: [&str; 22] = [
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "KHR_xmp_json_ld",
    "EXT_lights_image_based",
    "EXT_lights_ies",
    "MSFT_lod",
    "KHR_animation_pointer",
    "KHR_audio",
];

/// Extension of compressed meshes.
pub const DRACO: &str = "KHR_draco_mesh_compression";

/// Compressions and an old kind of materials, and the command of gltf-transform 4 that removes each.
const REMOVABLE: [(&str, &str); 7] = [
    (DRACO, "copy"),
    ("EXT_meshopt_compression", "copy"),
    ("KHR_meshopt_compression", "copy"),
    ("KHR_texture_basisu", "ktxdecompress"),
    ("EXT_texture_webp", "png --formats webp"),
    ("EXT_texture_avif", "png --formats avif"),
    ("KHR_materials_pbrSpecularGlossiness", "metalrough"),
];

/// Refuses extensions without which a file cannot be read.
pub fn check_required(json: &Gltf, path: &Path) -> Result<(), String> {
    for name in &*json.extensions_required {
        if REMOVABLE.iter().any(|(known, _)| known == name) {
            return Err(refuse_removable(name, path));
        }
        if !READ.contains(&name.as_str()) {
            return Err(format!(
                "requires the extension {name}, which is not read; export it without, or remove it from \
                 extensionsRequired if the file is right without it"
            ));
        }
    }
    Ok(())
}

/// Says why a part cannot be read, and what removes its extension.
pub fn refuse_removable(name: &str, path: &Path) -> String {
    let known = REMOVABLE.iter().find(|(known, _)| *known == name);
    let command = known.map_or("copy", |(_, command)| command);
    let file = path.file_name().unwrap_or_default().to_string_lossy();
    format!(
        "needs {name}, which is not read; remove it: npx @gltf-transform/cli {command} \"{file}\" plain.glb"
    )
}

/// Returns the first of the names that a command removes.
pub fn removable_extension<'a>(mut names: impl Iterator<Item = &'a String>) -> Option<&'a str> {
    names.find_map(|name| {
        let known = REMOVABLE.iter().any(|(known, _)| known == name);
        known.then_some(name.as_str())
    })
}
