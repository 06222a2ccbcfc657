//! Members of the uniform blocks of a shader, and their values.

use std::collections::BTreeSet;

use wgpu::naga::proc::Layouter;
use wgpu::naga::{ArraySize, Handle, Module, Scalar, Type, TypeInner, VectorSize};

use crate::filter::{Binding, Expression, MATRIX_NUMBERS, name_element};
use crate::shader::{BlockNumber, NumberKind, UniformBlock};

/// Upper limit on the numbers of a block.
const MAX_NUMBERS: usize = 1024;

/// Name that stands for all members without a value of their own.
const OTHERS: &str = "*";

/// Upper limit on the bytes of a block, which every adapter grants.
const MAX_BYTES: u32 = 64 << 10;

/// A member of a block: its name, its place and its numbers.
struct Member {
    name: String,
    offset: u32,
    /// Places and kinds of its numbers.
    numbers: Vec<(u32, NumberKind)>,
}

/// Names that values may have.
pub(super) struct KnownValues<'a> {
    /// Counts the numbers of a name.
    pub count: &'a dyn Fn(&str) -> Option<usize>,
    /// List of the names, for messages.
    pub listed: String,
    /// Members that hold the rows of a matrix, by name and offset.
    pub by_rows: &'a BTreeSet<(String, u32)>,
}

/// Lays out the values of a block.
pub(super) fn fill_block(
    module: &Module,
    block: Handle<Type>,
    binding: Option<&Binding>,
    known: &KnownValues,
) -> Result<UniformBlock, String> {
    let mut layouter = Layouter::default();
    layouter
        .update(module.to_ctx())
        .map_err(|error| format!("has no layout: {error}"))?;
    let members = list_members(module, block)?;
    let given = binding.map_or(&[][..], |binding| &binding.values);
    let others = given.iter().find(|(name, _)| name == OTHERS);
    let others = others.map(|(_, values)| values);
    let mut numbers = Vec::new();
    for member in &members {
        let place = format!("@{}", member.offset);
        let value = given
            .iter()
            .find(|(name, _)| *name == member.name || *name == place);
        let values = match value {
            Some((_, values)) => values.clone(),
            None if (known.count)(&member.name) == Some(member.numbers.len()) => {
                vec![Expression::Name(member.name.clone())]
            }
            None if others.is_some() => others.cloned().unwrap_or_default(),
            None => {
                return Err(format!(
                    "its member \"{}\" ({} at byte {}) has no value; add it to `values` of its [[pass.binding]], as a \
                     number, a parameter, an expression, or one of {}; 0 for padding, and \"*\" = 0 for all others",
                    member.name,
                    describe(&member.numbers),
                    member.offset,
                    known.listed
                ));
            }
        };
        let is_by_rows = known
            .by_rows
            .contains(&(member.name.clone(), member.offset));
        let values = spell_out(&values, known.count, is_by_rows);
        if values.len() != 1 && values.len() != member.numbers.len() {
            return Err(format!(
                "its member \"{}\" holds {}, and `values` has {} for it; allowed: one for all, or as many as it holds",
                member.name,
                describe(&member.numbers),
                values.len()
            ));
        }
        for (index, (offset, kind)) in member.numbers.iter().enumerate() {
            numbers.push(BlockNumber {
                offset: *offset,
                kind: *kind,
                value: values.get(index).unwrap_or(&values[0]).clone(),
            });
        }
    }
    let is_member = |name: &String| {
        name == OTHERS
            || (members.iter())
                .any(|member| member.name == *name || format!("@{}", member.offset) == *name)
    };
    if let Some((name, _)) = given.iter().find(|(name, _)| !is_member(name)) {
        let names: Vec<&str> = members.iter().map(|member| &member.name[..]).collect();
        return Err(format!(
            "`values` names \"{name}\", which is no member; it has: {}",
            names.join(", ")
        ));
    }
    let bytes = layouter[block].size;
    if bytes > MAX_BYTES
        || numbers
            .iter()
            .any(|number| number.offset.saturating_add(4) > bytes)
    {
        return Err(format!(
            "takes {bytes} bytes; allowed: at most {MAX_BYTES}, with all members in it"
        ));
    }
    Ok(UniformBlock { bytes, numbers })
}

/// Writes a value that stands for several numbers as so many values. Matrices come column by column, or row by row.
fn spell_out(
    values: &[Expression],
    count: &dyn Fn(&str) -> Option<usize>,
    is_by_rows: bool,
) -> Vec<Expression> {
    let spelled = values.iter().flat_map(|value| {
        let Expression::Name(name) = value else {
            return vec![value.clone()];
        };
        let numbers = count(name).unwrap_or(1);
        let place = |index: usize| match is_by_rows && numbers == MATRIX_NUMBERS {
            true => 4 * (index % 4) + index / 4,
            false => index,
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
    let kind = numbers.first().map_or("nothing", |(_, kind)| kind.name());
    match numbers.len() {
        1 => kind.to_owned(),
        count => format!("{count} x {kind}"),
    }
}

fn list_members(module: &Module, block: Handle<Type>) -> Result<Vec<Member>, String> {
    let ty = &module.types[block];
    let mut left = MAX_NUMBERS;
    let mut list = |name: String, ty, offset| {
        let mut numbers = Vec::new();
        list_numbers(module, ty, offset, &mut left, &mut numbers)
            .map_err(|reason| format!("its member \"{name}\" {reason}"))?;
        Ok(Member {
            name,
            offset,
            numbers,
        })
    };
    match &ty.inner {
        TypeInner::Struct { members, .. } => (members.iter())
            .map(|member| {
                let name = member
                    .name
                    .clone()
                    .unwrap_or_else(|| format!("@{}", member.offset));
                list(name, member.ty, member.offset)
            })
            .collect(),
        _ => Ok(vec![list("@0".to_owned(), block, 0)?]),
    }
}

/// Lists the numbers of a type in order.
fn list_numbers(
    module: &Module,
    ty: Handle<Type>,
    offset: u32,
    left: &mut usize,
    numbers: &mut Vec<(u32, NumberKind)>,
) -> Result<(), String> {
    let mut row = |offset: u32, count: u32, scalar: Scalar| {
        let kind = NumberKind::of(scalar).ok_or("holds numbers that are not of 32 bits")?;
        *left = (left.checked_sub(count as usize))
            .ok_or_else(|| format!("makes the block hold more than {MAX_NUMBERS} numbers"))?;
        numbers.extend((0..count).map(|index| (offset.saturating_add(4 * index), kind)));
        Ok::<(), String>(())
    };
    match &module.types[ty].inner {
        TypeInner::Scalar(scalar) => row(offset, 1, *scalar),
        TypeInner::Vector { size, scalar } => row(offset, *size as u32, *scalar),
        TypeInner::Matrix {
            columns,
            rows,
            scalar,
        } => {
            let stride = match rows {
                VectorSize::Bi => 8,
                VectorSize::Tri | VectorSize::Quad => 16,
            };
            (0..*columns as u32).try_for_each(|column| {
                row(
                    offset.saturating_add(column * stride),
                    *rows as u32,
                    *scalar,
                )
            })
        }
        TypeInner::Array {
            base,
            size: ArraySize::Constant(count),
            stride,
        } => (0..count.get()).try_for_each(|index| {
            let offset = offset.saturating_add(index.saturating_mul(*stride));
            // An array of empty structs is refused by its length.
            *left = left.checked_sub(1).ok_or("is too long")?;
            let listed = list_numbers(module, *base, offset, left, numbers);
            *left += 1;
            listed
        }),
        TypeInner::Struct { members, .. } => members.iter().try_for_each(|member| {
            let offset = offset.saturating_add(member.offset);
            list_numbers(module, member.ty, offset, left, numbers)
        }),
        _ => Err("is no number, vector, matrix, array of known length, or struct of these".into()),
    }
}
