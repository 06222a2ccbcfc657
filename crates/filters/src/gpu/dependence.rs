//! Dependence of passes on the colour image and on the frame's index.

use std::collections::BTreeSet;

use crate::Filter;
use crate::filter::History;
use crate::shader::EntryPoint;

/// What changes the result of a pass, by itself or through other passes.
#[derive(Clone, Copy)]
pub(super) struct Dependence {
    /// The colour image.
    pub color: bool,
    /// The frame's index.
    pub noise: bool,
}

/// Finds what each pass depends on.
pub(super) fn find_dependences(filter: &Filter) -> Vec<Dependence> {
    let colors = find_color_dependent(filter).into_iter();
    let passes = colors.zip(find_noise_dependent(filter));
    let passes = passes.map(|(color, noise)| Dependence { color, noise });
    passes.collect()
}

/// Finds the passes whose result depends on the colour image, by themselves or through other
/// passes.
pub(super) fn find_color_dependent(filter: &Filter) -> Vec<bool> {
    let before = History::Color.texture();
    find_dependent(filter, BTreeSet::from(["color", before, "output"]), |_| {
        false
    })
}

/// Finds the passes whose result depends on the frame's index, by themselves or through other
/// passes.
fn find_noise_dependent(filter: &Filter) -> Vec<bool> {
    find_dependent(filter, BTreeSet::new(), |entry| entry.draws_noise)
}

/// Finds the passes that are sources, that touch a tainted texture, or that touch what such a pass
/// writes.
fn find_dependent<'f>(
    filter: &'f Filter,
    mut tainted: BTreeSet<&'f str>,
    is_source: fn(&EntryPoint) -> bool,
) -> Vec<bool> {
    loop {
        let known = tainted.len();
        let dependent = filter
            .passes
            .iter()
            .map(|pass| {
                let entry = filter.entry_point(pass);
                let EntryPoint { reads, writes, .. } = entry;
                let mut touched = reads.iter().chain(writes);
                let dependent =
                    is_source(entry) || touched.any(|texture| tainted.contains(&texture[..]));
                if dependent {
                    tainted.extend(writes.iter().map(String::as_str));
                }
                dependent
            })
            .collect();
        if tainted.len() == known {
            return dependent;
        }
    }
}
