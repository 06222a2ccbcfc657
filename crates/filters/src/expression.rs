//! Arithmetic on values of the frame, of the convention and on parameters.

/// An expression: numbers, names, `+ - * / ^`, brackets, `floor(..)`, `ceil(..)`, `min(.., ..)` and `max(.., ..)`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Expression {
    /// A number.
    Number(f64),
    /// A parameter or a value of the frame.
    Name(String),
    /// The value of a function or an operator.
    Apply(Function, Vec<Expression>),
}

/// Function or operator of an expression.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Function {
    /// The first argument with the other sign.
    Negative,
    /// The largest whole number that is not larger.
    Floor,
    /// The smallest whole number that is not smaller.
    Ceil,
    /// The smaller of two.
    Min,
    /// The larger of two.
    Max,
    /// One of `+ - * / ^`.
    Operator(char),
}

/// Functions by name, with the number of their arguments.
const FUNCTIONS: [(&str, Function, usize); 4] = [
    ("floor", Function::Floor, 1),
    ("ceil", Function::Ceil, 1),
    ("min", Function::Min, 2),
    ("max", Function::Max, 2),
];

/// Upper limit on the characters of an expression, which limits its depth as well.
const MAX_CHARACTERS: usize = 200;

impl Expression {
    /// Parses an expression; `is_known` knows which names there are.
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
        let expression = parser.sum()?;
        match parser.rest.trim_start() {
            "" => Ok(expression),
            rest => Err(format!(
                "goes on with \"{rest}\" where an operator is expected"
            )),
        }
    }

    /// Computes the value.
    pub fn evaluate(&self, value: &dyn Fn(&str) -> f64) -> f64 {
        match self {
            Self::Number(number) => *number,
            Self::Name(name) => value(name),
            Self::Apply(function, arguments) => {
                let argument = |index: usize| arguments[index].evaluate(value);
                match function {
                    Function::Negative => -argument(0),
                    Function::Floor => argument(0).floor(),
                    Function::Ceil => argument(0).ceil(),
                    Function::Min => argument(0).min(argument(1)),
                    Function::Max => argument(0).max(argument(1)),
                    Function::Operator('+') => argument(0) + argument(1),
                    Function::Operator('-') => argument(0) - argument(1),
                    Function::Operator('*') => argument(0) * argument(1),
                    Function::Operator('/') => argument(0) / argument(1),
                    Function::Operator(_) => argument(0).powf(argument(1)),
                }
            }
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
            Self::Apply(_, arguments) => arguments.iter().any(|it| it.reads_any(is_wanted)),
        }
    }
}

struct Parser<'t> {
    rest: &'t str,
    is_known: &'t dyn Fn(&str) -> bool,
}

impl Parser<'_> {
    fn sum(&mut self) -> Result<Expression, String> {
        let mut left = self.product()?;
        while let Some(operator) = self.take(&['+', '-']) {
            left = Expression::Apply(Function::Operator(operator), vec![left, self.product()?]);
        }
        Ok(left)
    }

    fn product(&mut self) -> Result<Expression, String> {
        let mut left = self.power()?;
        while let Some(operator) = self.take(&['*', '/']) {
            left = Expression::Apply(Function::Operator(operator), vec![left, self.power()?]);
        }
        Ok(left)
    }

    fn power(&mut self) -> Result<Expression, String> {
        if self.take(&['-']).is_some() {
            return Ok(Expression::Apply(Function::Negative, vec![self.power()?]));
        }
        let base = self.atom()?;
        match self.take(&['^']) {
            None => Ok(base),
            Some(operator) => {
                let operator = Function::Operator(operator);
                Ok(Expression::Apply(operator, vec![base, self.power()?]))
            }
        }
    }

    fn atom(&mut self) -> Result<Expression, String> {
        if self.take(&['(']).is_some() {
            let inner = self.sum()?;
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
            return Err("has an operator without a value beside it".into());
        }
        if word.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
            let number = word.parse::<f64>();
            return (number.map(Expression::Number))
                .map_err(|_| format!("\"{word}\" is no number"));
        }
        let function = FUNCTIONS.iter().find(|(name, ..)| *name == word);
        if let Some((_, function, count)) = function
            && self.take(&['(']).is_some()
        {
            let mut arguments = vec![self.sum()?];
            while self.take(&[',']).is_some() {
                arguments.push(self.sum()?);
            }
            self.close()?;
            return match arguments.len() == *count {
                true => Ok(Expression::Apply(*function, arguments)),
                false => Err(format!(
                    "has {word} of {} values; allowed: {count}",
                    arguments.len()
                )),
            };
        }
        match (self.is_known)(word) {
            true => Ok(Expression::Name(word.to_owned())),
            false => Err(format!("holds the unknown name \"{word}\"")),
        }
    }

    fn close(&mut self) -> Result<(), String> {
        let end = self.take(&[')']);
        end.map(|_| ())
            .ok_or("has a bracket without the other".into())
    }

    /// Takes one of the characters if it is next.
    fn take(&mut self, wanted: &[char]) -> Option<char> {
        let rest = self.rest.trim_start();
        let first = rest.chars().next().filter(|first| wanted.contains(first))?;
        self.rest = &rest[first.len_utf8()..];
        Some(first)
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
            ("floor(width / 20)", 4.0),
            ("ceil(width / 80) * 8", 16.0),
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
            ("1 +", "without a value"),
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
