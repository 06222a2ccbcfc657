//! Whether `filter.toml` and the kernels say the same.

use std::collections::BTreeSet;
use std::path::PathBuf;

use crate::filter::{Filter, Pass};
use crate::gpu::{EntryPoint, Role};
use crate::manifest::Lines;
use crate::{FilterError, Format};

/// Refuses a filter whose declarations and kernels differ: parameters, textures, entry points, and the order in which
/// passes read and write.
pub(crate) fn check(filter: &Filter, lines: &Lines) -> Result<(), FilterError> {
    let check = Check { filter, lines };
    check.parameters()?;
    check.variables()?;
    check.passes()
}

/// The texture that a variable of that name writes; `None` where the name is not one that writes.
pub(crate) fn written(variable: &str) -> Option<&str> {
    variable.strip_suffix("_out")
}

struct Check<'a> {
    filter: &'a Filter,
    lines: &'a Lines,
}

impl Check<'_> {
    fn parameters(&self) -> Result<(), FilterError> {
        let parameters = &self.filter.parameters;
        let members = &self.filter.shader.members;
        for index in 0..parameters.len().max(members.len()) {
            let reason = match (parameters.get(index), members.get(index)) {
                (Some(parameter), Some(member)) => {
                    let wanted = (&parameter.name[..], parameter.kind.wgsl_type(), 4 * index);
                    let found = (
                        &member.name[..],
                        &member.wgsl_type[..],
                        member.offset as usize,
                    );
                    if wanted == found {
                        continue;
                    }
                    format!(
                        "member {} of the uniform parameters is {}: {} at byte {}; {}:{} declares {}: {} at byte {} there",
                        index + 1,
                        found.0,
                        found.1,
                        found.2,
                        self.lines.path.display(),
                        self.lines.parameters[index],
                        wanted.0,
                        wanted.1,
                        wanted.2,
                    )
                }
                (None, Some(member)) => format!(
                    "the uniform parameters has a member \"{}\" that {} does not declare; add a [[parameter]] in the \
                     same order",
                    member.name,
                    self.lines.path.display(),
                ),
                (Some(parameter), None) => {
                    let reason = format!(
                        "parameter \"{}\" is not a member of the uniform parameters in {}; add `{}: {},` to its struct",
                        parameter.name,
                        self.kernels().display(),
                        parameter.name,
                        parameter.kind.wgsl_type(),
                    );
                    return Err(self.manifest(self.lines.parameters[index], reason));
                }
                (None, None) => unreachable!("the loop ends at the longer list"),
            };
            let line = members.get(index).map(|member| member.line);
            return Err(self.kernel(line, reason));
        }
        Ok(())
    }

    fn variables(&self) -> Result<(), FilterError> {
        for variable in &self.filter.shader.variables {
            self.variable(&variable.name, variable.role)
                .map_err(|reason| {
                    self.kernel(
                        Some(variable.line),
                        format!("\"{}\" {reason}", variable.name),
                    )
                })?;
        }
        Ok(())
    }

    fn variable(&self, name: &str, role: Role) -> Result<(), String> {
        let declared = |name: &str| {
            let mut textures = self.filter.textures.iter();
            textures.find(|texture| texture.name == name)
        };
        match (role, name) {
            (Role::Uniform, "parameters" | "frame") => Ok(()),
            (Role::Read, "color" | "velocity" | "depth") => Ok(()),
            (Role::Read, name) if declared(name).is_some() => Ok(()),
            (Role::Write(Format::Rgba32Float), "output") => Ok(()),
            (Role::Write(_), "output") => {
                Err("has another format than the image: rgba32float".into())
            }
            (Role::Write(found), name) => match written(name).and_then(declared) {
                Some(texture) if texture.format == found => Ok(()),
                Some(texture) => Err(format!(
                    "has format {found:?}; texture \"{}\" is declared as {:?}",
                    texture.name, texture.format
                )),
                None => Err(self.undeclared()),
            },
            (Role::Uniform | Role::Read, _) => Err(self.undeclared()),
        }
    }

    fn undeclared(&self) -> String {
        let textures = &self.filter.textures;
        let names: Vec<&str> = textures.iter().map(|texture| &texture.name[..]).collect();
        format!(
            "is declared by no one; uniforms: parameters, frame; read: color, velocity, depth or a [[texture]] by its \
             name; written: output or a [[texture]] as <name>_out; textures of {}: {}",
            self.lines.path.display(),
            if names.is_empty() {
                "none".to_owned()
            } else {
                names.join(", ")
            }
        )
    }

    fn passes(&self) -> Result<(), FilterError> {
        let mut ready = BTreeSet::from(["color", "velocity", "depth"]);
        let mut used = BTreeSet::new();
        for (pass, line) in self.filter.passes.iter().zip(&self.lines.passes) {
            let refuse =
                |reason: String| self.manifest(*line, format!("pass \"{}\": {reason}", pass.entry));
            let entry = self.entry_point(pass).map_err(refuse)?;
            let (mut reads, mut writes) = (BTreeSet::new(), BTreeSet::new());
            for variable in entry
                .variables
                .iter()
                .map(|v| &self.filter.shader.variables[*v])
            {
                match variable.role {
                    Role::Uniform => {}
                    Role::Read => _ = reads.insert(&variable.name[..]),
                    Role::Write(_) => {
                        _ = writes.insert(written(&variable.name).unwrap_or(&variable.name));
                    }
                }
            }
            if let Some(name) = reads.difference(&ready).next() {
                return Err(refuse(format!(
                    "reads \"{name}\" before any pass has written it"
                )));
            }
            if writes.is_empty() {
                return Err(refuse("writes nothing".into()));
            }
            used.extend(reads);
            used.extend(&writes);
            ready.extend(&writes);
        }
        if !ready.contains("output") {
            let reason = "no pass writes \"output\"".into();
            return Err(self.manifest(self.lines.passes.first().copied().unwrap_or(1), reason));
        }
        for (texture, line) in self.filter.textures.iter().zip(&self.lines.textures) {
            if !used.contains(&texture.name[..]) {
                let reason = format!("texture \"{}\" is used by no pass", texture.name);
                return Err(self.manifest(*line, reason));
            }
        }
        Ok(())
    }

    fn entry_point(&self, pass: &Pass) -> Result<&EntryPoint, String> {
        let shader = &self.filter.shader;
        shader.entry_point(&pass.entry).ok_or_else(|| {
            let names: Vec<&str> = shader.entry_points.iter().map(|e| &e.name[..]).collect();
            format!(
                "{} has no such @compute entry point; it has: {}",
                self.kernels().display(),
                names.join(", ")
            )
        })
    }

    fn kernels(&self) -> PathBuf {
        let file = format!("{}.wgsl", self.filter.name);
        self.lines.path.with_file_name(file)
    }

    fn kernel(&self, line: Option<usize>, reason: String) -> FilterError {
        FilterError::Folder {
            path: self.kernels(),
            line,
            reason,
        }
    }

    fn manifest(&self, line: usize, reason: String) -> FilterError {
        FilterError::Folder {
            path: self.lines.path.clone(),
            line: Some(line),
            reason,
        }
    }
}
