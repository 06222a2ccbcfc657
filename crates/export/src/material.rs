//! Materials: metallic-roughness, emissive, with holes.

use glam::Vec3;
use gltf_json::extensions::material::{
    EmissiveStrength, EmissiveStrengthFactor, IndexOfRefraction, Ior, Specular,
    SpecularColorFactor, SpecularFactor,
};
use gltf_json::material::{
    AlphaCutoff, AlphaMode, EmissiveFactor, PbrBaseColorFactor, PbrMetallicRoughness,
    StrengthFactor,
};
use gltf_json::validation::Checked;
use gltf_json::{Index, Material};
use tracer::Finish;

use crate::buffer::Document;
use crate::error::ExportError;
use crate::textures::Textures;

/// Opacity below which a surface has a hole.
const HOLE: f32 = 0.5;

/// Adds a material. A diffuse one has no specular reflection at all, which takes `KHR_materials_specular`: without it a dielectric
/// of index 1.5 reflects 4 %.
pub fn push_material(
    document: &mut Document,
    textures: &mut Textures,
    material: &tracer::Material,
) -> Result<Index<Material>, ExportError> {
    let mut extensions = gltf_json::extensions::material::Material::default();
    let (metallic, roughness) = match material.finish {
        Finish::Diffuse => {
            extensions.specular = Some(Specular {
                specular_factor: SpecularFactor(0.0),
                specular_texture: None,
                specular_color_factor: SpecularColorFactor([1.0; 3]),
                specular_color_texture: None,
                extras: None,
            });
            (0.0, 1.0)
        }
        Finish::Conductor { roughness } => (1.0, roughness),
        Finish::Coated { roughness, index } => {
            extensions.ior = Some(Ior {
                ior: IndexOfRefraction(index),
                extras: None,
            });
            (0.0, roughness)
        }
    };
    let is_cut = material.opacity < HOLE || material.opacity_texture.is_some();
    let base_color_texture = match (material.diffuse_texture, material.opacity_texture) {
        (color, Some(opacity)) => Some(textures.add_cut_out(document, color, opacity)?),
        (Some(color), None) => Some(textures.add_file(document, color)?),
        (None, None) => None,
    };
    let (factor, strength) = scale_emission(material.emission);
    if strength > 1.0 {
        extensions.emissive_strength = Some(EmissiveStrength {
            emissive_strength: EmissiveStrengthFactor(strength),
        });
    }
    let emissive_texture = match material.emission_texture {
        Some(texture) if material.emission != Vec3::ZERO => {
            Some(textures.add_file(document, texture)?)
        }
        _ => None,
    };
    let [red, green, blue] = material.diffuse.to_array();
    Ok(document.root.push(Material {
        alpha_cutoff: is_cut.then_some(AlphaCutoff(HOLE)),
        alpha_mode: Checked::Valid(match is_cut {
            true => AlphaMode::Mask,
            false => AlphaMode::Opaque,
        }),
        double_sided: true,
        name: Some(material.name.clone()),
        pbr_metallic_roughness: PbrMetallicRoughness {
            base_color_factor: PbrBaseColorFactor([red, green, blue, material.opacity]),
            base_color_texture,
            metallic_factor: StrengthFactor(metallic),
            roughness_factor: StrengthFactor(roughness),
            metallic_roughness_texture: None,
            extensions: None,
            extras: None,
        },
        normal_texture: None,
        occlusion_texture: None,
        emissive_texture,
        emissive_factor: EmissiveFactor(factor.to_array()),
        extensions: Some(extensions),
        extras: None,
    }))
}

/// Parts an emission into a factor of at most 1 and a strength of at least 1.
fn scale_emission(emission: Vec3) -> (Vec3, f32) {
    let strength = emission.max_element().max(1.0);
    (emission / strength, strength)
}
