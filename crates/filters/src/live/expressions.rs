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

/// Writes an expression for filter.toml.
pub(super) fn write(expression: &Expression) -> Value {
    match expression {
        Expression::Number(number) => json!(number),
        other => json!(text(other)),
    }
}

fn text(expression: &Expression) -> String {
    let (function, arguments) = match expression {
        Expression::Number(number) => return number.to_string(),
        Expression::Name(name) => return name.clone(),
        Expression::Apply(function, arguments) => (function, arguments),
    };
    let parts: Vec<String> = arguments.iter().map(text).collect();
    let is_word = function.starts_with(|letter: char| letter.is_alphabetic());
    match &parts[..] {
        parts if is_word => format!("{function}({})", parts.join(", ")),
        [one] => format!("({function}{one})"),
        parts => format!("({})", parts.join(&format!(" {function} "))),
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
