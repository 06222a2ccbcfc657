//! Agreement of `filter.toml` with its kernels.

use std::collections::BTreeSet;
use std::path::PathBuf;

use crate::filter::{INPUTS, Lines, PassShader};
use crate::shader::{EntryPoint, Role, Shader, Texel, written_texture};
use crate::{Filter, FilterError, Format, Pass, Repeat, Stage};

/// Refuses a filter whose declarations and kernels differ: parameters, textures, entry points, and the order in which
/// passes read and write.
pub(super) fn check_agreement(filter: &Filter) -> Result<(), FilterError> {
    let lines = &filter.lines;
    let check = Check { filter, lines };
    check.check_parameters()?;
    check.check_variables()?;
    check.check_passes()
}

/// Filter, and the lines of its declarations.
struct Check<'a> {
    filter: &'a Filter,
    lines: &'a Lines,
}

impl Check<'_> {
    fn check_parameters(&self) -> Result<(), FilterError> {
        let parameters = &self.filter.parameters;
        let Some(kernels) = self.kernels() else {
            return self.check_parameters_are_used();
        };
        let uniforms = &kernels.uniforms;
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
                        self.kernel_path().display(),
                        parameter.name,
                        parameter.kind.wgsl_type(),
                    );
                    return Err(self.refuse_manifest(self.lines.parameters[index], reason));
                }
                (None, None) => unreachable!("the loop ends at the longer list"),
            };
            let line = members.get(index).map(|member| member.line);
            return Err(self.refuse_kernel(line, reason));
        }
        Ok(())
    }

    /// Refuses a parameter that changes nothing, where shaders take only the parameters that they want.
    fn check_parameters_are_used(&self) -> Result<(), FilterError> {
        let Filter {
            shaders,
            passes,
            textures,
            ..
        } = self.filter;
        let is_used = |name: &str| {
            let mut blocks = shaders.iter().flat_map(|shader| &shader.blocks);
            let mut repeats = passes.iter().map(|pass| &pass.repeat);
            let mut divisors =
                (textures.iter()).flat_map(|texture| texture.divided_by.iter().flatten());
            blocks.any(|block| block.reads(name))
                || repeats.any(|repeat| matches!(repeat, Repeat::Parameter(known) if known == name))
                || divisors.any(|divisor| divisor.reads(name))
                || (passes.iter().filter_map(|pass| pass.shader.as_ref()))
                    .flat_map(PassShader::list_expressions)
                    .any(|expression| expression.reads(name))
        };
        let parameters = self.filter.parameters.iter().zip(&self.lines.parameters);
        match parameters.into_iter().find(|(parameter, _)| !is_used(&parameter.name)) {
            None => Ok(()),
            Some((unused, line)) => Err(self.refuse_manifest(
                *line,
                format!(
                    "parameter \"{}\" changes nothing: no member of a uniform block, `constants`, `repeat`, `level` or \
                     `divided_by` has it; name it in the `values` of a [[pass.binding]], or remove it",
                    unused.name
                ),
            )),
        }
    }

    fn check_variables(&self) -> Result<(), FilterError> {
        let kernels = self.kernels();
        for variable in kernels.iter().flat_map(|kernels| &kernels.variables) {
            self.check_variable(&variable.name, variable.role)
                .map_err(|reason| {
                    self.refuse_kernel(variable.line, format!("\"{}\" {reason}", variable.name))
                })?;
        }
        Ok(())
    }

    fn check_variable(&self, name: &str, role: Role) -> Result<(), String> {
        let declared = |name: &str| {
            let mut textures = self.filter.textures.iter();
            textures.find(|texture| texture.name == name)
        };
        match (role, name) {
            (Role::Uniform, "parameters" | "frame") => Ok(()),
            (Role::Read(Texel::Float), "color" | "velocity" | "depth") => Ok(()),
            (Role::Read(Texel::Float), name) if self.is_history(name) => Ok(()),
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
                None => Err(self.refuse_undeclared()),
            },
            (Role::Write(Format::Rgba32Float | Format::Rgba16Float), "output") => Ok(()),
            (Role::Write(_), "output") => {
                Err("has another format than the image: rgba32float or rgba16float".into())
            }
            (Role::Write(found), name) if name != written_texture(name) => {
                match declared(written_texture(name)) {
                    Some(texture) if texture.format == found => Ok(()),
                    Some(texture) => Err(format!(
                        "has format {found:?}; texture \"{}\" is declared as {:?}",
                        texture.name, texture.format
                    )),
                    None => Err(self.refuse_undeclared()),
                }
            }
            _ => Err(self.refuse_undeclared()),
        }
    }

    /// Tells whether a name is that of a declared input of the frame before.
    fn is_history(&self, name: &str) -> bool {
        let mut history = self.filter.history.iter();
        history.any(|history| history.texture() == name)
    }

    fn refuse_undeclared(&self) -> String {
        let textures = &self.filter.textures;
        let names: Vec<&str> = textures.iter().map(|texture| &texture.name[..]).collect();
        format!(
            "is no known input or output; uniforms: parameters, frame; read: color, velocity, depth, those of the frame before \
             as color_before and so on if `history` names them, or a [[texture]] by its name; written: output or a [[texture]] as <name>_out; textures of {}: {}",
            self.lines.path.display(),
            if names.is_empty() {
                "none".to_owned()
            } else {
                names.join(", ")
            }
        )
    }

    fn check_passes(&self) -> Result<(), FilterError> {
        let before = self.filter.history.iter().map(|history| history.texture());
        let mut ready: BTreeSet<&str> = INPUTS.into_iter().chain(before).collect();
        let mut used = BTreeSet::new();
        for (pass, line) in self.filter.passes.iter().zip(&self.lines.passes) {
            let refuse = |reason: String| {
                self.refuse_manifest(*line, format!("pass \"{}\": {reason}", pass.entry))
            };
            let entry = self.find_entry_point(pass).map_err(refuse)?;
            if let Some(shader) = &pass.shader {
                check_targets(self.filter, shader, entry).map_err(refuse)?;
            }
            if let Some(vertex) = self.filter.vertex_entry(pass) {
                check_vertex(vertex, entry).map_err(refuse)?;
            }
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
            return Err(
                self.refuse_manifest(self.lines.passes.first().copied().unwrap_or(1), reason)
            );
        }
        for (texture, line) in self.filter.textures.iter().zip(&self.lines.textures) {
            if !used.contains(&texture.name) {
                let reason = format!("texture \"{}\" is used by no pass", texture.name);
                return Err(self.refuse_manifest(*line, reason));
            }
        }
        Ok(())
    }

    fn find_entry_point(&self, pass: &Pass) -> Result<&EntryPoint, String> {
        let shader = self.filter.shader(pass);
        shader.entry_point(pass.kernel()).ok_or_else(|| {
            let names: Vec<&str> = shader.entry_points.iter().map(|e| &e.name[..]).collect();
            format!(
                "{} has no such @compute entry point; it has: {}",
                self.kernel_path().display(),
                names.join(", ")
            )
        })
    }

    /// Returns the kernels of the filter's WGSL file, which are bound by name.
    fn kernels(&self) -> Option<&Shader> {
        let pass = self.filter.passes.iter().find(|pass| pass.shader.is_none());
        pass.map(|pass| self.filter.shader(pass))
    }

    fn kernel_path(&self) -> PathBuf {
        let file = format!("{}.wgsl", self.filter.name);
        self.lines.path.with_file_name(file)
    }

    fn refuse_kernel(&self, line: Option<usize>, reason: String) -> FilterError {
        FilterError::Folder {
            path: self.kernel_path(),
            line,
            reason,
        }
    }

    fn refuse_manifest(&self, line: usize, reason: String) -> FilterError {
        FilterError::Folder {
            path: self.lines.path.clone(),
            line: Some(line),
            reason,
        }
    }
}

/// Refuses a fragment shader whose colours are not the render targets that filter.toml names.
fn check_targets(filter: &Filter, shader: &PassShader, entry: &EntryPoint) -> Result<(), String> {
    if shader.stage == Stage::Compute {
        return Ok(());
    }
    let targets = &shader.targets;
    let wanted: Vec<u32> = (0..targets.len() as u32).collect();
    if entry.locations != wanted {
        return Err(format!(
            "the fragment shader writes colours to locations {:?}; filter.toml has {} in `targets`; allowed: one target for \
             each location, from 0",
            entry.locations,
            targets.join(", ")
        ));
    }
    let size = |name: &String| {
        let texture = filter.textures.iter().find(|texture| texture.name == *name);
        texture.and_then(|texture| texture.divided_by.clone())
    };
    if let Some(other) = targets.iter().find(|name| size(name) != size(&targets[0])) {
        return Err(format!(
            "targets \"{}\" and \"{other}\" have different sizes; allowed: targets of one size",
            targets[0]
        ));
    }
    let has_mips = |name: &String| {
        let texture = filter.textures.iter().find(|texture| texture.name == *name);
        texture.is_some_and(|texture| texture.mips > 1)
    };
    match targets
        .iter()
        .find(|name| shader.level.is_some() && !has_mips(name))
    {
        Some(plain) => Err(format!(
            "level: target \"{plain}\" has no mip levels; give its [[texture]] `mips`, or leave `level` out"
        )),
        None => Ok(()),
    }
}

/// Refuses a vertex stage that wants vertices, or that leaves out what the fragment shader reads.
fn check_vertex(vertex: &EntryPoint, fragment: &EntryPoint) -> Result<(), String> {
    if !vertex.inputs.is_empty() {
        return Err(format!(
            "vertex shader \"{}\" reads attributes at locations {:?}; there are no vertex buffers; allowed: one that makes \
             its three corners from the index of the vertex; or leave `vertex` out for a triangle of the program's own",
            vertex.name, vertex.inputs
        ));
    }
    match fragment
        .inputs
        .iter()
        .find(|location| !vertex.locations.contains(location))
    {
        Some(missing) => Err(format!(
            "the fragment shader reads location {missing}; vertex shader \"{}\" writes locations {:?}; allowed: one that \
             writes all that the other reads",
            vertex.name, vertex.locations
        )),
        None => Ok(()),
    }
}
