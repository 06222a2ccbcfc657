//! Search for kernels that draw noise: they read the index of the frame.

use wgpu::naga::{Expression, Function, GlobalVariable, Handle, Module, TypeInner};

use super::resource_usage::list_called;

/// Returns true if a function, or one that it calls, may read the member `frame_index` of the
/// uniform `frame`. A read of the whole uniform counts.
pub(super) fn reads_frame_index(module: &Module, function: &Function) -> bool {
    let Some((frame, index)) = find_frame_index(module) else {
        return false;
    };
    let called = list_called(module, function);
    let called = called.iter().map(|callee| &module.functions[*callee]);
    called
        .chain([function])
        .any(|function| reads(function, frame, index))
}

/// Finds the uniform, and the place of the member in it.
fn find_frame_index(module: &Module) -> Option<(Handle<GlobalVariable>, u32)> {
    let variables = module.global_variables.iter();
    let (handle, variable) = variables
        .filter(|(_, variable)| variable.binding.is_some())
        .find(|(_, variable)| variable.name.as_deref() == Some("frame"))?;
    let TypeInner::Struct { members, .. } = &module.types[variable.ty].inner else {
        return None;
    };
    let named = |name: &Option<String>| name.as_deref() == Some("frame_index");
    let index = members.iter().position(|member| named(&member.name))?;
    Some((handle, index as u32))
}

/// Returns true if a function itself reads the member.
fn reads(function: &Function, frame: Handle<GlobalVariable>, member: u32) -> bool {
    let is_frame = |base: &Handle<Expression>| matches!(&function.expressions[*base], Expression::GlobalVariable(variable) if *variable == frame);
    let mut expressions = function.expressions.iter();
    expressions.any(|(_, expression)| match expression {
        Expression::AccessIndex { base, index } => *index == member && is_frame(base),
        Expression::Load { pointer } => is_frame(pointer),
        _ => false,
    })
}
