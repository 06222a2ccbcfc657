//! One dispatch of a pass, ready to run.

use super::binding::Pipeline;
use super::transfer::Target;
use crate::shader::UniformBlock;

/// One dispatch.
#[derive(Debug)]
pub(super) struct Dispatch {
    pub entry: String,
    pub pipeline: Pipeline,
    /// Bind groups of its stages.
    pub groups: Vec<wgpu::BindGroup>,
    pub workgroups: [u32; 2],
    /// Render targets, by location; none for a kernel.
    pub attachments: Vec<wgpu::TextureView>,
    /// Textures whose content is copied to others before it runs.
    pub copies: Vec<[wgpu::Texture; 2]>,
    /// Uniform blocks, with the buffers that hold them.
    pub blocks: Vec<(UniformBlock, wgpu::Buffer)>,
    /// Bytes of the textures that it reads and of those that it writes, each counted once and
    /// whole.
    pub bytes: u64,
    /// True if its result changes with the colour image.
    pub depends_on_color: bool,
    /// True if its result changes with the frame's index.
    pub depends_on_noise: bool,
    /// Textures whose first level it writes, by name.
    pub written: Vec<(String, Target)>,
    /// Run of the pass, and number of its runs.
    pub iteration: u32,
    pub iterations: u32,
}

impl Dispatch {
    /// Returns true if it writes the first level of a texture.
    pub fn writes(&self, texture: &str) -> bool {
        self.written.iter().any(|(name, _)| name == texture)
    }

    /// Adds the dispatch to the commands of an encoder.
    pub fn encode(&self, encoder: &mut wgpu::CommandEncoder) {
        for [from, to] in &self.copies {
            copy_levels(encoder, from, to);
        }
        match &self.pipeline {
            Pipeline::Compute(pipeline) => {
                let mut pass = encoder.begin_compute_pass(&Default::default());
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, &self.groups[0], &[]);
                let [x, y] = self.workgroups;
                pass.dispatch_workgroups(x, y, 1);
            }
            Pipeline::Render(pipeline) => {
                let attachments: Vec<_> = (self.attachments.iter())
                    .map(|view| {
                        Some(wgpu::RenderPassColorAttachment {
                            view,
                            depth_slice: None,
                            resolve_target: None,
                            // A fragment that is discarded leaves what was there.
                            ops: wgpu::Operations {
                                load: wgpu::LoadOp::Load,
                                store: wgpu::StoreOp::Store,
                            },
                        })
                    })
                    .collect();
                let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                    label: Some(&self.entry),
                    color_attachments: &attachments,
                    ..Default::default()
                });
                pass.set_pipeline(pipeline);
                for (index, group) in self.groups.iter().enumerate() {
                    pass.set_bind_group(index as u32, group, &[]);
                }
                pass.draw(0..3, 0..1);
            }
        }
    }
}

/// Copies a texture with all its mip levels to another one like it.
fn copy_levels(encoder: &mut wgpu::CommandEncoder, from: &wgpu::Texture, to: &wgpu::Texture) {
    for level in 0..from.mip_level_count() {
        let at_level = |texture| wgpu::TexelCopyTextureInfo {
            mip_level: level,
            ..wgpu::Texture::as_image_copy(texture)
        };
        let size = from
            .size()
            .mip_level_size(level, wgpu::TextureDimension::D2);
        encoder.copy_texture_to_texture(at_level(from), at_level(to), size);
    }
}
