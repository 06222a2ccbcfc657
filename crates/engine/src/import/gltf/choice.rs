//! Choices by name: the animation, and the camera.

use super::animation::display_name;
use super::file::File;
use super::schema::Perspective;
use super::stage::Stage;

/// Returns the animations of the names, or the first, and a note that names the others.
pub fn choose_animations(
    file: &File,
    names: &[String],
) -> Result<(Vec<usize>, Option<String>), String> {
    let count = file.json.animations.len();
    let all: Vec<String> = (0..count)
        .map(|index| display_name(&file.json, index))
        .collect();
    let list = quote(&all);
    if names.is_empty() {
        let note = (count > 1).then(|| {
            format!(
                "animation \"{}\" of {list} is imported; name another with --animation, or several that play together",
                all[0]
            )
        });
        return Ok(((0..count.min(1)).collect(), note));
    }
    let find = |name: &String| match all.iter().position(|other| other == name) {
        Some(index) => Ok(index),
        None if count == 0 => Err(format!("has no animation \"{name}\", and no other")),
        None => Err(format!("has no animation \"{name}\"; allowed: {list}")),
    };
    let chosen = names.iter().map(find).collect::<Result<_, String>>()?;
    Ok((chosen, None))
}

/// A node with a perspective camera.
pub struct NodeCamera<'a> {
    pub node: usize,
    pub lens: &'a Perspective,
}

/// Returns the camera of a name, of its own or its node's, or the first; none if the file shows
/// none; with a note about others.
pub fn choose_camera<'a>(
    stage: &'a Stage,
    name: Option<&str>,
) -> Result<(Option<NodeCamera<'a>>, Option<String>), String> {
    let json = &stage.file.json;
    let mut cameras = Vec::new();
    let mut orthographic = Vec::new();
    for node in &stage.tree.shown {
        let Some(index) = json.nodes[*node].camera else {
            continue;
        };
        let camera = File::entry(&json.cameras, "cameras", index)?;
        let names = [&json.nodes[*node].name, &camera.name];
        let title = names.iter().find(|name| !name.is_empty());
        let title = title.map_or_else(|| index.to_string(), |name| (*name).clone());
        match &camera.perspective {
            Some(lens) if camera.kind == "perspective" => cameras.push((title, names, *node, lens)),
            _ => orthographic.push((title, names)),
        }
    }
    let titles: Vec<String> = cameras.iter().map(|(title, ..)| title.clone()).collect();
    let list = quote(&titles);
    let chosen = match name {
        None => cameras.first(),
        Some(name) => {
            let is_named = |title: &String, names: &[&String; 2]| {
                title == name || names.iter().any(|other| *other == name)
            };
            let found = cameras
                .iter()
                .find(|(title, names, ..)| is_named(title, names));
            if found.is_none() {
                let what = if orthographic
                    .iter()
                    .any(|(title, names)| is_named(title, names))
                {
                    format!("its camera \"{name}\" is orthographic, which scenes do not have")
                } else {
                    format!("has no camera \"{name}\"")
                };
                let allowed = if titles.is_empty() {
                    "none is perspective; leave --camera out, and one is framed on the model"
                        .to_owned()
                } else {
                    format!("allowed: {list}")
                };
                return Err(format!("{what}; {allowed}"));
            }
            found
        }
    };
    let note = match chosen {
        Some((title, ..)) if name.is_none() && cameras.len() > 1 => Some(format!(
            "camera \"{title}\" of {list} is imported; choose another with --camera"
        )),
        None if !orthographic.is_empty() => {
            Some("its orthographic camera has no counterpart".to_owned())
        }
        _ => None,
    };
    let chosen = chosen.map(|(_, _, node, lens)| NodeCamera { node: *node, lens });
    Ok((chosen, note))
}

fn quote(names: &[String]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
    names.join(", ")
}
