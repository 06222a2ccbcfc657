//! Runs with some filters scaled to the picture and others not.

use filters::Filter;

use super::Run;
use super::case::Case;

impl Run {
    /// Names the filters that are scaled to the pictures' width, and the user's own that are not;
    /// none for a run that does not mix both.
    pub fn scaling_note(&self) -> Option<String> {
        let builtin = Filter::builtin_names();
        let filters = || self.cases.iter().filter(|case| !case.is_reference);
        let is_scaled =
            |case: &&Case| (case.reference_width).is_some_and(|width| width != self.render.width);
        let scaled = list_names(filters().filter(is_scaled));
        // A picture that an engine drew has no preset, and no filter.toml that could name a width.
        let is_own = |case: &&Case| !builtin.contains(&case.filter) && !case.preset.is_empty();
        let written = filters().filter(|case| is_own(case) && case.reference_width.is_none());
        let written = list_names(written);
        if scaled.is_empty() || written.is_empty() {
            return None;
        }
        Some(format!(
            "Lengths in pixels are scaled to pictures {} wide for {}, and are as written for {}, whose filter.toml names no \
             reference_width. Give its lengths unit = \"pixels\" and name one, or compare all as written.",
            self.render.width,
            scaled.join(", "),
            written.join(", ")
        ))
    }
}

/// Lists filters with their presets, each once.
fn list_names<'a>(cases: impl Iterator<Item = &'a Case>) -> Vec<String> {
    let mut names = Vec::new();
    for case in cases {
        let name = format!("{}:{}", case.filter, case.preset);
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}
