//! MTL files: the statements that describe diffuse, glossy, emissive and cut-out surfaces. All others are passed over.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use glam::Vec3;

use super::error::{SceneError, list};
use super::files::Files;
use super::finish::{Number, Numbers};
use super::light::{amiss_in_albedo, amiss_in_radiance};
use super::statements::{Statement, shown, statements};
use super::texture::{Textures, Use};
use crate::limits::{LARGEST_MATERIAL_FILE, MOST_MATERIALS};
use crate::{Finish, Material};

/// Albedo of faces without a material, and of materials that name neither Kd nor map_Kd.
const DEFAULT_ALBEDO: f32 = 0.5;

/// Name of the material of faces that have none.
pub(super) const DEFAULT_NAME: &str = "default";

/// The MTL files of one OBJ file.
#[derive(Default)]
pub(super) struct Libraries {
    /// By name as the OBJ file writes it: the statements that matter, which tobj can read without fail.
    pub(super) texts: BTreeMap<PathBuf, String>,
    /// Where a material's statement stands; `newmtl` is where the material begins.
    places: BTreeMap<(String, &'static str), (PathBuf, usize)>,
    /// The number of a material's statement, of those that tobj does not read.
    numbers: BTreeMap<(String, &'static str), f32>,
}

/// Statements that are read. tobj panics on colours of fewer than three numbers, so it gets only checked ones.
const KEYWORDS: [&str; 10] = [
    "newmtl", "Kd", "Ke", "d", "map_Kd", "map_Ke", "map_d", "Pr", "Pm", "Ni",
];

/// Statements that hold a name.
const NAMES: [&str; 4] = ["newmtl", "map_Kd", "map_Ke", "map_d"];

/// Statements about the finish: roughness, metallic, index of refraction.
const FINISH: [&str; 3] = ["Pr", "Pm", "Ni"];

/// The surface of faces without a material.
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
    }
}

impl Libraries {
    /// Reads and checks one file; `path` is where it lies, `name` how the OBJ file calls it. The outer error is the
    /// reason why it cannot be read at all, for the caller knows the place that names the file.
    pub(super) fn add(
        &mut self,
        files: &mut Files,
        path: &Path,
        name: &str,
    ) -> Result<Result<(), SceneError>, String> {
        let text = files.text(path, LARGEST_MATERIAL_FILE)?;
        Ok(self.check(path, &text).map(|checked| {
            self.texts.insert(name.into(), checked);
        }))
    }

    /// Whether one of the files defines a material.
    pub(super) fn defines(&self, material: &str) -> bool {
        self.places.contains_key(&(material.to_owned(), "newmtl"))
    }

    /// Names of all materials, for messages.
    pub(super) fn names(&self) -> String {
        list(
            self.places
                .keys()
                .filter(|(_, keyword)| *keyword == "newmtl")
                .map(|(name, _)| name.as_str()),
        )
    }

    fn check(&mut self, path: &Path, text: &str) -> Result<String, SceneError> {
        let mut checked = String::new();
        let mut current: Option<&str> = None;
        let mut materials = 0;
        for statement in statements(text) {
            let fail = |reason| SceneError::line(path, statement.line, reason);
            if statement.keyword == "newmtl" {
                current = Some(statement.rest);
                materials += 1;
                if materials > MOST_MATERIALS {
                    return Err(fail(format!(
                        "the file has more than {MOST_MATERIALS} materials; leave out those that no mesh uses"
                    )));
                }
            }
            let amiss = amiss_in_statement(&statement);
            amiss.map_or(Ok(()), |reason| Err(fail(reason)))?;
            let Some(keyword) = KEYWORDS.into_iter().find(|k| *k == statement.keyword) else {
                continue;
            };
            let material = current.ok_or_else(|| {
                fail(format!(
                    "{keyword} stands before the first newmtl; it belongs to no material"
                ))
            })?;
            let place = (path.to_owned(), statement.line);
            if NAMES.contains(&keyword) {
                statement.check_name().map_err(fail)?;
            }
            if let Some((path, line)) = self.places.insert((material.to_owned(), keyword), place) {
                return Err(fail(format!(
                    "{keyword} of material \"{material}\" is given again; it stands in {}:{line} already",
                    path.display()
                )));
            }
            if FINISH.contains(&keyword) {
                let number = statement.numbers(&[1]).map_err(fail)?[0];
                self.numbers.insert((material.to_owned(), keyword), number);
            } else {
                checked += &format!("{keyword} {}\n", statement.rest);
            }
        }
        Ok(checked)
    }

    /// A material as tobj read it, with its textures.
    pub(super) fn material(
        &self,
        files: &mut Files,
        textures: &mut Textures,
        read: &tobj::Material,
    ) -> Result<Material, SceneError> {
        let mut texture = |keyword, name: Option<&str>, usage| {
            let Some(name) = name else { return Ok(None) };
            let (library, line) = &self.places[&(read.name.clone(), keyword)];
            // Programs on Windows write their own separator.
            let path = library.with_file_name("").join(name.replace('\\', "/"));
            let index = textures.load(files, &path, usage);
            index
                .map(Some)
                .map_err(|reason| SceneError::line(library, *line, reason))
        };
        let map_emission = read.unknown_param.get("map_Ke").map(String::as_str);
        let diffuse_texture = texture("map_Kd", read.diffuse_texture.as_deref(), Use::Color)?;
        let emission_texture = texture("map_Ke", map_emission, Use::Color)?;
        let opacity_texture = texture("map_d", read.dissolve_texture.as_deref(), Use::Opacity)?;
        // A texture without its factor is meant to be seen as it is.
        let default_albedo = diffuse_texture.map_or(DEFAULT_ALBEDO, |_| 1.0);
        let default_emission = emission_texture.map_or(0.0, |_| 1.0);
        Ok(Material {
            name: read.name.clone(),
            finish: self.finish(&read.name)?,
            diffuse: Vec3::from(read.diffuse.unwrap_or([default_albedo; 3])),
            diffuse_texture,
            emission: Vec3::from(read.emissive.unwrap_or([default_emission; 3])),
            emission_texture,
            opacity: read.dissolve.unwrap_or(1.0),
            opacity_texture,
        })
    }

    fn finish(&self, material: &str) -> Result<Finish, SceneError> {
        let number = |keyword| self.numbers.get(&(material.to_owned(), keyword)).copied();
        let [roughness, metallic, index] = FINISH.map(number);
        let numbers = Numbers {
            roughness,
            metallic: metallic == Some(1.0),
            index,
        };
        numbers.finish().map_err(|(number, reason)| {
            let keyword = match number {
                Number::Roughness => "Pr",
                Number::Metallic => "Pm",
                Number::Index => "Ni",
            };
            let (path, line) = &self.places[&(material.to_owned(), keyword)];
            SceneError::line(path, *line, format!("{keyword} {reason}"))
        })
    }
}

/// What is wrong with a statement, if anything.
fn amiss_in_statement(statement: &Statement) -> Option<String> {
    let triple = |amiss: fn([f32; 3]) -> Option<String>| match statement.numbers(&[3]) {
        Ok(numbers) => amiss([numbers[0], numbers[1], numbers[2]])
            .map(|reason| format!("{} {reason}", statement.keyword)),
        Err(reason) => Some(reason),
    };
    let single = || statement.numbers(&[1]).map(|numbers| numbers[0]);
    match statement.keyword {
        "newmtl" if statement.rest.is_empty() => Some("newmtl names no material".into()),
        "Kd" => triple(amiss_in_albedo),
        "Ke" => triple(amiss_in_radiance),
        "d" => match single() {
            Ok(opacity) if (0.0..=1.0).contains(&opacity) => None,
            Ok(opacity) => Some(format!("d is {opacity}; allowed: 0 to 1")),
            Err(reason) => Some(reason),
        },
        "Pm" => match single() {
            Ok(0.0 | 1.0) => None,
            Ok(metallic) => Some(format!(
                "Pm is {metallic}; allowed: 0 (paint, wood, plastic) or 1 (bare metal), nothing between"
            )),
            Err(reason) => Some(reason),
        },
        "Tr" => match single() {
            Ok(0.0) => None,
            _ => Some(
                "Tr is not read, for programs disagree about its sense; write d (1 is opaque)"
                    .into(),
            ),
        },
        "map_Kd" | "map_Ke" | "map_d" if statement.rest.is_empty() => {
            Some(format!("{} names no file", statement.keyword))
        }
        "map_Kd" | "map_Ke" | "map_d" if statement.rest.starts_with('-') => Some(format!(
            "{} has options (\"{}\"); allowed: the name of a file alone",
            statement.keyword,
            shown(statement.rest)
        )),
        _ => None,
    }
}
