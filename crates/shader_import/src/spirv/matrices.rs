//! Order of the numbers of matrices in uniform blocks: columns or rows one after the other.

use std::collections::{BTreeMap, BTreeSet};

use spirv::{Decoration, Op};

use super::words::Words;
use crate::language::Language;

/// Finds the members that contain the rows of a matrix as its author sees it, by name and offset.
///
/// What HLSL and Slang call a column is a row in their SPIR-V, so the decorations say the opposite
/// there.
pub(super) fn find_by_rows(words: &Words, language: Language) -> BTreeSet<(String, u32)> {
    let rows = match language {
        Language::Hlsl | Language::Slang => Decoration::ColMajor,
        _ => Decoration::RowMajor,
    };
    let decorated = (words.all(Op::MemberDecorate))
        .filter(|[_, _, kind]| *kind == rows as u32)
        .map(|[block, member, _]| [block, member]);
    let offsets: BTreeMap<[u32; 2], u32> = (words.all(Op::MemberDecorate))
        .filter(|[_, _, kind, _]| *kind == Decoration::Offset as u32)
        .map(|[block, member, _, offset]| ([block, member], offset))
        .collect();
    let names = words.find_names(Op::MemberName);
    let find = |member: [u32; 2]| {
        let offset = *offsets.get(&member)?;
        let name = names.get(&member).cloned();
        Some((name.unwrap_or_else(|| format!("@{offset}")), offset))
    };
    decorated.filter_map(find).collect()
}
