//! Members of the uniform blocks of a shader, and their values.

use std::collections::BTreeSet;

use wgpu::naga::{Handle, Module, Type};

use crate::filter::{Binding, MATRIX_NUMBERS};
use crate::shader::{BlockNumber, Member, NumberKind, UniformBlock, list_members, name_element};
use crate::{Expression, Filter};

/// Name that stands for all members without a value of their own.
const OTHERS: &str = "*";

/// Lays out the values of a block. `by_rows` has the members that contain the rows of a matrix, by
/// name and offset.
pub(super) fn fill_block(
    filter: &Filter,
    module: &Module,
    block: Handle<Type>,
    binding: Option<&Binding>,
    by_rows: &BTreeSet<(String, u32)>,
) -> Result<UniformBlock, String> {
    let given = binding.map_or(&[][..], |binding| &binding.values);
    let others = given.iter().find(|(name, _)| name == OTHERS);
    // An array without a length is as long as its list.
    let find_length = |name: &str, offset| {
        let values = find_given(given, name, offset).or(others);
        values.map_or(0, |(_, values)| spell_out(filter, values, false).len())
    };
    let members = list_members(module, block, &find_length)?;
    let missing = members
        .iter()
        .filter(|member| find_values(filter, given, member).is_none());
    let missing: Vec<&Member> = missing.collect();
    if !missing.is_empty() {
        return Err(refuse_missing(filter, &missing));
    }
    let mut numbers = Vec::new();
    for member in &members {
        let values = find_values(filter, given, member).unwrap_or_default();
        let own_name = member.name.rsplit('.').next().unwrap_or_default();
        let is_by_rows = by_rows.contains(&(own_name.to_owned(), member.own_offset));
        let values = spell_out(filter, &values, is_by_rows);
        if values.len() != 1 && values.len() != member.numbers.len() {
            return Err(format!(
                "its member \"{}\" holds {}, and `values` has {} for it; allowed: one for all, or as many as it holds",
                member.name,
                describe(&member.numbers),
                values.len()
            ));
        }
        let values = values.iter().cycle();
        let placed = member.numbers.iter().zip(values);
        numbers.extend(placed.map(|((offset, kind), value)| BlockNumber {
            offset: *offset,
            kind,
            value: value.clone(),
        }));
    }
    let is_known = |name: &str| {
        let mut members = members.iter();
        name == OTHERS || members.any(|member| is_meant(name, &member.name, member.offset))
    };
    if let Some((name, _)) = given.iter().find(|(name, _)| !is_known(name)) {
        let names: Vec<&str> = members.iter().map(|member| &member.name[..]).collect();
        return Err(format!(
            "`values` names \"{name}\", which is no member; it has: {}",
            names.join(", ")
        ));
    }
    UniformBlock::new(module, block, numbers)
}

/// Names all members that have no value.
fn refuse_missing(filter: &Filter, missing: &[&Member]) -> String {
    let names = missing.iter().map(|member| {
        let Member {
            name,
            offset,
            numbers,
            ..
        } = member;
        format!("\"{name}\" ({} at byte {offset})", describe(numbers))
    });
    let names = names.collect::<Vec<_>>().join(", ");
    let (whose, add) = match missing {
        [_] => (format!("its member {names} has no value"), "add it"),
        _ => (format!("its members {names} have no values"), "add them"),
    };
    format!(
        "{whose}; {add} to `values` of its [[pass.binding]], as a number, a parameter, an expression, or one of {}; 0 for \
         padding, and \"*\" = 0 for all others",
        filter.list_values()
    )
}

/// Finds the values of a member: its own, those that it is called after, or those of all others;
/// none if it has none.
fn find_values(
    filter: &Filter,
    given: &[(String, Vec<Expression>)],
    member: &Member,
) -> Option<Vec<Expression>> {
    let Member {
        name,
        offset,
        numbers,
        ..
    } = member;
    let is_named = filter.count_numbers(name) == Some(numbers.len());
    let others = given.iter().find(|(name, _)| name == OTHERS);
    (find_given(given, name, *offset).map(|(_, values)| values.clone()))
        .or_else(|| is_named.then(|| vec![Expression::Name(name.clone())]))
        .or_else(|| others.map(|(_, values)| values.clone()))
}

/// Returns true if `values` means a member by this name: its own, its offset, or that of a struct
/// or array around it.
fn is_meant(name: &str, member: &str, offset: u32) -> bool {
    let rest = member.strip_prefix(name);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
        || name == format!("@{offset}")
}

/// Finds what `values` says about a member: under its own name, or else that of the innermost
/// struct that it names.
fn find_given<'a>(
    given: &'a [(String, Vec<Expression>)],
    member: &str,
    offset: u32,
) -> Option<&'a (String, Vec<Expression>)> {
    let meant = given
        .iter()
        .filter(|(name, _)| is_meant(name, member, offset));
    meant.max_by_key(|(name, _)| name.len())
}

/// Expands a value that stands for several numbers to one value each. Matrices come column by
/// column, or row by row.
fn spell_out(filter: &Filter, values: &[Expression], is_by_rows: bool) -> Vec<Expression> {
    let spelled = values.iter().flat_map(|value| {
        let Expression::Name(name) = value else {
            return vec![value.clone()];
        };
        let numbers = filter.count_numbers(name).unwrap_or(1);
        let place = |index: usize| {
            if is_by_rows && numbers == MATRIX_NUMBERS {
                4 * (index % 4) + index / 4
            } else {
                index
            }
        };
        match numbers {
            1 => vec![value.clone()],
            _ => (0..numbers)
                .map(|index| Expression::Name(name_element(name, place(index))))
                .collect(),
        }
    });
    spelled.collect()
}

fn describe(numbers: &[(u32, NumberKind)]) -> String {
    let kind = numbers.first().map_or("nothing", |(_, kind)| kind);
    match numbers.len() {
        1 => kind.to_owned(),
        count => format!("{count} x {kind}"),
    }
}
