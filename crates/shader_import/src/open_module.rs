//! Module of a shader, as naga reads it.

use std::collections::{BTreeMap, BTreeSet};

use naga::{Module, ResourceBinding};

/// A module that is not validated yet.
#[derive(Default)]
pub struct OpenModule {
    /// All that the shader declares.
    pub module: Module,
    /// Places of variables that were split from others, each with the place of the other.
    pub owners: BTreeMap<ResourceBinding, ResourceBinding>,
    /// Names and offsets of members that contain the rows of a matrix one after the other.
    pub by_rows: BTreeSet<(String, u32)>,
}

/// Place of the block of push constants. It is a uniform block here, and naga knows push constants
/// only up to 256 bytes.
pub const PUSH_CONSTANTS: ResourceBinding = ResourceBinding {
    group: u32::MAX,
    binding: 0,
};
