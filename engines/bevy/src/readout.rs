//! Reads colour, velocity and depth of the view that was drawn last.

use bevy::core_pipeline::prepass::ViewPrepassTextures;
use bevy::core_pipeline::schedule::{Core3d, Core3dSystems};
use bevy::prelude::*;
use bevy::render::RenderApp;
use bevy::render::renderer::{RenderContext, RenderDevice, ViewQuery};
use bevy::render::view::{Msaa, ViewTarget};
use wgpu::util::DeviceExt;

/// Pixels of a picture, rows from the top.
#[derive(Default)]
pub struct Pixels {
    pub color: Vec<[f32; 3]>,
    /// Motion since the drawing before, in parts of the picture, +y down.
    pub velocity: Vec<[f32; 2]>,
    /// Near plane's distance divided by the depth; 0 is the background.
    pub depth: Vec<f32>,
}

/// Buffer of the last drawing: red, green, blue, velocity, depth and nothing, in 32 bits.
#[derive(Resource, Default)]
struct Drawn(Option<wgpu::Buffer>);

pub struct ReadoutPlugin;

impl Plugin for ReadoutPlugin {
    fn build(&self, app: &mut App) {
        let render = app.get_sub_app_mut(RenderApp).expect("a renderer");
        render
            .init_resource::<Drawn>()
            .add_systems(Core3d, copy.after(Core3dSystems::PostProcess));
    }
}

const SHADER: &str = "
@group(0) @binding(0) var color: texture_2d<f32>;
@group(0) @binding(1) var velocity: texture_VELOCITY<f32>;
@group(0) @binding(2) var depth: texture_depth_DEPTH;
@group(0) @binding(3) var<storage, read_write> output: array<vec4<f32>>;
@compute @workgroup_size(8, 8) fn copy(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(color);
    if any(id.xy >= size) { return; }
    let at = 2u * (id.y * size.x + id.x);
    let motion = textureLoad(velocity, id.xy, 0).xy;
    output[at] = vec4(textureLoad(color, id.xy, 0).rgb, motion.x);
    output[at + 1u] = vec4(motion.y, textureLoad(depth, id.xy, 0), 0.0, 0.0);
}";

fn copy(
    view: ViewQuery<(&ViewTarget, &ViewPrepassTextures, &Msaa)>,
    mut context: RenderContext,
    mut drawn: ResMut<Drawn>,
) {
    let (target, prepass, msaa) = view.into_inner();
    let (Some(velocity), Some(depth)) = (prepass.motion_vectors_view(), prepass.depth_view())
    else {
        return;
    };
    let kind = if *msaa == Msaa::Off {
        "2d"
    } else {
        "multisampled_2d"
    };
    let source = SHADER.replace("VELOCITY", kind).replace("DEPTH", kind);
    let device = context.render_device().wgpu_device().clone();
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(source.into()),
    });
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: None,
        module: &module,
        entry_point: None,
        compilation_options: Default::default(),
        cache: None,
    });
    let size = target.main_texture().size();
    let output = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(size.width * size.height) * 32,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    let views = [target.main_texture_view(), velocity, depth];
    let mut entries: Vec<wgpu::BindGroupEntry> = (0..)
        .zip(views)
        .map(|(binding, view)| wgpu::BindGroupEntry {
            binding,
            resource: wgpu::BindingResource::TextureView(view),
        })
        .collect();
    entries.push(wgpu::BindGroupEntry {
        binding: 3,
        resource: output.as_entire_binding(),
    });
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &entries,
    });
    let mut pass = context
        .command_encoder()
        .begin_compute_pass(&wgpu::ComputePassDescriptor::default());
    pass.set_pipeline(&pipeline);
    pass.set_bind_group(0, &group, &[]);
    pass.dispatch_workgroups(size.width.div_ceil(8), size.height.div_ceil(8), 1);
    drop(pass);
    drawn.0 = Some(output);
}

/// Reads what the last update drew.
pub fn read(app: &mut App) -> Pixels {
    let world = app.sub_app(RenderApp).world();
    let (device, queue) = (
        world.resource::<RenderDevice>().wgpu_device(),
        world.resource::<bevy::render::renderer::RenderQueue>(),
    );
    let output = world
        .resource::<Drawn>()
        .0
        .as_ref()
        .expect("the camera drew");
    let staging = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: &vec![0; output.size() as usize],
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
    });
    let mut encoder = device.create_command_encoder(&Default::default());
    encoder.copy_buffer_to_buffer(output, 0, &staging, 0, output.size());
    queue.submit([encoder.finish()]);
    staging
        .slice(..)
        .map_async(wgpu::MapMode::Read, |mapped| mapped.unwrap());
    device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
    let bytes = staging.slice(..).get_mapped_range();
    let mut pixels = Pixels::default();
    for pixel in bytes.chunks_exact(32) {
        let part = |at: usize| f32::from_le_bytes(pixel[4 * at..4 * at + 4].try_into().unwrap());
        pixels.color.push([part(0), part(1), part(2)]);
        pixels.velocity.push([part(3), part(4)]);
        pixels.depth.push(part(5));
    }
    pixels
}
