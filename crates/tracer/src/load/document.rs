//! The text of a scene.toml: its syntax, its variants, and the lines that its values stand in.

use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer};

use super::error::{SceneError, is_name, list};
use super::schema::SceneTable;

/// What a variant may change.
const VARIANT_KEYS: [&str; 6] = [
    "background",
    "camera",
    "exposure",
    "object",
    "shutter",
    "sun",
];

/// Keys of an object that say where it is: still, or moving. Giving one way in a variant takes back the other.
const STILL_POSE: [&str; 3] = ["translation", "rotation", "scale"];
const MOVING_POSE: [&str; 2] = ["keys", "interpolation"];

/// A scene.toml as text.
pub(super) struct Document {
    /// The file.
    pub(super) path: PathBuf,
    text: String,
}

impl Document {
    pub(super) fn new(path: &Path, text: String) -> Self {
        Self {
            path: path.to_owned(),
            text,
        }
    }

    /// An error at a place in the text.
    pub(super) fn error(&self, place: Range<usize>, reason: impl Into<String>) -> SceneError {
        let before = &self.text.as_bytes()[..place.start.min(self.text.len())];
        let line = 1 + before.iter().filter(|byte| **byte == b'\n').count();
        SceneError::line(&self.path, line, reason)
    }

    /// Names of the variants, in the order of the file.
    pub(super) fn variants(&self) -> Result<Vec<String>, SceneError> {
        let mut table = self.table()?;
        let Some(variants) = table.get_mut("variant") else {
            return Ok(Vec::new());
        };
        let mut names: Vec<_> = self.as_table("variant", variants)?.keys().collect();
        names.sort_by_key(|name| name.span().start);
        for name in &names {
            if !is_name(name.get_ref()) {
                let reason = format!(
                    "variant name \"{}\": allowed are letters, digits, _ and -",
                    name.get_ref()
                );
                return Err(self.error(name.span(), reason));
            }
        }
        Ok(names
            .iter()
            .map(|name| name.get_ref().to_string())
            .collect())
    }

    /// The scene with one variant's changes, or as it is.
    pub(super) fn scene(&self, variant: Option<&str>) -> Result<SceneTable, SceneError> {
        let mut scene = self.table()?;
        let variants = scene.remove("variant");
        if let Some(name) = variant {
            let known = self.variants()?;
            if !known.iter().any(|other| other == name) {
                let known = list(known.iter().map(String::as_str));
                let reason = format!("variant \"{name}\" is unknown; variants: {known}");
                return Err(SceneError::file(&self.path, reason));
            }
            let mut variants = variants.expect("a known variant stands in a table of variants");
            let changes = self
                .as_table("variant", &mut variants)?
                .remove(name)
                .expect("a known variant has a table");
            self.apply(&mut scene, name, changes)?;
        }
        let end = self.text.len();
        SceneTable::deserialize(Deserializer::from(Spanned::new(0..end, scene)))
            .map_err(|error| self.syntax_error(&error))
    }

    fn table(&self) -> Result<DeTable<'_>, SceneError> {
        let table = DeTable::parse(&self.text).map_err(|error| self.syntax_error(&error))?;
        let span = table.span();
        let root = Spanned::new(span, DeValue::Table(table.into_inner()));
        self.check_numbers(&root)?;
        match root.into_inner() {
            DeValue::Table(table) => Ok(table),
            _ => unreachable!("a document is a table"),
        }
    }

    /// TOML can write `nan` and `inf`; a scene cannot use them anywhere.
    fn check_numbers(&self, value: &Spanned<DeValue<'_>>) -> Result<(), SceneError> {
        match value.get_ref() {
            DeValue::Float(number) => match number.as_str().parse::<f64>() {
                Ok(parsed) if parsed.is_finite() => Ok(()),
                _ => {
                    let reason = format!("found {number}; allowed: finite numbers");
                    Err(self.error(value.span(), reason))
                }
            },
            DeValue::Array(values) => values
                .iter()
                .try_for_each(|value| self.check_numbers(value)),
            DeValue::Table(table) => table
                .values()
                .try_for_each(|value| self.check_numbers(value)),
            _ => Ok(()),
        }
    }

    /// Objects are changed key by key; everything else that a variant names is replaced whole.
    fn apply<'i>(
        &self,
        scene: &mut DeTable<'i>,
        variant: &str,
        mut changes: Spanned<DeValue<'i>>,
    ) -> Result<(), SceneError> {
        let what = format!("variant \"{variant}\"");
        for (key, mut change) in std::mem::take(self.as_table(&what, &mut changes)?) {
            match key.get_ref().as_ref() {
                "object" => {
                    let objects = scene
                        .entry(key)
                        .or_insert(Spanned::new(0..0, DeValue::Table(DeTable::new())));
                    let objects = self.as_table("object", objects)?;
                    for (name, change) in std::mem::take(self.as_table(&what, &mut change)?) {
                        self.apply_to_object(objects, variant, name, change)?;
                    }
                }
                other if VARIANT_KEYS.contains(&other) => {
                    scene.remove(other);
                    scene.insert(key, change);
                }
                other => {
                    let allowed = list(VARIANT_KEYS);
                    let reason = format!(
                        "variant \"{variant}\" changes \"{other}\"; a variant may change: {allowed}"
                    );
                    return Err(self.error(key.span(), reason));
                }
            }
        }
        Ok(())
    }

    fn apply_to_object<'i>(
        &self,
        objects: &mut DeTable<'i>,
        variant: &str,
        name: Spanned<toml::de::DeString<'i>>,
        mut change: Spanned<DeValue<'i>>,
    ) -> Result<(), SceneError> {
        let Some(object) = objects.get_mut(name.get_ref().as_ref()) else {
            let known: Vec<_> = objects.keys().map(|name| name.get_ref().as_ref()).collect();
            let reason = format!(
                "variant \"{variant}\" changes object \"{}\", which the scene lacks; objects: {}",
                name.get_ref(),
                list(known)
            );
            return Err(self.error(name.span(), reason));
        };
        let what = format!("object \"{}\"", name.get_ref());
        let object = self.as_table(&what, object)?;
        let change = std::mem::take(self.as_table(&what, &mut change)?);
        for (given, taken_back) in [
            (&STILL_POSE[..], &MOVING_POSE[..]),
            (&MOVING_POSE[..], &STILL_POSE[..]),
            (&["mesh"], &["shapes"]),
            (&["shapes"], &["mesh"]),
        ] {
            if given.iter().any(|key| change.contains_key(*key)) {
                for key in taken_back {
                    object.remove(*key);
                }
            }
        }
        merge(object, change);
        Ok(())
    }

    fn as_table<'a, 'i>(
        &self,
        what: &str,
        value: &'a mut Spanned<DeValue<'i>>,
    ) -> Result<&'a mut DeTable<'i>, SceneError> {
        let place = value.span();
        match value.get_mut() {
            DeValue::Table(table) => Ok(table),
            other => {
                let found = other.type_str();
                Err(self.error(place, format!("{what} is a {found}; a table is needed")))
            }
        }
    }

    /// serde speaks of fields, variants and types of Rust; a scene has keys, families and numbers.
    fn syntax_error(&self, error: &toml::de::Error) -> SceneError {
        let reason = error
            .message()
            .replace("unknown field", "unknown key")
            .replace("missing field", "missing key")
            .replace("duplicate field", "duplicate key")
            .replace("unknown variant", "unknown family")
            .replace("expected f64", "expected a number")
            .replace("expected f32", "expected a number")
            .replace("expected u32", "expected a whole number from 0")
            .replace("expected one of", "allowed:")
            .replace("expected", "allowed:");
        match error.span() {
            Some(place) => self.error(place, reason),
            None => SceneError::file(&self.path, reason),
        }
    }
}

/// Tables are merged, everything else is replaced.
fn merge<'i>(base: &mut DeTable<'i>, changes: DeTable<'i>) {
    for (key, change) in changes {
        match (
            base.get_mut(key.get_ref().as_ref()).map(Spanned::get_mut),
            change,
        ) {
            (Some(DeValue::Table(base)), change) if change.get_ref().is_table() => {
                if let DeValue::Table(change) = change.into_inner() {
                    merge(base, change);
                }
            }
            (_, change) => {
                base.remove(key.get_ref().as_ref());
                base.insert(key, change);
            }
        }
    }
}
