//! Filters whose colours keep 32 bits, for numbers that a format would round.

use std::collections::BTreeSet;

use super::dependence::find_color_dependent;
use super::targets::output_format;
use crate::filter::{History, Layer};
use crate::{Filter, Format};

impl Filter {
    /// Returns the filter with 32-bit floats for the colour, the output, and the textures of floats
    /// that depend on colour. Velocity, depth and textures made from them alone keep their formats,
    /// so that the weights do not change. None if all of these have 32 bits already, or if a shader
    /// cannot store them so.
    pub fn widen_colors(&self) -> Option<Self> {
        let colored = self.list_colored();
        let widen = |name: &str, format: Format| {
            if colored.contains(name) {
                format.widened()
            } else {
                format
            }
        };
        let mut wide = self.clone();
        wide.convention.color_format = None;
        wide.convention.output_format = None;
        for texture in &mut wide.textures {
            texture.format = widen(&texture.name, texture.format);
        }
        for shader in &mut wide.shaders {
            *shader = shader.store_as(&widen)?;
        }
        let formats = |filter: &Self| {
            let declared = filter.textures.iter().map(|texture| texture.format);
            let builtin = [
                filter.convention.format_of(Layer::Color),
                output_format(filter),
            ];
            builtin.into_iter().chain(declared).collect::<Vec<_>>()
        };
        (formats(self) != formats(&wide)).then_some(wide)
    }

    /// Lists the textures that depend on colour.
    fn list_colored(&self) -> BTreeSet<String> {
        let dependent = self.passes.iter().zip(find_color_dependent(self));
        let written = dependent
            .filter(|(_, depends)| *depends)
            .flat_map(|(pass, _)| self.entry_point(pass).writes.iter().cloned());
        let builtin = ["color", History::Color.texture(), "output"];
        builtin
            .into_iter()
            .map(str::to_owned)
            .chain(written)
            .collect()
    }
}
