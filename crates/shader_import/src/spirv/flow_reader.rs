//! Reader of the control flow of naga's functions: from each mark to the marks that follow.

use std::cell::Cell;
use std::collections::BTreeMap;

use naga::{
    Block, Expression, Function, GlobalVariable, Handle, Literal, Module, Statement, SwitchCase,
};

use super::next_block::Next;

/// Where control goes from the statements of a block: at their end, at a `break`, and at a
/// `continue`.
#[derive(Clone, Copy)]
struct Exits<'e> {
    end: &'e dyn Fn() -> Next,
    on_break: &'e dyn Fn() -> Next,
    on_continue: &'e dyn Fn() -> Next,
}

impl<'e> Exits<'e> {
    fn ending(self, end: &'e dyn Fn() -> Next) -> Self {
        Self { end, ..self }
    }
}

/// Upper limit on blocks within one another, and on jumps without a mark.
const MAX_DEPTH: u32 = 10_000;

/// Reader of one function of naga.
pub(super) struct Reader<'m> {
    module: &'m Module,
    function: &'m Function,
    mark: Handle<GlobalVariable>,
    depth: Cell<u32>,
}

impl<'m> Reader<'m> {
    /// Makes a reader; `mark` is the variable that blocks store their marks in.
    pub fn new(module: &'m Module, function: &'m Function, mark: Handle<GlobalVariable>) -> Self {
        Self {
            module,
            function,
            mark,
            depth: Cell::new(0),
        }
    }

    /// Lists the marks, each with where control goes from there.
    pub fn list_marks(&self, marks: &mut BTreeMap<u32, Vec<Next>>) {
        let end = || Next::End;
        let outside = Exits {
            end: &end,
            on_break: &end,
            on_continue: &end,
        };
        self.list_marks_of(&self.function.body, outside, marks);
    }

    fn list_marks_of(
        &self,
        block: &[Statement],
        exits: Exits,
        marks: &mut BTreeMap<u32, Vec<Next>>,
    ) {
        for (index, statement) in block.iter().enumerate() {
            let rest = &block[index + 1..];
            if let Some(mark) = self.read_mark(statement) {
                marks
                    .entry(mark)
                    .or_default()
                    .push(self.find_next(rest, exits));
            }
            self.visit_blocks(statement, rest, exits, &mut |block, exits| {
                self.list_marks_of(block, exits, marks);
            });
        }
    }

    /// Reads the mark that a statement stores.
    fn read_mark(&self, statement: &Statement) -> Option<u32> {
        let Statement::Store { pointer, value } = statement else {
            return None;
        };
        let expressions = &self.function.expressions;
        let is_mark = matches!(expressions[*pointer], Expression::GlobalVariable(variable) if variable == self.mark);
        let Expression::Constant(constant) = expressions[*value] else {
            return None;
        };
        let init = self.module.constants[constant].init;
        match self.module.global_expressions[init] {
            Expression::Literal(Literal::U32(mark)) if is_mark => Some(mark),
            _ => None,
        }
    }

    /// Finds the marks that control reaches first from the begin of some statements.
    fn find_next(&self, block: &[Statement], exits: Exits) -> Next {
        if self.depth.get() > MAX_DEPTH {
            return Next::Lost;
        }
        self.depth.set(self.depth.get() + 1);
        let next = self.find_next_inner(block, exits);
        self.depth.set(self.depth.get() - 1);
        next
    }

    fn find_next_inner(&self, block: &[Statement], exits: Exits) -> Next {
        for (index, statement) in block.iter().enumerate() {
            if let Some(mark) = self.read_mark(statement) {
                return Next::Block(mark);
            }
            let mut nexts = Vec::new();
            self.visit_blocks(
                statement,
                &block[index + 1..],
                exits,
                &mut |block, exits| {
                    nexts.push(self.find_next(block, exits));
                },
            );
            let mut nexts = nexts.into_iter();
            let mut next = || Box::new(nexts.next().expect("it has a block"));
            match statement {
                Statement::Return { .. } => return Next::Return,
                Statement::Kill => return Next::Kill,
                Statement::Break => return (exits.on_break)(),
                Statement::Continue => return (exits.on_continue)(),
                Statement::Block(_) | Statement::Loop { .. } => return *next(),
                Statement::If { .. } => return Next::Either(next(), next()),
                Statement::Switch { cases, .. } => {
                    let cases = cases.iter().map(|case| (case.value, *next()));
                    return Next::Choice(cases.collect());
                }
                _ => {}
            }
        }
        (exits.end)()
    }

    /// Calls a function with the blocks of a statement that `rest` follows, and with where control
    /// goes from each.
    fn visit_blocks(
        &self,
        statement: &Statement,
        rest: &[Statement],
        exits: Exits,
        visit: &mut dyn FnMut(&[Statement], Exits),
    ) {
        let after = || self.find_next(rest, exits);
        let inner = exits.ending(&after);
        match statement {
            Statement::Block(block) => visit(block, inner),
            Statement::If { accept, reject, .. } => {
                visit(accept, inner);
                visit(reject, inner);
            }
            Statement::Switch { cases, .. } => {
                for index in 0..cases.len() {
                    let end = || self.end_case(cases, index, &after, exits);
                    let on_break = &after;
                    visit(&cases[index].body, Exits { on_break, ..inner }.ending(&end));
                }
            }
            Statement::Loop {
                body,
                continuing,
                break_if,
            } => {
                let repeated = Repeated {
                    body,
                    continuing,
                    may_break: break_if.is_some(),
                    after: &after,
                };
                let (end, again) = (|| self.repeat(&repeated), || self.start_again(&repeated));
                let inside = Exits {
                    end: &end,
                    on_break: &after,
                    on_continue: &end,
                };
                visit(body, inside);
                visit(continuing, inside.ending(&again));
            }
            _ => {}
        }
    }

    /// Finds where control goes at the end of a case.
    fn end_case(
        &self,
        cases: &[SwitchCase],
        index: usize,
        after: &dyn Fn() -> Next,
        exits: Exits,
    ) -> Next {
        match cases.get(index + 1) {
            Some(next) if cases[index].fall_through => {
                let end = || self.end_case(cases, index + 1, after, exits);
                let on_break = after;
                self.find_next(
                    &next.body,
                    Exits {
                        end: &end,
                        on_break,
                        ..exits
                    },
                )
            }
            _ => after(),
        }
    }

    /// Finds where control goes at the end of a loop's body.
    fn repeat(&self, repeated: &Repeated) -> Next {
        let (end, again) = (|| self.repeat(repeated), || self.start_again(repeated));
        self.find_next(
            repeated.continuing,
            Exits {
                end: &again,
                on_break: repeated.after,
                on_continue: &end,
            },
        )
    }

    /// Finds where control goes at the end of a loop's last statements.
    fn start_again(&self, repeated: &Repeated) -> Next {
        let end = || self.repeat(repeated);
        let start = self.find_next(
            repeated.body,
            Exits {
                end: &end,
                on_break: repeated.after,
                on_continue: &end,
            },
        );
        if repeated.may_break {
            Next::Repeat(Box::new((repeated.after)()), Box::new(start))
        } else {
            start
        }
    }
}

/// A loop of naga.
struct Repeated<'l> {
    body: &'l Block,
    continuing: &'l Block,
    /// True if it may end after its last statements.
    may_break: bool,
    /// Where control goes after it.
    after: &'l dyn Fn() -> Next,
}
