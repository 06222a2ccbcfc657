//! Loop iterations of kernels: how many an adapter allows, and how many a kernel takes.
//!
//! Mesa's llvmpipe ends every loop of an invocation after 65,535 iterations in total, without a word: the picture is wrong
//! and no error says so. [`probe`] finds such a limit; [`count`] makes kernels tell how near they come to it.

use std::borrow::Cow;

use wgpu::naga::{
    AddressSpace, AtomicFunction, BinaryOperator, Block, EntryPoint, Expression, Function,
    FunctionArgument, GlobalVariable, Handle, Literal, MemoryDecorations, Module, Range,
    ResourceBinding, Scalar, Span, Statement, StorageAccess, Type, TypeInner, front,
};

use super::adapter::Gpu;
use super::transfer::Place;
use crate::FilterError;

/// Loop iterations that an adapter grants one invocation, all its loops together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LoopLimit {
    /// Iterations after which every loop ends.
    pub iterations: u32,
    /// Invocations that run in step and share the limit, at most: where they branch apart, their iterations add up.
    pub lanes: u32,
}

impl LoopLimit {
    /// Iterations of one invocation from which on the picture may be wrong: its neighbours in step may take as many.
    pub fn safe(self) -> u32 {
        self.iterations / self.lanes.max(1)
    }
}

/// Iterations that the probe asks for: an adapter that grants these is taken to have no limit.
const PROBED: u32 = 1 << 20;

/// One invocation that counts its iterations. The remainder keeps a compiler from working the count out by itself.
const PROBE: &str = "
@group(0) @binding(0) var<storage, read_write> found: array<u32, 2>;
@compute @workgroup_size(1)
fn probe() {
    var value = found[1];
    var iterations = 0u;
    while iterations < found[0] {
        value = value * 1664525u + 1013904223u;
        iterations += 1u;
    }
    found[0] = iterations;
    found[1] = value;
}
";

/// The iterations that the adapter grants, where that is fewer than a million.
pub(super) fn probe(gpu: &Gpu) -> Result<Option<u32>, FilterError> {
    let place = Place {
        filter: "none",
        pass: "probe of the longest loop",
    };
    let readable = gpu.guarded(place, || {
        let module = gpu
            .device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(place.pass),
                source: wgpu::ShaderSource::Wgsl(PROBE.into()),
            });
        let pipeline = gpu
            .device
            .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(place.pass),
                layout: None,
                module: &module,
                entry_point: None,
                compilation_options: Default::default(),
                cache: None,
            });
        let buffer = |usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(place.pass),
                size: 8,
                usage: usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let found = buffer(wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
        let readable = buffer(wgpu::BufferUsages::MAP_READ);
        gpu.queue
            .write_buffer(&found, 0, bytemuck::cast_slice(&[PROBED, 1]));
        let bind_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(place.pass),
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: found.as_entire_binding(),
            }],
        });
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &bind_group, &[]);
        pass.dispatch_workgroups(1, 1, 1);
        drop(pass);
        encoder.copy_buffer_to_buffer(&found, 0, &readable, 0, 8);
        gpu.queue.submit([encoder.finish()]);
        readable
    })?;
    let iterations = gpu.read_buffer::<u32>(&readable, place)?[0];
    Ok((iterations < PROBED).then_some(iterations))
}

/// The kernels of a WGSL source, rewritten so that every invocation counts its loop iterations and, from `least` on, raises
/// the number in the storage buffer at `binding` to its count. The source has been validated.
pub(super) fn count(source: &str, binding: u32, least: u32) -> wgpu::ShaderSource<'static> {
    let mut module = front::wgsl::parse_str(source).expect("the kernels were parsed when loaded");
    let counter = Counter::declare(&mut module, binding);
    let functions = module.functions.iter_mut().map(|(_, function)| function);
    let entries = module.entry_points.iter_mut();
    for function in functions.chain(entries.map(|entry| &mut entry.function)) {
        counter.count_in(function);
    }
    for index in 0..module.entry_points.len() {
        let entry = &mut module.entry_points[index];
        let kernel = std::mem::take(&mut entry.function);
        let (inner, arguments) = inner(entry, kernel);
        let inner = module.functions.append(inner, Span::UNDEFINED);
        module.entry_points[index].function = counter.reporting(inner, arguments, least);
    }
    wgpu::ShaderSource::Naga(Cow::Owned(module))
}

/// The body of an entry point as a function that another one can call, and the arguments of the entry point.
fn inner(entry: &EntryPoint, kernel: Function) -> (Function, Vec<FunctionArgument>) {
    let arguments = kernel.arguments.clone();
    let mut inner = kernel;
    inner.name = Some(format!("{}_counted", entry.name));
    for argument in &mut inner.arguments {
        argument.binding = None;
    }
    (inner, arguments)
}

/// The variables that the rewritten kernels count with.
struct Counter {
    number: Handle<Type>,
    /// Iterations of this invocation so far.
    iterations: Handle<GlobalVariable>,
    /// The largest count of any invocation.
    most: Handle<GlobalVariable>,
}

impl Counter {
    fn declare(module: &mut Module, binding: u32) -> Self {
        let mut insert = |inner| {
            let name = None;
            module.types.insert(Type { name, inner }, Span::UNDEFINED)
        };
        let number = insert(TypeInner::Scalar(Scalar::U32));
        let atomic = insert(TypeInner::Atomic(Scalar::U32));
        let mut declare = |name: &str, space, binding, ty| {
            let variable = GlobalVariable {
                name: Some(name.to_owned()),
                space,
                binding,
                ty,
                init: None,
                memory_decorations: MemoryDecorations::empty(),
            };
            module.global_variables.append(variable, Span::UNDEFINED)
        };
        let iterations = declare("loop_iterations", AddressSpace::Private, None, number);
        let access = StorageAccess::LOAD | StorageAccess::STORE;
        let group = 0;
        let most = declare(
            "most_loop_iterations",
            AddressSpace::Storage { access },
            Some(ResourceBinding { group, binding }),
            atomic,
        );
        Self {
            number,
            iterations,
            most,
        }
    }

    /// Counts in every loop of a function.
    fn count_in(&self, function: &mut Function) {
        let mut body = std::mem::take(&mut function.body);
        self.visit(&mut body, function);
        function.body = body;
    }

    fn visit(&self, block: &mut Block, function: &mut Function) {
        for statement in block.iter_mut() {
            match statement {
                Statement::Block(inner) => self.visit(inner, function),
                Statement::If { accept, reject, .. } => {
                    self.visit(accept, function);
                    self.visit(reject, function);
                }
                Statement::Switch { cases, .. } => {
                    for case in cases {
                        self.visit(&mut case.body, function);
                    }
                }
                Statement::Loop {
                    body, continuing, ..
                } => {
                    self.visit(body, function);
                    self.visit(continuing, function);
                    let old = std::mem::replace(body, self.increment(function));
                    body.extend_block(old);
                }
                _ => {}
            }
        }
    }

    /// `loop_iterations += 1;`
    fn increment(&self, function: &mut Function) -> Block {
        let mut append = |expression| function.expressions.append(expression, Span::UNDEFINED);
        let pointer = append(Expression::GlobalVariable(self.iterations));
        let right = append(Expression::Literal(Literal::U32(1)));
        let left = append(Expression::Load { pointer });
        let value = append(Expression::Binary {
            op: BinaryOperator::Add,
            left,
            right,
        });
        Block::from_vec(vec![
            Statement::Emit(Range::new_from_bounds(left, value)),
            Statement::Store { pointer, value },
        ])
    }

    /// An entry point that runs the kernel and then reports a count of `least` or more.
    fn reporting(
        &self,
        kernel: Handle<Function>,
        arguments: Vec<FunctionArgument>,
        least: u32,
    ) -> Function {
        let mut function = Function {
            arguments,
            ..Function::default()
        };
        let count = function.arguments.len() as u32;
        let mut append = |expression| function.expressions.append(expression, Span::UNDEFINED);
        let passed = (0..count)
            .map(|index| append(Expression::FunctionArgument(index)))
            .collect();
        let counted = append(Expression::GlobalVariable(self.iterations));
        let most = append(Expression::GlobalVariable(self.most));
        let right = append(Expression::Literal(Literal::U32(least)));
        let value = append(Expression::Load { pointer: counted });
        let condition = append(Expression::Binary {
            op: BinaryOperator::GreaterEqual,
            left: value,
            right,
        });
        let result = append(Expression::AtomicResult {
            ty: self.number,
            comparison: false,
        });
        let report = Statement::Atomic {
            pointer: most,
            fun: AtomicFunction::Max,
            value,
            result: Some(result),
        };
        function.body = Block::from_vec(vec![
            Statement::Call {
                function: kernel,
                arguments: passed,
                result: None,
            },
            Statement::Emit(Range::new_from_bounds(value, condition)),
            Statement::If {
                condition,
                accept: Block::from_vec(vec![report]),
                reject: Block::new(),
            },
            Statement::Return { value: None },
        ]);
        function
    }
}
