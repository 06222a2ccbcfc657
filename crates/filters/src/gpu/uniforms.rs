//! Uniforms that every kernel may read.

use frame::Reprojection;

use super::device::Gpu;
use super::matrices::CameraMatrices;
use crate::filter::split_element;
use crate::input::FRAMES_PER_SECOND;
use crate::{Convention, Input};

/// The uniform `frame`: the WGSL struct `Frame` of common.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct FrameUniform {
    pub size: [i32; 2],
    pub exposure: f32,
    pub frame_index: u32,
    pub iteration: u32,
    pub iterations: u32,
    pub frames_per_second: f32,
    /// WGSL aligns matrices to 16 bytes.
    pub gap: u32,
    pub reprojection: [[f32; 4]; 4],
}

impl FrameUniform {
    /// Takes what all dispatches of an input share.
    pub fn of(input: &Input, convention: &Convention) -> Self {
        let velocity = input.velocity;
        let rate = (input.frames_per_second).or(convention.frames_per_second);
        Self {
            size: [velocity.width as i32, velocity.height as i32],
            exposure: input.exposure as f32,
            frame_index: input.frame_index,
            frames_per_second: rate.unwrap_or(FRAMES_PER_SECOND) as f32,
            reprojection: to_columns(input.reprojection.unwrap_or(Reprojection::STILL)),
            ..Self::default()
        }
    }
}

/// Values of a frame that kernels may read, and that members of uniform blocks may name.
#[derive(Clone, Copy, Debug)]
pub(super) struct FrameValues {
    pub uniform: FrameUniform,
    /// Convention of the filter, with the frame's own rate.
    rate: Convention,
    /// Matrices of the camera; none for a filter that reads none.
    matrices: Option<CameraMatrices>,
}

impl FrameValues {
    /// Takes what all dispatches of an input share.
    pub fn of(input: &Input, convention: &Convention) -> Self {
        let size = [input.velocity.width, input.velocity.height];
        Self {
            uniform: FrameUniform::of(input, convention),
            rate: convention.at_rate(input.frames_per_second),
            matrices: (input.camera.as_ref())
                .map(|camera| CameraMatrices::new(camera, size, convention)),
        }
    }

    /// Sets the run of a pass.
    pub fn of_run(mut self, iteration: u32, iterations: u32) -> Self {
        self.uniform.iteration = iteration;
        self.uniform.iterations = iterations;
        self
    }

    /// Returns a value of the convention that depends on the frame; none for any other name.
    pub fn value_of_rate(&self, name: &str) -> Option<f64> {
        let depends = matches!(name, "frames_per_second" | "delta_time");
        self.rate.value(name).filter(|_| depends)
    }

    /// Returns a value by name.
    pub fn value(&self, name: &str) -> f64 {
        let uniform = &self.uniform;
        match name {
            "width" | "resolution[0]" => f64::from(uniform.size[0]),
            "height" | "resolution[1]" => f64::from(uniform.size[1]),
            // Frames are seen through the middle of each pixel.
            "jitter[0]" | "jitter[1]" => 0.0,
            "exposure" => f64::from(uniform.exposure),
            "frame_index" => f64::from(uniform.frame_index),
            "iteration" => f64::from(uniform.iteration),
            "iterations" => f64::from(uniform.iterations),
            _ => self.number_of_matrix(name).unwrap_or_else(|| {
                unreachable!("filter.toml was refused for the unknown value {name}")
            }),
        }
    }

    fn number_of_matrix(&self, name: &str) -> Option<f64> {
        let (matrix, index) = split_element(name)?;
        self.matrices.as_ref()?.number(matrix, index)
    }
}

/// Lays a matrix out as a WGSL mat4x3: columns, each filled up to four numbers.
fn to_columns(reprojection: Reprojection) -> [[f32; 4]; 4] {
    let [x, y, common] = reprojection.rows;
    [0, 1, 2, 3].map(|column| {
        [
            x[column] as f32,
            y[column] as f32,
            common[column] as f32,
            0.0,
        ]
    })
}

/// The uniforms `parameters` and `frame`.
#[derive(Debug)]
pub(super) struct Uniforms {
    pub parameters: wgpu::Buffer,
    /// One `frame` per dispatch, a stride apart.
    frames: wgpu::Buffer,
    stride: u64,
}

impl Uniforms {
    /// Uploads the parameters, and makes room for one `frame` per dispatch.
    pub fn new(gpu: &Gpu, parameters: &[u8], dispatches: u32) -> Self {
        let buffer = |label, size| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let alignment = gpu.device.limits().min_uniform_buffer_offset_alignment;
        let stride = (size_of::<FrameUniform>() as u64).next_multiple_of(alignment.into());
        let uniforms = Self {
            parameters: buffer(
                "parameters",
                parameters.len().next_multiple_of(16).max(16) as u64,
            ),
            frames: buffer("frame", stride * u64::from(dispatches)),
            stride,
        };
        gpu.queue.write_buffer(&uniforms.parameters, 0, parameters);
        uniforms
    }

    /// Writes the uniform `frame` of one dispatch.
    pub fn upload_frame(&self, gpu: &Gpu, dispatch: usize, frame: FrameUniform) {
        let offset = dispatch as u64 * self.stride;
        let bytes = bytemuck::bytes_of(&frame);
        gpu.queue.write_buffer(&self.frames, offset, bytes);
    }

    /// Binds the uniform `frame` of one dispatch.
    pub fn bind_frame(&self, dispatch: usize) -> wgpu::BindingResource<'_> {
        wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: &self.frames,
            offset: dispatch as u64 * self.stride,
            size: wgpu::BufferSize::new(size_of::<FrameUniform>() as u64),
        })
    }
}

#[cfg(test)]
mod tests {
    use std::mem::offset_of;
    use std::path::Path;

    use super::FrameUniform;
    use crate::shader::Shader;

    #[test]
    fn the_uniform_frame_lies_as_common_wgsl_declares_it() {
        let shader = Shader::parse(Path::new("none.wgsl"), "").unwrap();
        let found: Vec<(&str, usize)> = shader.uniforms["frame"]
            .iter()
            .map(|member| (&member.name[..], member.offset as usize))
            .collect();
        let expected = [
            ("size", offset_of!(FrameUniform, size)),
            ("exposure", offset_of!(FrameUniform, exposure)),
            ("frame_index", offset_of!(FrameUniform, frame_index)),
            ("iteration", offset_of!(FrameUniform, iteration)),
            ("iterations", offset_of!(FrameUniform, iterations)),
            (
                "frames_per_second",
                offset_of!(FrameUniform, frames_per_second),
            ),
            ("reprojection", offset_of!(FrameUniform, reprojection)),
        ];
        assert_eq!(found, expected);
    }
}
