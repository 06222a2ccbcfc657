//! Textures of a filter on the GPU, by name.

use std::collections::BTreeMap;

use super::device::Gpu;
use super::transfer::{Target, count_texels};
use crate::filter::{Layer, Rounding};
use crate::shader::{EntryPoint, Role, Variable};
use crate::{Filter, FilterError, Format, Pass, Settings, Texture};

/// Textures by name. One that a pass both reads and writes has two copies; the first is the one to
/// read.
#[derive(Debug)]
pub(super) struct Targets(BTreeMap<String, Vec<Target>>);

/// Bytes that the textures of a filter may take in sum.
pub const MAX_TEXTURE_BYTES: u64 = 8 << 30;

/// A planned texture.
struct Planned {
    texture: Texture,
    size: [u32; 2],
    mips: u32,
    copies: usize,
}

/// Plans the textures that every filter has, and those that this one declares.
fn plan_targets(
    filter: &Filter,
    settings: &Settings,
    size: [u32; 2],
) -> Result<Vec<Planned>, String> {
    let named = |layer: Layer| (layer.name(), layer);
    let before = (filter.history.iter()).map(|history| (history.texture(), history.layer()));
    let inputs = Layer::OF_EVERY_FRAME.into_iter().map(named).chain(before);
    let inputs = inputs.chain(filter.further_inputs().into_iter().map(named));
    let inputs = inputs.map(|(name, layer)| (name, filter.convention.format_of(layer)));
    let builtin = inputs.chain([("output", output_format(filter))]);
    let builtin = builtin.map(|(name, format)| Texture {
        name: name.to_owned(),
        format,
        divided_by: None,
        rounding: Rounding::Up,
        mips: 1,
        holds: None,
    });
    let numbers = settings.list_numbers(filter);
    let plan = |texture: Texture| {
        let divisors = find_divisors(&texture, &numbers, size)?;
        let [width, height] = [0, 1].map(|axis| match texture.rounding {
            Rounding::Up => size[axis].div_ceil(divisors[axis]),
            Rounding::Down => (size[axis] / divisors[axis]).max(1),
        });
        Ok(Planned {
            size: [width, height],
            // The last level has one texel.
            mips: texture.mips.min(width.max(height).ilog2() + 1),
            copies: filter.count_copies(&texture.name),
            texture,
        })
    };
    let all = builtin.chain(filter.textures.iter().cloned());
    all.map(plan).collect()
}

/// Computes the divisors of a texture's width and height on pictures of a size. `numbers` are the
/// settings by name.
fn find_divisors(
    texture: &Texture,
    numbers: &BTreeMap<String, f64>,
    size: [u32; 2],
) -> Result<[u32; 2], String> {
    let Some(divisors) = &texture.divided_by else {
        return Ok([1, 1]);
    };
    let value = |name: &str| match (numbers.get(name), name) {
        (Some(number), _) => *number,
        (None, "width") => f64::from(size[0]),
        (None, _) => f64::from(size[1]),
    };
    let [width, height] = divisors.each_ref().map(|divisor| {
        let side = divisor.evaluate(&value);
        let is_allowed = side.fract() == 0.0 && (1.0..=f64::from(u32::MAX)).contains(&side);
        is_allowed.then_some(side as u32).ok_or_else(|| {
            format!(
                "divided_by of texture \"{}\" is {side}; allowed: whole numbers from 1; round it with ceil(), and keep it \
                 above 0 with max()",
                texture.name
            )
        })
    });
    Ok([width?, height?])
}

/// Finds the format of the output: the one in which a shader stores it, or the convention's for
/// render targets.
pub(crate) fn output_format(filter: &Filter) -> Format {
    let mut stored = (filter.shaders.iter()).filter_map(|shader| shader.stored_format("output"));
    (stored.next()).unwrap_or(filter.convention.output_format())
}

/// Lists the formats of the render targets of a pass, by location.
pub(crate) fn list_target_formats(filter: &Filter, pass: &Pass) -> Vec<wgpu::TextureFormat> {
    let formats = pass.list_targets().map(|name| match filter.texture(name) {
        Some(texture) => texture.format.wgpu(),
        None => output_format(filter).wgpu(),
    });
    formats.collect()
}

/// Finds how the passes write a texture.
fn find_usage(filter: &Filter, name: &str) -> wgpu::TextureUsages {
    let mut usage = wgpu::TextureUsages::empty();
    for pass in &filter.passes {
        let entry = filter.entry_point(pass);
        let is_target = pass.list_targets().any(|target| target == name);
        if is_target {
            usage |= wgpu::TextureUsages::RENDER_ATTACHMENT;
        } else if entry.writes.contains(name) {
            usage |= wgpu::TextureUsages::STORAGE_BINDING;
        }
    }
    usage
}

impl Targets {
    /// Makes the textures. Fails before any is made if they take more than [`MAX_TEXTURE_BYTES`].
    pub fn new(
        gpu: &Gpu,
        filter: &Filter,
        settings: &Settings,
        size: [u32; 2],
    ) -> Result<Self, FilterError> {
        let refuse = |reason: String| FilterError::Size {
            filter: filter.name.clone(),
            width: size[0],
            height: size[1],
            reason,
        };
        let planned = plan_targets(filter, settings, size).map_err(refuse)?;
        let sizes = planned.iter().map(|plan| {
            let texels = count_texels(plan.size[0], plan.size[1], 0..plan.mips);
            texels * plan.texture.format.texel_bytes() * plan.copies as u64
        });
        let bytes: u64 = sizes.sum();
        if bytes > MAX_TEXTURE_BYTES {
            return Err(refuse(format!(
                "its textures take {bytes} bytes; allowed: at most {MAX_TEXTURE_BYTES}; render a smaller frame, or \
                 declare fewer or smaller textures"
            )));
        }
        gpu.catch_errors(filter.place("textures"), || {
            let made = planned.into_iter().map(|plan| {
                let Texture { name, format, .. } = plan.texture;
                let usage = find_usage(filter, &name);
                let make = |_| gpu.create_target(&name, plan.size, plan.mips, format, usage);
                let copies = (0..plan.copies).map(make).collect();
                (name, copies)
            });
            Self(made.collect())
        })
    }

    /// Returns the copy to read. Panics if there is no texture of that name.
    pub fn current(&self, name: &str) -> &Target {
        match self.0.get(name) {
            Some(copies) => &copies[0],
            None => panic!("the filter has no texture \"{name}\""),
        }
    }

    /// Returns the texture that the kernel reads or writes through a variable.
    pub fn of_variable(&self, entry: &EntryPoint, variable: &Variable) -> &Target {
        match variable.role {
            Role::Write(_) => self.written(entry, &variable.resource),
            _ => self.current(&variable.resource),
        }
    }

    /// Returns the texture that the kernel writes by that name.
    pub fn written(&self, entry: &EntryPoint, name: &str) -> &Target {
        if entry
            .exchanged_textures()
            .any(|exchanged| exchanged == name)
        {
            &self.0[name][1]
        } else {
            self.current(name)
        }
    }

    /// Returns the size of a mip level in texels.
    pub fn size(&self, name: &str, level: u32) -> [u32; 2] {
        let texture = &self.current(name).texture;
        [texture.width(), texture.height()].map(|side| (side >> level).max(1))
    }

    /// Lists the copies to read and to write of each texture that the kernel both reads and writes.
    pub fn list_exchanged(&self, entry: &EntryPoint) -> Vec<[wgpu::Texture; 2]> {
        (entry.exchanged_textures())
            .map(|name| [0, 1].map(|copy| self.0[name][copy].texture.clone()))
            .collect()
    }

    /// Exchanges copies, so that the next pass reads what this one wrote.
    pub fn exchange(&mut self, entry: &EntryPoint) {
        for name in entry.exchanged_textures() {
            let copies = self.0.get_mut(name);
            copies
                .expect("a checked kernel uses declared textures")
                .swap(0, 1);
        }
    }
}
