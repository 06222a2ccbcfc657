//! The tables of a scene.toml: the scene, and its variants.

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use super::document::Document;
use super::error::{SceneError, check_name, join_names};
use super::schema::{
    BackgroundTable, CameraTable, ObjectTable, SceneTable, ShutterTable, SunTable,
};
use super::variant_changes::{
    VARIANT_KEYS, apply_variant, find_object, merge_tables, unknown_change,
};
use crate::SceneId;
use crate::limits::{MOST_OBJECTS, MOST_VARIANTS};

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
            let Some(changes) = self.variants.get(name) else {
                let known = join_names(self.variant_names.iter().map(String::as_str));
                let reason = format!("variant \"{name}\" is unknown; variants: {known}");
                return Err(SceneError::in_file(&self.document.path, reason));
            };
            apply_variant(self.document, &mut scene, name, changes)?;
        }
        let whole = Spanned::new(self.document.whole(), DeValue::Table(scene));
        self.document.read(whole)
    }

    /// Checks all variants at once, not only the one that somebody chooses. Reads what each changes and no more, so that the
    /// time grows with the length of the text.
    pub(super) fn check_variants(&self) -> Result<(), SceneError> {
        for key in VARIANT_KEYS {
            if let Some(value) = self.scene.get(key) {
                self.check_part(key, value)?;
            }
        }
        for name in &self.variant_names {
            let what = format!("variant \"{name}\"");
            let variant = &self.variants[name.as_str()];
            for (key, change) in self.document.expect_table(&what, variant)? {
                match key.get_ref().as_ref() {
                    "object" => {
                        for (object, change) in self.document.expect_table(&what, change)? {
                            self.check_object(name, object, change)?;
                        }
                    }
                    other if VARIANT_KEYS.contains(&other) => self.check_part(other, change)?,
                    _ => return Err(unknown_change(self.document, name, key)),
                }
            }
        }
        Ok(())
    }

    fn check_part(&self, key: &str, value: &Spanned<DeValue<'a>>) -> Result<(), SceneError> {
        fn check<T: DeserializeOwned>(
            document: &Document,
            value: &Spanned<DeValue<'_>>,
        ) -> Result<(), SceneError> {
            document.read::<T>(value.clone()).map(|_| ())
        }
        match key {
            "background" => check::<BackgroundTable>(self.document, value),
            "camera" => check::<CameraTable>(self.document, value),
            "exposure" => check::<f64>(self.document, value),
            "object" => {
                let mut objects = self.document.expect_table("object", value)?.values();
                objects.try_for_each(|object| check::<ObjectTable>(self.document, object))
            }
            "shutter" => check::<ShutterTable>(self.document, value),
            "sun" => check::<SunTable>(self.document, value),
            other => unreachable!("\"{other}\" is no key of a variant"),
        }
    }

    /// Checks a change of an object. Only the tables that it merges with are read with it.
    fn check_object(
        &self,
        variant: &str,
        name: &Spanned<DeString<'a>>,
        change: &Spanned<DeValue<'a>>,
    ) -> Result<(), SceneError> {
        let object = find_object(self.document, &self.scene, variant, name)?;
        let what = format!("object \"{}\"", name.get_ref());
        let change = self.document.expect_table(&what, change)?.clone();
        let mut changed = DeTable::new();
        for key in change.keys() {
            let before = object.get_key_value(key.get_ref().as_ref());
            if let Some((key, before)) = before.filter(|(_, before)| before.get_ref().is_table()) {
                changed.insert(key.clone(), before.clone());
            }
        }
        merge_tables(&mut changed, change);
        let changed = Spanned::new(name.span(), DeValue::Table(changed));
        self.document.read::<ObjectTable>(changed).map(|_| ())
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
        if index == MOST_VARIANTS {
            let reason = format!(
                "the scene has {} variants; allowed: {MOST_VARIANTS}; move some to a folder of their own",
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
    if table.len() <= MOST_OBJECTS {
        return Ok(());
    }
    let mut places: Vec<_> = table.keys().map(Spanned::span).collect();
    places.sort_by_key(|place| place.start);
    let reason = format!(
        "the scene has {} objects; allowed: {MOST_OBJECTS}; join those that move together into one mesh",
        table.len()
    );
    Err(document.error(places[MOST_OBJECTS].clone(), reason))
}
