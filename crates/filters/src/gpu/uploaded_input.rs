//! Input that stays on the GPU while a filter runs on it with several settings.

use super::device::Gpu;
use super::place::Place;
use super::transfer::{Target, to_texels};
use super::uniforms::FrameUniform;
use crate::{Filter, FilterError, Format, Input};

/// A checked and uploaded input of one filter.
#[derive(Debug)]
pub struct UploadedInput {
    pub(super) filter: String,
    pub(super) size: [u32; 2],
    pub(super) frame: FrameUniform,
    pub(super) color: Vec<Target>,
    pub(super) velocity: Target,
    pub(super) depth: Target,
}

impl UploadedInput {
    pub(super) fn new(gpu: &Gpu, filter: &Filter, input: &Input) -> Result<Self, FilterError> {
        let size = [input.velocity.width, input.velocity.height];
        input.check(&filter.name, size, filter.shader.reads_reprojection)?;
        let place = Place {
            filter: &filter.name,
            pass: "upload",
        };
        let texture = |name, format, values: &[f32]| {
            let target = gpu.create_target(name, size[0], size[1], format);
            gpu.upload(&target, values);
            target
        };
        gpu.catch_errors(place, || Self {
            filter: filter.name.clone(),
            size,
            frame: FrameUniform::of(input),
            color: (input.color.iter())
                .map(|color| texture("color", Format::Rgba32Float, &to_texels(color)))
                .collect(),
            velocity: texture(
                "velocity",
                Format::Rg32Float,
                bytemuck::cast_slice(&input.velocity.pixels),
            ),
            depth: texture("depth", Format::R32Float, &input.depth.pixels),
        })
    }
}
