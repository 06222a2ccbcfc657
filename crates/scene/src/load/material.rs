//! Changes to materials that a scene.toml makes for one object.

use std::path::Path;

use toml::Spanned;

use super::document::Document;
use super::error::{SceneError, Slip};
use super::files::Files;
use super::finish::FinishValues;
use super::schema::MaterialTable;
use super::texture::{Textures, Use};
use super::translucency::change_translucency;
use crate::{Finish, Material};

/// Changes the values of a finish that the table names.
fn change_finish(table: &MaterialTable, before: Finish) -> Result<Finish, Slip> {
    let before = FinishValues::from(before);
    let MaterialTable {
        roughness,
        metallic,
        index_of_refraction: index,
        ..
    } = table;
    let given = |value: &Option<Spanned<f32>>| value.as_ref().map(|value| *value.get_ref());
    let values = FinishValues {
        roughness: given(roughness).or(before.roughness),
        metallic: (metallic.as_ref()).map_or(before.metallic, |metallic| *metallic.get_ref()),
        index: given(index).or(before.index),
    };
    let names = ["roughness", "metallic", "index_of_refraction"];
    values.build(names).map_err(|(wrong, reason)| {
        let places = [
            roughness.as_ref().map(Spanned::span),
            metallic.as_ref().map(Spanned::span),
            index.as_ref().map(Spanned::span),
        ];
        let place = places[wrong].clone();
        let place = place.expect("the material's own values were allowed");
        Slip::new(place, reason)
    })
}

/// Replaces the values that the table names. Paths of textures are relative to the scene's folder.
/// `is_blended` says what the object's opacities mean.
pub(super) fn change_material(
    document: &Document,
    files: &mut Files,
    textures: &mut Textures,
    folder: &Path,
    (table, is_blended): (&MaterialTable, bool),
    material: &mut Material,
) -> Result<(), SceneError> {
    if let Some(diffuse) = &table.diffuse {
        material.diffuse = diffuse.0;
    }
    if let Some(emission) = &table.emission {
        material.emission = emission.0;
    }
    if let Some(opacity) = &table.opacity {
        material.opacity = opacity.0;
    }
    let locate = |slip| document.locate(slip);
    material.finish = change_finish(table, material.finish).map_err(locate)?;
    change_translucency(table, is_blended, material).map_err(locate)?;
    for (name, usage, index) in [
        (
            &table.diffuse_texture,
            Use::Color,
            &mut material.diffuse_texture,
        ),
        (
            &table.emission_texture,
            Use::Color,
            &mut material.emission_texture,
        ),
        (
            &table.opacity_texture,
            Use::Opacity,
            &mut material.opacity_texture,
        ),
    ] {
        if let Some(name) = name {
            let loaded = textures.load(files, &folder.join(name.get_ref()), usage);
            *index = Some(loaded.map_err(|reason| document.error(name.span(), reason))?);
        }
    }
    Ok(())
}
