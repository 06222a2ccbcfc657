//! Expressions as JSON.

use serde_json::{Value, json};

use crate::Expression;

/// Describes an expression: a number, a name, or a list of a function and its arguments.
pub(super) fn describe(expression: &Expression) -> Value {
    match expression {
        Expression::Number(number) => json!(number),
        Expression::Name(name) => json!(name),
        Expression::Apply(function, arguments) => {
            let arguments = arguments.iter().map(describe);
            std::iter::once(json!(function)).chain(arguments).collect()
        }
    }
}

/// Lists the names in an expression.
pub(super) fn list_names(expression: &Expression) -> Vec<&str> {
    match expression {
        Expression::Number(_) => Vec::new(),
        Expression::Name(name) => vec![name],
        Expression::Apply(_, arguments) => arguments.iter().flat_map(list_names).collect(),
    }
}
