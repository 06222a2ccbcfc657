//! Changes that a variant makes to the tables of a scene.toml.

use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use super::document::Document;
use super::error::{SceneError, join_names};

/// Keys that a variant may change.
pub(super) const VARIANT_KEYS: [&str; 6] = [
    "background",
    "camera",
    "exposure",
    "object",
    "shutter",
    "sun",
];

/// Keys of an object that give a still pose.
const STILL_POSE: [&str; 3] = ["translation", "rotation", "scale"];

/// Keys of an object that give a motion.
const MOTION: [&str; 2] = ["keys", "interpolation"];

/// Keys of an object that a variant gives, and those that it thereby removes.
const ALTERNATIVES: [(&[&str], &[&str]); 4] = [
    (&STILL_POSE, &MOTION),
    (&MOTION, &STILL_POSE),
    (&["mesh"], &["shapes"]),
    (&["shapes"], &["mesh"]),
];

/// Applies a variant: changes objects key by key, and replaces all else whole.
pub(super) fn apply_variant<'a>(
    document: &Document,
    scene: &mut DeTable<'a>,
    variant: &str,
    changes: &Spanned<DeValue<'a>>,
) -> Result<(), SceneError> {
    let what = format!("variant \"{variant}\"");
    for (key, change) in document.expect_table(&what, changes)? {
        match key.get_ref().as_ref() {
            "object" => {
                for (name, change) in document.expect_table(&what, change)? {
                    apply_to_object(document, scene, variant, name, change)?;
                }
            }
            other if VARIANT_KEYS.contains(&other) => {
                scene.remove(other);
                scene.insert(key.clone(), change.clone());
            }
            _ => return Err(unknown_change(document, variant, key)),
        }
    }
    Ok(())
}

fn apply_to_object<'a>(
    document: &Document,
    scene: &mut DeTable<'a>,
    variant: &str,
    name: &Spanned<DeString<'a>>,
    change: &Spanned<DeValue<'a>>,
) -> Result<(), SceneError> {
    let what = format!("object \"{}\"", name.get_ref());
    let change = document.expect_table(&what, change)?.clone();
    // Refuses an object that is no table, or that is not there.
    find_object(document, scene, variant, name)?;
    let object = scene
        .get_mut("object")
        .and_then(|objects| table_mut(objects)?.get_mut(name.get_ref().as_ref()))
        .and_then(table_mut)
        .expect("it has just been found");
    for (given, removed) in ALTERNATIVES {
        if given.iter().any(|key| change.contains_key(*key)) {
            for key in removed {
                object.remove(*key);
            }
        }
    }
    merge_tables(object, change);
    Ok(())
}

/// Finds the object that a variant changes.
pub(super) fn find_object<'b, 'a>(
    document: &Document,
    scene: &'b DeTable<'a>,
    variant: &str,
    name: &Spanned<DeString<'a>>,
) -> Result<&'b DeTable<'a>, SceneError> {
    let objects = match scene.get("object") {
        Some(objects) => Some(document.expect_table("object", objects)?),
        None => None,
    };
    if let Some(object) = objects.and_then(|objects| objects.get(name.get_ref().as_ref())) {
        return document.expect_table(&format!("object \"{}\"", name.get_ref()), object);
    }
    let known = objects.into_iter().flat_map(|objects| objects.keys());
    let reason = format!(
        "variant \"{variant}\" changes object \"{}\", which the scene does not have; objects: {}",
        name.get_ref(),
        join_names(known.map(|name| name.get_ref().as_ref()))
    );
    Err(document.error(name.span(), reason))
}

/// Makes the error about a key that no variant may change.
pub(super) fn unknown_change(
    document: &Document,
    variant: &str,
    key: &Spanned<DeString<'_>>,
) -> SceneError {
    let reason = format!(
        "variant \"{variant}\" changes \"{}\"; a variant may change: {}",
        key.get_ref(),
        join_names(VARIANT_KEYS)
    );
    document.error(key.span(), reason)
}

fn table_mut<'b, 'a>(value: &'b mut Spanned<DeValue<'a>>) -> Option<&'b mut DeTable<'a>> {
    match value.get_mut() {
        DeValue::Table(table) => Some(table),
        _ => None,
    }
}

/// Merges tables into tables and replaces all other values.
pub(super) fn merge_tables<'a>(base: &mut DeTable<'a>, changes: DeTable<'a>) {
    for (key, change) in changes {
        match (
            base.get_mut(key.get_ref().as_ref()).map(Spanned::get_mut),
            change,
        ) {
            (Some(DeValue::Table(base)), change) if change.get_ref().is_table() => {
                if let DeValue::Table(change) = change.into_inner() {
                    merge_tables(base, change);
                }
            }
            (_, change) => {
                base.remove(key.get_ref().as_ref());
                base.insert(key, change);
            }
        }
    }
}
