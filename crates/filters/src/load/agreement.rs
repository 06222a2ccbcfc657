//! Agreement of `filter.toml` with its kernels.

use std::collections::BTreeSet;
use std::path::PathBuf;

use super::stages::{check_coordinates, check_targets, check_vertex};
use crate::bind::check_texture;
use crate::filter::{Layer, PassShader};
use crate::shader::{BlockNumber, EntryPoint, Role, Shader, Variable, written_texture};
use crate::{Count, Expression, Filter, FilterError, Pass};

impl Filter {
    /// Refuses a filter whose declarations and kernels differ: parameters, textures, entry points,
    /// and the order in which passes read and write.
    pub(super) fn check_agreement(&self) -> Result<(), FilterError> {
        // The kernels of the filter's WGSL file are bound by name.
        match self.passes.iter().find(|pass| pass.shader.is_none()) {
            Some(pass) => self.check_kernels(self.shader(pass))?,
            None => self.check_parameters_are_used()?,
        }
        self.check_switches_of_camera()?;
        self.check_passes()
    }

    /// Checks the variables of the WGSL file, which are bound by name, and the uniform of
    /// parameters.
    fn check_kernels(&self, kernels: &Shader) -> Result<(), FilterError> {
        let mut uniforms = kernels
            .variables
            .iter()
            .filter_map(|variable| match variable.role {
                Role::Block(block) => Some((variable, &kernels.blocks[block])),
                _ => None,
            });
        let uniform = uniforms.find(|(variable, _)| variable.name == "parameters");
        let members = uniform.map_or(&[][..], |(_, block)| &block.numbers);
        let line = uniform.and_then(|(variable, _)| variable.line);
        self.check_members(members, line)?;
        for variable in &kernels.variables {
            self.check_variable(variable).map_err(|reason| {
                self.refuse_kernel(variable.line, format!("\"{}\" {reason}", variable.name))
            })?;
        }
        Ok(())
    }

    /// Compares the parameters with the numbers of their uniform: names, types and offsets. `line`
    /// is the uniform's.
    fn check_members(
        &self,
        members: &[BlockNumber],
        line: Option<usize>,
    ) -> Result<(), FilterError> {
        let name = |member: &BlockNumber| match &member.value {
            Expression::Name(name) => name.clone(),
            _ => unreachable!("numbers of a kernel are named after members"),
        };
        let manifest = self.lines.path.display();
        let parameters = &self.parameters;
        for (index, parameter) in parameters.iter().enumerate() {
            let declared = self.lines.parameters[index];
            let wanted = (
                parameter.name.clone(),
                parameter.kind.wgsl_type(),
                4 * index,
            );
            let Some(member) = members.get(index) else {
                let reason = format!(
                    "parameter \"{0}\" is not a member of the uniform parameters in {1}; add `{0}: {2},` to its struct",
                    wanted.0,
                    self.kernel_path().display(),
                    wanted.1,
                );
                return Err(self.refuse_manifest(declared, reason));
            };
            let uniform_member = (name(member), member.kind, member.offset as usize);
            if wanted != uniform_member {
                let (found_name, found_type, found_byte) = uniform_member;
                let (name, kind, byte) = wanted;
                let place = format!(
                    "`parameters` member {} is `{found_name}: {found_type}`",
                    index + 1
                );
                let reason = if (found_name, found_type) == (name.clone(), kind) {
                    format!(
                        "{place} at byte {found_byte}, but byte {byte} is expected: leave out @align and @size"
                    )
                } else {
                    format!("{place}, but {manifest}:{declared} declares `{name}: {kind}`")
                };
                return Err(self.refuse_kernel(line, reason));
            }
        }
        match members.get(parameters.len()) {
            None => Ok(()),
            Some(member) => {
                let reason = format!(
                    "the uniform parameters has a member \"{}\" that {manifest} does not declare; add a [[parameter]] in \
                     the same order",
                    name(member)
                );
                Err(self.refuse_kernel(line, reason))
            }
        }
    }

    /// Refuses a switch of the camera's motion if no kernel reads that motion.
    fn check_switches_of_camera(&self) -> Result<(), FilterError> {
        let reads = self.shaders.iter().any(|shader| shader.reads_reprojection);
        let parameters = self.parameters.iter().zip(&self.lines.parameters);
        let mut switches = parameters.filter(|(parameter, _)| parameter.no_camera_at.is_some());
        match switches.next() {
            Some((parameter, line)) if !reads => Err(self.refuse_manifest(
                *line,
                format!(
                    "parameter \"{}\": no_camera_at is for kernels that call before_camera, which none of this filter \
                     does; leave it out",
                    parameter.name
                ),
            )),
            _ => Ok(()),
        }
    }

    /// Refuses a parameter that changes nothing, if shaders read only the parameters that they
    /// want.
    fn check_parameters_are_used(&self) -> Result<(), FilterError> {
        let Filter {
            shaders,
            passes,
            textures,
            ..
        } = self;
        let is_used = |name: &str| {
            let mut blocks = shaders.iter().flat_map(|shader| &shader.blocks);
            let mut repeats = passes.iter().map(|pass| &pass.repeat);
            let mut divisors =
                (textures.iter()).flat_map(|texture| texture.divided_by.iter().flatten());
            blocks.any(|block| block.reads(name))
                || repeats.any(|repeat| matches!(repeat, Count::Parameter(known) if known == name))
                || divisors.any(|divisor| divisor.reads(name))
                || (passes.iter().filter_map(|pass| pass.shader.as_ref()))
                    .flat_map(PassShader::list_expressions)
                    .any(|expression| expression.reads(name))
        };
        let parameters = self.parameters.iter().zip(&self.lines.parameters);
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

    fn check_variable(&self, variable: &Variable) -> Result<(), String> {
        let Variable { name, resource, .. } = variable;
        let is_known = match variable.role {
            Role::Block(_) => matches!(&name[..], "parameters" | "frame"),
            Role::Write(_) if name == "output" => true,
            Role::Write(_) if name == written_texture(name) => false,
            _ => self.has_texture(resource) && resource != "output",
        };
        if is_known {
            check_texture(self, variable.role, resource)
        } else {
            Err(self.refuse_undeclared())
        }
    }

    fn refuse_undeclared(&self) -> String {
        let textures = &self.textures;
        let names: Vec<&str> = textures.iter().map(|texture| &texture.name[..]).collect();
        format!(
            "is no known input or output; uniforms: parameters, frame; read: {}, {}, those of the frame before \
             as color_before and so on if `history` names them, or a [[texture]] by its name; written: output or a [[texture]] as <name>_out; textures of {}: {}",
            Layer::list_names(Layer::OF_EVERY_FRAME),
            Layer::list_names(Layer::FURTHER),
            self.lines.path.display(),
            if names.is_empty() {
                "none".to_owned()
            } else {
                names.join(", ")
            }
        )
    }

    fn check_passes(&self) -> Result<(), FilterError> {
        let before = self.history.iter().map(|history| history.texture());
        let inputs = Layer::OF_EVERY_FRAME.into_iter().chain(Layer::FURTHER);
        let mut ready: BTreeSet<&str> = inputs.map(Layer::name).chain(before).collect();
        let mut used = BTreeSet::<String>::new();
        for (pass, line) in self.passes.iter().zip(&self.lines.passes) {
            let refuse = |reason: String| {
                self.refuse_manifest(*line, format!("pass \"{}\": {reason}", pass.entry))
            };
            let entry = self.find_entry_point(pass).map_err(refuse)?;
            if let Some(shader) = &pass.shader {
                check_targets(self, shader, entry).map_err(refuse)?;
            }
            match self.stages(pass)[..] {
                [_, (_, vertex)] => check_vertex(vertex, entry).map_err(refuse)?,
                _ => check_coordinates(entry).map_err(refuse)?,
            }
            // The output is read only in place, and begins as a copy of the colours.
            let is_missing = |name: &&String| !ready.contains(&name[..]) && *name != "output";
            if let Some(name) = entry.reads.iter().find(is_missing) {
                return Err(refuse(format!(
                    "reads \"{name}\" before any pass has written it"
                )));
            }
            if entry.writes.is_empty() {
                return Err(refuse("writes nothing".into()));
            }
            used.extend(entry.reads.iter().chain(&entry.writes).cloned());
            ready.extend(entry.writes.iter().map(String::as_str));
        }
        if !ready.contains("output") {
            let reason = "no pass writes \"output\"".into();
            return Err(
                self.refuse_manifest(self.lines.passes.first().copied().unwrap_or(1), reason)
            );
        }
        for (texture, line) in self.textures.iter().zip(&self.lines.textures) {
            if !used.contains(&texture.name) {
                let reason = format!("texture \"{}\" is used by no pass", texture.name);
                return Err(self.refuse_manifest(*line, reason));
            }
        }
        match (self.history.iter()).find(|history| !used.contains(history.texture())) {
            None => Ok(()),
            Some(unread) => Err(FilterError::in_file(
                &self.lines.path,
                None,
                format!(
                    "history names \"{}\", and no pass reads \"{}\"; read it, or leave it out",
                    unread.layer().name(),
                    unread.texture()
                ),
            )),
        }
    }

    fn find_entry_point(&self, pass: &Pass) -> Result<&EntryPoint, String> {
        let shader = self.shader(pass);
        shader.entry_point(pass.kernel()).ok_or_else(|| {
            let names: Vec<&str> = shader.entry_points.iter().map(|e| &e.name[..]).collect();
            format!(
                "{} has no such @compute entry point; it has: {}",
                self.kernel_path().display(),
                names.join(", ")
            )
        })
    }

    fn kernel_path(&self) -> PathBuf {
        let file = format!("{}.wgsl", self.name);
        self.lines.path.with_file_name(file)
    }

    fn refuse_kernel(&self, line: Option<usize>, reason: String) -> FilterError {
        FilterError::in_file(&self.kernel_path(), line, reason)
    }

    fn refuse_manifest(&self, line: usize, reason: String) -> FilterError {
        FilterError::in_file(&self.lines.path, line, reason)
    }
}
