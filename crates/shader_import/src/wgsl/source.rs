//! Text of WGSL, and errors that name its lines.

use std::path::Path;

use naga::valid::{ModuleInfo, ValidationFlags, Validator};
use naga::{GlobalVariable, Handle, Module, SourceLocation, front};

use super::nesting::check_nesting;
use crate::fault::FileFault;
use crate::naga_error::tidy;
use crate::validation::CAPABILITIES;

/// Kernels of a file, with common.wgsl appended if they use it.
pub struct WgslText<'a> {
    /// The file.
    path: &'a Path,
    kernels: &'a str,
    /// Kernels, then common.wgsl.
    text: String,
}

impl<'a> WgslText<'a> {
    /// Appends `common` to the kernels, so that line numbers of the kernels stay valid.
    pub fn new(path: &'a Path, kernels: &'a str, common: &str) -> Self {
        Self {
            path,
            kernels,
            text: format!("{}\n{common}", kernels.trim_end()),
        }
    }

    /// Parses the text. Refuses text that is nested too deeply before naga sees it.
    ///
    /// # Errors
    /// The first line that naga refuses.
    pub fn parse(&self) -> Result<Module, FileFault> {
        check_nesting(self.path, self.kernels)?;
        let options = front::wgsl::Options {
            capabilities: CAPABILITIES,
            ..front::wgsl::Options::new()
        };
        let mut parser = front::wgsl::Frontend::new_with_options(options);
        parser.parse(&self.text).map_err(|error| {
            let message = error.emit_to_string_with_path(&self.text, self.name());
            self.refuse(error.location(&self.text), &message)
        })
    }

    /// Validates the module that was parsed.
    ///
    /// # Errors
    /// The first line that naga refuses.
    pub fn validate(&self, module: &Module) -> Result<ModuleInfo, FileFault> {
        let mut validator = Validator::new(ValidationFlags::all(), CAPABILITIES);
        validator.validate(module).map_err(|error| {
            let message = error.emit_to_string_with_path(&self.text, self.name());
            self.refuse(error.location(&self.text), &message)
        })
    }

    /// Returns the name of the file.
    fn name(&self) -> &str {
        let name = self.path.file_name().and_then(|name| name.to_str());
        name.expect("the WGSL file is named after the filter")
    }

    /// Makes a fault of a message of naga.
    fn refuse(&self, place: Option<SourceLocation>, message: &str) -> FileFault {
        let line = place.map(|place| place.line_number as usize);
        let mut fault = self.fault(line, tidy(message));
        if fault.line.is_some() {
            fault.column = place.map(|place| place.line_position as usize);
        }
        fault
    }

    /// Makes a fault that names a line of the text.
    pub fn fault(&self, line: Option<usize>, reason: String) -> FileFault {
        let kernel_lines = self.kernels.trim_end().lines().count();
        let (line, reason) = match line {
            Some(line) if line > kernel_lines => (
                None,
                format!(
                    "does not go together with common.wgsl, line {}: {reason}",
                    line - kernel_lines
                ),
            ),
            line => (line, reason),
        };
        FileFault::new(self.path, line, reason)
    }

    /// Refuses `override`, which nothing sets and which leaves sizes unknown.
    ///
    /// # Errors
    /// The first `override`.
    pub fn refuse_overrides(&self, module: &Module) -> Result<(), FileFault> {
        let Some((handle, constant)) = module.overrides.iter().next() else {
            return Ok(());
        };
        let line = module.overrides.get_span(handle).location(&self.text);
        let name = constant.name.as_deref().unwrap_or_default();
        Err(self.fault(
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
