//! Search for barriers that only some invocations of a workgroup may reach. The search for what
//! differs among invocations follows values through variables and calls, and knows no order of
//! statements.

use std::collections::{BTreeMap, BTreeSet};

use wgpu::naga::{
    AddressSpace, Binding, Block, BuiltIn, EntryPoint, Expression, Function, GlobalVariable,
    Handle, LocalVariable, Module, Statement, TypeInner,
};

use super::operands::list_operands;

/// Names the function of a barrier that only some invocations may reach.
pub(super) fn find_divergent_barrier(module: &Module, entry: &EntryPoint) -> Option<String> {
    let mut search = Search {
        module,
        private: BTreeSet::new(),
        known: BTreeMap::new(),
        function_name: None,
    };
    loop {
        let before = search.private.len();
        search.known.clear();
        let arguments = entry.function.arguments.iter();
        let arguments: Vec<bool> = arguments
            .map(|argument| differs_at_start(&argument.binding))
            .collect();
        search.search(&entry.function, &arguments, false);
        if search.private.len() == before {
            return search.function_name;
        }
    }
}

/// Returns true for a value of an entry point that differs among the invocations of a workgroup; a
/// struct's members are looked at one by one.
fn differs_at_start(binding: &Option<Binding>) -> bool {
    !matches!(
        binding,
        None | Some(Binding::BuiltIn(
            BuiltIn::WorkGroupId | BuiltIn::WorkGroupSize | BuiltIn::NumWorkGroups
        ))
    )
}

/// The functions of an entry point.
struct Search<'m> {
    module: &'m Module,
    /// Private variables whose values differ among invocations.
    private: BTreeSet<Handle<GlobalVariable>>,
    /// Whether the result of a function differs, by its arguments and by whether all invocations
    /// call it.
    known: BTreeMap<(usize, Vec<bool>, bool), bool>,
    function_name: Option<String>,
}

impl Search<'_> {
    /// Searches a function, some of whose `arguments` differ; `divergent` if only some invocations
    /// call it. Returns whether its result differs.
    fn search(&mut self, function: &Function, arguments: &[bool], divergent: bool) -> bool {
        let mut visit = Visit {
            function,
            arguments,
            locals: BTreeSet::new(),
            results: BTreeSet::new(),
            differs: Vec::new(),
            returns_other: false,
        };
        loop {
            let before = (visit.locals.len(), visit.results.len(), self.private.len());
            visit.find_differing(self);
            self.follow(&mut visit, &function.body, divergent);
            if before == (visit.locals.len(), visit.results.len(), self.private.len()) {
                return visit.returns_other;
            }
        }
    }

    /// Follows control through a block that only some invocations run if `divergent`. Returns how
    /// some may leave it before its end.
    fn follow(&mut self, visit: &mut Visit, block: &Block, mut divergent: bool) -> Left {
        let mut left = Left::default();
        for statement in block.iter() {
            let inner = match statement {
                Statement::Block(inner) => self.follow(visit, inner, divergent),
                Statement::If {
                    condition,
                    accept,
                    reject,
                } => {
                    let divergent = divergent || visit.differs(*condition);
                    let accepted = self.follow(visit, accept, divergent);
                    accepted.or(self.follow(visit, reject, divergent))
                }
                Statement::Switch { selector, cases } => {
                    let divergent = divergent || visit.differs(*selector);
                    let cases = cases.iter();
                    let left = cases.fold(Left::default(), |left, case| {
                        left.or(self.follow(visit, &case.body, divergent))
                    });
                    Left {
                        broke: false,
                        ..left
                    }
                }
                Statement::Loop {
                    body,
                    continuing,
                    break_if,
                } => {
                    let first = self.follow(visit, body, divergent);
                    let ends = break_if.is_some_and(|condition| visit.differs(condition));
                    let again = divergent || first.broke || first.returned || ends;
                    let mut left = first;
                    if again != divergent {
                        left = left.or(self.follow(visit, body, again));
                    }
                    self.follow(visit, continuing, again);
                    Left {
                        returned: left.returned,
                        ..Left::default()
                    }
                }
                other => self.follow_simple(visit, other, divergent),
            };
            left = left.or(inner);
            divergent |= left.returned || left.broke || left.continued;
        }
        left
    }

    /// Follows a statement without blocks.
    fn follow_simple(&mut self, visit: &mut Visit, statement: &Statement, divergent: bool) -> Left {
        let mut left = Left::default();
        match statement {
            Statement::Break => left.broke = divergent,
            Statement::Continue => left.continued = divergent,
            Statement::Return { value } => {
                left.returned = divergent;
                visit.returns_other |= divergent || value.is_some_and(|value| visit.differs(value));
            }
            Statement::Store { pointer, value }
                if divergent || visit.differs(*value) || visit.differs(*pointer) =>
            {
                self.mark(visit, *pointer);
            }
            Statement::Call {
                function,
                arguments,
                result,
            } => {
                let given: Vec<bool> = arguments
                    .iter()
                    .map(|argument| visit.differs(*argument))
                    .collect();
                let key = (function.index(), given, divergent);
                let differs = match self.known.get(&key) {
                    Some(differs) => *differs,
                    None => {
                        let callee = &self.module.functions[*function];
                        let differs = self.search(callee, &key.1, divergent);
                        self.known.insert(key.clone(), differs);
                        differs
                    }
                };
                if differs || divergent {
                    visit.results.extend(*result);
                }
                // It may store what differs through a pointer.
                if divergent || key.1.contains(&true) {
                    arguments
                        .iter()
                        .for_each(|argument| self.mark(visit, *argument));
                }
            }
            Statement::ControlBarrier(_) | Statement::WorkGroupUniformLoad { .. } if divergent => {
                let name = visit.function.name.clone().unwrap_or_default();
                self.function_name.get_or_insert(name);
            }
            _ => {}
        }
        left
    }

    /// Notes that the variable behind a pointer differs among invocations.
    fn mark(&mut self, visit: &mut Visit, pointer: Handle<Expression>) {
        match visit.find_root(pointer) {
            Some(Root::Local(variable)) => _ = visit.locals.insert(variable),
            Some(Root::Global(variable))
                if self.module.global_variables[variable].space == AddressSpace::Private =>
            {
                self.private.insert(variable);
            }
            _ => {}
        }
    }
}

/// Ways in which some invocations, and not others, leave a block before its end.
#[derive(Clone, Copy, Default)]
struct Left {
    returned: bool,
    broke: bool,
    continued: bool,
}

impl Left {
    fn or(self, other: Self) -> Self {
        Self {
            returned: self.returned || other.returned,
            broke: self.broke || other.broke,
            continued: self.continued || other.continued,
        }
    }
}

/// A variable behind a pointer.
enum Root {
    Local(Handle<LocalVariable>),
    Global(Handle<GlobalVariable>),
}

/// One function, and what differs in it among invocations.
struct Visit<'v> {
    function: &'v Function,
    arguments: &'v [bool],
    locals: BTreeSet<Handle<LocalVariable>>,
    /// Results of calls.
    results: BTreeSet<Handle<Expression>>,
    /// By expression.
    differs: Vec<bool>,
    returns_other: bool,
}

impl Visit<'_> {
    fn differs(&self, expression: Handle<Expression>) -> bool {
        self.differs[expression.index()]
    }

    /// Finds the expressions that differ; operands come before what is made of them.
    fn find_differing(&mut self, search: &Search) {
        self.differs.clear();
        for (handle, expression) in self.function.expressions.iter() {
            let of_itself = match expression {
                Expression::FunctionArgument(index) => self.arguments[*index as usize],
                Expression::AccessIndex { base, index } => {
                    self.is_own_member(search, *base, *index)
                }
                Expression::LocalVariable(variable) => self.locals.contains(variable),
                Expression::GlobalVariable(variable) => search.private.contains(variable),
                Expression::CallResult(_) => self.results.contains(&handle),
                Expression::AtomicResult { .. }
                | Expression::SubgroupBallotResult
                | Expression::SubgroupOperationResult { .. } => true,
                _ => false,
            };
            let mut operands = list_operands(expression).into_iter();
            let differs = of_itself || operands.any(|operand| self.differs(operand));
            self.differs.push(differs);
        }
    }

    /// Returns true for a member of an entry point's struct that differs among invocations.
    fn is_own_member(&self, search: &Search, base: Handle<Expression>, index: u32) -> bool {
        let Expression::FunctionArgument(argument) = self.function.expressions[base] else {
            return false;
        };
        let ty = self.function.arguments[argument as usize].ty;
        match &search.module.types[ty].inner {
            TypeInner::Struct { members, .. } => {
                (members.get(index as usize)).is_some_and(|member| {
                    member.binding.is_some() && differs_at_start(&member.binding)
                })
            }
            _ => false,
        }
    }

    fn find_root(&self, pointer: Handle<Expression>) -> Option<Root> {
        match self.function.expressions[pointer] {
            Expression::LocalVariable(variable) => Some(Root::Local(variable)),
            Expression::GlobalVariable(variable) => Some(Root::Global(variable)),
            Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => {
                self.find_root(base)
            }
            _ => None,
        }
    }
}
