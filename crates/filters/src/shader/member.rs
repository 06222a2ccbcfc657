//! Members of blocks, and the places of their numbers.

use wgpu::naga::{ArraySize, Handle, Module, Scalar, Type, TypeInner, VectorSize};

/// Upper limit on the numbers of a block. The data of a scene that Godot hands over, of this frame
/// and the last, has some 1,500.
const MAX_NUMBERS: usize = 4096;

/// A member of a block: its name, its place and its numbers.
pub(crate) struct Member {
    /// Path from the block, such as `GBuffer.ScreenSize`.
    pub name: String,
    /// Offset in bytes.
    pub offset: u32,
    /// Offset in bytes in the struct that declares it.
    pub own_offset: u32,
    /// Places and kinds of its numbers.
    pub numbers: Vec<(u32, NumberKind)>,
}

/// Type of a number of 32 bits, as WGSL names it.
pub(crate) type NumberKind = &'static str;

/// Returns the kind of a scalar; none for those of other sizes.
fn find_kind(scalar: Scalar) -> Option<NumberKind> {
    match scalar {
        Scalar::F32 => Some("f32"),
        Scalar::I32 => Some("i32"),
        Scalar::U32 => Some("u32"),
        _ => None,
    }
}

/// Names one number of several.
pub(crate) fn name_element(whole: &str, index: usize) -> String {
    format!("{whole}[{index}]")
}

/// Lists the members of a block; those of structs in it by their paths. `find_length` says how many
/// numbers an array without a length gets, by its name and offset.
pub(crate) fn list_members(
    module: &Module,
    block: Handle<Type>,
    find_length: &dyn Fn(&str, u32) -> usize,
) -> Result<Vec<Member>, String> {
    let mut lister = Lister {
        module,
        find_length,
        left: MAX_NUMBERS,
        members: Vec::new(),
    };
    lister.list(String::new(), block, 0, 0)?;
    Ok(lister.members)
}

/// Members of a block, listed so far.
struct Lister<'a> {
    module: &'a Module,
    find_length: &'a dyn Fn(&str, u32) -> usize,
    /// Numbers that it may still have.
    left: usize,
    members: Vec<Member>,
}

/// Returns the place of an element.
fn place(offset: u32, index: u32, stride: u32) -> u32 {
    offset.saturating_add(index.saturating_mul(stride))
}

impl Lister<'_> {
    /// Lists what lies at a path and an offset; `own_offset` is that within the innermost struct.
    fn list(
        &mut self,
        path: String,
        ty: Handle<Type>,
        offset: u32,
        own_offset: u32,
    ) -> Result<(), String> {
        let types = &self.module.types;
        match &types[ty].inner {
            TypeInner::Struct { members, .. } => members.iter().try_for_each(|member| {
                let name = member.name.clone();
                let name = name.unwrap_or_else(|| format!("@{}", member.offset));
                let path = match &path[..] {
                    "" => name,
                    path => format!("{path}.{name}"),
                };
                let offset = offset.saturating_add(member.offset);
                self.list(path, member.ty, offset, member.offset)
            }),
            TypeInner::Array {
                base,
                size: ArraySize::Constant(count),
                stride,
            } if matches!(types[*base].inner, TypeInner::Struct { .. }) => (0..count.get())
                .try_for_each(|index| {
                    let path = name_element(&path, index as usize);
                    self.list(path, *base, place(offset, index, *stride), 0)
                }),
            inner => {
                let name = if path.is_empty() { "@0".into() } else { path };
                let mut numbers = Vec::new();
                let mut list = |ty, offset| {
                    let listed =
                        list_numbers(self.module, ty, offset, &mut self.left, &mut numbers);
                    listed.map_err(|reason| format!("its member \"{name}\" {reason}"))?;
                    Ok::<_, String>(numbers.len())
                };
                let of_element = list(ty, offset)?.max(1);
                if let TypeInner::Array {
                    base,
                    size: ArraySize::Dynamic,
                    stride,
                } = inner
                {
                    for index in 1..(self.find_length)(&name, offset) / of_element {
                        list(*base, place(offset, index as u32, *stride))?;
                    }
                }
                self.members.push(Member {
                    name,
                    offset,
                    own_offset,
                    numbers,
                });
                Ok(())
            }
        }
    }
}

/// Lists the numbers of a type in order: one element of an array without a length.
fn list_numbers(
    module: &Module,
    ty: Handle<Type>,
    offset: u32,
    left: &mut usize,
    numbers: &mut Vec<(u32, NumberKind)>,
) -> Result<(), String> {
    let mut row = |offset: u32, count: u32, scalar: Scalar| {
        let kind = find_kind(scalar).ok_or("holds numbers that are not of 32 bits")?;
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
            (0..*columns as u32)
                .try_for_each(|column| row(place(offset, column, stride), *rows as u32, *scalar))
        }
        TypeInner::Array { base, size, stride } => {
            let count = match size {
                ArraySize::Constant(count) => count.get(),
                _ => 1,
            };
            (0..count).try_for_each(|index| {
                // An array of empty structs is refused by its length.
                *left = left.checked_sub(1).ok_or("is too long")?;
                let place = place(offset, index, *stride);
                let listed = list_numbers(module, *base, place, left, numbers);
                *left += 1;
                listed
            })
        }
        TypeInner::Struct { members, .. } => members.iter().try_for_each(|member| {
            let offset = offset.saturating_add(member.offset);
            list_numbers(module, member.ty, offset, left, numbers)
        }),
        _ => Err("is no number, vector, matrix, array, or struct of these".into()),
    }
}
