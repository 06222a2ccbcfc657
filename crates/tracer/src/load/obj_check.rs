//! What an OBJ file must hold before tobj reads it: tobj names no lines, takes NaN for a number, forgets materials that
//! it does not find, and panics on some indices.

use std::path::Path;

use super::error::SceneError;
use super::files::Files;
use super::mtl::Libraries;
use super::statements::{Statement, statements};

/// How many of each precede a face, in the order of a corner's indices.
#[derive(Default)]
struct Counts {
    vertices: usize,
    texcoords: usize,
    normals: usize,
}

/// Which indices the corners of a face have: texture coordinates, normals.
type Form = (bool, bool);

/// Checks an OBJ file, reads the MTL files that it names, and returns the statements that make up its mesh.
pub(super) fn check(
    files: &mut Files,
    path: &Path,
    text: &str,
    libraries: &mut Libraries,
) -> Result<String, SceneError> {
    let mut checked = String::new();
    let mut counts = Counts::default();
    // Of the faces that tobj will take as one mesh: it would mix up their arrays if their forms differed.
    let mut form: Option<Form> = None;
    let mut material = "";
    for statement in statements(text) {
        let fail = |reason: String| SceneError::line(path, statement.line, reason);
        match statement.keyword {
            "v" => {
                check_vertex(&statement).map_err(fail)?;
                counts.vertices += 1;
            }
            "vt" => {
                statement.numbers(&[2, 3]).map_err(fail)?;
                counts.texcoords += 1;
            }
            "vn" => {
                let normal = statement.numbers(&[3]).map_err(fail)?;
                if normal.iter().map(|part| part * part).sum::<f32>() == 0.0 {
                    return Err(fail("vn has no length; a normal is a direction".into()));
                }
                counts.normals += 1;
            }
            "f" => {
                let found = check_face(&statement, &counts).map_err(fail)?;
                if *form.get_or_insert(found) != found {
                    let reason = "the face has other kinds of indices than those before it; give texture \
                                  coordinates and normals to all faces of a group and material, or to none";
                    return Err(fail(reason.into()));
                }
            }
            "o" | "g" => form = None,
            "usemtl" => {
                check_material(&statement, libraries).map_err(fail)?;
                if statement.rest != material {
                    form = None;
                    material = statement.rest;
                }
            }
            "mtllib" => {
                let library = path.with_file_name("").join(statement.rest);
                libraries
                    .add(files, &library, statement.rest)
                    .map_err(|error| {
                        let name = library.display();
                        fail(format!("material library {name} cannot be read: {error}"))
                    })??;
            }
            // Lines and points too: tobj would make triangles of lines with three points.
            _ => continue,
        }
        // Six numbers are a position and a colour, which nothing here uses.
        let words = statement.rest.split_whitespace();
        let rest = match (statement.keyword, words.clone().count()) {
            ("v", 6) => words.take(3).collect::<Vec<_>>().join(" "),
            _ => statement.rest.to_owned(),
        };
        checked += &format!("{} {rest}\n", statement.keyword);
    }
    Ok(checked)
}

fn check_vertex(statement: &Statement) -> Result<(), String> {
    let numbers = statement.numbers(&[3, 4, 6])?;
    if numbers.len() == 4 && numbers[3] == 0.0 {
        return Err("v has the weight 0, which puts it at infinity; leave the weight out".into());
    }
    Ok(())
}

fn check_material(statement: &Statement, libraries: &Libraries) -> Result<(), String> {
    if libraries.defines(statement.rest) {
        return Ok(());
    }
    Err(format!(
        "usemtl names material \"{}\", which no mtllib above it defines; materials: {}",
        statement.rest,
        libraries.names()
    ))
}

fn check_face(statement: &Statement, counts: &Counts) -> Result<Form, String> {
    let mut form = None;
    let mut corners = 0;
    for corner in statement.rest.split_whitespace() {
        let found = check_corner(corner, counts)?;
        if *form.get_or_insert(found) != found {
            return Err(format!(
                "f has corners with different kinds of indices: \"{}\"; write all as v, v/vt, v//vn or v/vt/vn",
                statement.rest
            ));
        }
        corners += 1;
    }
    match form {
        Some(form) if corners >= 3 => Ok(form),
        _ => Err(format!("f has {corners} corners; a face needs at least 3")),
    }
}

fn check_corner(corner: &str, counts: &Counts) -> Result<Form, String> {
    let mut parts = corner.split('/');
    let mut index = |what: &str, count: usize| match parts.next() {
        None | Some("") => Ok(false),
        Some(word) => check_index(word, what, count).map(|()| true),
    };
    let vertex = index("vertex", counts.vertices)?;
    let texcoord = index("texture coordinate", counts.texcoords)?;
    let normal = index("normal", counts.normals)?;
    if !vertex || parts.next().is_some() {
        return Err(format!(
            "f has the corner \"{corner}\"; allowed: v, v/vt, v//vn or v/vt/vn"
        ));
    }
    Ok((texcoord, normal))
}

/// 1 is the first, -1 the latest so far.
fn check_index(word: &str, what: &str, count: usize) -> Result<(), String> {
    let index: i64 = word
        .parse()
        .map_err(|_| format!("f has the {what} index \"{word}\"; allowed: whole numbers"))?;
    if index != 0 && index.unsigned_abs() <= count as u64 {
        return Ok(());
    }
    Err(if count == 0 {
        format!("f has the {what} index {index}, but no {what} precedes it")
    } else {
        format!("f has the {what} index {index}; allowed: 1 to {count}, or -{count} to -1")
    })
}
