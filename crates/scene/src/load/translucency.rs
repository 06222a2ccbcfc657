//! The translucency of materials: the meaning of opacities by an object's `alpha`, and
//! checks of its materials' requests.

use std::path::Path;

use toml::Spanned;

use super::error::Slip;
use super::schema::{AlphaWord, BuffersWord, MaterialTable, ObjectTable};
use crate::{Finish, Material, Translucency};

/// Index of refraction of glass if no file gives one.
pub(super) const GLASS: f32 = 1.5;

/// Choices of an object about its translucent surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Alpha {
    /// True if opacity mixes a surface with what is behind it; else it cuts holes.
    pub(super) is_blended: bool,
    /// True if the scene.toml chooses.
    is_written: bool,
    /// True if velocity, depth and object id come from the translucent surfaces.
    in_buffers: bool,
}

impl Alpha {
    /// Reads `alpha` and `buffers` of an object.
    pub(super) fn read(table: &ObjectTable) -> Result<Self, Slip> {
        let is_blended = table.alpha == Some(AlphaWord::Blended);
        if let (Some(buffers), false) = (&table.buffers, is_blended) {
            let reason = "buffers says which velocity and depth a translucent object has; give it alpha = \"blended\"";
            return Err(Slip::new(buffers.span(), reason));
        }
        let buffers = table.buffers.as_ref().map(|buffers| *buffers.get_ref());
        Ok(Self {
            is_blended,
            is_written: table.alpha.is_some(),
            in_buffers: buffers == Some(BuffersWord::Own),
        })
    }

    /// Says what becomes of a material that its file calls translucent, if the scene.toml does not
    /// choose.
    pub(super) fn note(self, material: &Material, mesh: &Path) -> Option<String> {
        let opacity = material.opacity;
        let is_clear = material.translucency == Some(Translucency::CLEAR);
        if self.is_written || opacity == 1.0 || opacity == 0.0 && is_clear {
            return None;
        }
        Some(format!(
            "material \"{}\" of {} has the opacity {opacity} and is drawn {}; write alpha = \"blended\" to let light through, or \
             alpha = \"cutout\" to keep this",
            material.name,
            mesh.display(),
            if opacity < Material::HOLE {
                "as a hole"
            } else {
                "opaque"
            }
        ))
    }

    /// Sets the translucency of a material of the object, from what its file asks for. A material
    /// that is opaque everywhere has none. The error says what is wrong with the material.
    pub(super) fn apply(self, material: &mut Material) -> Result<(), String> {
        let asked = material.translucency.take();
        if !self.is_blended {
            return Ok(());
        }
        let asked = asked.unwrap_or(Translucency::CLEAR);
        let is_opaque = material.opacity == 1.0 && material.opacity_texture.is_none();
        if let Some(index) = asked.glass {
            if is_opaque {
                let reason = "is thin glass with an opacity of 1, which lets nothing pass; give it less (0 is clean glass)";
                return Err(reason.into());
            }
            if !(1.0..=Finish::DENSEST).contains(&index) {
                let most = Finish::DENSEST;
                return Err(format!(
                    "is thin glass with an index of refraction of {index}; allowed: 1 to {most}"
                ));
            }
        }
        material.translucency = (!is_opaque).then_some(Translucency {
            // Glass of index 1 reflects nothing.
            glass: asked.glass.filter(|index| *index > 1.0),
            in_buffers: self.in_buffers,
            ..asked
        });
        Ok(())
    }
}

/// Changes a material's translucency by the keys of a scene.toml.
pub(super) fn change_translucency(
    table: &MaterialTable,
    is_blended: bool,
    material: &mut Material,
) -> Result<(), Slip> {
    let places = [
        (table.filter.as_ref().map(Spanned::span), "filter"),
        (table.thin_glass.as_ref().map(Spanned::span), "thin_glass"),
    ];
    for (place, key) in places {
        if let (Some(place), false) = (place, is_blended) {
            let reason =
                format!("{key} is about light that passes; give the object alpha = \"blended\"");
            return Err(Slip::new(place, reason));
        }
    }
    let mut asked = material.translucency.unwrap_or(Translucency::CLEAR);
    if let Some(filter) = &table.filter {
        asked.filter = filter.get_ref().0;
    }
    if let Some(is_glass) = &table.thin_glass {
        asked.glass = is_glass.get_ref().then(|| asked.glass.unwrap_or(GLASS));
    }
    if let (Some(glass), Some(index)) = (&mut asked.glass, &table.index_of_refraction) {
        *glass = *index.get_ref();
    }
    material.translucency = Some(asked);
    Ok(())
}
