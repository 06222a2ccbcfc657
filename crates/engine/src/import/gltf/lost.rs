//! What a file says and a scene cannot, and which materials it is about.

use std::collections::{BTreeMap, BTreeSet};

/// Features without a counterpart.
#[derive(Debug, Default)]
pub struct Lost {
    /// Names of the materials that have each feature.
    pub by_feature: BTreeMap<String, BTreeSet<String>>,
    /// Features that belong to no surface.
    pub others: BTreeSet<String>,
}

impl Lost {
    pub fn add(&mut self, feature: &str, material: &str) {
        let materials = self.by_feature.entry(feature.to_owned()).or_default();
        materials.insert(material.to_owned());
    }

    /// Adds a number of things, such as `2 spot lights`, unless there are none.
    pub fn count(&mut self, count: usize, one: &str, many: &str) {
        match count {
            0 => {}
            1 => _ = self.others.insert(format!("1 {one}")),
            _ => _ = self.others.insert(format!("{count} {many}")),
        }
    }
}
