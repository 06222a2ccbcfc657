//! Probe that finds the loop limit of an adapter.
//!
//! Mesa's llvmpipe silently ends every loop of an invocation after 65,535 iterations in total: the
//! picture is wrong without an error. Kernels on such an adapter count their iterations, see
//! [`count_loop_iterations`](crate::shader::count_loop_iterations).

use super::device::Gpu;
use super::place::Place;
use crate::FilterError;

/// Iterations that the probe asks for. An adapter that grants these counts as unlimited.
const PROBED: u32 = 1 << 20;

/// Kernel with one invocation that counts its iterations. The arithmetic keeps a compiler from
/// working the count out.
const PROBE: &str = "
@group(0) @binding(0) var<storage, read_write> found: array<u32, 2>;
@compute @workgroup_size(1)
fn probe() {
    var value = found[1];
    var iterations = 0u;
    while iterations < found[0] {
        value = value * 1664525u + 1013904223u;
        iterations += 1u;
    }
    found[0] = iterations;
    found[1] = value;
}
";

/// Finds the iterations that the adapter grants, if these are fewer than a million.
pub(super) fn find_loop_limit(gpu: &Gpu) -> Result<Option<u32>, FilterError> {
    let place = Place {
        filter: "none",
        pass: "probe of the longest loop",
    };
    let mut turn = gpu.take_turn(place)?;
    let readable = gpu.catch_errors(place, || {
        let module = gpu
            .device()
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(place.pass),
                source: wgpu::ShaderSource::Wgsl(PROBE.into()),
            });
        let pipeline = gpu
            .device()
            .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(place.pass),
                layout: None,
                module: &module,
                entry_point: None,
                compilation_options: Default::default(),
                cache: None,
            });
        let buffer = |usage| gpu.create_buffer(place.pass, 8, usage | wgpu::BufferUsages::COPY_DST);
        let storage = buffer(wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
        let readable = buffer(wgpu::BufferUsages::MAP_READ);
        gpu.queue()
            .write_buffer(&storage, 0, bytemuck::cast_slice(&[PROBED, 1]));
        let bind_group = gpu.device().create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(place.pass),
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: storage.as_entire_binding(),
            }],
        });
        let mut encoder = gpu.device().create_command_encoder(&Default::default());
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &bind_group, &[]);
        pass.dispatch_workgroups(1, 1, 1);
        drop(pass);
        encoder.copy_buffer_to_buffer(&storage, 0, &readable, 0, 8);
        turn.submit(encoder.finish());
        readable
    })?;
    let iterations = turn.read_buffer::<u32>(&readable, place)?[0];
    Ok((iterations < PROBED).then_some(iterations))
}
