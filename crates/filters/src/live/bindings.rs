//! Bindings of a stage as data.

use serde::Serialize;
use wgpu::naga::ScalarKind;

use crate::shader::{BlockNumber, EntryPoint, Role, SamplerFilter, Shader, Variable, Wrap};
use crate::{Expression, Format};

/// A variable of group 0, and what it is bound to.
#[derive(Clone, Debug, Serialize)]
pub(super) struct LiveBinding {
    binding: u32,
    #[serde(flatten)]
    role: LiveRole,
}

/// A resource.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "role", rename_all = "snake_case")]
enum LiveRole {
    /// A texture.
    Read {
        resource: String,
        kind: &'static str,
        /// True if a sampler interpolates it.
        filterable: bool,
        level: Option<Expression>,
    },
    /// A storage texture.
    Write {
        resource: String,
        format: Format,
        level: Option<Expression>,
    },
    /// A uniform block, or a storage buffer: offset, type and value of each number.
    Block {
        bytes: usize,
        storage: bool,
        numbers: Vec<(u32, &'static str, Expression)>,
    },
    Sampler {
        filter: SamplerFilter,
        mip: SamplerFilter,
        wrap: Wrap,
    },
}

impl LiveBinding {
    /// Lists the bindings that an entry point uses.
    pub fn list(shader: &Shader, entry: &EntryPoint) -> Vec<Self> {
        let describe = |index: &usize| {
            let variable = &shader.variables[*index];
            Self {
                binding: variable.binding,
                role: find_role(shader, variable, entry.interpolated.contains(index)),
            }
        };
        entry.variables.iter().map(describe).collect()
    }
}

fn find_role(shader: &Shader, variable: &Variable, filterable: bool) -> LiveRole {
    let (resource, level) = (variable.resource.clone(), variable.level.clone());
    match variable.role {
        Role::Read(kind) => LiveRole::Read {
            resource,
            kind: match kind {
                ScalarKind::Uint => "uint",
                ScalarKind::Sint => "sint",
                _ => "float",
            },
            filterable,
            level,
        },
        Role::Write(format) => LiveRole::Write {
            resource,
            format,
            level,
        },
        Role::Block(block) => {
            let block = &shader.blocks[block];
            let number = |it: &BlockNumber| (it.offset, it.kind, it.value.clone());
            LiveRole::Block {
                bytes: block.buffer_bytes(),
                storage: block.is_storage,
                numbers: block.numbers.iter().map(number).collect(),
            }
        }
        Role::Sampler(sampling) => LiveRole::Sampler {
            filter: sampling.filter,
            mip: sampling.mip_filter,
            wrap: sampling.wrap,
        },
    }
}

impl Shader {
    /// Lists the expressions of a variable: its level, and the numbers of its block.
    pub fn list_expressions(&self, variable: usize) -> impl Iterator<Item = &Expression> {
        let Variable { role, level, .. } = &self.variables[variable];
        let numbers = match role {
            Role::Block(block) => &self.blocks[*block].numbers[..],
            _ => &[],
        };
        let values = numbers.iter().map(|number| &number.value);
        values.chain(level)
    }
}
