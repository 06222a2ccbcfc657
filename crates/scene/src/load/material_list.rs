//! Lists of different materials.

use std::collections::HashMap;

use crate::Material;

/// Materials without repeats, found by name: there may be thousands, and two of one name are rare.
#[derive(Default)]
pub(super) struct MaterialList {
    pub(super) list: Vec<Material>,
    indices: HashMap<String, Vec<usize>>,
}

impl MaterialList {
    /// Adds a material, unless an equal one is there, and returns its index.
    pub(super) fn add(&mut self, material: Material) -> usize {
        let named = self.indices.entry(material.name.clone()).or_default();
        let known = named.iter().find(|index| self.list[**index] == material);
        known.copied().unwrap_or_else(|| {
            named.push(self.list.len());
            self.list.push(material);
            self.list.len() - 1
        })
    }
}
