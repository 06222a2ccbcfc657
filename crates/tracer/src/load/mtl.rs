//! Materials from MTL files: diffuse, glossy, emissive, cut-out and translucent surfaces. Other statements are skipped.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use glam::Vec3;

use super::error::{SceneError, join_names};
use super::files::Files;
use super::finish::{FinishValue, FinishValues};
use super::light::{check_albedo, check_radiance};
use super::statements::{Statement, shorten, split_statements};
use super::texture::{Textures, Use};
use super::translucency::GLASS;
use crate::limits::{LARGEST_MATERIAL_FILE, MOST_MATERIALS};
use crate::{Finish, Material, Translucency};

/// Albedo of faces without a material, and of materials with neither Kd nor map_Kd.
const DEFAULT_ALBEDO: f32 = 0.5;

/// Name of the material of faces without one.
const DEFAULT_NAME: &str = "default";

/// The MTL files of one OBJ file.
#[derive(Default)]
pub(super) struct Libraries {
    /// Checked statements for tobj, by name as the OBJ file writes it.
    pub(super) texts: BTreeMap<PathBuf, String>,
    /// Place of each statement, by material and keyword; a material begins at its `newmtl`.
    places: BTreeMap<(String, &'static str), (PathBuf, usize)>,
    /// Numbers of statements that tobj does not read, by material and keyword.
    numbers: BTreeMap<(String, &'static str), f32>,
    /// Colour of what passes each material (Tf).
    filters: BTreeMap<String, Vec3>,
}

/// Statements that are read. tobj gets them checked: it panics on colours of fewer than three numbers.
const KEYWORDS: [&str; 13] = [
    "newmtl", "Kd", "Ke", "d", "map_Kd", "map_Ke", "map_d", "Pr", "Pm", "Ni", "Tf", "Tr", "illum",
];

/// Statements that hold a name.
const NAMES: [&str; 4] = ["newmtl", "map_Kd", "map_Ke", "map_d"];

/// Statements about the finish: roughness, metallic, index of refraction.
const FINISH: [&str; 3] = ["Pr", "Pm", "Ni"];

/// Statements that tobj is not given, beside those about the finish: colour of what passes, transparency, illumination model.
const PASSING: [&str; 3] = ["Tf", "Tr", "illum"];

/// Illumination model of glass: "Transparency: Glass on, Reflection: Ray trace on".
const GLASS_MODEL: f32 = 4.0;
/// Largest difference between a Tr and 1 - d, by rounding of decimals.
const SAME_TRANSPARENCY: f32 = 1e-3;

/// Material of faces without one.
pub(super) fn default_material() -> Material {
    Material {
        name: DEFAULT_NAME.into(),
        finish: Finish::Diffuse,
        diffuse: Vec3::splat(DEFAULT_ALBEDO),
        diffuse_texture: None,
        emission: Vec3::ZERO,
        emission_texture: None,
        opacity: 1.0,
        opacity_texture: None,
        translucency: None,
    }
}

impl Libraries {
    /// Reads and checks a file, which the OBJ file calls `name`. The outer error says why it cannot be read; the caller
    /// knows the line that names it.
    pub(super) fn add(
        &mut self,
        files: &mut Files,
        path: &Path,
        name: &str,
    ) -> Result<Result<(), SceneError>, String> {
        let text = files.read_text(path, LARGEST_MATERIAL_FILE)?;
        Ok(self.check(path, &text).map(|checked| {
            self.texts.insert(name.into(), checked);
        }))
    }

    /// Tells whether one of the files defines a material.
    pub(super) fn defines(&self, material: &str) -> bool {
        self.places.contains_key(&(material.to_owned(), "newmtl"))
    }

    /// Lists the names of all materials, for messages.
    pub(super) fn list_names(&self) -> String {
        join_names(
            self.places
                .keys()
                .filter(|(_, keyword)| *keyword == "newmtl")
                .map(|(name, _)| name.as_str()),
        )
    }

    fn check(&mut self, path: &Path, text: &str) -> Result<String, SceneError> {
        let mut checked = String::new();
        let mut transparencies = Vec::new();
        let mut current: Option<&str> = None;
        let mut materials = 0;
        for statement in split_statements(text) {
            let fail = |reason| SceneError::at_line(path, statement.line, reason);
            if statement.keyword == "newmtl" {
                current = Some(statement.rest);
                materials += 1;
                if materials > MOST_MATERIALS {
                    return Err(fail(format!(
                        "the file has more than {MOST_MATERIALS} materials; leave out those that no mesh uses"
                    )));
                }
            }
            check_statement(&statement).map_err(fail)?;
            let Some(keyword) = KEYWORDS.into_iter().find(|k| *k == statement.keyword) else {
                continue;
            };
            let material = current.ok_or_else(|| {
                fail(format!(
                    "{keyword} stands before the first newmtl; move it below the newmtl of its material"
                ))
            })?;
            let place = (path.to_owned(), statement.line);
            if NAMES.contains(&keyword) {
                statement.check_name().map_err(fail)?;
            }
            if let Some((path, line)) = self.places.insert((material.to_owned(), keyword), place) {
                return Err(fail(format!(
                    "{keyword} of material \"{material}\" is given twice, first in {}:{line}; delete one",
                    path.display()
                )));
            }
            if keyword == "Tf" {
                let numbers = statement.read_numbers(&[3]).map_err(fail)?;
                let filter = Vec3::from_slice(&numbers);
                self.filters.insert(material.to_owned(), filter);
            } else if PASSING.contains(&keyword) {
                // Programs write words for illum too, which are ignored as other models are.
                let number = statement
                    .read_numbers(&[1])
                    .map_or(0.0, |numbers| numbers[0]);
                self.numbers.insert((material.to_owned(), keyword), number);
                if keyword == "Tr" {
                    transparencies.push((statement.line, material.to_owned()));
                }
            } else if FINISH.contains(&keyword) {
                let number = statement.read_numbers(&[1]).map_err(fail)?[0];
                self.numbers.insert((material.to_owned(), keyword), number);
            } else {
                checked += &format!("{keyword} {}\n", statement.rest);
                if keyword == "d" {
                    let number = statement.read_numbers(&[1]).map_err(fail)?[0];
                    self.numbers.insert((material.to_owned(), keyword), number);
                }
            }
        }
        for (line, material) in transparencies {
            self.check_transparency(&material)
                .map_err(|reason| SceneError::at_line(path, line, reason))?;
        }
        Ok(checked)
    }

    /// Refuses a Tr that does not say what the material's d says.
    fn check_transparency(&self, material: &str) -> Result<(), String> {
        let number = |keyword| self.numbers.get(&(material.to_owned(), keyword)).copied();
        match (number("Tr"), number("d")) {
            (None | Some(0.0), _) => Ok(()),
            (Some(_), None) => Err(
                "Tr is not read, since programs disagree about its meaning; write d (1 is opaque)"
                    .into(),
            ),
            (Some(transparency), Some(opacity))
                if (transparency - (1.0 - opacity)).abs() > SAME_TRANSPARENCY =>
            {
                let allowed = 1.0 - opacity;
                Err(format!(
                    "Tr is {transparency} beside d {opacity}; allowed: 1 - d, here {allowed}; delete Tr"
                ))
            }
            _ => Ok(()),
        }
    }

    /// Builds what a material asks for where its opacity is blended.
    fn build_translucency(&self, material: &str) -> Translucency {
        let number = |keyword| self.numbers.get(&(material.to_owned(), keyword)).copied();
        let is_glass = number("illum") == Some(GLASS_MODEL);
        Translucency {
            filter: self.filters.get(material).copied().unwrap_or(Vec3::ONE),
            glass: is_glass.then(|| number("Ni").unwrap_or(GLASS)),
            ..Translucency::CLEAR
        }
    }

    /// Builds a material from what tobj read, with its textures.
    pub(super) fn build_material(
        &self,
        files: &mut Files,
        textures: &mut Textures,
        read: &tobj::Material,
    ) -> Result<Material, SceneError> {
        let mut texture = |keyword, name: Option<&str>, usage| {
            let Some(name) = name else { return Ok(None) };
            let (library, line) = &self.places[&(read.name.clone(), keyword)];
            // Programs on Windows write backslashes.
            let path = library.with_file_name("").join(name.replace('\\', "/"));
            let index = textures.load(files, &path, usage);
            index
                .map(Some)
                .map_err(|reason| SceneError::at_line(library, *line, reason))
        };
        let map_emission = read.unknown_param.get("map_Ke").map(String::as_str);
        let diffuse_texture = texture("map_Kd", read.diffuse_texture.as_deref(), Use::Color)?;
        let emission_texture = texture("map_Ke", map_emission, Use::Color)?;
        let opacity_texture = texture("map_d", read.dissolve_texture.as_deref(), Use::Opacity)?;
        // A texture alone is shown as it is.
        let default_albedo = diffuse_texture.map_or(DEFAULT_ALBEDO, |_| 1.0);
        let default_emission = emission_texture.map_or(0.0, |_| 1.0);
        Ok(Material {
            name: read.name.clone(),
            finish: self.build_finish(&read.name)?,
            diffuse: Vec3::from(read.diffuse.unwrap_or([default_albedo; 3])),
            diffuse_texture,
            emission: Vec3::from(read.emissive.unwrap_or([default_emission; 3])),
            emission_texture,
            opacity: read.dissolve.unwrap_or(1.0),
            opacity_texture,
            translucency: Some(self.build_translucency(&read.name)),
        })
    }

    fn build_finish(&self, material: &str) -> Result<Finish, SceneError> {
        let number = |keyword| self.numbers.get(&(material.to_owned(), keyword)).copied();
        let [roughness, metallic, index] = FINISH.map(number);
        let values = FinishValues {
            roughness,
            metallic: metallic == Some(1.0),
            index,
        };
        values.build().map_err(|(value, reason)| {
            let keyword = match value {
                FinishValue::Roughness => "Pr",
                FinishValue::Metallic => "Pm",
                FinishValue::Index => "Ni",
            };
            let (path, line) = &self.places[&(material.to_owned(), keyword)];
            SceneError::at_line(path, *line, format!("{keyword} {reason}"))
        })
    }
}

/// Checks the values of a statement.
fn check_statement(statement: &Statement) -> Result<(), String> {
    let keyword = statement.keyword;
    let rest = statement.rest;
    let check_triple = |check: fn([f32; 3]) -> Result<(), String>| {
        let numbers = statement.read_numbers(&[3])?;
        check([numbers[0], numbers[1], numbers[2]]).map_err(|reason| format!("{keyword} {reason}"))
    };
    let read_one = || statement.read_numbers(&[1]).map(|numbers| numbers[0]);
    match keyword {
        "newmtl" if rest.is_empty() => Err("newmtl names no material; give it a name".into()),
        "Kd" => check_triple(check_albedo),
        "Ke" => check_triple(check_radiance),
        "d" => match read_one()? {
            opacity if (0.0..=1.0).contains(&opacity) => Ok(()),
            opacity => Err(format!("d is {opacity}; allowed: 0 to 1")),
        },
        "Pm" => match read_one()? {
            0.0 | 1.0 => Ok(()),
            metallic => Err(format!(
                "Pm is {metallic}; allowed: 0 (paint, wood, plastic) or 1 (bare metal), nothing between"
            )),
        },
        "Tf" => check_triple(check_albedo),
        "Tr" => read_one().map(|_| ()),
        "map_Kd" | "map_Ke" | "map_d" if rest.is_empty() => {
            Err(format!("{keyword} names no file; give it one"))
        }
        "map_Kd" | "map_Ke" | "map_d" if rest.starts_with('-') => Err(format!(
            "{keyword} has options (\"{}\"); allowed: a file name alone",
            shorten(rest)
        )),
        _ => Ok(()),
    }
}
