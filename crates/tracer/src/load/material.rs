//! What a scene.toml changes about the materials of an object's mesh.

use std::path::Path;

use glam::Vec3;
use toml::Spanned;

use super::document::Document;
use super::error::SceneError;
use super::files::Files;
use super::finish::{Number, Numbers};
use super::light::{amiss_in_albedo, radiance};
use super::schema::MaterialTable;
use super::texture::{Textures, Use};
use crate::{Finish, Material};

/// The finish that the material had, with what the table names.
fn finish(
    document: &Document,
    table: &MaterialTable,
    before: Finish,
) -> Result<Finish, SceneError> {
    let before = Numbers::of(before);
    let given = |number: &Option<Spanned<f32>>| number.as_ref().map(|number| *number.get_ref());
    let metallic = table.metallic.as_ref().map(|metallic| *metallic.get_ref());
    let numbers = Numbers {
        roughness: given(&table.roughness).or(before.roughness),
        metallic: metallic.unwrap_or(before.metallic),
        index: given(&table.index_of_refraction).or(before.index),
    };
    let span = |given: &Option<Spanned<f32>>| given.as_ref().map(Spanned::span);
    numbers.finish().map_err(|(number, reason)| {
        let (name, place) = match number {
            Number::Roughness => ("roughness", span(&table.roughness)),
            Number::Metallic => ("metallic", table.metallic.as_ref().map(Spanned::span)),
            Number::Index => ("index_of_refraction", span(&table.index_of_refraction)),
        };
        let place = place.expect("what the material had before was allowed");
        document.error(place, format!("{name} {reason}"))
    })
}

/// Replaces what the table names. Textures lie relative to the scene's folder.
pub(super) fn override_material(
    document: &Document,
    files: &mut Files,
    textures: &mut Textures,
    folder: &Path,
    table: &MaterialTable,
    material: &mut Material,
) -> Result<(), SceneError> {
    if let Some(diffuse) = &table.diffuse {
        if let Some(reason) = amiss_in_albedo(*diffuse.get_ref()) {
            return Err(document.error(diffuse.span(), format!("diffuse {reason}")));
        }
        material.diffuse = Vec3::from(*diffuse.get_ref());
    }
    if let Some(emission) = &table.emission {
        let place = emission.span();
        material.emission = radiance(document, "emission", *emission.get_ref(), place)?;
    }
    if let Some(opacity) = &table.opacity {
        material.opacity = *opacity.get_ref();
        if !(0.0..=1.0).contains(&material.opacity) {
            let reason = format!("opacity is {}; allowed: 0 to 1", material.opacity);
            return Err(document.error(opacity.span(), reason));
        }
    }
    material.finish = finish(document, table, material.finish)?;
    let mut texture = |name: &Option<Spanned<String>>, usage, index: &mut Option<usize>| {
        if let Some(name) = name {
            let loaded = textures.load(files, &folder.join(name.get_ref()), usage);
            *index = Some(loaded.map_err(|reason| document.error(name.span(), reason))?);
        }
        Ok(())
    };
    texture(
        &table.diffuse_texture,
        Use::Color,
        &mut material.diffuse_texture,
    )?;
    texture(
        &table.emission_texture,
        Use::Color,
        &mut material.emission_texture,
    )?;
    texture(
        &table.opacity_texture,
        Use::Opacity,
        &mut material.opacity_texture,
    )
}
