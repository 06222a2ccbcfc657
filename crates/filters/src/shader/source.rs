//! Text of a kernel file, and errors that name its lines.

use std::path::Path;

use wgpu::naga::{GlobalVariable, Handle, Module, SourceLocation};

use crate::FilterError;

/// Kernels of a filter with common.wgsl appended.
pub(super) struct Source<'a> {
    /// The filter's file.
    pub path: &'a Path,
    /// Both texts.
    pub text: String,
    kernel_lines: usize,
}

impl<'a> Source<'a> {
    /// Appends `common` to the kernels, so that line numbers of the kernels stay valid.
    pub fn new(path: &'a Path, kernels: &str, common: &str) -> Self {
        Self {
            path,
            kernel_lines: kernels.trim_end().lines().count(),
            text: format!("{}\n{common}", kernels.trim_end()),
        }
    }

    /// Returns the name of the filter's file.
    pub fn name(&self) -> &str {
        let name = self.path.file_name().and_then(|name| name.to_str());
        name.expect("the WGSL file is named after the filter")
    }

    /// Makes an error of a message of naga.
    pub fn refuse(&self, place: Option<SourceLocation>, message: &str) -> FilterError {
        let line = place.map(|place| place.line_number as usize);
        let mut error = self.at(line, tidy(message));
        if let FilterError::Folder {
            line: Some(_),
            column,
            ..
        } = &mut error
        {
            *column = place.map(|place| place.line_position as usize);
        }
        error
    }

    /// Makes an error that names a line.
    pub fn at(&self, line: Option<usize>, reason: String) -> FilterError {
        let (line, reason) = match line {
            Some(line) if line > self.kernel_lines => (
                None,
                format!(
                    "does not go together with common.wgsl, line {}: {reason}",
                    line - self.kernel_lines
                ),
            ),
            line => (line, reason),
        };
        FilterError::in_file(self.path, line, reason)
    }

    /// Refuses `override`, which nothing sets and which leaves sizes unknown.
    pub fn refuse_overrides(&self, module: &Module) -> Result<(), FilterError> {
        let Some((handle, constant)) = module.overrides.iter().next() else {
            return Ok(());
        };
        let line = module.overrides.get_span(handle).location(&self.text);
        let name = constant.name.as_deref().unwrap_or_default();
        Err(self.at(
            Some(line.line_number as usize),
            format!("override \"{name}\" is set by nobody; allowed: const, or a [[parameter]]"),
        ))
    }

    /// Finds the line in which a function begins.
    pub fn line_of_function(&self, name: &str) -> Option<usize> {
        let begins = |line: &str| {
            let mut after = line.split("fn ").skip(1).map(str::trim_start);
            after.any(|after| {
                let rest = after.strip_prefix(name);
                rest.is_some_and(|rest| rest.trim_start().starts_with('('))
            })
        };
        let line = self.text.lines().position(begins)?;
        Some(line + 1)
    }

    /// Finds the line of a variable.
    pub fn line(&self, module: &Module, handle: Handle<GlobalVariable>) -> usize {
        let span = module.global_variables.get_span(handle);
        span.location(&self.text).line_number as usize
    }
}

/// Removes the word "error" before a message of naga, and blanks at the ends of its lines.
pub(crate) fn tidy(message: &str) -> String {
    let message = message.strip_prefix("error: ").unwrap_or(message);
    let lines = message.trim_end().lines().map(str::trim_end);
    lines.collect::<Vec<_>>().join("\n").replace('\t', " ")
}
