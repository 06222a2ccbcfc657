//! Arithmetic on parameters and on values of the frame and the convention.

/// An expression: numbers, names, `+ - * / ^`, brackets, `floor(..)`, `ceil(..)`, `min(.., ..)` and
/// `max(.., ..)`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Expression {
    /// A number.
    Number(f64),
    /// A parameter or a value of the frame.
    Name(String),
    /// The value of a function or an operator.
    Apply(&'static str, Vec<Expression>),
}

/// Functions, with the number of their arguments.
const FUNCTIONS: [(&str, usize); 4] = [("floor", 1), ("ceil", 1), ("min", 2), ("max", 2)];

/// Operators with two sides, the weakest first.
const OPERATORS: [[&str; 2]; 2] = [["+", "-"], ["*", "/"]];

/// Upper limit on the characters of an expression, which limits its depth as well.
const MAX_CHARACTERS: usize = 200;

impl Expression {
    /// Parses an expression; `is_known` is true for the names that exist.
    pub fn parse(text: &str, is_known: &dyn Fn(&str) -> bool) -> Result<Self, String> {
        if text.len() > MAX_CHARACTERS {
            return Err(format!(
                "has {} characters; allowed: at most {MAX_CHARACTERS}",
                text.len()
            ));
        }
        let mut parser = Parser {
            rest: text,
            is_known,
        };
        let expression = parser.operation(0)?;
        match parser.rest.trim_start() {
            "" => Ok(expression),
            rest => Err(format!(
                "goes on with \"{rest}\" where an operator is expected"
            )),
        }
    }

    /// Computes the value.
    pub fn evaluate(&self, value: &dyn Fn(&str) -> f64) -> f64 {
        let (function, arguments) = match self {
            Self::Number(number) => return *number,
            Self::Name(name) => return value(name),
            Self::Apply(function, arguments) => (*function, arguments),
        };
        let arguments: Vec<f64> = arguments
            .iter()
            .map(|argument| argument.evaluate(value))
            .collect();
        match (function, &arguments[..]) {
            ("-", [a]) => -a,
            ("floor", [a]) => a.floor(),
            ("ceil", [a]) => a.ceil(),
            ("min", [a, b]) => a.min(*b),
            ("max", [a, b]) => a.max(*b),
            ("+", [a, b]) => a + b,
            ("-", [a, b]) => a - b,
            ("*", [a, b]) => a * b,
            ("/", [a, b]) => a / b,
            ("^", [a, b]) => a.powf(*b),
            _ => unreachable!("the parser makes no other function"),
        }
    }

    /// Returns true if the value depends on a name.
    pub fn reads(&self, wanted: &str) -> bool {
        self.reads_any(&|name| name == wanted)
    }

    /// Returns true if the value depends on one of several names.
    pub(crate) fn reads_any(&self, is_wanted: &dyn Fn(&str) -> bool) -> bool {
        match self {
            Self::Number(_) => false,
            Self::Name(name) => is_wanted(name),
            Self::Apply(_, arguments) => arguments
                .iter()
                .any(|argument| argument.reads_any(is_wanted)),
        }
    }
}

struct Parser<'t> {
    rest: &'t str,
    is_known: &'t dyn Fn(&str) -> bool,
}

impl Parser<'_> {
    /// Parses a chain of the operators at `level`, from left to right.
    fn operation(&mut self, level: usize) -> Result<Expression, String> {
        let Some(operators) = OPERATORS.get(level) else {
            return self.power();
        };
        let mut left = self.operation(level + 1)?;
        while let Some(operator) = self.take(operators) {
            left = Expression::Apply(operator, vec![left, self.operation(level + 1)?]);
        }
        Ok(left)
    }

    fn power(&mut self) -> Result<Expression, String> {
        if let Some(minus) = self.take(&["-"]) {
            return Ok(Expression::Apply(minus, vec![self.power()?]));
        }
        let base = self.atom()?;
        match self.take(&["^"]) {
            None => Ok(base),
            Some(operator) => Ok(Expression::Apply(operator, vec![base, self.power()?])),
        }
    }

    fn atom(&mut self) -> Result<Expression, String> {
        if self.take(&["("]).is_some() {
            let inner = self.operation(0)?;
            return self.close().map(|()| inner);
        }
        self.rest = self.rest.trim_start();
        let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.';
        let mut end = self.rest.find(|c| !is_part(c)).unwrap_or(self.rest.len());
        // `view[3]` is one name.
        if let Some(index) = self.rest[end..].strip_prefix('[').filter(|_| end > 0) {
            end += index.find(']').map_or(0, |length| length + 2);
        }
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest;
        if word.is_empty() {
            return Err("has an operator without a value next to it".into());
        }
        if word.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
            let number = word.parse::<f64>();
            return (number.map(Expression::Number))
                .map_err(|_| format!("\"{word}\" is no number"));
        }
        let function = FUNCTIONS.iter().find(|(name, _)| *name == word);
        if let Some((function, count)) = function
            && self.take(&["("]).is_some()
        {
            let mut arguments = vec![self.operation(0)?];
            while self.take(&[","]).is_some() {
                arguments.push(self.operation(0)?);
            }
            self.close()?;
            return if arguments.len() == *count {
                Ok(Expression::Apply(function, arguments))
            } else {
                Err(format!(
                    "has {word} of {} values; allowed: {count}",
                    arguments.len()
                ))
            };
        }
        if (self.is_known)(word) {
            Ok(Expression::Name(word.to_owned()))
        } else {
            Err(format!("holds the unknown name \"{word}\""))
        }
    }

    fn close(&mut self) -> Result<(), String> {
        let end = self.take(&[")"]);
        end.map(|_| ())
            .ok_or("has a bracket without the other".into())
    }

    /// Consumes one of the marks if it is next.
    fn take(&mut self, wanted: &[&'static str]) -> Option<&'static str> {
        let rest = self.rest.trim_start();
        let mark = *wanted.iter().find(|mark| rest.starts_with(**mark))?;
        self.rest = &rest[mark.len()..];
        Some(mark)
    }
}

#[cfg(test)]
mod tests {
    use super::Expression;

    fn evaluate(text: &str) -> Result<f64, String> {
        let parsed = Expression::parse(text, &|name| ["width", "taps", "view[3]"].contains(&name))?;
        Ok(parsed.evaluate(&|name| if name == "width" { 90.0 } else { 4.0 }))
    }

    #[test]
    fn expressions_have_the_value_that_mathematics_gives_them() {
        for (text, expected) in [
            ("1", 1.0),
            (" 1 / width ", 1.0 / 90.0),
            ("1 - 2 - 3", -4.0),
            ("-2 ^ 2", -4.0),
            ("2 ^ (taps - 1)", 8.0),
            ("2 ^ -1", 0.5),
            ("2 * (1 + taps) / 4", 2.5),
            ("ceil(-0.5) + ceil (taps)", 4.0),
            ("max(1, floor(taps / 8)) + min(taps, 2 * 3)", 5.0),
            ("0.5e1 + .5", 5.5),
            ("-view[3] * 2", -8.0),
        ] {
            assert_eq!(evaluate(text), Ok(expected), "{text}");
        }
    }

    #[test]
    fn what_is_no_expression_is_refused() {
        for (text, says) in [
            ("", "without a value"),
            ("(1", "bracket without"),
            ("ceil(1", "bracket without"),
            ("ceil 1", "unknown name \"ceil\""),
            ("max(1)", "max of 1 values; allowed: 2"),
            ("floor(1, 2)", "floor of 2 values; allowed: 1"),
            ("min(1, 2", "bracket without"),
            ("1 2", "goes on with"),
            ("time", "unknown name \"time\""),
            ("1.2.3", "no number"),
            (&"(".repeat(300), "has 300 characters"),
        ] {
            let refusal = evaluate(text).unwrap_err();
            assert!(refusal.contains(says), "{text}: {refusal}");
        }
    }
}
