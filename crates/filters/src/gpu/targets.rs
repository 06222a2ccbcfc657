//! The textures of a run.

use std::collections::BTreeMap;

use super::adapter::Gpu;
use super::shader::{EntryPoint, Role, Shader, Variable, written};
use super::transfer::Target;
use crate::{Filter, Format, Settings};

/// Textures by name. One that a pass both reads and writes has two copies, and the first is the one to read.
#[derive(Debug)]
pub(super) struct Targets(BTreeMap<String, Vec<Target>>);

impl Targets {
    pub fn new(gpu: &Gpu, filter: &Filter, settings: &Settings, size: [u32; 2]) -> Self {
        let mut targets = BTreeMap::new();
        for (name, format) in [
            ("color", Format::Rgba32Float),
            ("velocity", Format::Rg32Float),
            ("depth", Format::R32Float),
            ("output", Format::Rgba32Float),
        ] {
            let target = gpu.target(name, size[0], size[1], format);
            targets.insert(name.to_owned(), vec![target]);
        }
        for texture in &filter.textures {
            let divided_by = texture.divided_by.as_ref();
            let divisor = divided_by.map_or(1, |length| settings.pixels(length));
            let [width, height] = size.map(|side| side.div_ceil(divisor));
            let exchanged = filter.passes.iter().any(|pass| {
                let mut names = filter.entry_point(pass).exchanged();
                names.any(|name| *name == texture.name)
            });
            let copies = if exchanged { 2 } else { 1 };
            let copies = (0..copies)
                .map(|_| gpu.target(&texture.name, width, height, texture.format))
                .collect();
            targets.insert(texture.name.clone(), copies);
        }
        Self(targets)
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
