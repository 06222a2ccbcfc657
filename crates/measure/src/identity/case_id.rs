//! Identity of a case.

use std::collections::BTreeMap;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::path::PathBuf;

use filters::Value;
use frame::Alignment;
use scene::SceneId;
use serde::{Deserialize, Serialize};

use super::filter_id::FilterId;
use super::reference_picture::ReferencePicture;
use crate::InputFormat;
use crate::filter_choice::overrides_text;

/// Identity of a case: a filter or a reference on a scene, with all choices. As a text: `fan /
/// jump_flood:paper`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CaseId {
    /// Scene.
    pub scene: SceneId,
    /// Filter name; for a reference picture [`ReferencePicture::name`].
    pub filter: String,
    /// Preset that the parameters started from; for a reference picture
    /// [`ReferencePicture::preset`].
    pub preset: String,
    /// True for a reference picture to compare filters with: no filter made it, and no bound limits
    /// it.
    #[serde(rename = "bar")]
    pub is_reference: bool,
    /// Form of the frame that the filter got.
    pub input: InputFormat,
    /// Parameters that `--set` changed.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub overrides: BTreeMap<String, Value>,
    /// Shutter alignment that the filter declares and is scored against.
    pub alignment: Alignment,
}

impl CaseId {
    /// Names the case without its scene, as in tables: `jump_flood:paper`, followed by everything
    /// unusual.
    pub fn name(&self) -> String {
        let mut name = match self.preset.as_str() {
            "" => self.filter.clone(),
            preset => format!("{}:{preset}", self.filter),
        };
        name += &overrides_text(&self.overrides);
        name.extend(self.input.change().map(|change| format!(" {change}")));
        name
    }

    /// Returns the reference picture; none for a filter's picture.
    pub fn reference(&self) -> Option<ReferencePicture> {
        let picture = ReferencePicture::find(&self.filter, &self.preset);
        picture.filter(|_| self.is_reference)
    }

    /// Returns the identity of the preset alone, so that cases with other overrides compare.
    pub fn of_preset(&self) -> Self {
        Self {
            overrides: BTreeMap::new(),
            ..self.clone()
        }
    }

    /// Returns the identity of the filter or reference without the scene.
    pub fn filter_id(&self) -> FilterId {
        FilterId {
            is_reference: self.is_reference,
            name: self.name(),
            alignment: self.alignment,
        }
    }

    /// Returns the folder of its pictures, relative to `run.json`. References have one per
    /// alignment.
    pub fn folder(&self) -> PathBuf {
        let mut parts = vec![self.filter.clone(), self.preset.clone()];
        parts.extend(self.is_reference.then(|| self.alignment.to_string()));
        let overrides = self.overrides.iter();
        parts.extend(overrides.map(|(parameter, value)| format!("{parameter}_{value}")));
        parts.extend(self.input.change().map(|change| change.replace('=', "_")));
        parts.retain(|part| !part.is_empty());
        self.scene.folder().join(parts.join("_"))
    }
}

impl fmt::Display for CaseId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} / {}", self.scene, self.name())
    }
}

// No parameter value is NaN.
impl Eq for CaseId {}

impl Hash for CaseId {
    fn hash<H: Hasher>(&self, state: &mut H) {
        (&self.scene, self.filter_id()).hash(state);
    }
}
