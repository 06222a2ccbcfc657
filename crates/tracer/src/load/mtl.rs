//! Materials from MTL files: diffuse, glossy, emissive, cut-out and translucent surfaces. Other statements are skipped.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use glam::Vec3;

use super::error::{SceneError, join_names};
use super::files::Files;
use super::finish::FinishValues;
use super::light::{check_albedo, check_radiance};
use super::statements::{Statement, shorten, split_statements};
use super::texture::{Textures, Use};
use super::translucency::GLASS;
use crate::limits::MAX_MATERIALS;
use crate::{Material, Translucency};

/// Albedo of faces without a material, and of materials with neither Kd nor map_Kd.
const DEFAULT_ALBEDO: f32 = 0.5;

/// Name of the material of faces without one.
const DEFAULT_NAME: &str = "default";

/// Statements that are read.
const KEYWORDS: [&str; 13] = [
    "newmtl", "Kd", "Ke", "d", "map_Kd", "map_Ke", "map_d", "Pr", "Pm", "Ni", "Tf", "Tr", "illum",
];

/// Statements of roughness, metallic and index of refraction.
const FINISH: [&str; 3] = ["Pr", "Pm", "Ni"];

/// Illumination model of glass: "Transparency: Glass on, Reflection: Ray trace on".
const GLASS_MODEL: f32 = 4.0;
/// Largest difference between a Tr and 1 - d, by rounding of decimals.
const SAME_TRANSPARENCY: f32 = 1e-3;

/// The MTL files of one OBJ file.
#[derive(Default)]
pub(super) struct Libraries {
    /// Materials by name.
    materials: BTreeMap<String, Statements>,
}

/// Statements of a material, by keyword.
#[derive(Default)]
struct Statements(BTreeMap<&'static str, Stated>);

/// Statement that has been checked.
struct Stated {
    path: PathBuf,
    line: usize,
    /// Numbers; empty for a name, and for words in the place of a number that may be ignored.
    numbers: Vec<f32>,
    /// Text after the keyword.
    text: String,
}

/// Material of faces without one.
pub(super) fn default_material() -> Material {
    Material {
        name: DEFAULT_NAME.into(),
        diffuse: Vec3::splat(DEFAULT_ALBEDO),
        ..Material::default()
    }
}

impl Libraries {
    /// Returns whether one of the files defines a material.
    pub(super) fn defines(&self, material: &str) -> bool {
        self.materials.contains_key(material)
    }

    /// Lists the names of all materials, for messages.
    pub(super) fn list_names(&self) -> String {
        join_names(self.materials.keys().map(String::as_str))
    }

    /// Builds all materials, with their textures.
    pub(super) fn build_materials(
        &self,
        files: &mut Files,
        textures: &mut Textures,
    ) -> Result<BTreeMap<String, Material>, SceneError> {
        let materials = self.materials.iter();
        materials
            .map(|(name, own)| Ok((name.clone(), own.build(name, files, textures)?)))
            .collect()
    }

    /// Reads and checks the text of a file.
    pub(super) fn read(&mut self, path: &Path, text: &str) -> Result<(), SceneError> {
        let mut current = None;
        let mut materials = 0;
        for statement in split_statements(text) {
            let fail = |reason| SceneError::at_line(path, statement.line, reason);
            let Some(keyword) = KEYWORDS.into_iter().find(|k| *k == statement.keyword) else {
                continue;
            };
            let numbers = read_values(&statement).map_err(fail)?;
            if keyword == "newmtl" {
                current = Some(statement.rest);
                materials += 1;
                if materials > MAX_MATERIALS {
                    return Err(fail(format!(
                        "the file has more than {MAX_MATERIALS} materials; leave out those that no mesh uses"
                    )));
                }
            }
            let material = current.ok_or_else(|| {
                fail(format!(
                    "{keyword} comes before the first newmtl; move it below the newmtl of its material"
                ))
            })?;
            let stated = Stated {
                path: path.to_owned(),
                line: statement.line,
                numbers,
                text: statement.rest.to_owned(),
            };
            let own = self.materials.entry(material.to_owned()).or_default();
            if let Some(first) = own.0.insert(keyword, stated) {
                return Err(fail(format!(
                    "{keyword} of material \"{material}\" is given twice, first in {}:{}; delete one",
                    first.path.display(),
                    first.line
                )));
            }
        }
        Ok(())
    }
}

impl Statements {
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

    fn build(
        &self,
        name: &str,
        files: &mut Files,
        textures: &mut Textures,
    ) -> Result<Material, SceneError> {
        self.check_transparency()
            .map_err(|reason| self.error("Tr", reason))?;
        let mut texture = |keyword, usage| {
            let Some(stated) = self.0.get(keyword) else {
                return Ok(None);
            };
            // Programs on Windows write backslashes.
            let name = stated.text.replace('\\', "/");
            let index = textures.load(files, &stated.path.with_file_name("").join(name), usage);
            index
                .map(Some)
                .map_err(|reason| self.error(keyword, reason))
        };
        let diffuse_texture = texture("map_Kd", Use::Color)?;
        let emission_texture = texture("map_Ke", Use::Color)?;
        let opacity_texture = texture("map_d", Use::Opacity)?;
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
            name: name.to_owned(),
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
                match (transparency - allowed).abs() > SAME_TRANSPARENCY {
                    false => Ok(()),
                    true => Err(format!(
                        "Tr is {transparency} next to d {opacity}; allowed: 1 - d, here {allowed}; delete Tr"
                    )),
                }
            }
        }
    }
}

/// Reads the numbers of a statement, and checks its values.
fn read_values(statement: &Statement) -> Result<Vec<f32>, String> {
    let Statement { keyword, rest, .. } = *statement;
    let numbers = match keyword {
        "Kd" | "Ke" | "Tf" => statement.read_numbers(&[3])?,
        "d" | "Pr" | "Pm" | "Ni" | "Tr" => statement.read_numbers(&[1])?,
        // Programs write words too, which are ignored as other models are.
        "illum" => statement.read_numbers(&[1]).unwrap_or_default(),
        _ => Vec::new(),
    };
    let checked = match (keyword, numbers.as_slice()) {
        ("Kd" | "Tf", &[r, g, b]) => check_albedo([r, g, b]),
        ("Ke", &[r, g, b]) => check_radiance([r, g, b]),
        ("d", [opacity]) if !(0.0..=1.0).contains(opacity) => {
            Err(format!("is {opacity}; allowed: 0 to 1"))
        }
        ("Pm", [metallic]) if ![0.0, 1.0].contains(metallic) => Err(format!(
            "is {metallic}; allowed: 0 (paint, wood, plastic) or 1 (bare metal), nothing between"
        )),
        ("newmtl", _) if rest.is_empty() => Err("names no material; give it a name".into()),
        ("map_Kd" | "map_Ke" | "map_d", _) if rest.is_empty() => {
            Err("names no file; give it one".into())
        }
        ("map_Kd" | "map_Ke" | "map_d", _) if rest.starts_with('-') => Err(format!(
            "has options (\"{}\"); allowed: a file name alone",
            shorten(rest)
        )),
        _ => Ok(()),
    };
    checked.map_err(|reason| format!("{keyword} {reason}"))?;
    if numbers.is_empty() && keyword != "illum" {
        statement.check_name()?;
    }
    Ok(numbers)
}
