//! Cases of a `switch` that fall through into the next one, which naga gets wrong.

use naga::{Block, Module, Statement, SwitchCase};

/// Tells naga which cases never reach their end. It takes each that does not end with `break` and
/// the like for one that falls through.
pub fn settle_fall_through(module: &mut Module) {
    let functions = module.functions.iter_mut().map(|(_, function)| function);
    let entries = module
        .entry_points
        .iter_mut()
        .map(|entry| &mut entry.function);
    for function in functions.chain(entries) {
        visit(&mut function.body, &mut |cases| {
            for case in cases.iter_mut().filter(|case| !case.body.is_empty()) {
                case.fall_through &= finishes(&case.body);
            }
        });
    }
}

/// Finds a case that falls through into the next one, after labels that share a body. The writer of
/// SPIR-V counts such labels as one, and jumps to a wrong case: to the falling one itself, without
/// end.
pub fn falls_through_wrongly(module: &Module) -> bool {
    let mut falls_through = false;
    let functions = module.functions.iter().map(|(_, function)| function);
    let entries = module.entry_points.iter().map(|entry| &entry.function);
    for function in functions.chain(entries) {
        visit(&mut function.body.clone(), &mut |cases| {
            let is_label = |case: &SwitchCase| case.fall_through && case.body.is_empty();
            let mut after_label = cases.iter().skip_while(|case| !is_label(case));
            falls_through |= after_label.any(|case| case.fall_through && !case.body.is_empty());
        });
    }
    falls_through
}

/// Calls a function with the cases of each `switch`, inner ones first.
fn visit(block: &mut Block, on_switch: &mut dyn FnMut(&mut [SwitchCase])) {
    for statement in block.iter_mut() {
        match statement {
            Statement::Block(inner) => visit(inner, on_switch),
            Statement::If { accept, reject, .. } => {
                visit(accept, on_switch);
                visit(reject, on_switch);
            }
            Statement::Loop {
                body, continuing, ..
            } => {
                visit(body, on_switch);
                visit(continuing, on_switch);
            }
            Statement::Switch { cases, .. } => {
                for case in cases.iter_mut() {
                    visit(&mut case.body, on_switch);
                }
                on_switch(cases);
            }
            _ => {}
        }
    }
}

/// Returns true if control may reach the end of a block.
fn finishes(block: &Block) -> bool {
    match block.last() {
        Some(Statement::Block(inner)) => finishes(inner),
        Some(Statement::If { accept, reject, .. }) => finishes(accept) || finishes(reject),
        Some(Statement::Switch { cases, .. }) => {
            let is_left = |case: &SwitchCase| breaks(&case.body);
            let ends = |case: &SwitchCase| !case.fall_through && finishes(&case.body);
            cases.iter().any(|case| is_left(case) || ends(case))
        }
        Some(Statement::Loop { body, break_if, .. }) => break_if.is_some() || breaks(body),
        Some(statement) => !statement.is_terminator(),
        None => true,
    }
}

/// Returns true if a block has a `break` of the loop or the `switch` around it.
fn breaks(block: &Block) -> bool {
    block.iter().any(|statement| match statement {
        Statement::Break => true,
        Statement::Block(inner) => breaks(inner),
        Statement::If { accept, reject, .. } => breaks(accept) || breaks(reject),
        _ => false,
    })
}
