//! The parents of objects: each stands above what is attached to it.

use std::collections::{HashMap, HashSet};

use toml::Spanned;

use super::document::Document;
use super::error::{SceneError, list};
use super::schema::ObjectTable;
use crate::Parent;

/// What an object is attached to; `above` objects stand above it in the file.
pub(super) fn parent(
    document: &Document,
    above: usize,
    name: &str,
    table: &ObjectTable,
    in_file_order: &[(&Spanned<String>, &ObjectTable)],
    places: &HashMap<&str, usize>,
) -> Result<Parent, SceneError> {
    let Some(parent) = &table.parent else {
        return Ok(Parent::World);
    };
    let word = parent.get_ref().as_str();
    if word == "camera" {
        return Ok(Parent::Camera);
    }
    let fail = |reason| Err(document.error(parent.span(), reason));
    match places.get(word) {
        // What stands above has been checked: there is no way back from there.
        Some(index) if *index < above => Ok(Parent::Object(*index)),
        None => {
            let names = in_file_order
                .iter()
                .map(|(name, _)| name.get_ref().as_str());
            fail(format!(
                "object \"{name}\" has the parent \"{word}\", which the scene lacks; allowed: camera, {}",
                list(names.filter(|other| *other != name))
            ))
        }
        Some(_) => match circle(name, parent, in_file_order, places) {
            Some(circle) => fail(format!(
                "objects are each other's parents: {circle}; one of them must have another parent or none"
            )),
            None => fail(format!(
                "object \"{name}\" stands before its parent \"{word}\"; move the parent above it"
            )),
        },
    }
}

/// The way from an object over its parents to one that it meets twice, if it does: `a -> b -> a`.
fn circle(
    name: &str,
    parent: &Spanned<String>,
    in_file_order: &[(&Spanned<String>, &ObjectTable)],
    places: &HashMap<&str, usize>,
) -> Option<String> {
    let mut way = vec![name];
    let mut seen = HashSet::from([name]);
    let mut next = Some(parent);
    while let Some(ancestor) = next {
        let ancestor = ancestor.get_ref().as_str();
        way.push(ancestor);
        if !seen.insert(ancestor) {
            return Some(way_shown(&way));
        }
        next = places
            .get(ancestor)
            .and_then(|index| in_file_order[*index].1.parent.as_ref());
    }
    None
}

/// Both ends of a way, and what is between if that is short.
fn way_shown(way: &[&str]) -> String {
    const MOST_SHOWN: usize = 16;
    if way.len() <= MOST_SHOWN {
        return way.join(" -> ");
    }
    let [begin, end] = [&way[..MOST_SHOWN / 2], &way[way.len() - MOST_SHOWN / 2..]];
    format!("{} -> ... -> {}", begin.join(" -> "), end.join(" -> "))
}
