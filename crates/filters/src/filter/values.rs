//! Names of values that members of uniform blocks may have, besides parameters.

use super::convention::CONVENTION_VALUES;
use super::definition::Filter;
use super::parameter::Value;
use super::settings::Settings;

/// Numbers of the frame and of the pass.
const NUMBERS: [&str; 6] = [
    "width",
    "height",
    "exposure",
    "frame_index",
    "iteration",
    "iterations",
];

/// Values of two numbers. `resolution[0]` is the first number.
const PAIRS: [&str; 2] = ["resolution", "jitter"];

/// Matrices of the camera of this frame. With `previous_` before its name, each belongs to the
/// frame before.
pub(crate) const MATRICES: [&str; 6] = [
    "projection",
    "inverse_projection",
    "view",
    "inverse_view",
    "view_projection",
    "inverse_view_projection",
];

/// First part of the names of matrices of the frame before.
pub(crate) const PREVIOUS: &str = "previous_";

/// Numbers of a matrix.
pub(crate) const MATRIX_NUMBERS: usize = 16;

/// Parts of the camera that a filter reads.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CameraUse {
    /// The camera's motion over the pixels.
    pub reprojection: bool,
    /// Its matrices.
    pub matrices: bool,
}

impl Filter {
    /// Counts the numbers that a name stands for; none for an unknown name.
    pub(crate) fn count_numbers(&self, name: &str) -> Option<usize> {
        let is_parameter = (self.parameters.iter()).any(|parameter| parameter.name == name);
        if is_parameter || NUMBERS.contains(&name) || self.convention.value(name).is_some() {
            return Some(1);
        }
        let count = |whole: &str| {
            let pair = PAIRS.contains(&whole).then_some(2);
            let is_known = find_matrix(whole).is_some_and(|(matrix, _)| {
                self.convention.near.is_some() || !MATRICES[matrix].ends_with("projection")
            });
            pair.or(is_known.then_some(MATRIX_NUMBERS))
        };
        match split_element(name) {
            Some((whole, index)) => count(whole).filter(|count| index < *count).map(|_| 1),
            None => count(name),
        }
    }

    /// Lists the names of all values, for messages.
    pub(crate) fn list_values(&self) -> String {
        let of_convention = CONVENTION_VALUES.into_iter();
        let matrices = MATRICES.map(str::to_owned).into_iter();
        let previous = MATRICES.map(|name| format!("{PREVIOUS}{name}"));
        let names = (self
            .parameters
            .iter()
            .map(|parameter| parameter.name.clone()))
        .chain(NUMBERS.map(str::to_owned))
        .chain(of_convention.map(str::to_owned))
        .chain(PAIRS.map(str::to_owned))
        .chain(matrices.chain(previous));
        let known = names.filter(|name| self.count_numbers(name).is_some());
        known.collect::<Vec<_>>().join(", ")
    }

    /// Returns true if with these settings a shader reads where the camera is, or how it moved.
    pub fn reads_camera(&self, settings: &Settings) -> bool {
        let CameraUse {
            reprojection,
            matrices,
        } = self.camera_use(settings);
        reprojection || matrices
    }

    /// Lists the parts of the camera that the shaders read with these settings.
    pub(crate) fn camera_use(&self, settings: &Settings) -> CameraUse {
        let mut blocks = self.shaders.iter().flat_map(|shader| &shader.blocks);
        let switches: Vec<(&String, &Value)> = (self.parameters.iter())
            .filter_map(|parameter| Some((&parameter.name, parameter.no_camera_at.as_ref()?)))
            .collect();
        let is_off = |(name, off): &(&String, &Value)| settings.values[*name] == **off;
        let is_needed = switches.is_empty() || !switches.iter().all(is_off);
        CameraUse {
            reprojection: is_needed && self.shaders.iter().any(|shader| shader.reads_reprojection),
            matrices: blocks.any(|block| block.reads_any(&is_of_matrix)),
        }
    }
}

/// Finds a matrix by name: its index in [`MATRICES`], and whether it belongs to the frame before.
pub(crate) fn find_matrix(name: &str) -> Option<(usize, bool)> {
    let (matrix, is_previous) = match name.strip_prefix(PREVIOUS) {
        Some(matrix) => (matrix, true),
        None => (name, false),
    };
    let index = MATRICES.iter().position(|known| *known == matrix)?;
    Some((index, is_previous))
}

/// Splits the name of one number of several, such as `view[3]`.
pub(crate) fn split_element(name: &str) -> Option<(&str, usize)> {
    let (whole, index) = name.strip_suffix(']')?.split_once('[')?;
    Some((whole, index.parse().ok()?))
}

/// Returns true for a number of a matrix.
fn is_of_matrix(name: &str) -> bool {
    split_element(name).is_some_and(|(whole, _)| find_matrix(whole).is_some())
}

/// Says why a name that some filters know is unknown to this one.
pub(crate) fn explain_unknown(name: &str) -> Option<&'static str> {
    let whole = split_element(name).map_or(name, |(whole, _)| whole);
    if find_matrix(whole).is_some_and(|(matrix, _)| MATRICES[matrix].ends_with("projection")) {
        return Some("needs near, and a depth other than \"linear\", in [convention]");
    }
    match name {
        "frames_per_second" | "delta_time" => Some("needs frames_per_second in [convention]"),
        "near" | "far" => Some("has to be in [convention]"),
        _ => None,
    }
}
