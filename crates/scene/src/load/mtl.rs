//! Materials from the statements of MTL files: diffuse, glossy, emissive, cut-out and translucent
//! surfaces.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use glam::Vec3;

use super::error::SceneError;
use super::files::Files;
use super::finish::FinishValues;
use super::map_options::{Mapping, read_map};
use super::statements::Statement;
use super::texture::{Textures, Use};
use super::translucency::GLASS;
use super::values::{check_albedo, check_radiance};
use crate::limits::LARGEST_NUMBER;
use crate::{Material, Translucency};

/// Albedo of faces without a material, and of materials with neither Kd nor map_Kd.
const DEFAULT_ALBEDO: f32 = 0.5;

/// Name of the material of faces without one.
const DEFAULT_NAME: &str = "default";

/// Statements of roughness, metallic and index of refraction.
const FINISH: [&str; 3] = ["Pr", "Pm", "Ni"];

/// Statements of textures.
pub(super) const MAPS: [&str; 3] = ["map_Kd", "map_Ke", "map_d"];

/// Illumination model of glass: "Transparency: Glass on, Reflection: Ray trace on".
const GLASS_MODEL: f32 = 4.0;
/// Largest difference between a Tr and 1 - d, by rounding of decimals.
const SAME_TRANSPARENCY: f32 = 1e-3;

/// Statements of a material, by keyword.
#[derive(Default)]
pub(super) struct Statements(pub(super) BTreeMap<&'static str, Stated>);

/// Statement with what was read from it.
pub(super) struct Stated {
    pub(super) path: PathBuf,
    pub(super) line: usize,
    /// Text after the keyword, as tobj takes it.
    pub(super) text: String,
    /// Numbers; empty for a name, and for words in the place of a number that may be ignored.
    numbers: Vec<f32>,
    /// Options of a texture.
    pub(super) mapping: Mapping,
    /// Options of a texture that would change the picture, and are not read.
    pub(super) unread: Vec<String>,
}

/// Material of faces without one.
pub(super) fn default_material() -> Material {
    Material {
        name: DEFAULT_NAME.into(),
        diffuse: Vec3::splat(DEFAULT_ALBEDO),
        ..Material::default()
    }
}

impl Stated {
    /// Reads the text of a statement as tobj takes it: no comment after numbers, no options before
    /// a file, and three numbers for a colour, since tobj panics on fewer.
    pub(super) fn read(keyword: &str, statement: &Statement, path: &Path) -> Result<Self, String> {
        let mut mapping = Mapping::NONE;
        let mut unread = Vec::new();
        let text = match number_count(keyword) {
            Some(count) => {
                if statement.words().count() < count {
                    statement.read_first_numbers(count)?;
                }
                statement.words().collect::<Vec<&str>>().join(" ")
            }
            None if keyword == "illum" => {
                // Programs write words too, which are ignored as other models are.
                let model = statement
                    .words()
                    .next()
                    .and_then(|word| word.parse::<f32>().ok());
                (model.unwrap_or_default() as u8).to_string()
            }
            None if MAPS.contains(&keyword) => {
                statement.check_name()?;
                let map =
                    read_map(statement.rest).map_err(|reason| format!("{keyword} {reason}"))?;
                mapping = map.mapping;
                unread = map
                    .unread
                    .iter()
                    .map(|option| (*option).to_owned())
                    .collect();
                // Programs on Windows write backslashes.
                map.file.replace('\\', "/")
            }
            None if statement.rest.is_empty() => {
                return Err(format!("{keyword} names no material; give it a name"));
            }
            None => {
                statement.check_name()?;
                statement.rest.to_owned()
            }
        };
        Ok(Self {
            path: path.to_owned(),
            line: statement.line,
            text,
            numbers: Vec::new(),
            mapping,
            unread,
        })
    }
}

impl Statements {
    /// Takes the numbers that tobj read, and checks them.
    pub(super) fn read_numbers(&mut self, material: &tobj::Material) -> Result<(), SceneError> {
        for (keyword, stated) in &mut self.0 {
            let fail = |reason| SceneError::at_line(&stated.path, stated.line, reason);
            let statement = Statement {
                line: stated.line,
                keyword,
                rest: &stated.text,
            };
            stated.numbers = read_numbers(material, &statement).map_err(fail)?;
        }
        Ok(())
    }

    /// The numbers after a keyword.
    fn numbers(&self, keyword: &str) -> Option<&[f32]> {
        self.0.get(keyword).map(|stated| stated.numbers.as_slice())
    }

    /// The number after a keyword.
    fn number(&self, keyword: &str) -> Option<f32> {
        self.numbers(keyword)?.first().copied()
    }

    /// Makes an error about a statement that there is.
    fn error(&self, keyword: &str, reason: String) -> SceneError {
        let Stated { path, line, .. } = &self.0[keyword];
        SceneError::at_line(path, *line, reason)
    }

    pub(super) fn build(
        &self,
        material: &tobj::Material,
        files: &mut Files,
        textures: &mut Textures,
    ) -> Result<Material, SceneError> {
        self.check_transparency()
            .map_err(|reason| self.error("Tr", reason))?;
        let mut texture = |keyword, file: Option<&String>, usage| {
            let Some(file) = file else {
                return Ok(None);
            };
            let path = self.0[keyword].path.with_file_name("").join(file);
            let index = textures.load(files, &path, usage);
            index
                .map(Some)
                .map_err(|reason| self.error(keyword, reason))
        };
        let diffuse_texture = texture("map_Kd", material.diffuse_texture.as_ref(), Use::Color)?;
        let emission_file = material.unknown_param.get("map_Ke");
        let emission_texture = texture("map_Ke", emission_file, Use::Color)?;
        let opacity_texture = texture("map_d", material.dissolve_texture.as_ref(), Use::Opacity)?;
        let color = |keyword, default| {
            let numbers = self.numbers(keyword);
            numbers.map_or(Vec3::splat(default), Vec3::from_slice)
        };
        let finish = FinishValues {
            roughness: self.number("Pr"),
            metallic: self.number("Pm") == Some(1.0),
            index: self.number("Ni"),
        };
        let is_glass = self.number("illum") == Some(GLASS_MODEL);
        Ok(Material {
            name: material.name.clone(),
            finish: (finish.build(FINISH))
                .map_err(|(wrong, reason)| self.error(FINISH[wrong], reason))?,
            // A texture alone is shown as it is.
            diffuse: color("Kd", diffuse_texture.map_or(DEFAULT_ALBEDO, |_| 1.0)),
            diffuse_texture,
            emission: color("Ke", emission_texture.map_or(0.0, |_| 1.0)),
            emission_texture,
            opacity: self.number("d").unwrap_or(1.0),
            opacity_texture,
            translucency: Some(Translucency {
                filter: color("Tf", 1.0),
                glass: is_glass.then(|| self.number("Ni").unwrap_or(GLASS)),
                ..Translucency::CLEAR
            }),
        })
    }

    /// Refuses a Tr that contradicts d.
    fn check_transparency(&self) -> Result<(), String> {
        match (self.number("Tr"), self.number("d")) {
            (None | Some(0.0), _) => Ok(()),
            (Some(_), None) => Err(
                "Tr is not read, since programs disagree about its meaning; write d (1 is opaque)"
                    .into(),
            ),
            (Some(transparency), Some(opacity)) => {
                let allowed = 1.0 - opacity;
                if (transparency - allowed).abs() > SAME_TRANSPARENCY {
                    Err(format!(
                        "Tr is {transparency} next to d {opacity}; allowed: 1 - d, here {allowed}; delete Tr"
                    ))
                } else {
                    Ok(())
                }
            }
        }
    }
}

/// Returns how many numbers a statement holds; none for other statements than those of numbers.
pub(super) fn number_count(keyword: &str) -> Option<usize> {
    match keyword {
        "Kd" | "Ke" | "Tf" => Some(3),
        "d" | "Pr" | "Pm" | "Ni" | "Tr" => Some(1),
        _ => None,
    }
}

/// Takes the numbers of a statement from what tobj read, and checks them.
fn read_numbers(material: &tobj::Material, statement: &Statement) -> Result<Vec<f32>, String> {
    let keyword = statement.keyword;
    let read = match keyword {
        "Kd" => material.diffuse.map(Vec::from),
        "Ke" => material.emissive.map(Vec::from),
        "d" => material.dissolve.map(|opacity| vec![opacity]),
        "Ni" => material.optical_density.map(|index| vec![index]),
        "illum" => material
            .illumination_model
            .map(|model| vec![f32::from(model)]),
        // tobj keeps what it does not know as text.
        _ => None,
    };
    let is_allowed = |number: &f32| f64::from(number.abs()) <= LARGEST_NUMBER;
    let numbers = match (read, number_count(keyword)) {
        (Some(numbers), _) if numbers.iter().all(is_allowed) => numbers,
        (_, Some(count)) => statement.read_first_numbers(count)?,
        (_, None) => Vec::new(),
    };
    let checked = match (keyword, numbers.as_slice()) {
        ("Kd" | "Tf", &[r, g, b]) => check_albedo([r, g, b]),
        ("Ke", &[r, g, b]) => check_radiance([r, g, b]),
        ("d", [opacity]) if !(0.0..=1.0).contains(opacity) => {
            Err(format!("{opacity}; allowed: 0 to 1"))
        }
        ("Pm", [metallic]) if ![0.0, 1.0].contains(metallic) => Err(format!(
            "{metallic}; allowed: 0 (paint, wood, plastic) or 1 (bare metal), nothing between"
        )),
        _ => Ok(()),
    };
    checked.map_err(|reason| format!("{keyword} is {reason}"))?;
    Ok(numbers)
}
