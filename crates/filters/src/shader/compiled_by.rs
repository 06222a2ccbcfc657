//! Compilers of one shader, tried one after the other.

use std::fmt;

use crate::FilterError;

/// Compiler that made a shader, and those that failed before it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct CompiledBy {
    program: &'static str,
    failed: Vec<Failure>,
}

/// Compiler that failed, and its error.
#[derive(Clone, Debug, PartialEq)]
struct Failure {
    program: &'static str,
    error: FilterError,
}

/// Tries compilers, each with its program, until one makes what is wanted.
pub(crate) fn try_each<C, T>(
    compilers: impl Iterator<Item = (&'static str, C)>,
    attempt: impl Fn(C) -> Result<T, FilterError>,
) -> Result<(T, CompiledBy), FilterError> {
    let mut failed = Vec::new();
    for (program, compiler) in compilers {
        match attempt(compiler) {
            Ok(made) => return Ok((made, CompiledBy { program, failed })),
            Err(FilterError::Interrupted) => return Err(FilterError::Interrupted),
            Err(error) => failed.push(Failure { program, error }),
        }
    }
    Err(join(failed))
}

/// Joins the errors of all compilers to one at the place of the first; an error that all share
/// appears once.
fn join(mut failed: Vec<Failure>) -> FilterError {
    failed.dedup_by(|a, b| a.error == b.error);
    let reasons: Vec<String> = failed.iter().map(Failure::reason).collect();
    let mut error = (failed.into_iter().next().expect("a compiler was tried")).error;
    if let (2.., FilterError::Folder(fault)) = (reasons.len(), &mut error) {
        fault.reason = reasons.join("\n");
    }
    error
}

impl Failure {
    /// Names the compiler, and says why it failed.
    fn reason(&self) -> String {
        match &self.error {
            FilterError::Folder(fault) if fault.reason.starts_with(self.program) => {
                fault.reason.clone()
            }
            FilterError::Folder(fault) => format!("{}: {}", self.program, fault.reason),
            error => format!("{}: {error}", self.program),
        }
    }
}

impl fmt::Display for CompiledBy {
    /// Writes `glslangValidator; slangc refuses it: error: ..`, with the first line of each error.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.program)?;
        let mut reasons = self.failed.iter().map(Failure::reason);
        reasons.try_for_each(|reason| write!(f, "; {}", reason.lines().next().unwrap_or_default()))
    }
}
