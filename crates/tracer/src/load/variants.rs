//! The variants of a scene.toml: what they change, and the scene with the changes of one.

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use super::document::Document;
use super::error::{SceneError, is_name, list};
use super::schema::{
    BackgroundTable, CameraTable, ObjectTable, SceneTable, ShutterTable, SunTable,
};
use crate::limits::{MOST_OBJECTS, MOST_VARIANTS};

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

/// A scene.toml taken apart: the scene as it is, and its variants.
pub(super) struct Parsed<'a> {
    document: &'a Document,
    scene: DeTable<'a>,
    variants: DeTable<'a>,
    /// In the order of the file.
    names: Vec<String>,
}

impl<'a> Parsed<'a> {
    pub(super) fn of(document: &'a Document) -> Result<Self, SceneError> {
        let mut scene = document.table()?;
        let variants = match scene.remove("variant") {
            Some(variants) => document.as_table("variant", &variants)?.clone(),
            None => DeTable::new(),
        };
        let names = names(document, &variants)?;
        if let Some(objects) = scene.get("object") {
            check_count(document, objects)?;
        }
        Ok(Self {
            document,
            scene,
            variants,
            names,
        })
    }

    /// Names of the variants, in the order of the file.
    pub(super) fn names(&self) -> &[String] {
        &self.names
    }

    /// The scene with one variant's changes, or as it is.
    pub(super) fn scene(&self, variant: Option<&str>) -> Result<SceneTable, SceneError> {
        let mut scene = self.scene.clone();
        if let Some(name) = variant {
            let Some(changes) = self.variants.get(name) else {
                let known = list(self.names.iter().map(String::as_str));
                let reason = format!("variant \"{name}\" is unknown; variants: {known}");
                return Err(SceneError::file(&self.document.path, reason));
            };
            self.apply(&mut scene, name, changes)?;
        }
        let whole = Spanned::new(self.document.whole(), DeValue::Table(scene));
        self.document.read(whole)
    }

    /// Refuses a slip in any variant at once, not only when somebody chooses it. Reads what each changes and nothing
    /// else, so that the time grows with the length of the text.
    pub(super) fn check(&self) -> Result<(), SceneError> {
        for key in VARIANT_KEYS {
            if let Some(value) = self.scene.get(key) {
                self.check_part(key, value)?;
            }
        }
        for name in &self.names {
            let what = format!("variant \"{name}\"");
            for (key, change) in self
                .document
                .as_table(&what, &self.variants[name.as_str()])?
            {
                match key.get_ref().as_ref() {
                    "object" => {
                        for (object, change) in self.document.as_table(&what, change)? {
                            self.check_object(name, object, change)?;
                        }
                    }
                    other if VARIANT_KEYS.contains(&other) => self.check_part(other, change)?,
                    other => return Err(self.unknown_change(name, key, other)),
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
                let mut objects = self.document.as_table("object", value)?.values();
                objects.try_for_each(|object| check::<ObjectTable>(self.document, object))
            }
            "shutter" => check::<ShutterTable>(self.document, value),
            "sun" => check::<SunTable>(self.document, value),
            other => unreachable!("\"{other}\" is no key of a variant"),
        }
    }

    /// Only tables are merged with what was there before.
    fn check_object(
        &self,
        variant: &str,
        name: &Spanned<DeString<'a>>,
        change: &Spanned<DeValue<'a>>,
    ) -> Result<(), SceneError> {
        let what = format!("object \"{}\"", name.get_ref());
        let object = match self.scene.get("object") {
            Some(objects) => {
                let objects = self.document.as_table("object", objects)?;
                objects.get(name.get_ref().as_ref())
            }
            None => None,
        };
        let Some(object) = object else {
            return Err(self.unknown_object(&self.scene, variant, name));
        };
        let object = self.document.as_table(&what, object)?;
        let change = self.document.as_table(&what, change)?.clone();
        let mut changed = DeTable::new();
        for key in change.keys() {
            let before = object.get_key_value(key.get_ref().as_ref());
            if let Some((key, before)) = before.filter(|(_, before)| before.get_ref().is_table()) {
                changed.insert(key.clone(), before.clone());
            }
        }
        merge(&mut changed, change);
        let changed = Spanned::new(name.span(), DeValue::Table(changed));
        self.document.read::<ObjectTable>(changed).map(|_| ())
    }

    /// Objects are changed key by key; everything else that a variant names is replaced whole.
    fn apply(
        &self,
        scene: &mut DeTable<'a>,
        variant: &str,
        changes: &Spanned<DeValue<'a>>,
    ) -> Result<(), SceneError> {
        let what = format!("variant \"{variant}\"");
        for (key, change) in self.document.as_table(&what, changes)? {
            match key.get_ref().as_ref() {
                "object" => {
                    for (name, change) in self.document.as_table(&what, change)? {
                        self.apply_to_object(scene, variant, name, change)?;
                    }
                }
                other if VARIANT_KEYS.contains(&other) => {
                    scene.remove(other);
                    scene.insert(key.clone(), change.clone());
                }
                other => return Err(self.unknown_change(variant, key, other)),
            }
        }
        Ok(())
    }

    fn apply_to_object(
        &self,
        scene: &mut DeTable<'a>,
        variant: &str,
        name: &Spanned<DeString<'a>>,
        change: &Spanned<DeValue<'a>>,
    ) -> Result<(), SceneError> {
        let what = format!("object \"{}\"", name.get_ref());
        let change = self.document.as_table(&what, change)?.clone();
        if let Some(objects) = scene.get("object") {
            let objects = self.document.as_table("object", objects)?;
            if let Some(object) = objects.get(name.get_ref().as_ref()) {
                self.document.as_table(&what, object)?;
            }
        }
        let object = scene
            .get_mut("object")
            .and_then(|objects| table_mut(objects)?.get_mut(name.get_ref().as_ref()))
            .and_then(table_mut);
        let Some(object) = object else {
            return Err(self.unknown_object(scene, variant, name));
        };
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

    fn unknown_change(&self, variant: &str, key: &Spanned<DeString<'a>>, word: &str) -> SceneError {
        let allowed = list(VARIANT_KEYS);
        let reason =
            format!("variant \"{variant}\" changes \"{word}\"; a variant may change: {allowed}");
        self.document.error(key.span(), reason)
    }

    fn unknown_object(
        &self,
        scene: &DeTable<'a>,
        variant: &str,
        name: &Spanned<DeString<'a>>,
    ) -> SceneError {
        let objects = scene.get("object").map(Spanned::get_ref);
        let known = match objects {
            Some(DeValue::Table(objects)) => {
                list(objects.keys().map(|name| name.get_ref().as_ref()))
            }
            _ => list([]),
        };
        let reason = format!(
            "variant \"{variant}\" changes object \"{}\", which the scene lacks; objects: {known}",
            name.get_ref()
        );
        self.document.error(name.span(), reason)
    }
}

/// Names of the variants, checked, in the order of the file.
fn names(document: &Document, variants: &DeTable) -> Result<Vec<String>, SceneError> {
    let mut names: Vec<_> = variants.keys().collect();
    names.sort_by_key(|name| name.span().start);
    for (index, name) in names.iter().enumerate() {
        if !is_name(name.get_ref()) {
            let reason = format!(
                "variant name \"{}\": allowed are letters, digits, _ and -",
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
fn check_count(document: &Document, objects: &Spanned<DeValue>) -> Result<(), SceneError> {
    let DeValue::Table(table) = objects.get_ref() else {
        return Ok(());
    };
    if table.len() <= MOST_OBJECTS {
        return Ok(());
    }
    let mut starts: Vec<_> = table.keys().map(Spanned::span).collect();
    starts.sort_by_key(|place| place.start);
    let reason = format!(
        "the scene has {} objects; allowed: {MOST_OBJECTS}; join those that move together into one mesh",
        table.len()
    );
    Err(document.error(starts[MOST_OBJECTS].clone(), reason))
}

fn table_mut<'b, 'i>(value: &'b mut Spanned<DeValue<'i>>) -> Option<&'b mut DeTable<'i>> {
    match value.get_mut() {
        DeValue::Table(table) => Some(table),
        _ => None,
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
