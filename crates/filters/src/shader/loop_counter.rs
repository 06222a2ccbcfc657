//! Counters of each invocation's loop iterations, in kernels.

use wgpu::naga::{
    AddressSpace, AtomicFunction, BinaryOperator, Block, Expression, Function, FunctionArgument,
    FunctionResult, GlobalVariable, Handle, Literal, MemoryDecorations, Module, Range,
    ResourceBinding, Scalar, Span, Statement, StorageAccess, Type, TypeInner,
};

/// Rewrites validated kernels so that every invocation counts its loop iterations. Counts from
/// `least` on raise the number in the storage buffer at `binding`.
pub(crate) fn count_loop_iterations(module: &Module, binding: u32, least: u32) -> Module {
    let mut module = module.clone();
    let counter = Counter::declare(&mut module, binding);
    let functions = module.functions.iter_mut().map(|(_, function)| function);
    let entries = module.entry_points.iter_mut();
    for function in functions.chain(entries.map(|entry| &mut entry.function)) {
        counter.count_in(function);
    }
    for index in 0..module.entry_points.len() {
        let entry = &mut module.entry_points[index];
        let mut callee = std::mem::take(&mut entry.function);
        let (arguments, result) = (callee.arguments.clone(), callee.result.clone());
        callee.name = Some(format!("{}_counted", entry.name));
        // Only entry points have bindings.
        (callee.arguments.iter_mut()).for_each(|argument| argument.binding = None);
        (callee.result.iter_mut()).for_each(|result| result.binding = None);
        let callee = module.functions.append(callee, Span::UNDEFINED);
        module.entry_points[index].function = counter.report_from(callee, arguments, result, least);
    }
    module
}

/// Variables that the rewritten kernels count with.
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
                    let old = std::mem::replace(body, self.make_increment(function));
                    body.extend_block(old);
                }
                _ => {}
            }
        }
    }

    /// Makes `loop_iterations += 1;`.
    fn make_increment(&self, function: &mut Function) -> Block {
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

    /// Makes an entry point that runs the kernel and then reports a count of `least` or more.
    fn report_from(
        &self,
        kernel: Handle<Function>,
        arguments: Vec<FunctionArgument>,
        result: Option<FunctionResult>,
        least: u32,
    ) -> Function {
        let returns = result.is_some();
        let mut function = Function {
            arguments,
            result,
            ..Function::default()
        };
        let count = function.arguments.len() as u32;
        let mut append = |expression| function.expressions.append(expression, Span::UNDEFINED);
        let passed = (0..count)
            .map(|index| append(Expression::FunctionArgument(index)))
            .collect();
        let returned = returns.then(|| append(Expression::CallResult(kernel)));
        let counted = append(Expression::GlobalVariable(self.iterations));
        let most = append(Expression::GlobalVariable(self.most));
        let right = append(Expression::Literal(Literal::U32(least)));
        let value = append(Expression::Load { pointer: counted });
        let condition = append(Expression::Binary {
            op: BinaryOperator::GreaterEqual,
            left: value,
            right,
        });
        let raised = append(Expression::AtomicResult {
            ty: self.number,
            comparison: false,
        });
        let report = Statement::Atomic {
            pointer: most,
            fun: AtomicFunction::Max,
            value,
            result: Some(raised),
        };
        function.body = Block::from_vec(vec![
            Statement::Call {
                function: kernel,
                arguments: passed,
                result: returned,
            },
            Statement::Emit(Range::new_from_bounds(value, condition)),
            Statement::If {
                condition,
                accept: Block::from_vec(vec![report]),
                reject: Block::new(),
            },
            Statement::Return { value: returned },
        ]);
        function
    }
}
