//! Resources that a kernel asks of a device, found in naga's module.

use wgpu::naga::valid::{GlobalUse, ModuleInfo};
use wgpu::naga::{AddressSpace, Block, EntryPoint, Function, Handle, Module, Statement, TypeInner};

/// Bytes that the variables of one invocation may take: those of a kernel and of all functions that it calls, and
/// `var<private>`; WGSL promises 8,192 for each of the two kinds. No value may be larger either, such as a table in a `const`.
pub const MAX_INVOCATION_BYTES: u64 = 16_384;

/// Expressions and statements of a kernel and of every function that it calls, when each call is replaced by the function's
/// body, as compilers for GPUs do.
pub const MAX_INLINED: u64 = 200_000;

/// What one entry point asks for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Demand {
    /// Bytes of `var<workgroup>`.
    pub workgroup_bytes: u64,
    /// Bytes of the variables and of the largest value of one invocation.
    pub invocation_bytes: u64,
    /// Expressions and statements of all functions with every call inlined.
    pub inlined: u64,
}

impl Demand {
    /// Of the entry point with that index.
    pub fn of(module: &Module, info: &ModuleInfo, index: usize) -> Self {
        let entry = &module.entry_points[index];
        let used = info.get_entry_point(index);
        let globals = |space| {
            let variables = module.global_variables.iter();
            let used = variables.filter(|(handle, variable)| {
                variable.space == space && used[*handle] != GlobalUse::empty()
            });
            used.map(|(_, variable)| size(module, &module.types[variable.ty].inner))
                .sum::<u64>()
        };
        let called = called_functions(module, &entry.function);
        let locals: u64 = (called.iter().map(|handle| &module.functions[*handle]))
            .chain([&entry.function])
            .map(|function| local_bytes(module, function))
            .sum();
        let values = (called
            .iter()
            .map(|handle| (&module.functions[*handle], &info[*handle])))
        .chain([(&entry.function, used)])
        .map(|(function, info)| {
            let types = function
                .expressions
                .iter()
                .map(|(handle, _)| info[handle].ty.inner_with(&module.types));
            types.map(|ty| size(module, ty)).max().unwrap_or(0)
        });
        Self {
            workgroup_bytes: globals(AddressSpace::WorkGroup),
            invocation_bytes: (globals(AddressSpace::Private) + locals)
                .max(values.max().unwrap_or(0)),
            inlined: inlined(module, entry, &called),
        }
    }
}

/// Bytes of a type; of one that is too large to tell, as many as there are numbers.
fn size(module: &Module, ty: &TypeInner) -> u64 {
    ty.try_size(module.to_ctx())
        .map_or(u64::from(u32::MAX), u64::from)
}

fn local_bytes(module: &Module, function: &Function) -> u64 {
    let variables = function.local_variables.iter();
    variables
        .map(|(_, variable)| size(module, &module.types[variable.ty].inner))
        .sum()
}

/// Every function that a function calls, by itself or through others, once.
pub(super) fn called_functions(module: &Module, caller: &Function) -> Vec<Handle<Function>> {
    let mut called = Vec::new();
    calls(&caller.body, &mut called);
    let mut known = vec![false; module.functions.len()];
    let mut distinct = Vec::new();
    while let Some(function) = called.pop() {
        if !std::mem::replace(&mut known[function.index()], true) {
            distinct.push(function);
            calls(&module.functions[function].body, &mut called);
        }
    }
    distinct
}

/// Expressions and statements of an entry point and of those functions, with every call inlined. Naga lists functions after
/// those that they call.
fn inlined(module: &Module, entry: &EntryPoint, called: &[Handle<Function>]) -> u64 {
    let mut sizes = Vec::with_capacity(module.functions.len());
    let size = |sizes: &[u64], function: &Function| {
        let mut called = Vec::new();
        let statements = calls(&function.body, &mut called);
        let of_callee = |callee: &Handle<Function>| sizes.get(callee.index()).copied().unwrap_or(0);
        let inlined = called.iter().map(of_callee).fold(0, u64::saturating_add);
        inlined.saturating_add(statements + function.expressions.len() as u64)
    };
    for (_, function) in module.functions.iter() {
        let size = size(&sizes, function);
        sizes.push(size);
    }
    let of_called = called.iter().map(|function| sizes[function.index()]);
    of_called.fold(size(&sizes, &entry.function), u64::saturating_add)
}

/// Lists the functions that a block calls, once per call; returns how many statements it has.
fn calls(block: &Block, called: &mut Vec<Handle<Function>>) -> u64 {
    let mut statements = 0;
    for statement in block.iter() {
        statements += 1;
        statements += match statement {
            Statement::Call { function, .. } => {
                called.push(*function);
                0
            }
            Statement::Block(inner) => calls(inner, called),
            Statement::If { accept, reject, .. } => calls(accept, called) + calls(reject, called),
            Statement::Switch { cases, .. } => {
                (cases.iter().map(|case| calls(&case.body, called))).sum()
            }
            Statement::Loop {
                body, continuing, ..
            } => calls(body, called) + calls(continuing, called),
            _ => 0,
        };
    }
    statements
}
