//! Textures on the GPU, and transfers to and from them.

use frame::{Raster, Vectors};
use half::f16;
use wgpu::naga::ScalarKind;

use super::device::Gpu;
use super::place::Place;
use super::waiting::Turn;
use crate::filter::Layer;
use crate::{Convention, FilterError, Format, Input};

impl Format {
    /// Encodes the numbers of an input, which are floats.
    fn encode(self, values: &[f32]) -> Vec<u8> {
        match self {
            Format::R32Float | Format::Rg32Float | Format::Rgba32Float => {
                bytemuck::cast_slice(values).to_vec()
            }
            Format::R16Float | Format::Rg16Float | Format::Rgba16Float => (values.iter())
                .flat_map(|value| {
                    f16::from_f32(value.clamp(-LARGEST_F16, LARGEST_F16)).to_le_bytes()
                })
                .collect(),
            Format::R8Unorm | Format::Rg8Unorm | Format::Rgba8Unorm => (values.iter())
                .map(|value| (value.clamp(0.0, 1.0) * 255.0).round() as u8)
                .collect(),
            Format::Rgb10a2Unorm => pack(values, |texel| {
                let part = |value: f32, most: f32| (value.clamp(0.0, 1.0) * most).round() as u32;
                let [r, g, b] = [0, 1, 2].map(|index| part(texel[index], 1023.0));
                r | g << 10 | b << 20 | part(texel[3], 3.0) << 30
            }),
            Format::Rg11b10Ufloat => pack(values, |texel| {
                let [r, g, b] =
                    [(0, 4), (1, 4), (2, 5)].map(|(index, cut)| shorten(texel[index], cut));
                r | g << 11 | b << 22
            }),
            _ => unreachable!("no input holds whole numbers"),
        }
    }

    /// Decodes the numbers of a row. Those of `r32uint` become the floats of their bits.
    fn decode(self, bytes: &[u8]) -> Vec<f32> {
        match self {
            Format::Rgb10a2Unorm => unpack(bytes, |word| {
                let part = |shift: u32| (word >> shift & 1023) as f32 / 1023.0;
                [part(0), part(10), part(20), (word >> 30) as f32 / 3.0]
            }),
            Format::Rg11b10Ufloat => unpack(bytes, |word| {
                let part = |bits: u32, cut: u32| f16::from_bits((bits << cut) as u16).to_f32();
                [
                    part(word & 0x7ff, 4),
                    part(word >> 11 & 0x7ff, 4),
                    part(word >> 22, 5),
                    1.0,
                ]
            }),
            Format::R32Uint | Format::R32Float | Format::Rg32Float | Format::Rgba32Float => {
                bytemuck::pod_collect_to_vec(bytes)
            }
            _ => {
                let size = self.texel_bytes() as usize / self.components();
                let numbers = bytes.chunks_exact(size);
                numbers
                    .map(|number| decode_number(number, self.kind()))
                    .collect()
            }
        }
    }
}

/// Decodes a whole number, or a float of 8 or 16 bits.
fn decode_number(number: &[u8], kind: ScalarKind) -> f32 {
    let mut word = [0; 4];
    word[..number.len()].copy_from_slice(number);
    let bits = u32::from_le_bytes(word);
    let unused = 32 - 8 * number.len() as u32;
    match (kind, number.len()) {
        (ScalarKind::Uint, _) => bits as f32,
        // The sign is the highest bit in use.
        (ScalarKind::Sint, _) => ((bits << unused) as i32 >> unused) as f32,
        (_, 1) => bits as f32 / 255.0,
        _ => f16::from_bits(bits as u16).to_f32(),
    }
}

/// Packs texels of four numbers into 32 bits each.
fn pack(values: &[f32], word: impl Fn(&[f32]) -> u32) -> Vec<u8> {
    let words = values.chunks_exact(4).map(word);
    words.flat_map(u32::to_le_bytes).collect()
}

/// Unpacks texels of 32 bits.
fn unpack(bytes: &[u8], texel: impl Fn(u32) -> [f32; 4]) -> Vec<f32> {
    let words = bytes.chunks_exact(4);
    let words = words.map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]));
    words.flat_map(texel).collect()
}

/// Rounds a number from 0 to a 16-bit float without its sign and its last `cut` bits; larger
/// numbers become the largest one.
fn shorten(value: f32, cut: u32) -> u32 {
    let bits = u32::from(f16::from_f32(value.clamp(0.0, LARGEST_F16)).to_bits());
    let largest = (0x7c00 >> cut) - 1;
    ((bits + (1 << (cut - 1))) >> cut).min(largest)
}

/// The largest number of 16 bits: larger ones, such as the depth of the background, become this and
/// not infinite.
const LARGEST_F16: f32 = 65504.0;

/// A texture on the GPU.
#[derive(Clone, Debug)]
pub(super) struct Target {
    pub texture: wgpu::Texture,
    /// All its mip levels.
    whole: wgpu::TextureView,
    /// Each of them alone.
    levels: Vec<wgpu::TextureView>,
    pub format: Format,
}

impl Target {
    /// Returns the view of one mip level, or of all.
    pub fn view(&self, level: Option<u32>) -> &wgpu::TextureView {
        match level {
            Some(level) => &self.levels[level as usize],
            None => &self.whole,
        }
    }

    /// Returns the bytes of one mip level, or of all.
    pub fn bytes(&self, level: Option<u32>) -> u64 {
        let [width, height] = [self.texture.width(), self.texture.height()];
        let texels = match level {
            Some(level) => count_texels(width, height, level..level + 1),
            None => count_texels(width, height, 0..self.texture.mip_level_count()),
        };
        texels * self.format.texel_bytes()
    }
}

/// Counts the texels of mip levels.
pub(super) fn count_texels(width: u32, height: u32, levels: std::ops::Range<u32>) -> u64 {
    let side = |side: u32, level: u32| u64::from((side >> level).max(1));
    levels
        .map(|level| side(width, level) * side(height, level))
        .sum()
}

/// Converts a velocity of an input as a shader expects it, with as many components as its format
/// has.
pub(super) fn velocity_texels(
    convention: &Convention,
    input: &Input,
    velocity: &Vectors,
) -> Vec<f32> {
    let convention = convention.at_rate(input.frames_per_second);
    let velocity = convention.convert_velocity(velocity, input.exposure);
    match convention.format_of(Layer::Velocity).components() {
        4 => (velocity.pixels.iter())
            .flat_map(|[x, y]| [*x, *y, 0.0, 1.0])
            .collect(),
        _ => velocity.pixels.into_flattened(),
    }
}

/// Returns the bytes per row of a buffer that a texture is copied to.
pub(super) fn row_bytes(width: u32, format: Format) -> u64 {
    let bytes = u64::from(width) * format.texel_bytes();
    bytes.next_multiple_of(u64::from(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT))
}

impl Gpu {
    /// Creates a texture.
    pub(super) fn create_target(
        &self,
        label: &str,
        [width, height]: [u32; 2],
        mips: u32,
        format: Format,
        usage: wgpu::TextureUsages,
    ) -> Target {
        let texture = self.device().create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size: wgpu::Extent3d {
                width,
                height,
                depth_or_array_layers: 1,
            },
            mip_level_count: mips,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: format.wgpu(),
            usage: wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_DST
                | wgpu::TextureUsages::COPY_SRC
                | usage,
            view_formats: &[],
        });
        let view_level = |level| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                base_mip_level: level,
                mip_level_count: Some(1),
                ..Default::default()
            })
        };
        Target {
            whole: texture.create_view(&wgpu::TextureViewDescriptor::default()),
            levels: (0..mips).map(view_level).collect(),
            texture,
            format,
        }
    }

    /// Fills a texture with rows of `target.format` without padding.
    pub(super) fn upload(&self, target: &Target, values: &[f32]) {
        let row = target.texture.width() * target.format.texel_bytes() as u32;
        self.queue().write_texture(
            target.texture.as_image_copy(),
            &target.format.encode(values),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(row),
                rows_per_image: None,
            },
            target.texture.size(),
        );
    }

    /// Copies one texture to another of the same size and format, without leaving the GPU.
    pub(super) fn copy(&self, turn: &mut Turn, from: &Target, to: &Target) {
        let mut encoder = self.device().create_command_encoder(&Default::default());
        encoder.copy_texture_to_texture(
            from.texture.as_image_copy(),
            to.texture.as_image_copy(),
            from.texture.size(),
        );
        turn.submit(encoder.finish());
    }

    /// Waits for the GPU and reads a texture; components that its format lacks are 0.
    pub(super) fn download(
        &self,
        target: &Target,
        place: Place,
    ) -> Result<Raster<[f32; 4]>, FilterError> {
        let (width, height) = (target.texture.width(), target.texture.height());
        let padded = row_bytes(width, target.format);
        let mut turn = self.take_turn(place)?;
        let buffer = self.catch_errors(place, || {
            let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ;
            let buffer = self.create_buffer("read back", padded * u64::from(height), usage);
            let mut encoder = self.device().create_command_encoder(&Default::default());
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
            turn.submit(encoder.finish());
            buffer
        })?;
        let bytes: Vec<u8> = turn.read_buffer(&buffer, place)?;
        drop(turn);
        let components = target.format.components();
        let row = (u64::from(width) * target.format.texel_bytes()) as usize;
        let mut pixels = Vec::with_capacity(width as usize * height as usize);
        for padded in bytes.chunks(padded as usize) {
            let numbers = target.format.decode(&padded[..row]);
            match components {
                4 => pixels.extend_from_slice(bytemuck::cast_slice(&numbers)),
                _ => pixels.extend(numbers.chunks_exact(components).map(|texel| {
                    std::array::from_fn(|index| texel.get(index).copied().unwrap_or(0.0))
                })),
            }
        }
        Ok(Raster {
            width,
            height,
            pixels,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packed_formats_keep_as_many_bits_as_they_have() {
        let values = [0.25, 1.0, 0.5, 1.0, 0.0, 2.0, -1.0, 0.5];
        let unorm = Format::Rgb10a2Unorm;
        let decoded = unorm.decode(&unorm.encode(&values));
        for (decoded, value) in decoded.iter().zip(values).take(3) {
            assert!(
                (decoded - value).abs() <= 0.5 / 1023.0,
                "{decoded} for {value}"
            );
        }
        assert_eq!(decoded[4..7], [0.0, 1.0, 0.0]);
        let float = Format::Rg11b10Ufloat;
        let values = [3.17, 1000.0, 0.3, 1.0, 0.0, 1e9, -2.0, 1.0];
        let decoded = float.decode(&float.encode(&values));
        for (index, bits) in [(0, 7), (1, 7), (2, 6)] {
            let error = (decoded[index] / values[index] - 1.0).abs();
            assert!(error <= 0.5_f32.powi(bits), "{decoded:?}");
        }
        assert_eq!(decoded[4..], [0.0, 65024.0, 0.0, 1.0]);
    }

    #[test]
    fn whole_numbers_keep_their_values() {
        assert_eq!(Format::Rg8Sint.decode(&[0xff, 0x7f]), [-1.0, 127.0]);
        assert_eq!(Format::Rg16Uint.decode(&[1, 2, 0, 0x80]), [513.0, 32768.0]);
        let minus_two = (-2_i32).to_le_bytes();
        assert_eq!(Format::R32Sint.decode(&minus_two), [-2.0]);
        assert_eq!(Format::R16Sint.decode(&minus_two[..2]), [-2.0]);
    }
}
