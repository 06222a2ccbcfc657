//! Modules that were translated from another language, before their variables are bound.

use std::collections::{BTreeMap, BTreeSet};

use wgpu::naga::Module;

/// Group and binding of a resource.
pub(crate) type Place = (u32, u32);

/// A translated module that is not validated yet.
#[derive(Clone, Debug)]
pub(crate) struct OpenModule {
    pub module: Module,
    /// Places of variables that were split from others, each with the place of the other.
    pub owners: BTreeMap<Place, Place>,
    /// Names and offsets of members that hold the rows of a matrix one after the other.
    pub by_rows: BTreeSet<(String, u32)>,
}

impl From<Module> for OpenModule {
    fn from(module: Module) -> Self {
        Self {
            module,
            owners: BTreeMap::new(),
            by_rows: BTreeSet::new(),
        }
    }
}
