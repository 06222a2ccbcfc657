//! Textures of a filter on the GPU, by name.

use std::collections::BTreeMap;

use super::device::Gpu;
use super::place::Place;
use super::transfer::Target;
use crate::shader::{EntryPoint, Role, Shader, Variable, written_texture};
use crate::{Filter, FilterError, Format, Settings};

/// Textures by name. One that a pass both reads and writes has two copies; the first is the one to read.
#[derive(Debug)]
pub(super) struct Targets(BTreeMap<String, Vec<Target>>);

/// Bytes that the textures of a filter may take in sum.
pub const MAX_TEXTURE_BYTES: u64 = 8 << 30;

/// Description of a texture that is to be made.
struct TargetDescription<'f> {
    name: &'f str,
    size: [u32; 2],
    format: Format,
    copies: usize,
}

impl TargetDescription<'_> {
    fn bytes(&self) -> u64 {
        let [width, height] = self.size.map(u64::from);
        width * height * 4 * self.format.components() as u64 * self.copies as u64
    }
}

/// Describes the textures that every filter has, and those that this one declares.
fn describe_targets<'f>(
    filter: &'f Filter,
    settings: &Settings,
    size: [u32; 2],
) -> Vec<TargetDescription<'f>> {
    let builtin = [
        ("color", Format::Rgba32Float),
        ("velocity", Format::Rg32Float),
        ("depth", Format::R32Float),
        ("output", Format::Rgba32Float),
    ];
    let builtin = builtin.map(|(name, format)| TargetDescription {
        name,
        size,
        format,
        copies: 1,
    });
    let declared = filter.textures.iter().map(|texture| {
        let divided_by = texture.divided_by.as_ref();
        let divisor = divided_by.map_or(1, |length| settings.pixels(length));
        let exchanged = filter.passes.iter().any(|pass| {
            let mut names = filter.entry_point(pass).exchanged_textures();
            names.any(|name| *name == texture.name)
        });
        TargetDescription {
            name: &texture.name,
            size: size.map(|side| side.div_ceil(divisor)),
            format: texture.format,
            copies: if exchanged { 2 } else { 1 },
        }
    });
    builtin.into_iter().chain(declared).collect()
}

impl Targets {
    /// Makes the textures. Fails before any is made if they take more than [`MAX_TEXTURE_BYTES`].
    pub fn new(
        gpu: &Gpu,
        filter: &Filter,
        settings: &Settings,
        size: [u32; 2],
    ) -> Result<Self, FilterError> {
        let descriptions = describe_targets(filter, settings, size);
        let bytes: u64 = (descriptions.iter().map(TargetDescription::bytes)).sum();
        if bytes > MAX_TEXTURE_BYTES {
            return Err(FilterError::Size {
                filter: filter.name.clone(),
                width: size[0],
                height: size[1],
                reason: format!(
                    "its textures take {bytes} bytes; allowed: at most {MAX_TEXTURE_BYTES}; render a smaller frame, or \
                     declare fewer or smaller textures"
                ),
            });
        }
        let place = Place {
            filter: &filter.name,
            pass: "textures",
        };
        gpu.catch_errors(place, || {
            let made = descriptions.iter().map(|planned| {
                let [width, height] = planned.size;
                let copies = (0..planned.copies)
                    .map(|_| gpu.create_target(planned.name, width, height, planned.format));
                (planned.name.to_owned(), copies.collect())
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
            Role::Write(_) => {
                let name = written_texture(&variable.name);
                match entry.reads.contains(name) {
                    true => &self.0[name][1],
                    false => self.current(name),
                }
            }
            Role::Read(_) | Role::Uniform => self.current(&variable.name),
        }
    }

    /// Sums the bytes of the textures that the kernel reads and of those that it writes.
    pub fn sum_bytes(&self, shader: &Shader, entry: &EntryPoint) -> u64 {
        let variables = entry
            .variables
            .iter()
            .map(|index| &shader.variables[*index]);
        variables
            .filter(|variable| variable.role != Role::Uniform)
            .map(|variable| self.of_variable(entry, variable).bytes())
            .sum()
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
