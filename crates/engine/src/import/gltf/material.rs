//! Materials as statements of an MTL file.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

use glam::Vec3;
use measure::Error;
use scene::Finish;

use super::file::File;
use super::geometry::Primitive;
use super::images::{Images, Picture, plain_name};
use super::look::{Look, Mapping};
use super::lost::Lost;
use super::material_schema::{self, TextureInfo};
use super::schema::Gltf;

/// Metalness from which a surface is bare metal.
const METAL: f32 = 0.5;

/// Materials of a scene in the making.
pub struct Materials<'a> {
    json: &'a Gltf,
    images: Images<'a>,
    /// Looks by material, and by whether vertices have colours.
    looks: BTreeMap<(Option<usize>, bool), Look>,
    /// Text of the MTL file.
    pub text: String,
    pub lost: Lost,
}

impl<'a> Materials<'a> {
    pub fn new(file: &'a File, folder: &Path) -> Self {
        Self {
            json: &file.json,
            images: Images::new(file, folder),
            looks: BTreeMap::new(),
            text: String::new(),
            lost: Lost::default(),
        }
    }

    /// Returns the look of a primitive, and writes its material if it is new.
    pub fn look(&mut self, primitive: &Primitive) -> Result<Look, Error> {
        let key = (primitive.material, primitive.has_colors);
        if !self.looks.contains_key(&key) {
            let look = self.write(key.0, key.1)?;
            self.looks.insert(key, look);
        }
        let look = self.looks[&key].clone();
        if look.is_clamped {
            let is_outside = |value: &f32| !(-1e-3..=1.001).contains(value);
            if look
                .texcoords(primitive)
                .as_flattened()
                .iter()
                .any(is_outside)
            {
                self.lost.add("textures that do not repeat", &look.name);
            }
        }
        Ok(look)
    }

    fn write(&mut self, index: Option<usize>, has_colors: bool) -> Result<Look, Error> {
        let usual = material_schema::Material::default();
        let json = self.json;
        let entry = index.map_or(&usual, |index| &json.materials[index]);
        let name = self.name(index, &entry.name);
        let mut writing = Writing {
            entry,
            name,
            text: String::new(),
            mapping: None,
            is_clamped: false,
            images: &mut self.images,
            lost: &mut self.lost,
        };
        if has_colors {
            writing.lose("vertex colours");
        }
        let is_blended = writing.write()?;
        let look = Look {
            name: writing.name.clone(),
            is_blended,
            mapping: writing.mapping.take(),
            is_clamped: writing.is_clamped,
        };
        let text = writing.text;
        self.text += &format!("newmtl {}\n{text}", look.name);
        Ok(look)
    }

    fn name(&self, index: Option<usize>, name: &str) -> String {
        let name = match (index, name) {
            (None, _) => "default".to_owned(),
            (Some(index), "") => format!("material_{index}"),
            (Some(_), name) => plain_name(name),
        };
        let is_taken = |name: &String| self.looks.values().any(|look| look.name == *name);
        let further = (2..).map(|number| format!("{name}_{number}"));
        let mut names = std::iter::once(name.clone()).chain(further);
        names
            .find(|name| !is_taken(name))
            .expect("there is no last number")
    }
}

/// A material that is being written.
struct Writing<'a, 'b> {
    entry: &'a material_schema::Material,
    name: String,
    text: String,
    /// Texture coordinates of the first texture.
    mapping: Option<Mapping>,
    is_clamped: bool,
    images: &'a mut Images<'b>,
    lost: &'a mut Lost,
}

impl Writing<'_, '_> {
    fn lose(&mut self, feature: &str) {
        self.lost.add(feature, &self.name);
    }

    fn line(&mut self, words: std::fmt::Arguments) {
        writeln!(self.text, "{words}").expect("text takes text");
    }

    fn color(&mut self, keyword: &str, [r, g, b]: [f32; 3]) {
        self.line(format_args!("{keyword} {r} {g} {b}"));
    }

    /// Writes all statements; returns whether light passes through the surface.
    fn write(&mut self) -> Result<bool, Error> {
        let pbr = &self.entry.pbr_metallic_roughness;
        let [r, g, b, _] = pbr.base_color_factor.map(|part| part.clamp(0.0, 1.0));
        let base = self.texture(pbr.base_color_texture.as_ref())?;
        let is_unlit = self.entry.extensions.unlit.is_some();
        if is_unlit {
            self.color("Kd", [0.0; 3]);
            self.color("Ke", [r, g, b]);
            self.map("map_Ke", base.as_ref());
        } else {
            self.color("Kd", [r, g, b]);
            self.map("map_Kd", base.as_ref());
            self.write_emission()?;
            self.write_finish()?;
        }
        self.list_lost();
        if let Some(base) = &base
            && base.is_nearest
        {
            self.lose("textures without interpolation");
        }
        if !is_unlit && self.is_transmitting() {
            self.color("Tf", [r, g, b]);
            self.line(format_args!("d 0"));
            return Ok(true);
        }
        self.write_opacity(base.as_ref())
    }

    /// Copies a texture. A second texture with other coordinates than the first is lost.
    fn texture(&mut self, info: Option<&TextureInfo>) -> Result<Option<Picture>, Error> {
        let Some(info) = info else {
            return Ok(None);
        };
        let mapping = Mapping::of(info);
        if self.mapping.as_ref().is_some_and(|first| *first != mapping) {
            self.lose("second textures with coordinates of their own");
            return Ok(None);
        }
        let picture = self.images.copy(info)?;
        if let Some(picture) = &picture {
            self.mapping = Some(mapping);
            self.is_clamped |= picture.is_clamped;
        }
        Ok(picture)
    }

    fn map(&mut self, keyword: &str, picture: Option<&Picture>) {
        if let Some(picture) = picture {
            self.line(format_args!("{keyword} {}", picture.name));
        }
    }

    fn write_emission(&mut self) -> Result<(), Error> {
        let strength = self.entry.extensions.emission.as_ref();
        let strength = strength.map_or(1.0, |emission| emission.emissive_strength.max(0.0));
        let emission = strength * Vec3::from(self.entry.emissive_factor).max(Vec3::ZERO);
        if emission != Vec3::ZERO {
            let picture = self.texture(self.entry.emissive_texture.as_ref())?;
            let is_lost = picture.is_none() && self.entry.emissive_texture.is_some();
            self.color(
                "Ke",
                if is_lost {
                    [0.0; 3]
                } else {
                    emission.to_array()
                },
            );
            self.map("map_Ke", picture.as_ref());
        }
        Ok(())
    }

    /// Writes roughness, metalness and index of refraction. Without specular reflection, the
    /// surface is diffuse.
    fn write_finish(&mut self) -> Result<(), Error> {
        let pbr = &self.entry.pbr_metallic_roughness;
        let [mut roughness, mut metalness] = [pbr.roughness_factor, pbr.metallic_factor];
        if let Some(info) = &pbr.metallic_roughness_texture
            && let Some(picture) = self.images.copy(info)?
        {
            let [_, green, blue, _] = picture.mean;
            (roughness, metalness) = (roughness * green, metalness * blue);
            self.lose("textures of roughness and metalness (their mean is used)");
        }
        let extensions = &self.entry.extensions;
        let index = extensions.index.as_ref().map_or(1.5, |index| index.ior);
        let specular = extensions.specular.as_ref();
        let specular = specular.map_or(1.0, |specular| specular.specular_factor);
        let is_metal = metalness >= METAL;
        if !(0.02..=0.98).contains(&metalness) {
        } else {
            self.lose("metalness between 0 and 1 (the nearer is used)");
        }
        if !(specular == 0.0 || specular == 1.0) {
            self.lose("weakened specular reflection");
        }
        if self.is_transmitting() {
            if index > 1.0 {
                self.line(format_args!("illum 4\nNi {}", index.min(Finish::DENSEST)));
            }
            if roughness > 0.05 {
                self.lose("frosted glass");
            }
            return Ok(());
        }
        if is_metal || specular != 0.0 {
            let roughness = roughness.clamp(0.0, 1.0);
            let is_mirror = roughness < 0.5 * Finish::SMOOTHEST;
            let roughness = if is_mirror {
                0.0
            } else {
                roughness.max(Finish::SMOOTHEST)
            };
            self.line(format_args!("Pr {roughness}"));
            // An index of 0 stands for full reflection there.
            let index = if index == 0.0 { Finish::DENSEST } else { index };
            if is_metal {
                self.line(format_args!("Pm 1"));
            } else {
                self.line(format_args!("Ni {}", index.clamp(1.0, Finish::DENSEST)));
            }
        }
        Ok(())
    }

    /// Returns whether the surface is glass or a filter.
    fn is_transmitting(&self) -> bool {
        let transmission = self.entry.extensions.transmission.as_ref();
        transmission.is_some_and(|transmission| transmission.transmission_factor >= 0.5)
    }

    /// Writes opacity; returns whether light passes.
    fn write_opacity(&mut self, base: Option<&Picture>) -> Result<bool, Error> {
        let pbr = &self.entry.pbr_metallic_roughness;
        let [.., factor] = pbr.base_color_factor.map(|part| part.clamp(0.0, 1.0));
        let base = base.filter(|base| base.least_alpha < 1.0);
        match self.entry.alpha_mode.as_deref() {
            Some("BLEND") => {
                self.line(format_args!("d {factor}"));
                self.map("map_d", base);
                Ok(factor < 1.0 || base.is_some())
            }
            Some("MASK") => {
                let cutoff = self.entry.alpha_cutoff.unwrap_or(0.5);
                self.write_mask(base, factor, cutoff)?;
                Ok(false)
            }
            _ => Ok(false),
        }
    }

    /// Writes holes where `factor` times alpha is below the cutoff; ours are below 0.5.
    fn write_mask(
        &mut self,
        base: Option<&Picture>,
        factor: f32,
        cutoff: f32,
    ) -> Result<(), Error> {
        let info = &self.entry.pbr_metallic_roughness.base_color_texture;
        let (Some(base), Some(info)) = (base, info) else {
            let is_hole = factor < cutoff;
            self.line(format_args!("d {}", if is_hole { 0 } else { 1 }));
            return Ok(());
        };
        if factor == 1.0 && cutoff == 0.5 {
            self.map("map_d", Some(base));
            return Ok(());
        }
        // Straight lines keep the outline between texels, which a scaled and cut alpha would not.
        let slope = 0.5 / cutoff.abs().max((factor - cutoff).abs()).max(1e-3);
        let mapped = [slope * factor, 0.5 - slope * cutoff];
        if let Some(name) = self.images.write_opacity(info, mapped)? {
            self.line(format_args!("map_d {name}"));
        }
        Ok(())
    }

    /// Lists properties without a counterpart.
    fn list_lost(&mut self) {
        let entry = self.entry;
        let is_unlit = entry.extensions.unlit.is_some();
        if entry.normal_texture.is_some() && !is_unlit {
            self.lose("normal maps");
        }
        if entry.occlusion_texture.is_some() && !is_unlit {
            self.lose("occlusion maps (the truth computes its own)");
        }
        let specular = entry
            .extensions
            .specular
            .iter()
            .flat_map(|specular| specular.others.keys());
        let names: Vec<String> = entry
            .extensions
            .others
            .keys()
            .chain(specular)
            .cloned()
            .collect();
        for name in names {
            self.lose(name.trim_start_matches("KHR_materials_"));
        }
        if let Some(transmission) = &entry.extensions.transmission {
            let factor = transmission.transmission_factor;
            if factor > 0.0 && factor < 1.0 || transmission.transmission_texture.is_some() {
                self.lose("partial transmission (all or none is used)");
            }
        }
    }
}
