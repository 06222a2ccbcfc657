//! Resources that a kernel asks of a device.

use wgpu::naga::valid::{GlobalUse, ModuleInfo};
use wgpu::naga::{
    AddressSpace, Block, EntryPoint, Expression, Function, Handle, MathFunction, Module, Statement,
    TypeInner,
};

/// Bytes that the variables of one invocation may take: those of a kernel and of all functions that
/// it calls, and `var<private>`; WGSL promises 8,192 for each of the two kinds. No value may be
/// larger either, such as a table in a `const`.
pub const MAX_INVOCATION_BYTES: u64 = 16_384;

/// Expressions and statements of a kernel and of every function that it calls, when each call is
/// replaced by the function's body, as compilers for GPUs do.
pub const MAX_INLINED: u64 = 200_000;

/// Resources that one entry point asks for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct ResourceUsage {
    /// Bytes of `var<workgroup>`.
    pub workgroup_bytes: u64,
    /// Bytes of the variables and of the largest value of one invocation.
    pub invocation_bytes: u64,
    /// Expressions and statements of all functions with every call inlined.
    pub inlined: u64,
    /// True if it packs 32-bit floats to 16-bit floats, unpacks those, or rounds to them.
    pub packs_halves: bool,
}

impl ResourceUsage {
    /// Measures the entry point with that index.
    pub fn of(module: &Module, info: &ModuleInfo, index: usize) -> Self {
        let entry = &module.entry_points[index];
        let used = info.get_entry_point(index);
        let globals = |space| {
            let variables = module.global_variables.iter();
            let used = variables.filter(|(handle, variable)| {
                variable.space == space && used[*handle] != GlobalUse::empty()
            });
            used.map(|(_, variable)| size_of_type(module, &module.types[variable.ty].inner))
                .sum::<u64>()
        };
        let called = list_called(module, &entry.function);
        let functions = (called.iter()).map(|handle| (&module.functions[*handle], &info[*handle]));
        let functions: Vec<_> = functions.chain([(&entry.function, used)]).collect();
        let locals = functions
            .iter()
            .flat_map(|(function, _)| function.local_variables.iter())
            .map(|(_, variable)| size_of_type(module, &module.types[variable.ty].inner));
        let locals: u64 = locals.sum();
        let values = functions.iter().flat_map(|(function, info)| {
            let handles = function.expressions.iter().map(|(handle, _)| handle);
            handles.map(|handle| info[handle].ty.inner_with(&module.types))
        });
        let values = values.map(|ty| size_of_type(module, ty));
        Self {
            workgroup_bytes: globals(AddressSpace::WorkGroup),
            invocation_bytes: (globals(AddressSpace::Private) + locals)
                .max(values.max().unwrap_or(0)),
            inlined: count_inlined(module, entry, &called),
            packs_halves: (functions.iter()).any(|(function, _)| packs_halves(function)),
        }
    }

    /// Refuses a kernel that no device could be expected to run. `kernel` is its name.
    pub fn check(&self, kernel: &str) -> Result<(), String> {
        for (count, allowed, what, way_out) in [
            (
                self.invocation_bytes,
                MAX_INVOCATION_BYTES,
                "bytes of variables or of one value in an invocation",
                "keep large tables in a texture",
            ),
            (
                self.inlined,
                MAX_INLINED,
                "expressions and statements with every call inlined",
                "put a loop in the place of calls, or divide the pass",
            ),
        ] {
            if count > allowed {
                return Err(format!(
                    "kernel \"{kernel}\": {count} {what}; allowed: at most {allowed}; {way_out}"
                ));
            }
        }
        Ok(())
    }
}

/// Returns true for a function that converts between floats of 32 and of 16 bits.
fn packs_halves(function: &Function) -> bool {
    let mut expressions = function.expressions.iter();
    expressions.any(|(_, expression)| match expression {
        Expression::Math { fun, .. } => matches!(
            fun,
            MathFunction::Pack2x16float
                | MathFunction::Unpack2x16float
                | MathFunction::QuantizeToF16
        ),
        _ => false,
    })
}

/// Returns the bytes of a type, or the largest number if they do not fit.
fn size_of_type(module: &Module, ty: &TypeInner) -> u64 {
    ty.try_size(module.to_ctx())
        .map_or(u64::from(u32::MAX), u64::from)
}

/// Lists every function that a function calls, by itself or through others, once.
pub(super) fn list_called(module: &Module, caller: &Function) -> Vec<Handle<Function>> {
    let mut called = Vec::new();
    scan_calls(&caller.body, &mut called);
    let mut known = vec![false; module.functions.len()];
    let mut distinct = Vec::new();
    while let Some(function) = called.pop() {
        if !std::mem::replace(&mut known[function.index()], true) {
            distinct.push(function);
            scan_calls(&module.functions[function].body, &mut called);
        }
    }
    distinct
}

/// Counts the expressions and statements of an entry point and of the functions that it calls, with
/// every call inlined. Naga lists functions after those that they call.
fn count_inlined(module: &Module, entry: &EntryPoint, called: &[Handle<Function>]) -> u64 {
    let mut sizes = Vec::with_capacity(module.functions.len());
    let count = |sizes: &[u64], function: &Function| {
        let mut called = Vec::new();
        let statements = scan_calls(&function.body, &mut called);
        let of_callee = |callee: &Handle<Function>| sizes.get(callee.index()).copied().unwrap_or(0);
        let inlined = called.iter().map(of_callee).fold(0, u64::saturating_add);
        inlined.saturating_add(statements + function.expressions.len() as u64)
    };
    for (_, function) in module.functions.iter() {
        sizes.push(count(&sizes, function));
    }
    let of_called = called.iter().map(|function| sizes[function.index()]);
    of_called.fold(count(&sizes, &entry.function), u64::saturating_add)
}

/// Lists the functions that a block calls, once per call; returns how many statements it has.
fn scan_calls(block: &Block, called: &mut Vec<Handle<Function>>) -> u64 {
    let mut statements = 0;
    for statement in block.iter() {
        statements += 1;
        statements += match statement {
            Statement::Call { function, .. } => {
                called.push(*function);
                0
            }
            Statement::Block(inner) => scan_calls(inner, called),
            Statement::If { accept, reject, .. } => {
                scan_calls(accept, called) + scan_calls(reject, called)
            }
            Statement::Switch { cases, .. } => {
                (cases.iter().map(|case| scan_calls(&case.body, called))).sum()
            }
            Statement::Loop {
                body, continuing, ..
            } => scan_calls(body, called) + scan_calls(continuing, called),
            _ => 0,
        };
    }
    statements
}
