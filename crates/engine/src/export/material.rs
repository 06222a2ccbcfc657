//! Materials: metallic-roughness, emissive, with holes, translucent.

use glam::Vec3;
use measure::Error;
use scene::{Finish, Material, Translucency};
use serde_json::{Value, json};

use crate::export::document::{Document, widen};
use crate::export::textures::Textures;

/// Opacity below which a surface has a hole.
const HOLE: f32 = 0.5;

/// Adds a material. A translucent one blends; glass and filters transmit with the colour of the
/// light that passes.
pub fn push_material(
    document: &mut Document,
    textures: &mut Textures,
    material: &Material,
) -> Result<usize, Error> {
    check_translucency(material)?;
    let clear = material.translucency.filter(|_| is_clear(material));
    let mode = alpha_mode(material);
    let base_color_texture = match clear {
        Some(_) => None,
        None => textures.add(
            document,
            [material.diffuse_texture, material.opacity_texture],
            Vec3::ONE,
        )?,
    };
    // A fully transparent surface emits nothing.
    let emission = clear.map_or(material.emission, |_| Vec3::ZERO);
    let strength = emission.max_element().max(1.0);
    let emissive_texture = material.emission_texture.filter(|_| emission != Vec3::ZERO);
    // Blender 3.4 reads black where a texture is multiplied by a colour.
    let factor = emission / strength;
    let is_gray = factor.min_element() == factor.max_element();
    let (tint, factor) = match emissive_texture {
        Some(_) if !is_gray => (factor, Vec3::ONE),
        _ => (Vec3::ONE, factor),
    };
    let emissive_texture = textures.add(document, [emissive_texture, None], tint)?;
    let color = clear.map_or(material.diffuse, |clear| clear.filter);
    let alpha = clear.map_or(material.opacity, |_| 1.0);
    let [metallic, roughness] = match (clear, material.finish) {
        (Some(_), _) => [0.0, 0.0],
        (None, Finish::Diffuse) => [0.0, 1.0],
        (None, Finish::Conductor { roughness }) => [1.0, roughness],
        (None, Finish::Coated { roughness, .. }) => [0.0, roughness],
    };
    let texture = |index: Option<usize>| index.map(|index| json!({ "index": index }));
    let entry = json!({
        "alphaCutoff": (mode == "MASK").then_some(HOLE),
        "alphaMode": mode,
        "doubleSided": true,
        "emissiveFactor": factor.to_array().map(widen),
        "emissiveTexture": texture(emissive_texture),
        "extensions": describe_extensions(material, clear, strength),
        "name": material.name,
        "pbrMetallicRoughness": {
            "baseColorFactor": color.extend(alpha).to_array().map(widen),
            "baseColorTexture": texture(base_color_texture),
            "metallicFactor": metallic,
            "roughnessFactor": widen(roughness),
        },
    });
    Ok(document.push("materials", entry))
}

/// Describes properties that need an extension. Glass and filters without reflection have the index
/// of refraction 1. A diffuse material has no specular reflection at all: without
/// `KHR_materials_specular` a dielectric of index 1.5 reflects 4 %.
fn describe_extensions(material: &Material, clear: Option<Translucency>, strength: f32) -> Value {
    let index = match (clear, material.finish) {
        (Some(clear), _) => Some(clear.glass.unwrap_or(1.0)),
        (None, Finish::Coated { index, .. }) => Some(index),
        _ => None,
    };
    let is_matt = clear.is_none() && material.finish == Finish::Diffuse;
    let emission = (strength > 1.0).then(|| json!({ "emissiveStrength": widen(strength) }));
    json!({
        "KHR_materials_emissive_strength": emission,
        "KHR_materials_ior": index.map(|index| json!({ "ior": widen(index) })),
        "KHR_materials_specular": is_matt.then(|| json!({ "specularFactor": 0.0 })),
        "KHR_materials_transmission": clear.map(|_| json!({ "transmissionFactor": 1.0 })),
    })
}

/// Names the mode of alpha.
fn alpha_mode(material: &Material) -> &'static str {
    match material.translucency {
        _ if is_clear(material) => "OPAQUE",
        Some(_) => "BLEND",
        None if material.opacity < HOLE || material.opacity_texture.is_some() => "MASK",
        None => "OPAQUE",
    }
}

/// Returns true for glass or a filter that transmits all light that it does not absorb.
fn is_clear(material: &Material) -> bool {
    material.translucency.is_some_and(is_filter)
        && material.opacity == 0.0
        && material.opacity_texture.is_none()
}

fn is_filter(translucency: Translucency) -> bool {
    translucency.glass.is_some() || translucency.filter != Vec3::ONE
}

/// Refuses a translucent material that is neither a film without absorption nor clear.
fn check_translucency(material: &Material) -> Result<(), Error> {
    if material.translucency.is_some_and(is_filter) && !is_clear(material) {
        Err(Error::Refused(format!(
            "material {}: opacity {} beside glass or a filter, which glTF 2.0 has no words for; it can say: glass or a filter of \
             opacity 0 without a texture of opacity, and a film without a filter; give the print on the glass a material of its own",
            material.name, material.opacity
        )))
    } else {
        Ok(())
    }
}
