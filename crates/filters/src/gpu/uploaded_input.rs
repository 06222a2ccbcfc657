//! Input that stays on the GPU while a filter runs on it with several settings.

use super::device::Gpu;
use super::place::Place;
use super::transfer::{Target, to_texels, velocity_texels};
use super::uniforms::FrameValues;
use crate::{Filter, FilterError, Input};

/// A checked and uploaded input of one filter.
#[derive(Debug)]
pub struct UploadedInput {
    pub(super) filter: String,
    pub(super) size: [u32; 2],
    pub(super) frame: FrameValues,
    pub(super) color: Vec<Target>,
    pub(super) velocity: Target,
    pub(super) depth: Target,
}

impl UploadedInput {
    pub(super) fn new(gpu: &Gpu, filter: &Filter, input: &Input) -> Result<Self, FilterError> {
        let size = [input.velocity.width, input.velocity.height];
        input.check(&filter.name, size, filter.camera_use())?;
        let place = Place {
            filter: &filter.name,
            pass: "upload",
        };
        let convention = &filter.convention;
        let scale = convention.color_scale.unwrap_or(1.0) as f32;
        let texture = |name, values: &[f32]| {
            let format = convention.format_of(name);
            let usage = wgpu::TextureUsages::empty();
            let target = gpu.create_target(name, size, 1, format, usage);
            gpu.upload(&target, values);
            target
        };
        gpu.catch_errors(place, || Self {
            filter: filter.name.clone(),
            size,
            frame: FrameValues::of(input, convention),
            color: (input.color.iter())
                .map(|color| texture("color", &to_texels(color, scale)))
                .collect(),
            velocity: texture("velocity", &velocity_texels(convention, input)),
            depth: texture("depth", &convention.convert_depth(input.depth).pixels),
        })
    }
}
