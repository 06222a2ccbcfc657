//! The tables of a scene.toml: the scene, and its variants.

use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use super::document::Document;
use super::error::{SceneError, check_name, join_names};
use super::schema::{SceneTable, VariantTable};
use crate::SceneId;
use crate::limits::{MAX_OBJECTS, MAX_VARIANTS};

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

/// Parsed scene.toml, with the variants apart.
pub(super) struct ParsedScene<'a> {
    document: &'a Document,
    scene: DeTable<'a>,
    variants: DeTable<'a>,
    /// Names in the order of the file.
    variant_names: Vec<String>,
}

impl<'a> ParsedScene<'a> {
    /// Parses a scene.toml, and checks how many variants and objects it has.
    pub(super) fn parse(document: &'a Document) -> Result<Self, SceneError> {
        let mut scene = document.parse()?;
        let variants = match scene.remove("variant") {
            Some(variants) => document.expect_table("variant", &variants)?.clone(),
            None => DeTable::new(),
        };
        let variant_names = read_variant_names(document, &variants)?;
        if let Some(objects) = scene.get("object") {
            check_object_count(document, objects)?;
        }
        Ok(Self {
            document,
            scene,
            variants,
            variant_names,
        })
    }

    /// Names of the variants, in the order of the file.
    pub(super) fn variant_names(&self) -> &[String] {
        &self.variant_names
    }

    /// Reads the scene, or one of its variants.
    pub(super) fn read(&self, variant: Option<&str>) -> Result<SceneTable, SceneError> {
        let mut scene = self.scene.clone();
        if let Some(name) = variant {
            if !self.variants.contains_key(name) {
                let known = join_names(self.variant_names.iter().map(String::as_str));
                let reason = format!("variant \"{name}\" is unknown; variants: {known}");
                return Err(SceneError::in_file(&self.document.path, reason));
            }
            apply_changes(&mut scene, self.read_changes(name)?);
        }
        let whole = Spanned::new(self.document.whole(), DeValue::Table(scene));
        self.document.read(whole)
    }

    /// Checks the scene and all variants at once, not only the chosen one.
    pub(super) fn check_variants(&self) -> Result<(), SceneError> {
        self.read(None)?;
        let mut names = self.variant_names.iter();
        names.try_for_each(|name| self.read_changes(name).map(|_| ()))
    }

    /// Reads and checks what a variant changes, and no more, so that the time grows with the length
    /// of the text. Tables of its objects are merged with those of the scene's objects.
    fn read_changes(&self, variant: &str) -> Result<DeTable<'a>, SceneError> {
        let what = format!("variant \"{variant}\"");
        let value = &self.variants[variant];
        let mut changes = self.document.expect_table(&what, value)?.clone();
        if let Some(objects) = changes.get("object") {
            let mut merged = DeTable::new();
            for (name, change) in self.document.expect_table(&what, objects)? {
                let change = self.merge_object(variant, name, change)?;
                merged.insert(name.clone(), Spanned::new(name.span(), change));
            }
            let merged = Spanned::new(objects.span(), DeValue::Table(merged));
            changes["object"] = merged;
        }
        let checked = Spanned::new(value.span(), DeValue::Table(changes.clone()));
        self.document.read::<VariantTable>(checked)?;
        Ok(changes)
    }

    /// Merges the change of an object with the scene's tables of it.
    fn merge_object(
        &self,
        variant: &str,
        name: &Spanned<DeString<'a>>,
        change: &Spanned<DeValue<'a>>,
    ) -> Result<DeValue<'a>, SceneError> {
        let what = format!("object \"{}\"", name.get_ref());
        let object = self.find_object(variant, name)?;
        let change = self.document.expect_table(&what, change)?;
        let before = (change.keys()).filter_map(|key| object.get_key_value(key.get_ref().as_ref()));
        let mut merged: DeTable = before
            .filter(|(_, before)| before.get_ref().is_table())
            .map(|(key, before)| (key.clone(), before.clone()))
            .collect();
        merge_tables(&mut merged, change.clone());
        Ok(DeValue::Table(merged))
    }

    /// Finds the object that a variant changes.
    fn find_object(
        &self,
        variant: &str,
        name: &Spanned<DeString<'a>>,
    ) -> Result<&DeTable<'a>, SceneError> {
        let objects = match self.scene.get("object") {
            Some(objects) => Some(self.document.expect_table("object", objects)?),
            None => None,
        };
        if let Some(object) = objects.and_then(|objects| objects.get(name.get_ref().as_ref())) {
            let what = format!("object \"{}\"", name.get_ref());
            return self.document.expect_table(&what, object);
        }
        let known = objects.into_iter().flat_map(|objects| objects.keys());
        let reason = format!(
            "variant \"{variant}\" changes object \"{}\", which the scene does not have; objects: {}",
            name.get_ref(),
            join_names(known.map(|name| name.get_ref().as_ref()))
        );
        Err(self.document.error(name.span(), reason))
    }
}

/// Changes objects key by key, and replaces everything else whole.
fn apply_changes<'a>(scene: &mut DeTable<'a>, changes: DeTable<'a>) {
    for (key, change) in changes {
        let objects = scene.get_mut("object").and_then(table_mut);
        let Some(objects) = objects.filter(|_| key.get_ref() == "object") else {
            replace(scene, key, change);
            continue;
        };
        for (name, change) in into_table(change) {
            let object = objects.get_mut(name.get_ref().as_ref());
            let object = object.and_then(table_mut).expect("it has been found");
            let change = into_table(change);
            for (given, removed) in ALTERNATIVES {
                if given.iter().any(|key| change.contains_key(*key)) {
                    removed.iter().for_each(|key| drop(object.remove(*key)));
                }
            }
            for (key, value) in change {
                replace(object, key, value);
            }
        }
    }
}

/// Merges tables into tables and replaces all other values.
fn merge_tables<'a>(base: &mut DeTable<'a>, changes: DeTable<'a>) {
    for (key, change) in changes {
        let table = base.get_mut(key.get_ref().as_ref()).and_then(table_mut);
        match table.filter(|_| change.get_ref().is_table()) {
            Some(table) => merge_tables(table, into_table(change)),
            None => replace(base, key, change),
        }
    }
}

/// Replaces a value together with its key: messages name the key's place.
fn replace<'a>(table: &mut DeTable<'a>, key: Spanned<DeString<'a>>, value: Spanned<DeValue<'a>>) {
    table.remove(key.get_ref().as_ref());
    table.insert(key, value);
}

fn table_mut<'b, 'a>(value: &'b mut Spanned<DeValue<'a>>) -> Option<&'b mut DeTable<'a>> {
    match value.get_mut() {
        DeValue::Table(table) => Some(table),
        _ => None,
    }
}

fn into_table<'a>(value: Spanned<DeValue<'a>>) -> DeTable<'a> {
    match value.into_inner() {
        DeValue::Table(table) => table,
        _ => DeTable::new(),
    }
}

/// Reads and checks the names of variants, in the order of the file.
fn read_variant_names(document: &Document, variants: &DeTable) -> Result<Vec<String>, SceneError> {
    let mut names: Vec<_> = variants.keys().collect();
    names.sort_by_key(|name| name.span().start);
    for (index, name) in names.iter().enumerate() {
        check_name(name.get_ref())
            .map_err(|reason| document.error(name.span(), format!("variant {reason}")))?;
        if SceneId::new("", Some(name.get_ref())).variant.is_none() {
            let reason = format!(
                "variant \"{}\" has the name of a frame rate or of a sealed variant, which every scene has; rename it",
                name.get_ref()
            );
            return Err(document.error(name.span(), reason));
        }
        if index == MAX_VARIANTS {
            let reason = format!(
                "the scene has {} variants; allowed: {MAX_VARIANTS}; move some to a folder of their own",
                names.len()
            );
            return Err(document.error(name.span(), reason));
        }
    }
    Ok(names
        .iter()
        .map(|name| name.get_ref().to_string())
        .collect())
}

/// Refuses too many objects.
fn check_object_count(document: &Document, objects: &Spanned<DeValue>) -> Result<(), SceneError> {
    let DeValue::Table(table) = objects.get_ref() else {
        return Ok(());
    };
    if table.len() <= MAX_OBJECTS {
        return Ok(());
    }
    let mut places: Vec<_> = table.keys().map(Spanned::span).collect();
    places.sort_by_key(|place| place.start);
    let reason = format!(
        "the scene has {} objects; allowed: {MAX_OBJECTS}; join those that move together into one mesh",
        table.len()
    );
    Err(document.error(places[MAX_OBJECTS].clone(), reason))
}
