//! Members of the structs that uniforms hold.

use std::collections::BTreeMap;

use wgpu::naga::proc::Layouter;
use wgpu::naga::{AddressSpace, Module, Scalar, TypeInner};

use super::source::Source;

/// A member of a uniform struct.
#[derive(Clone, Debug)]
pub(crate) struct Member {
    pub name: String,
    /// `i32`, `u32`, `f32`, or what else was found.
    pub wgsl_type: String,
    /// Offset in bytes.
    pub offset: u32,
    pub line: usize,
}

/// Lists the members of every uniform by its name.
pub(super) fn find_uniforms(source: &Source, module: &Module) -> BTreeMap<String, Vec<Member>> {
    let mut layouter = Layouter::default();
    layouter
        .update(module.to_ctx())
        .expect("a validated module has a layout");
    let mut uniforms = BTreeMap::new();
    for (handle, uniform) in module.global_variables.iter() {
        if uniform.space != AddressSpace::Uniform {
            continue;
        }
        let line = source.line(module, handle);
        let member = |name: &Option<String>, ty, offset| Member {
            name: name.clone().unwrap_or_default(),
            wgsl_type: match &module.types[ty].inner {
                TypeInner::Scalar(Scalar::I32) => "i32".into(),
                TypeInner::Scalar(Scalar::U32) => "u32".into(),
                TypeInner::Scalar(Scalar::F32) => "f32".into(),
                _ => format!("something of {} bytes", layouter[ty].size),
            },
            offset,
            line,
        };
        let members = match &module.types[uniform.ty].inner {
            TypeInner::Struct { members, .. } => members
                .iter()
                .map(|found| member(&found.name, found.ty, found.offset))
                .collect(),
            _ => vec![member(&uniform.name, uniform.ty, 0)],
        };
        uniforms.insert(uniform.name.clone().unwrap_or_default(), members);
    }
    uniforms
}
