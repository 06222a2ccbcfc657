//! What an imported scene looks like at its instant: how bright it is, and what part of the picture
//! shows what was lost.

use std::ops::ControlFlow;

use frame::luminance;
use glam::Vec3;
use measure::Error;
use scene::{Background, Finish, Material, Scene};
use tracer::{RenderSettings, trace_frame};

use super::lost::Lost;

/// Width of the pictures that are measured.
const WIDTH: u32 = 128;

/// Radiance that a picture's middle tone should be near.
const MID_GREY: f32 = 0.18;

/// Stops by which the middle tone may differ from mid-grey.
const USUAL: f32 = 2.0;

fn settings(scene: &Scene) -> RenderSettings {
    RenderSettings {
        width: WIDTH,
        height: (WIDTH * scene.height / scene.width.max(1)).max(1),
        samples_per_pixel: 16,
        ..RenderSettings::default()
    }
}

fn trace(scene: &Scene) -> Result<Vec<[f32; 3]>, Error> {
    let frame = trace_frame(scene, &settings(scene), &|_| ControlFlow::Continue(()))?;
    Ok(frame.color.pixels)
}

/// Returns whole stops that bring the middle tone of the picture near mid-grey; none if it is near
/// already, or if more than half of the picture is black.
pub fn choose_stops(scene: &Scene) -> Result<Option<f32>, Error> {
    let mut tones: Vec<f32> = trace(scene)?.into_iter().map(luminance).collect();
    tones.sort_by(f32::total_cmp);
    let middle = tones[tones.len() / 2];
    let stops = (MID_GREY / middle).log2();
    Ok((stops.is_finite() && stops.abs() > USUAL).then(|| stops.round()))
}

/// Lists what was lost, with the part of the picture that shows it; what shows nowhere is left out.
pub fn list_lost(scene: &Scene, lost: &Lost) -> Result<Vec<String>, Error> {
    let features: Vec<_> = lost.by_feature.iter().collect();
    let mut list: Vec<String> = lost.others.iter().cloned().collect();
    for group in features.chunks(3) {
        let mut masks = scene.clone();
        masks.background = Background::Constant(Vec3::ZERO);
        masks.sun = None;
        for material in &mut masks.materials {
            let has = |at: usize| {
                let feature = group.get(at);
                f32::from(feature.is_some_and(|(_, names)| names.contains(&material.name)))
            };
            let emission = Vec3::new(has(0), has(1), has(2));
            *material = mask(material, emission);
        }
        let pixels = trace(&masks)?;
        for (at, (feature, _)) in group.iter().enumerate() {
            let sum: f32 = pixels.iter().map(|pixel| pixel[at]).sum();
            let share = 100.0 * sum / pixels.len() as f32;
            if share >= 0.05 {
                let digits = usize::from(share < 1.0);
                list.push(format!("{feature} ({share:.digits$} % of the picture)"));
            }
        }
    }
    Ok(list)
}

/// Makes a material send out a colour and nothing else, with its holes.
fn mask(material: &Material, emission: Vec3) -> Material {
    let is_blended = material.translucency.is_some();
    Material {
        name: material.name.clone(),
        finish: Finish::Diffuse,
        diffuse: Vec3::ZERO,
        diffuse_texture: None,
        emission,
        emission_texture: None,
        opacity: if is_blended { 1.0 } else { material.opacity },
        opacity_texture: material.opacity_texture.filter(|_| !is_blended),
        translucency: None,
    }
}
