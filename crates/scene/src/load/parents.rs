//! The parents of objects: each is above its children in the file.

use std::collections::{HashMap, HashSet};

use toml::Spanned;

use super::error::{Slip, join_names};
use super::schema::ObjectTable;
use crate::Parent;

/// Objects of a scene.toml in the order of the file.
pub(super) struct OrderedObjects<'a> {
    /// Names and tables.
    pub(super) tables: Vec<(&'a Spanned<String>, &'a ObjectTable)>,
    /// Index by name.
    indices: HashMap<&'a str, usize>,
}

impl<'a> OrderedObjects<'a> {
    /// Sorts tables by their place in the file.
    pub(super) fn new(
        tables: impl IntoIterator<Item = (&'a Spanned<String>, &'a ObjectTable)>,
    ) -> Self {
        let mut tables: Vec<_> = tables.into_iter().collect();
        tables.sort_by_key(|(name, _)| name.span().start);
        let indices = (tables.iter().enumerate())
            .map(|(index, (name, _))| (name.get_ref().as_str(), index))
            .collect();
        Self { tables, indices }
    }

    /// Reads the parent of the object at `index`.
    pub(super) fn read_parent(&self, index: usize) -> Result<Parent, Slip> {
        let (name, table) = self.tables[index];
        let name = name.get_ref().as_str();
        let Some(parent) = &table.parent else {
            return Ok(Parent::World);
        };
        let parent_name = parent.get_ref().as_str();
        if parent_name == "camera" {
            return Ok(Parent::Camera);
        }
        let reason = match self.indices.get(parent_name) {
            // Objects above this one have been checked, so that no cycle leads through them.
            Some(above) if *above < index => return Ok(Parent::Object(*above)),
            None => {
                let names = self.tables.iter().map(|(name, _)| name.get_ref().as_str());
                format!(
                    "object \"{name}\" has the parent \"{parent_name}\", which the scene does not have; allowed: \
                     camera, {}",
                    join_names(names.filter(|other| *other != name))
                )
            }
            Some(_) => match self.find_cycle(name, parent) {
                Some(cycle) => format!(
                    "the parents of objects form a cycle: {cycle}; give one of them another parent or none"
                ),
                None => format!(
                    "object \"{name}\" comes before its parent \"{parent_name}\"; move the parent above it"
                ),
            },
        };
        Err(Slip::new(parent.span(), reason))
    }

    /// Follows the parents of an object; returns the path if it meets an object twice: `a -> b ->
    /// a`.
    fn find_cycle(&self, name: &str, parent: &Spanned<String>) -> Option<String> {
        let mut path = vec![name];
        let mut seen = HashSet::from([name]);
        let mut next = Some(parent);
        while let Some(ancestor) = next {
            let ancestor = ancestor.get_ref().as_str();
            path.push(ancestor);
            if !seen.insert(ancestor) {
                return Some(shorten_path(&path));
            }
            let index = self.indices.get(ancestor);
            next = index.and_then(|index| self.tables[*index].1.parent.as_ref());
        }
        None
    }
}

/// Joins both ends of a path, and its middle if that is short.
fn shorten_path(path: &[&str]) -> String {
    const MAX_SHOWN: usize = 16;
    if path.len() <= MAX_SHOWN {
        return path.join(" -> ");
    }
    let [begin, end] = [&path[..MAX_SHOWN / 2], &path[path.len() - MAX_SHOWN / 2..]];
    format!("{} -> ... -> {}", begin.join(" -> "), end.join(" -> "))
}
