//! Pipelines of kernels, and bindings of their variables.

use super::device::Gpu;
use crate::shader::{EntryPoint, Role, Shader, Variable};

/// Creates the layout of group 0 as the kernel uses it, with the buffer of loop iterations if there is one.
pub(super) fn create_layout(
    gpu: &Gpu,
    shader: &Shader,
    entry: &EntryPoint,
    counted_at: Option<u32>,
) -> wgpu::BindGroupLayout {
    let counted = counted_at.map(|binding| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only: false },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    });
    let entries: Vec<wgpu::BindGroupLayoutEntry> = entry
        .variables
        .iter()
        .map(|variable| &shader.variables[*variable])
        .map(|variable| wgpu::BindGroupLayoutEntry {
            binding: variable.binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: match variable.role {
                Role::Uniform => wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                Role::Read(texel) => wgpu::BindingType::Texture {
                    sample_type: texel.wgpu(),
                    view_dimension: wgpu::TextureViewDimension::D2,
                    multisampled: false,
                },
                Role::Write(format) => wgpu::BindingType::StorageTexture {
                    access: wgpu::StorageTextureAccess::WriteOnly,
                    format: format.wgpu(),
                    view_dimension: wgpu::TextureViewDimension::D2,
                },
            },
            count: None,
        })
        .chain(counted)
        .collect();
    gpu.device
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some(&entry.name),
            entries: &entries,
        })
}

/// Compiles the kernel.
pub(super) fn create_pipeline(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    module: &wgpu::ShaderModule,
    entry: &EntryPoint,
) -> wgpu::ComputePipeline {
    let layout = gpu
        .device
        .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(&entry.name),
            bind_group_layouts: &[Some(layout)],
            immediate_size: 0,
        });
    gpu.device
        .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(&entry.name),
            layout: Some(&layout),
            module,
            entry_point: Some(&entry.name),
            compilation_options: Default::default(),
            cache: None,
        })
}

/// Binds each variable of group 0 to its resource, and the buffer of loop iterations if there is one.
pub(super) fn create_bind_group<'r>(
    gpu: &Gpu,
    shader: &Shader,
    entry: &EntryPoint,
    layout: &wgpu::BindGroupLayout,
    counted: Option<wgpu::BindGroupEntry<'r>>,
    resource: impl Fn(&Variable) -> wgpu::BindingResource<'r>,
) -> wgpu::BindGroup {
    let entries: Vec<wgpu::BindGroupEntry> = entry
        .variables
        .iter()
        .map(|variable| &shader.variables[*variable])
        .map(|variable| wgpu::BindGroupEntry {
            binding: variable.binding,
            resource: resource(variable),
        })
        .chain(counted)
        .collect();
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some(&entry.name),
        layout,
        entries: &entries,
    })
}
