//! Which kernels draw noise: those that read the index of the frame, by themselves or through functions that they call.

use wgpu::naga::{
    Block, Expression, Function, GlobalVariable, Handle, Module, Statement, TypeInner,
};

/// Whether a function may read the member `frame_index` of the uniform `frame`. A read of the whole uniform counts.
pub(super) fn reads_frame_index(module: &Module, function: &Function) -> bool {
    let Some((frame, index)) = frame_index(module) else {
        return false;
    };
    reads(module, function, frame, index)
}

/// The uniform, and the place of the member in it.
fn frame_index(module: &Module) -> Option<(Handle<GlobalVariable>, u32)> {
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

fn reads(module: &Module, function: &Function, frame: Handle<GlobalVariable>, member: u32) -> bool {
    let is_frame = |base: &Handle<Expression>| matches!(&function.expressions[*base], Expression::GlobalVariable(found) if *found == frame);
    let expressions = || {
        function
            .expressions
            .iter()
            .map(|(_, expression)| expression)
    };
    let by_itself = expressions().any(|expression| match expression {
        Expression::AccessIndex { base, index } => *index == member && is_frame(base),
        Expression::Load { pointer } => is_frame(pointer),
        _ => false,
    });
    let mut called = Vec::new();
    calls(&function.body, &mut called);
    by_itself
        || (called.into_iter())
            .any(|callee| reads(module, &module.functions[callee], frame, member))
}

/// The functions that a block calls.
fn calls(block: &Block, called: &mut Vec<Handle<Function>>) {
    for statement in block.iter() {
        match statement {
            Statement::Call { function, .. } => called.push(*function),
            Statement::Block(inner) => calls(inner, called),
            Statement::If { accept, reject, .. } => {
                calls(accept, called);
                calls(reject, called);
            }
            Statement::Switch { cases, .. } => {
                for case in cases {
                    calls(&case.body, called);
                }
            }
            Statement::Loop {
                body, continuing, ..
            } => {
                calls(body, called);
                calls(continuing, called);
            }
            _ => {}
        }
    }
}
