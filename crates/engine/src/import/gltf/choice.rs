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

/// A camera that the file shows.
struct Shown<'a> {
    node: usize,
    /// Names of its node and of itself.
    names: [&'a str; 2],
    /// Name in messages.
    title: String,
    /// None if it is orthographic.
    lens: Option<&'a Perspective>,
}

fn list_cameras(stage: &Stage) -> Result<Vec<Shown<'_>>, String> {
    let json = &stage.file.json;
    let mut cameras = Vec::new();
    for node in &stage.tree.shown {
        let Some(index) = json.nodes[*node].camera else {
            continue;
        };
        let camera = File::entry(&json.cameras, "cameras", index)?;
        let names = [json.nodes[*node].name.as_str(), camera.name.as_str()];
        let title = names.iter().find(|name| !name.is_empty());
        cameras.push(Shown {
            node: *node,
            names,
            title: title.map_or_else(|| index.to_string(), |name| (*name).to_owned()),
            lens: (camera.perspective.as_ref()).filter(|_| camera.kind == "perspective"),
        });
    }
    Ok(cameras)
}

/// Returns the camera of a name, of its own or its node's, or the first; none if the file shows
/// none; with a note about others.
pub fn choose_camera<'a>(
    stage: &'a Stage,
    name: Option<&str>,
) -> Result<(Option<NodeCamera<'a>>, Option<String>), String> {
    let cameras = list_cameras(stage)?;
    let titles: Vec<String> = (cameras.iter())
        .filter(|camera| camera.lens.is_some())
        .map(|camera| camera.title.clone())
        .collect();
    let list = quote(&titles);
    let node_camera = |camera: &Shown<'a>| {
        Some(NodeCamera {
            node: camera.node,
            lens: camera.lens?,
        })
    };
    let Some(name) = name else {
        let chosen = cameras.iter().find_map(node_camera);
        let note = match titles.len() {
            0 if cameras.is_empty() => None,
            0 => Some("its orthographic camera has no counterpart".to_owned()),
            1 => None,
            _ => Some(format!(
                "camera \"{}\" of {list} is imported; choose another with --camera",
                titles[0]
            )),
        };
        return Ok((chosen, note));
    };
    let mut named = (cameras.iter())
        .filter(|camera| camera.title == name || camera.names.contains(&name))
        .peekable();
    let what = match named.peek() {
        Some(_) => format!("its camera \"{name}\" is orthographic, which scenes do not have"),
        None => format!("has no camera \"{name}\""),
    };
    if let Some(chosen) = named.find_map(node_camera) {
        return Ok((Some(chosen), None));
    }
    let allowed = if titles.is_empty() {
        "none is perspective; leave --camera out, and one is framed on the model".to_owned()
    } else {
        format!("allowed: {list}")
    };
    Err(format!("{what}; {allowed}"))
}

fn quote(names: &[String]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
    names.join(", ")
}
