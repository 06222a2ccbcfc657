//! Checks of an OBJ file before tobj reads it: tobj reports no lines, accepts NaN, forgets unknown materials and panics on
//! some indices.

use std::path::Path;

use super::error::SceneError;
use super::files::Files;
use super::mtl::Libraries;
use super::statements::{Statement, shorten, split_statements};
use crate::limits::{LARGEST_NUMBER, MOST_CORNERS, MOST_TRIANGLES, MOST_VERTICES};

/// Numbers of elements above a line.
#[derive(Default)]
struct Counts {
    vertices: usize,
    texcoords: usize,
    normals: usize,
    triangles: usize,
}

/// Kinds of indices that the corners of a face have: texture coordinates, normals.
type Form = (bool, bool);

/// Checks an OBJ file, reads the MTL files that it names, and returns the statements of its mesh.
pub(super) fn check_obj(
    files: &mut Files,
    path: &Path,
    text: &str,
    libraries: &mut Libraries,
) -> Result<String, SceneError> {
    let mut checked = String::with_capacity(text.len());
    let mut counts = Counts::default();
    // Form of the faces that tobj takes as one mesh; it would mix up their arrays if their forms differed.
    let mut form: Option<Form> = None;
    let mut material = "";
    for statement in split_statements(text) {
        let fail = |reason: String| SceneError::at_line(path, statement.line, reason);
        match statement.keyword {
            "v" => {
                check_vertex(&statement).map_err(fail)?;
                add_count(&mut counts.vertices, 1, MOST_VERTICES, "vertices").map_err(fail)?;
            }
            "vt" => {
                statement.read_numbers(&[2, 3]).map_err(fail)?;
                let texcoords = &mut counts.texcoords;
                add_count(texcoords, 1, MOST_VERTICES, "texture coordinates").map_err(fail)?;
            }
            "vn" => {
                let normal = statement.read_numbers(&[3]).map_err(fail)?;
                if normal.iter().map(|part| part * part).sum::<f32>() == 0.0 {
                    return Err(fail("vn has no length; give it a direction".into()));
                }
                add_count(&mut counts.normals, 1, MOST_VERTICES, "normals").map_err(fail)?;
            }
            "f" => {
                let (found, corners) = check_face(&statement, &counts).map_err(fail)?;
                let triangles = &mut counts.triangles;
                add_count(triangles, corners - 2, MOST_TRIANGLES, "triangles").map_err(fail)?;
                if *form.get_or_insert(found) != found {
                    let reason = "the face has other kinds of indices than the faces before it; give texture \
                                  coordinates and normals to all faces of a group and material, or to none";
                    return Err(fail(reason.into()));
                }
            }
            "o" | "g" => {
                statement.check_name().map_err(fail)?;
                form = None;
            }
            "usemtl" => {
                statement.check_name().map_err(fail)?;
                check_material(&statement, libraries).map_err(fail)?;
                if statement.rest != material {
                    form = None;
                    material = statement.rest;
                }
            }
            "mtllib" => {
                statement.check_name().map_err(fail)?;
                let library = path.with_file_name("").join(statement.rest);
                libraries
                    .add(files, &library, statement.rest)
                    .map_err(|error| {
                        let name = library.display();
                        fail(format!("material library {name} cannot be read: {error}"))
                    })??;
            }
            // Skips lines and points too: tobj would make triangles of lines with three points.
            _ => continue,
        }
        checked += statement.keyword;
        // Six numbers are a position and a colour, which is not used.
        let words = || statement.rest.split_whitespace();
        if statement.keyword == "v" && words().count() == 6 {
            for word in words().take(3) {
                checked += " ";
                checked += word;
            }
        } else {
            checked += " ";
            checked += statement.rest;
        }
        checked += "\n";
    }
    Ok(checked)
}

/// Adds to a count, up to a limit.
fn add_count(count: &mut usize, more: usize, most: usize, what: &str) -> Result<(), String> {
    *count += more;
    if *count <= most {
        return Ok(());
    }
    Err(format!(
        "the file has more than {most} {what}, as many as are allowed; simplify the mesh, or split it into several files"
    ))
}

fn check_vertex(statement: &Statement) -> Result<(), String> {
    let numbers = statement.read_numbers(&[3, 4, 6])?;
    if numbers.len() == 4 && numbers[3] == 0.0 {
        return Err("v has the weight 0, which puts it at infinity; leave the weight out".into());
    }
    let (coordinates, weight) = numbers.split_at(3);
    if let [weight] = weight
        && coordinates
            .iter()
            .any(|part| f64::from(part / weight).abs() > LARGEST_NUMBER)
    {
        return Err(format!(
            "v has the weight {weight:e}, which puts it beyond {LARGEST_NUMBER:e}; leave the weight out"
        ));
    }
    Ok(())
}

fn check_material(statement: &Statement, libraries: &Libraries) -> Result<(), String> {
    if libraries.defines(statement.rest) {
        return Ok(());
    }
    Err(format!(
        "usemtl names material \"{}\", which no mtllib above it defines; materials: {}",
        shorten(statement.rest),
        libraries.list_names()
    ))
}

/// Checks a face, and returns its form and number of corners.
fn check_face(statement: &Statement, counts: &Counts) -> Result<(Form, usize), String> {
    let mut form = None;
    let mut corners = 0;
    for corner in statement.rest.split_whitespace() {
        let found = check_corner(corner, counts)?;
        if *form.get_or_insert(found) != found {
            return Err(format!(
                "f has corners with different kinds of indices: \"{}\"; write all as v, v/vt, v//vn or v/vt/vn",
                shorten(statement.rest)
            ));
        }
        corners += 1;
    }
    match form {
        Some(_) if corners > MOST_CORNERS => Err(format!(
            "f has {corners} corners; allowed: 3 to {MOST_CORNERS}; cut the face into triangles"
        )),
        Some(form) if corners >= 3 => Ok((form, corners)),
        _ => Err(format!("f has {corners} corners; allowed: 3 or more")),
    }
}

fn check_corner(corner: &str, counts: &Counts) -> Result<Form, String> {
    let mut parts = corner.split('/');
    let mut read_index = |what: &str, count: usize| match parts.next() {
        None | Some("") => Ok(false),
        Some(word) => check_index(word, what, count).map(|()| true),
    };
    let vertex = read_index("vertex", counts.vertices)?;
    let texcoord = read_index("texture coordinate", counts.texcoords)?;
    let normal = read_index("normal", counts.normals)?;
    if !vertex || parts.next().is_some() {
        return Err(format!(
            "f has the corner \"{}\"; allowed: v, v/vt, v//vn or v/vt/vn",
            shorten(corner)
        ));
    }
    Ok((texcoord, normal))
}

/// Checks an index: 1 is the first element, -1 the latest above the line.
fn check_index(word: &str, what: &str, count: usize) -> Result<(), String> {
    let index: i64 = word.parse().map_err(|_| {
        let word = shorten(word);
        format!("f has the {what} index \"{word}\"; allowed: whole numbers")
    })?;
    if index != 0 && index.unsigned_abs() <= count as u64 {
        return Ok(());
    }
    Err(if count == 0 {
        format!("f has the {what} index {index}, but no {what} stands above it")
    } else {
        format!("f has the {what} index {index}; allowed: 1 to {count}, or -{count} to -1")
    })
}
