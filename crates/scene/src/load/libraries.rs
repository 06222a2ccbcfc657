//! The MTL files of an OBJ file. tobj reads them; what it read is checked.

use std::collections::{BTreeSet, HashMap};
use std::path::Path;

use super::error::{SceneError, join_names};
use super::files::Files;
use super::map_options::Mapping;
use super::mtl::{MAPS, Stated, Statements, number_count};
use super::statements::{Statement, clean_text, shorten, split_statements};
use super::texture::Textures;
use crate::Material;
use crate::limits::{LARGEST_MATERIAL_FILE, MAX_MATERIALS};

/// Statements that are read; others are skipped.
const KEYWORDS: [&str; 13] = [
    "newmtl", "Kd", "Ke", "d", "map_Kd", "map_Ke", "map_d", "Pr", "Pm", "Ni", "Tf", "Tr", "illum",
];

/// The MTL files of one OBJ file.
#[derive(Default)]
pub(super) struct Libraries {
    /// Materials of all files, as tobj reads them.
    materials: Vec<tobj::Material>,
    /// Statements of each material.
    statements: Vec<Statements>,
    /// Indices of materials by name.
    indices: HashMap<String, usize>,
    /// Sentences about what was not read.
    pub(super) notes: Vec<String>,
}

impl Libraries {
    /// Reads the files that the `mtllib` statements of an OBJ file name, each once.
    pub(super) fn read(
        files: &mut Files,
        obj: &Path,
        statements: &[Statement],
    ) -> Result<Self, SceneError> {
        let mut libraries = Self::default();
        let mut seen = BTreeSet::new();
        for statement in statements {
            // Programs on Windows write backslashes.
            let text = statement.rest.replace('\\', "/");
            for name in library_names(files, obj, &text) {
                let path = obj.with_file_name("").join(name);
                if !seen.insert(path.clone()) {
                    continue;
                }
                let text = files
                    .read_text(&path, LARGEST_MATERIAL_FILE)
                    .map_err(|error| {
                        let name = path.display();
                        let reason = format!("material library {name} cannot be read: {error}");
                        SceneError::at_line(obj, statement.line, reason)
                    })?;
                libraries.add(&path, &clean_text(&text))?;
            }
        }
        Ok(libraries)
    }

    /// The materials for tobj, with their indices by name.
    pub(super) fn loaded(&self) -> tobj::MTLLoadResult {
        Ok((self.materials.clone(), self.indices.clone()))
    }

    /// Refuses `usemtl` statements of an OBJ file that name unknown materials.
    pub(super) fn check_materials<'a>(
        &self,
        obj: &Path,
        statements: impl Iterator<Item = &'a Statement<'a>>,
    ) -> Result<(), SceneError> {
        let unknown = statements.filter(|statement| !self.indices.contains_key(statement.rest));
        let Some(statement) = unknown.min_by_key(|statement| statement.line) else {
            return Ok(());
        };
        let names: BTreeSet<&str> = self.indices.keys().map(String::as_str).collect();
        let reason = format!(
            "usemtl names material \"{}\", which no mtllib defines; materials: {}",
            shorten(statement.rest),
            join_names(names)
        );
        Err(SceneError::at_line(obj, statement.line, reason))
    }

    /// Returns how a material's textures change texture coordinates.
    pub(super) fn mapping(&self, material: usize) -> Result<Mapping, SceneError> {
        let Statements(stated) = &self.statements[material];
        let mut maps = MAPS
            .iter()
            .filter_map(|keyword| stated.get_key_value(keyword));
        let Some((first, Stated { mapping, .. })) = maps.next() else {
            return Ok(Mapping::NONE);
        };
        match maps.find(|(_, map)| map.mapping != *mapping) {
            None => Ok(*mapping),
            Some((keyword, map)) => {
                let reason = format!(
                    "{keyword} has other options -s and -o than {first}; allowed: the same for all textures of a material"
                );
                Err(SceneError::at_line(&map.path, map.line, reason))
            }
        }
    }

    /// Builds all materials, with their textures.
    pub(super) fn build_materials(
        &self,
        files: &mut Files,
        textures: &mut Textures,
    ) -> Result<Vec<Material>, SceneError> {
        let materials = self.materials.iter().zip(&self.statements);
        materials
            .map(|(material, statements)| statements.build(material, files, textures))
            .collect()
    }

    /// Adds the materials of a file.
    fn add(&mut self, path: &Path, text: &str) -> Result<(), SceneError> {
        let start = self.statements.len();
        let mut for_tobj = String::new();
        for statement in split_statements(text) {
            let Some(keyword) = KEYWORDS.into_iter().find(|k| *k == statement.keyword) else {
                continue;
            };
            let fail = |reason| SceneError::at_line(path, statement.line, reason);
            let stated = Stated::read(keyword, &statement, path).map_err(fail)?;
            let place = format!("{}:{}", path.display(), statement.line);
            let unread = stated.unread.iter();
            self.notes.extend(
                unread.map(|option| format!("{place}: {keyword}'s option {option} is not read")),
            );
            for_tobj += &format!("{keyword} {}\n", stated.text);
            self.insert(keyword, stated, start).map_err(fail)?;
        }
        let loaded = tobj::load_mtl_buf(&mut for_tobj.as_bytes());
        let (materials, _) = loaded.map_err(|_| find_fault(path, text))?;
        for (material, statements) in materials.iter().zip(&mut self.statements[start..]) {
            statements.read_numbers(material)?;
        }
        self.materials.extend(materials);
        Ok(())
    }

    /// Adds a statement to the last material of a file, whose materials begin at `start`.
    fn insert(
        &mut self,
        keyword: &'static str,
        stated: Stated,
        start: usize,
    ) -> Result<(), String> {
        let refuse_second = |material: &str, first: &Stated| {
            Err(format!(
                "{keyword} of material \"{material}\" is given twice, first in {}:{}; delete one",
                first.path.display(),
                first.line
            ))
        };
        let index = self.statements.len();
        if keyword == "newmtl" {
            if index - start == MAX_MATERIALS {
                return Err(format!(
                    "the file has more than {MAX_MATERIALS} materials; leave out those that no mesh uses"
                ));
            }
            if let Some(first) = self.indices.insert(stated.text.clone(), index) {
                return refuse_second(&stated.text, &self.statements[first].0[keyword]);
            }
            self.statements.push(Statements::default());
        }
        let Some(Statements(material)) = self.statements[start..].last_mut() else {
            return Err(format!(
                "{keyword} comes before the first newmtl; move it below the newmtl of its material"
            ));
        };
        if let Some(first) = material.get(keyword) {
            return refuse_second(&material["newmtl"].text, first);
        }
        material.insert(keyword, stated);
        Ok(())
    }
}

/// Lists the files that a `mtllib` names. Names may have blanks: several files are taken only if
/// one with the whole name cannot be read.
fn library_names<'a>(files: &mut Files, obj: &Path, text: &'a str) -> Vec<&'a str> {
    let ends = text.match_indices(char::is_whitespace).map(|(end, _)| end);
    let is_end = |end: &usize| {
        let extension = end.checked_sub(4).and_then(|start| text.get(start..*end));
        extension.is_some_and(|extension| extension.eq_ignore_ascii_case(".mtl"))
    };
    let ends: Vec<usize> = ends.filter(is_end).chain([text.len()]).collect();
    let whole = obj.with_file_name("").join(text);
    if ends.len() == 1 || files.read_text(&whole, LARGEST_MATERIAL_FILE).is_ok() {
        return vec![text];
    }
    let starts = [0].into_iter().chain(ends.clone());
    starts
        .zip(ends)
        .map(|(start, end)| text[start..end].trim())
        .collect()
}

/// Finds the first number that tobj could not read.
fn find_fault(path: &Path, text: &str) -> SceneError {
    for statement in split_statements(text) {
        if let Some(count) = number_count(statement.keyword)
            && let Err(reason) = statement.read_first_numbers(count)
        {
            return SceneError::at_line(path, statement.line, reason);
        }
    }
    SceneError::in_file(
        path,
        "is no MTL file that can be read; export the materials again",
    )
}
