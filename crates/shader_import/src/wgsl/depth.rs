//! Depth textures of WGSL, read as textures of floats: the frame's depth is one.

use std::ops::Range;

use naga::{Expression, Function, Handle, ImageClass, ImageDimension, Module, Type, TypeInner};

const DEPTH: &str = "texture_depth_2d";

/// Change of a text: a range of bytes, and what takes its place.
type Edit = (Range<usize>, &'static str);

/// Rewrites a text of WGSL so that its depth textures are `texture_2d<f32>`: reading one gives four
/// numbers, and the first is meant. Lines keep their numbers. None if it has no such texture, or
/// compares with one, which floats cannot do. `module` is made of the text.
pub(super) fn read_depth_as_floats(module: &Module, text: &str) -> Option<String> {
    let mut edits = list_declarations(text);
    if edits.is_empty() {
        return None;
    }
    let functions = module.functions.iter().map(|(_, function)| function);
    let entries = module.entry_points.iter().map(|entry| &entry.function);
    for function in functions.chain(entries) {
        list_reads(module, function, text, &mut edits)?;
    }
    // The last edit comes first, so that the places of the others stay valid.
    edits.sort_by_key(|(place, _)| std::cmp::Reverse(place.start));
    let mut rewritten = text.to_owned();
    for (place, new) in edits {
        rewritten.replace_range(place, new);
    }
    Some(rewritten)
}

/// Lists the places of the type's name.
fn list_declarations(text: &str) -> Vec<Edit> {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let whole = text.match_indices(DEPTH).filter(|(at, name)| {
        !text[..*at].ends_with(is_part) && !text[at + name.len()..].starts_with(is_part)
    });
    whole
        .map(|(at, name)| (at..at + name.len(), "texture_2d<f32>"))
        .collect()
}

/// Adds an edit for each read of a depth texture; none if one is a comparison.
fn list_reads(
    module: &Module,
    function: &Function,
    text: &str,
    edits: &mut Vec<Edit>,
) -> Option<()> {
    for (handle, expression) in function.expressions.iter() {
        let (image, gathers, compares) = match *expression {
            Expression::ImageLoad { image, .. } => (image, false, false),
            Expression::ImageSample {
                image,
                gather,
                depth_ref,
                ..
            } => (image, gather.is_some(), depth_ref.is_some()),
            _ => continue,
        };
        if !find_type(function, module, image).is_some_and(|ty| is_depth(module, ty)) {
            continue;
        }
        if compares {
            return None;
        }
        // The span of a call is its function's name.
        let name = function.expressions.get_span(handle).to_range()?;
        let arguments = find_brackets(text, name.end)?;
        let (at, new) = if gathers {
            // A gather from floats says of which component.
            (arguments.start + 1, "0, ")
        } else {
            (arguments.end, ".x")
        };
        edits.push((at..at, new));
    }
    Some(())
}

/// Finds the brackets that open first after a place, with what they hold.
fn find_brackets(text: &str, from: usize) -> Option<Range<usize>> {
    let mut start = None;
    let mut depth = 0;
    let mut at = from;
    while let Some(c) = text.get(at..)?.chars().next() {
        let rest = &text[at..];
        let comment = if rest.starts_with("//") {
            Some(rest.find('\n').unwrap_or(rest.len()))
        } else if rest.starts_with("/*") {
            Some(rest.find("*/")? + 2)
        } else {
            None
        };
        match c {
            '(' if comment.is_none() => {
                start.get_or_insert(at);
                depth += 1;
            }
            ')' if comment.is_none() => {
                depth -= 1;
                if depth == 0 {
                    return Some(start?..at + 1);
                }
            }
            _ => {}
        }
        at += comment.unwrap_or(c.len_utf8());
    }
    None
}

/// Finds the type of an image.
fn find_type(
    function: &Function,
    module: &Module,
    image: Handle<Expression>,
) -> Option<Handle<Type>> {
    match function.expressions[image] {
        Expression::GlobalVariable(variable) => Some(module.global_variables[variable].ty),
        Expression::FunctionArgument(index) => Some(function.arguments[index as usize].ty),
        _ => None,
    }
}

fn is_depth(module: &Module, ty: Handle<Type>) -> bool {
    matches!(
        module.types[ty].inner,
        TypeInner::Image {
            dim: ImageDimension::D2,
            arrayed: false,
            class: ImageClass::Depth { multi: false },
        }
    )
}

#[cfg(test)]
mod tests {
    use super::find_brackets;

    #[test]
    fn brackets_within_comments_do_not_count() {
        let text = "textureLoad (depth, /* ) */ at((1)), // )\n 0) + (2)";
        let range = find_brackets(text, "textureLoad".len()).unwrap();
        assert_eq!(&text[range], "(depth, /* ) */ at((1)), // )\n 0)");
        assert_eq!(find_brackets("textureLoad(depth", 11), None);
    }
}
