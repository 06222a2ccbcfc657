//! The textures of a run.

use std::collections::BTreeMap;

use super::adapter::Gpu;
use super::shader::{EntryPoint, Role, Shader, Variable, written};
use super::transfer::{Place, Target};
use crate::{Filter, FilterError, Format, Settings};

/// Textures by name. One that a pass both reads and writes has two copies, and the first is the one to read.
#[derive(Debug)]
pub(super) struct Targets(BTreeMap<String, Vec<Target>>);

/// Bytes that the textures of a filter may take in sum.
pub const MAX_TEXTURE_BYTES: u64 = 8 << 30;

/// A texture to be made.
struct Planned<'f> {
    name: &'f str,
    size: [u32; 2],
    format: Format,
    copies: usize,
}

impl Planned<'_> {
    fn bytes(&self) -> u64 {
        let [width, height] = self.size.map(u64::from);
        width * height * 4 * self.format.components() as u64 * self.copies as u64
    }
}

fn planned<'f>(filter: &'f Filter, settings: &Settings, size: [u32; 2]) -> Vec<Planned<'f>> {
    let builtin = [
        ("color", Format::Rgba32Float),
        ("velocity", Format::Rg32Float),
        ("depth", Format::R32Float),
        ("output", Format::Rgba32Float),
    ];
    let builtin = builtin.map(|(name, format)| Planned {
        name,
        size,
        format,
        copies: 1,
    });
    let declared = filter.textures.iter().map(|texture| {
        let divided_by = texture.divided_by.as_ref();
        let divisor = divided_by.map_or(1, |length| settings.pixels(length));
        let exchanged = filter.passes.iter().any(|pass| {
            let mut names = filter.entry_point(pass).exchanged();
            names.any(|name| *name == texture.name)
        });
        Planned {
            name: &texture.name,
            size: size.map(|side| side.div_ceil(divisor)),
            format: texture.format,
            copies: if exchanged { 2 } else { 1 },
        }
    });
    builtin.into_iter().chain(declared).collect()
}

impl Targets {
    /// Makes the textures. Refuses, before any is made, what takes more than [`MAX_TEXTURE_BYTES`].
    pub fn new(
        gpu: &Gpu,
        filter: &Filter,
        settings: &Settings,
        size: [u32; 2],
    ) -> Result<Self, FilterError> {
        let planned = planned(filter, settings, size);
        let bytes: u64 = planned.iter().map(Planned::bytes).sum();
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
        gpu.guarded(place, || {
            let made = planned.iter().map(|planned| {
                let [width, height] = planned.size;
                let copies = (0..planned.copies)
                    .map(|_| gpu.target(planned.name, width, height, planned.format));
                (planned.name.to_owned(), copies.collect())
            });
            Self(made.collect())
        })
    }

    /// The copy to read. Panics where there is no texture of that name.
    pub fn current(&self, name: &str) -> &Target {
        match self.0.get(name) {
            Some(copies) => &copies[0],
            None => panic!("the filter has no texture \"{name}\""),
        }
    }

    /// What the kernel reads or writes through a variable.
    pub fn of_variable(&self, entry: &EntryPoint, variable: &Variable) -> &Target {
        match variable.role {
            Role::Write(_) => {
                let name = written(&variable.name);
                match entry.reads.contains(name) {
                    true => &self.0[name][1],
                    false => self.current(name),
                }
            }
            Role::Read(_) | Role::Uniform => self.current(&variable.name),
        }
    }

    /// Bytes of every texture that the kernel reads, and of every one that it writes.
    pub fn bytes(&self, shader: &Shader, entry: &EntryPoint) -> u64 {
        let variables = entry
            .variables
            .iter()
            .map(|index| &shader.variables[*index]);
        variables
            .filter(|variable| variable.role != Role::Uniform)
            .map(|variable| self.of_variable(entry, variable).bytes())
            .sum()
    }

    /// What the pass wrote becomes what the next one reads.
    pub fn exchange(&mut self, entry: &EntryPoint) {
        for name in entry.exchanged() {
            let copies = self.0.get_mut(name);
            copies
                .expect("a checked kernel uses declared textures")
                .swap(0, 1);
        }
    }
}
