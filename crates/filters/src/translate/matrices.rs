//! Order of the numbers of matrices in uniform blocks: columns or rows one after the other.

use std::collections::{BTreeMap, BTreeSet};

use super::Language;
use super::words::{Words, decoration, op};

/// Finds the members that hold the rows of a matrix as its author sees it, by name and offset.
///
/// What HLSL and Slang call a column is a row in their SPIR-V, so the decorations say the opposite there.
pub(super) fn find_by_rows(words: &Words, language: Language) -> BTreeSet<(String, u32)> {
    let rows = match language {
        Language::Hlsl | Language::Slang => decoration::COL_MAJOR,
        _ => decoration::ROW_MAJOR,
    };
    let decorated: BTreeSet<[u32; 2]> = (words.all(op::MEMBER_DECORATE))
        .filter(|[_, _, kind]| *kind == rows)
        .map(|[block, member, _]| [block, member])
        .collect();
    if decorated.is_empty() {
        return BTreeSet::new();
    }
    let offsets: BTreeMap<[u32; 2], u32> = (words.all(op::MEMBER_DECORATE))
        .filter(|[_, _, kind, _]| *kind == decoration::OFFSET)
        .map(|[block, member, _, offset]| ([block, member], offset))
        .collect();
    let names = words.find_member_names();
    let find = |member: [u32; 2]| {
        let offset = *offsets.get(&member)?;
        let name = names.get(&member).cloned().filter(|name| !name.is_empty());
        Some((name.unwrap_or_else(|| format!("@{offset}")), offset))
    };
    decorated.into_iter().filter_map(find).collect()
}
