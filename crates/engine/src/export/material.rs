//! Materials: metallic-roughness, emissive, with holes, translucent.

use glam::Vec3;
use gltf_json::extensions::material::{
    EmissiveStrength, EmissiveStrengthFactor, IndexOfRefraction, Ior, Specular,
    SpecularColorFactor, SpecularFactor, Transmission, TransmissionFactor,
};
use gltf_json::material::{
    AlphaCutoff, AlphaMode, EmissiveFactor, PbrBaseColorFactor, PbrMetallicRoughness,
    StrengthFactor,
};
use gltf_json::validation::Checked;
use gltf_json::{Index, Material};
use tracer::{Finish, Translucency};

use crate::export::buffer::Document;
use crate::export::error::ExportError;
use crate::export::textures::Textures;

/// Opacity below which a surface has a hole.
const HOLE: f32 = 0.5;

/// Way in which alpha counts.
fn alpha_mode(material: &tracer::Material) -> AlphaMode {
    match material.translucency {
        _ if is_clear(material) => AlphaMode::Opaque,
        Some(_) => AlphaMode::Blend,
        None if material.opacity < HOLE || material.opacity_texture.is_some() => AlphaMode::Mask,
        None => AlphaMode::Opaque,
    }
}

/// Returns true for glass, or a filter, through which all light passes that it does not take itself.
fn is_clear(material: &tracer::Material) -> bool {
    let is_filter = |own: Translucency| own.glass.is_some() || own.filter != Vec3::ONE;
    material.translucency.is_some_and(is_filter)
        && material.opacity == 0.0
        && material.opacity_texture.is_none()
}

/// Refuses a translucent material that is neither a film that takes no light nor clear.
fn check_translucency(material: &tracer::Material) -> Result<(), ExportError> {
    let plain = |own: Translucency| own.glass.is_none() && own.filter == Vec3::ONE;
    if material.translucency.is_none_or(plain) || is_clear(material) {
        return Ok(());
    }
    Err(ExportError::Translucency {
        material: material.name.clone(),
        opacity: material.opacity,
    })
}

/// Adds a material. A translucent one blends; glass and filters transmit in the colour of what passes, with the index of
/// refraction 1 where nothing is reflected. A diffuse one has no specular reflection at all, which takes `KHR_materials_specular`: without it a dielectric
/// of index 1.5 reflects 4 %.
pub fn push_material(
    document: &mut Document,
    textures: &mut Textures,
    material: &tracer::Material,
) -> Result<Index<Material>, ExportError> {
    check_translucency(material)?;
    let mut extensions = gltf_json::extensions::material::Material::default();
    let clear = material.translucency.filter(|_| is_clear(material));
    let (metallic, roughness) = match (clear, material.finish) {
        (Some(clear), _) => {
            extensions.ior = Some(Ior {
                ior: IndexOfRefraction(clear.glass.unwrap_or(1.0)),
                extras: None,
            });
            extensions.transmission = Some(Transmission {
                transmission_factor: TransmissionFactor(1.0),
                transmission_texture: None,
                extras: None,
            });
            (0.0, 0.0)
        }
        (None, Finish::Diffuse) => {
            extensions.specular = Some(Specular {
                specular_factor: SpecularFactor(0.0),
                specular_texture: None,
                specular_color_factor: SpecularColorFactor([1.0; 3]),
                specular_color_texture: None,
                extras: None,
            });
            (0.0, 1.0)
        }
        (None, Finish::Conductor { roughness }) => (1.0, roughness),
        (None, Finish::Coated { roughness, index }) => {
            extensions.ior = Some(Ior {
                ior: IndexOfRefraction(index),
                extras: None,
            });
            (0.0, roughness)
        }
    };
    let mode = alpha_mode(material);
    let base_color_texture = match (material.diffuse_texture, material.opacity_texture) {
        _ if clear.is_some() => None,
        (color, Some(opacity)) => Some(textures.add_cut_out(document, color, opacity)?),
        (Some(color), None) => Some(textures.add_file(document, color)?),
        (None, None) => None,
    };
    // What is not opaque at all sends out nothing.
    let emission = clear.map_or(material.emission, |_| Vec3::ZERO);
    let (factor, strength) = scale_emission(emission);
    if strength > 1.0 {
        extensions.emissive_strength = Some(EmissiveStrength {
            emissive_strength: EmissiveStrengthFactor(strength),
        });
    }
    let emissive_texture = match material.emission_texture {
        Some(texture) if emission != Vec3::ZERO => Some(textures.add_file(document, texture)?),
        _ => None,
    };
    let color = clear.map_or(material.diffuse, |clear| clear.filter);
    let alpha = clear.map_or(material.opacity, |_| 1.0);
    let [red, green, blue] = color.to_array();
    Ok(document.root.push(Material {
        alpha_cutoff: (mode == AlphaMode::Mask).then_some(AlphaCutoff(HOLE)),
        alpha_mode: Checked::Valid(mode),
        double_sided: true,
        name: Some(material.name.clone()),
        pbr_metallic_roughness: PbrMetallicRoughness {
            base_color_factor: PbrBaseColorFactor([red, green, blue, alpha]),
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
