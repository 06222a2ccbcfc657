//! Reading of a file by a plan: its animations, and the time that a scene shows.

use super::animation::Animation;
use super::choice::choose_animations;
use super::file::File;
use super::moment::Clip;
use super::plan::GltfPlan;
use super::stage::Stage;
use super::tree::Tree;

/// Reads everything that moves, with the animations of the plan.
pub fn read_stage(plan: &GltfPlan, file: File, notes: &mut Vec<String>) -> Result<Stage, String> {
    let tree = Tree::read(&file.json)?;
    let (chosen, note) = choose_animations(&file, &plan.animations)?;
    notes.extend(note);
    let targets = |node: usize| {
        let mesh = file.json.nodes[node].mesh;
        let mesh = mesh.and_then(|mesh| file.json.meshes.get(mesh));
        let primitive = mesh.and_then(|mesh| mesh.primitives.first());
        primitive.map_or(0, |primitive| primitive.targets.len())
    };
    let mut animation = Animation::default();
    for index in chosen {
        animation = animation.join(Animation::read(&file, index, targets)?)?;
    }
    Stage::read(file, tree, animation)
}

/// Chooses the instant and the frames around it.
pub fn choose_clip(plan: &GltfPlan, stage: &Stage) -> Result<Clip, String> {
    let range = stage.animation.range();
    let instant = match (range, plan.time) {
        (Some([start, end]), Some(time)) if !(start..=end).contains(&time) => {
            return Err(format!(
                "its animation \"{}\" lasts from {start} s to {end} s; --time is {time} s",
                stage.animation.name
            ));
        }
        (_, Some(time)) => time,
        (Some([start, end]), None) => 0.5 * (start + end),
        (None, None) => 0.0,
    };
    if range.is_none() && plan.orbit.is_none() {
        return Err("has no animation, so nothing would move; export it with one, or give an orbit such as --orbit 3deg/frame".into());
    }
    let reach = plan.exposure.ceil().max(2.0);
    Ok(Clip {
        instant,
        rate: plan.rate,
        frames: plan.frames,
        span: [-reach, f64::from(plan.frames - 1) + reach],
    })
}
