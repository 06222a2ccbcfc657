//! The pieces that a scene's objects are made of.

use std::collections::BTreeMap;

use measure::Error;

use super::images::plain_name;
use super::look::Look;
use super::material::Materials;
use super::moment::Clip;
use super::piece::Piece;
use super::stage::Stage;

/// Lists the pieces of all nodes that are shown, with the looks of their primitives.
pub fn list_pieces(
    stage: &Stage,
    clip: &Clip,
    materials: &mut Materials,
) -> Result<Vec<(Piece, Vec<Look>)>, Error> {
    let json = &stage.file.json;
    let mut names = BTreeMap::new();
    let mut pieces = Vec::new();
    let mut flat = 0;
    for node in &stage.tree.shown {
        let Some(mesh) = json.nodes[*node].mesh else {
            continue;
        };
        if is_flat(stage, clip, *node) {
            flat += 1;
            continue;
        }
        let mut kinds = [Vec::new(), Vec::new()];
        for (index, primitive) in stage.meshes.primitives[&mesh].iter().enumerate() {
            let look = materials.look(primitive)?;
            kinds[usize::from(look.is_blended)].push((index, look));
        }
        for (kind, parts) in kinds.into_iter().enumerate() {
            if parts.is_empty() {
                continue;
            }
            let (primitives, looks) = parts.into_iter().unzip();
            let title = match json.nodes[*node].name.as_str() {
                "" => json.meshes[mesh].name.as_str(),
                name => name,
            };
            pieces.push((
                Piece {
                    name: object_name(title, kind == 1, &mut names),
                    node: *node,
                    mesh,
                    primitives,
                    is_blended: kind == 1,
                },
                looks,
            ));
        }
    }
    materials
        .lost
        .count(flat, "node scaled to nothing", "nodes scaled to nothing");
    Ok(pieces)
}

/// Returns whether a node is scaled to nothing all the time, as files hide things.
fn is_flat(stage: &Stage, clip: &Clip, node: usize) -> bool {
    let [start, end] = clip.span;
    let is_flat = |frame: f64| {
        let world = stage.world(node, clip.moment(frame).seconds);
        let axes = [world.x_axis, world.y_axis, world.z_axis];
        axes.iter().filter(|axis| axis.length() < 1e-9).count() > 1
    };
    let is_skinned = stage.file.json.nodes[node].skin.is_some();
    !is_skinned && [start, 0.0, end].into_iter().all(is_flat)
}

/// Names an object by its node: unique, and of letters that scenes allow.
fn object_name(title: &str, is_blended: bool, names: &mut BTreeMap<String, usize>) -> String {
    let mut name = plain_name(title);
    if name.is_empty() {
        name = "node".to_owned();
    }
    if is_blended {
        name += "_blended";
    }
    let reserved = ["background", "camera", "floor", "wall"];
    if reserved.contains(&name.as_str()) || name.starts_with("point_light_") {
        name = format!("node_{name}");
    }
    loop {
        let count = names.entry(name.clone()).or_insert(0);
        *count += 1;
        if *count == 1 {
            return name;
        }
        name = format!("{name}_{count}");
    }
}
