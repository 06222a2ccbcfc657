//! Textures on the GPU, and transfers to and from them.

use frame::{Image, Raster};

use super::device::Gpu;
use super::place::Place;
use crate::filter::DEFAULT_TIME_LIMIT;
use crate::shader::Texel;
use crate::{FilterError, Format};

impl Format {
    /// Converts the format to that of wgpu.
    pub(super) fn wgpu(self) -> wgpu::TextureFormat {
        match self {
            Format::R32Uint => wgpu::TextureFormat::R32Uint,
            Format::R32Float => wgpu::TextureFormat::R32Float,
            Format::Rg32Float => wgpu::TextureFormat::Rg32Float,
            Format::Rgba32Float => wgpu::TextureFormat::Rgba32Float,
        }
    }
}

impl Texel {
    /// Converts the type to that of wgpu.
    pub(super) fn wgpu(self) -> wgpu::TextureSampleType {
        match self {
            Texel::Float => wgpu::TextureSampleType::Float { filterable: false },
            Texel::Uint => wgpu::TextureSampleType::Uint,
        }
    }
}

/// A texture on the GPU.
#[derive(Debug)]
pub(super) struct Target {
    pub texture: wgpu::Texture,
    pub view: wgpu::TextureView,
    pub format: Format,
}

impl Target {
    /// Returns its size in bytes.
    pub fn bytes(&self) -> u64 {
        let texels = u64::from(self.texture.width()) * u64::from(self.texture.height());
        texels * 4 * self.format.components() as u64
    }
}

/// Converts a colour image to texels with a fourth component of 1.
pub(super) fn to_texels(color: &Image) -> Vec<f32> {
    let pixels = color.pixels.iter();
    pixels.flat_map(|[r, g, b]| [*r, *g, *b, 1.0]).collect()
}

/// Returns the bytes per row of a buffer that a texture is copied to.
pub(super) fn row_bytes(width: u32, format: Format) -> u64 {
    let bytes = u64::from(width) * 4 * format.components() as u64;
    bytes.next_multiple_of(u64::from(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT))
}

impl Gpu {
    /// Creates a texture.
    pub(super) fn create_target(
        &self,
        label: &str,
        width: u32,
        height: u32,
        format: Format,
    ) -> Target {
        let texture = self.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size: wgpu::Extent3d {
                width,
                height,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: format.wgpu(),
            usage: wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::STORAGE_BINDING
                | wgpu::TextureUsages::COPY_DST
                | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        Target {
            view: texture.create_view(&wgpu::TextureViewDescriptor::default()),
            texture,
            format,
        }
    }

    /// Fills a texture with rows of `target.format` without padding.
    pub(super) fn upload(&self, target: &Target, values: &[f32]) {
        let row = target.texture.width() * 4 * target.format.components() as u32;
        self.queue.write_texture(
            target.texture.as_image_copy(),
            bytemuck::cast_slice(values),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(row),
                rows_per_image: None,
            },
            target.texture.size(),
        );
    }

    /// Copies one texture to another of the same size and format, without leaving the GPU.
    pub(super) fn copy(&self, from: &Target, to: &Target) {
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_texture(
            from.texture.as_image_copy(),
            to.texture.as_image_copy(),
            from.texture.size(),
        );
        self.queue.submit([encoder.finish()]);
    }

    /// Waits for the GPU and reads a texture; components that its format lacks are 0.
    pub(super) fn download(
        &self,
        target: &Target,
        place: Place,
    ) -> Result<Raster<[f32; 4]>, FilterError> {
        let (width, height) = (target.texture.width(), target.texture.height());
        let padded = row_bytes(width, target.format);
        let buffer = self.catch_errors(place, || {
            let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("read back"),
                size: padded * u64::from(height),
                usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
                mapped_at_creation: false,
            });
            let mut encoder = self.device.create_command_encoder(&Default::default());
            encoder.copy_texture_to_buffer(
                target.texture.as_image_copy(),
                wgpu::TexelCopyBufferInfo {
                    buffer: &buffer,
                    layout: wgpu::TexelCopyBufferLayout {
                        offset: 0,
                        bytes_per_row: Some(padded as u32),
                        rows_per_image: None,
                    },
                },
                target.texture.size(),
            );
            self.queue.submit([encoder.finish()]);
            buffer
        })?;
        let values: Vec<f32> = self.read_buffer(&buffer, place)?;
        let components = target.format.components();
        let row = padded as usize / 4;
        Ok(Raster::from_fn(width, height, |x, y| {
            let start = y as usize * row + x as usize * components;
            let texel = &values[start..start + components];
            std::array::from_fn(|component| texel.get(component).copied().unwrap_or(0.0))
        }))
    }

    /// Waits for the GPU and reads a whole buffer.
    pub(super) fn read_buffer<T: bytemuck::Pod>(
        &self,
        buffer: &wgpu::Buffer,
        place: Place,
    ) -> Result<Vec<T>, FilterError> {
        let (sender, receiver) = std::sync::mpsc::channel();
        buffer.map_async(wgpu::MapMode::Read, .., move |result| {
            _ = sender.send(result);
        });
        self.wait(place, DEFAULT_TIME_LIMIT)?;
        match receiver.try_recv() {
            Ok(Ok(())) => {}
            Ok(Err(error)) => return Err(place.refuse(error)),
            Err(_) => return Err(place.refuse("the GPU stopped answering")),
        }
        let bytes = buffer
            .get_mapped_range(..)
            .map_err(|error| place.refuse(error))?;
        Ok(bytemuck::pod_collect_to_vec(&bytes[..]))
    }
}
