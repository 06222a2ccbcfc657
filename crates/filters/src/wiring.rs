//! Agreement of `filter.toml` with its kernels.

use std::collections::BTreeSet;
use std::path::PathBuf;

use crate::filter::{Filter, Pass};
use crate::gpu::{EntryPoint, Role, Texel, written};
use crate::manifest::Lines;
use crate::{FilterError, Format};

/// Refuses a filter whose declarations and kernels differ: parameters, textures, entry points, and the order in which
/// passes read and write.
pub(crate) fn check(filter: &Filter) -> Result<(), FilterError> {
    let lines = &filter.lines;
    let check = Check { filter, lines };
    check.parameters()?;
    check.variables()?;
    check.passes()
}

/// Per pass: whether what it writes depends on the colour image, by itself or through other passes.
pub(crate) fn color_dependent(filter: &Filter) -> Vec<bool> {
    dependent(filter, BTreeSet::from(["color", "output"]), |_| false)
}

/// Per pass: whether what it writes depends on the frame's index, by itself or through other passes.
pub(crate) fn noise_dependent(filter: &Filter) -> Vec<bool> {
    dependent(filter, BTreeSet::new(), |entry| entry.draws_noise)
}

/// Per pass: whether it touches a tainted texture, or one that such a pass writes, or is a source itself.
fn dependent<'f>(
    filter: &'f Filter,
    mut tainted: BTreeSet<&'f str>,
    is_source: fn(&EntryPoint) -> bool,
) -> Vec<bool> {
    loop {
        let known = tainted.len();
        let dependent = filter
            .passes
            .iter()
            .map(|pass| {
                let entry = filter.entry_point(pass);
                let EntryPoint { reads, writes, .. } = entry;
                let mut touched = reads.iter().chain(writes);
                let dependent =
                    is_source(entry) || touched.any(|texture| tainted.contains(&texture[..]));
                if dependent {
                    tainted.extend(writes.iter().map(String::as_str));
                }
                dependent
            })
            .collect();
        if tainted.len() == known {
            return dependent;
        }
    }
}

struct Check<'a> {
    filter: &'a Filter,
    lines: &'a Lines,
}

impl Check<'_> {
    fn parameters(&self) -> Result<(), FilterError> {
        let parameters = &self.filter.parameters;
        let uniforms = &self.filter.shader.uniforms;
        let members = uniforms.get("parameters").map_or(&[][..], Vec::as_slice);
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
            (Role::Read(Texel::Float), "color" | "velocity" | "depth") => Ok(()),
            (Role::Read(Texel::Uint), "color" | "velocity" | "depth") => {
                Err("holds floats: texture_2d<f32>".into())
            }
            (Role::Read(found), name) => match declared(name) {
                Some(texture) if Texel::of(texture.format) == found => Ok(()),
                Some(texture) => Err(format!(
                    "does not fit the declared format {:?}: r32uint is read as texture_2d<u32>, every other as \
                     texture_2d<f32>",
                    texture.format
                )),
                None => Err(self.undeclared()),
            },
            (Role::Write(Format::Rgba32Float), "output") => Ok(()),
            (Role::Write(_), "output") => {
                Err("has another format than the image: rgba32float".into())
            }
            (Role::Write(found), name) if name != written(name) => match declared(written(name)) {
                Some(texture) if texture.format == found => Ok(()),
                Some(texture) => Err(format!(
                    "has format {found:?}; texture \"{}\" is declared as {:?}",
                    texture.name, texture.format
                )),
                None => Err(self.undeclared()),
            },
            _ => Err(self.undeclared()),
        }
    }

    fn undeclared(&self) -> String {
        let textures = &self.filter.textures;
        let names: Vec<&str> = textures.iter().map(|texture| &texture.name[..]).collect();
        format!(
            "is unknown; uniforms: parameters, frame; read: color, velocity, depth or a [[texture]] by its \
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
            if let Some(name) = entry.reads.iter().find(|name| !ready.contains(&name[..])) {
                return Err(refuse(format!(
                    "reads \"{name}\" before any pass has written it"
                )));
            }
            if entry.writes.is_empty() {
                return Err(refuse("writes nothing".into()));
            }
            used.extend(entry.reads.iter().chain(&entry.writes));
            ready.extend(entry.writes.iter().map(String::as_str));
        }
        if !ready.contains("output") {
            let reason = "no pass writes \"output\"".into();
            return Err(self.manifest(self.lines.passes.first().copied().unwrap_or(1), reason));
        }
        for (texture, line) in self.filter.textures.iter().zip(&self.lines.textures) {
            if !used.contains(&texture.name) {
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
