//! Declarations of a kernel file, found with naga's reflection; needs no adapter.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use wgpu::naga::proc::Layouter;
use wgpu::naga::valid::{Capabilities, GlobalUse, ModuleInfo, ValidationFlags, Validator};
use wgpu::naga::{
    AddressSpace, GlobalVariable, Handle, ImageClass, ImageDimension, Module, Scalar, ScalarKind,
    ShaderStage, SourceLocation, StorageAccess, StorageFormat, TypeInner, front,
};

use super::demand::Demand;
use super::limits::refuse_immense;
use super::nesting;
use super::noise::reads_frame_index;
use super::stack::on_stack;
use crate::FilterError;
use crate::filter::Format;
use crate::text::without_controls;

/// The kernels of a filter with the common part behind them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shader {
    /// The filter's file.
    pub path: PathBuf,
    /// WGSL: the filter's file, then common.wgsl.
    pub source: String,
    /// Resource variables of group 0, in order of declaration.
    pub variables: Vec<Variable>,
    /// Members of the structs that uniforms hold, by the uniform's name.
    pub uniforms: BTreeMap<String, Vec<Member>>,
    /// Whether the kernels ask how the camera moved.
    pub reads_reprojection: bool,
    /// Compute entry points.
    pub entry_points: Vec<EntryPoint>,
}

/// A resource variable.
#[derive(Clone, Debug)]
pub(crate) struct Variable {
    pub name: String,
    pub binding: u32,
    pub role: Role,
    /// In the WGSL file, from 1.
    pub line: usize,
}

/// What a resource variable is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    /// `var<uniform>`.
    Uniform,
    /// `texture_2d<f32>` or `texture_2d<u32>`.
    Read(Texel),
    /// `texture_storage_2d<format, write>`.
    Write(Format),
}

/// What a texture that is read holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Texel {
    /// `f32`.
    Float,
    /// `u32`.
    Uint,
}

impl Texel {
    /// What a texture of that format holds.
    pub fn of(format: Format) -> Self {
        match format {
            Format::R32Uint => Texel::Uint,
            Format::R32Float | Format::Rg32Float | Format::Rgba32Float => Texel::Float,
        }
    }
}

/// A member of a uniform struct.
#[derive(Clone, Debug)]
pub(crate) struct Member {
    pub name: String,
    /// `i32`, `u32`, `f32`, or what else was found.
    pub wgsl_type: String,
    /// In bytes.
    pub offset: u32,
    pub line: usize,
}

/// A kernel.
#[derive(Clone, Debug)]
pub(crate) struct EntryPoint {
    pub name: String,
    /// Invocations per workgroup.
    pub workgroup_size: [u32; 3],
    /// Indices of the variables that it uses.
    pub variables: Vec<usize>,
    /// Names of the textures that it reads.
    pub reads: BTreeSet<String>,
    /// Names of the textures that it writes.
    pub writes: BTreeSet<String>,
    /// Whether it reads the frame's index, from which noise is drawn.
    pub draws_noise: bool,
    /// What it asks of a device.
    pub demand: Demand,
    /// In the WGSL file, from 1.
    pub line: Option<usize>,
}

impl EntryPoint {
    /// Names of the textures that it both reads and writes: those have two copies, exchanged after each iteration.
    pub fn exchanged(&self) -> impl Iterator<Item = &String> {
        self.reads.intersection(&self.writes)
    }
}

/// The texture that a variable of that name writes: `<texture>_out`, and `output` itself.
pub(crate) fn written(variable: &str) -> &str {
    variable.strip_suffix("_out").unwrap_or(variable)
}

impl Shader {
    /// Parses and validates the kernels at `path`, with `common` appended after them. What recurses too deep is refused
    /// before naga sees it.
    pub fn parse(path: &Path, kernels: &str, common: &str) -> Result<Self, FilterError> {
        nesting::check(path, kernels)?;
        let parsed = on_stack(|| Self::parse_here(path, kernels, common));
        parsed.unwrap_or_else(|panic| {
            Err(FilterError::Folder {
                path: path.to_owned(),
                line: None,
                reason: format!(
                    "naga, which reads WGSL, fails on it: {}; write it otherwise, or make it smaller",
                    without_controls(&panic)
                ),
            })
        })
    }

    fn parse_here(path: &Path, kernels: &str, common: &str) -> Result<Self, FilterError> {
        let source = Source {
            path,
            kernel_lines: kernels.trim_end().lines().count(),
            text: format!("{}\n{common}", kernels.trim_end()),
        };
        let options = front::wgsl::Options {
            capabilities: CAPABILITIES,
            ..front::wgsl::Options::new()
        };
        let mut parser = front::wgsl::Frontend::new_with_options(options);
        let module = parser.parse(&source.text).map_err(|error| {
            let message = error.emit_to_string_with_path(&source.text, source.name());
            source.refuse(error.location(&source.text), &message)
        })?;
        source.refuse_overrides(&module)?;
        let info = Validator::new(ValidationFlags::all(), CAPABILITIES)
            .validate(&module)
            .map_err(|error| {
                let message = error.emit_to_string_with_path(&source.text, source.name());
                source.refuse(error.location(&source.text), &message)
            })?;
        let handles: Vec<Handle<GlobalVariable>> = module
            .global_variables
            .iter()
            .filter(|(_, variable)| variable.binding.is_some())
            .map(|(handle, _)| handle)
            .collect();
        let variables = handles
            .iter()
            .map(|handle| variable(&source, &module, *handle))
            .collect::<Result<Vec<_>, _>>()?;
        let entry_points = entry_points(&source, &module, &info, &handles, &variables);
        for entry in &entry_points {
            refuse_immense(entry).map_err(|reason| source.at(entry.line, reason))?;
        }
        Ok(Self {
            path: path.to_owned(),
            uniforms: uniforms(&source, &module),
            reads_reprojection: kernels.contains("before_camera(")
                || kernels.contains("frame.reprojection"),
            entry_points,
            variables,
            source: source.text,
        })
    }

    /// A binding of group 0 that no variable has.
    pub fn free_binding(&self) -> u32 {
        let used = |binding| (self.variables.iter()).any(|variable| variable.binding == binding);
        let free = (0..).find(|binding| !used(*binding));
        free.expect("a kernel has fewer variables than there are numbers")
    }

    /// The entry point of that name.
    pub fn entry_point(&self, name: &str) -> Option<&EntryPoint> {
        self.entry_points.iter().find(|entry| entry.name == name)
    }
}

/// What every device has; kernels can `enable` nothing more.
const CAPABILITIES: Capabilities =
    Capabilities::MULTISAMPLED_SHADING.union(Capabilities::CUBE_ARRAY_TEXTURES);

struct Source<'a> {
    path: &'a Path,
    text: String,
    kernel_lines: usize,
}

impl Source<'_> {
    fn name(&self) -> &str {
        let name = self.path.file_name().and_then(|name| name.to_str());
        name.expect("the WGSL file is named after the filter")
    }

    fn refuse(&self, place: Option<SourceLocation>, message: &str) -> FilterError {
        let message = tidy(message);
        match place {
            Some(place) if place.line_number as usize <= self.kernel_lines => {
                FilterError::Kernels {
                    path: self.path.to_owned(),
                    line: place.line_number as usize,
                    column: place.line_position as usize,
                    reason: message,
                }
            }
            place => self.at(place.map(|place| place.line_number as usize), message),
        }
    }

    fn at(&self, line: Option<usize>, reason: String) -> FilterError {
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
        FilterError::Folder {
            path: self.path.to_owned(),
            line,
            reason,
        }
    }

    /// Refuses what nothing can set, and what leaves sizes unknown.
    fn refuse_overrides(&self, module: &Module) -> Result<(), FilterError> {
        let Some((handle, found)) = module.overrides.iter().next() else {
            return Ok(());
        };
        let line = module.overrides.get_span(handle).location(&self.text);
        let name = found.name.as_deref().unwrap_or_default();
        Err(self.at(
            Some(line.line_number as usize),
            format!("override \"{name}\" is set by nobody; allowed: const, or a [[parameter]]"),
        ))
    }

    /// The line in which a function begins.
    fn line_of_function(&self, name: &str) -> Option<usize> {
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

    fn line(&self, module: &Module, handle: Handle<GlobalVariable>) -> usize {
        let span = module.global_variables.get_span(handle);
        span.location(&self.text).line_number as usize
    }
}

/// A message of naga without the word "error" before it, nor blanks at the ends of its lines.
fn tidy(message: &str) -> String {
    let message = message.strip_prefix("error: ").unwrap_or(message);
    let lines = message.trim_end().lines().map(str::trim_end);
    let lines: Vec<String> = lines.map(without_controls).collect();
    lines.join("\n")
}

fn variable(
    source: &Source,
    module: &Module,
    handle: Handle<GlobalVariable>,
) -> Result<Variable, FilterError> {
    let variable = &module.global_variables[handle];
    let name = variable.name.clone().unwrap_or_default();
    let line = source.line(module, handle);
    let binding = variable.binding.expect("only bound variables are listed");
    if binding.group != 0 {
        return Err(source.at(
            Some(line),
            format!(
                "\"{name}\" is in group {}; only @group(0) is bound",
                binding.group
            ),
        ));
    }
    let role = match (&variable.space, &module.types[variable.ty].inner) {
        (AddressSpace::Uniform, _) => Some(Role::Uniform),
        (
            AddressSpace::Handle,
            TypeInner::Image {
                dim: ImageDimension::D2,
                arrayed: false,
                class,
            },
        ) => image_role(*class),
        _ => None,
    };
    let role = role.ok_or_else(|| {
        source.at(
            Some(line),
            format!(
                "\"{name}\" cannot be bound; allowed: var<uniform>, texture_2d<f32>, texture_2d<u32>, and \
                 texture_storage_2d<r32uint | r32float | rg32float | rgba32float, write>"
            ),
        )
    })?;
    Ok(Variable {
        name,
        binding: binding.binding,
        role,
        line,
    })
}

fn image_role(class: ImageClass) -> Option<Role> {
    match class {
        ImageClass::Sampled {
            kind: ScalarKind::Float,
            multi: false,
        } => Some(Role::Read(Texel::Float)),
        ImageClass::Sampled {
            kind: ScalarKind::Uint,
            multi: false,
        } => Some(Role::Read(Texel::Uint)),
        ImageClass::Storage { format, access } if access == StorageAccess::STORE => {
            let format = match format {
                StorageFormat::R32Uint => Format::R32Uint,
                StorageFormat::R32Float => Format::R32Float,
                StorageFormat::Rg32Float => Format::Rg32Float,
                StorageFormat::Rgba32Float => Format::Rgba32Float,
                _ => return None,
            };
            Some(Role::Write(format))
        }
        _ => None,
    }
}

fn uniforms(source: &Source, module: &Module) -> BTreeMap<String, Vec<Member>> {
    let mut layouter = Layouter::default();
    layouter
        .update(module.to_ctx())
        .expect("a validated module has a layout");
    let mut uniforms = BTreeMap::new();
    for (handle, uniform) in module.global_variables.iter() {
        if uniform.space != AddressSpace::Uniform {
            continue;
        }
        let line = source.line(module, handle);
        let member = |name: &Option<String>, ty, offset| Member {
            name: name.clone().unwrap_or_default(),
            wgsl_type: match &module.types[ty].inner {
                TypeInner::Scalar(Scalar::I32) => "i32".into(),
                TypeInner::Scalar(Scalar::U32) => "u32".into(),
                TypeInner::Scalar(Scalar::F32) => "f32".into(),
                _ => format!("something of {} bytes", layouter[ty].size),
            },
            offset,
            line,
        };
        let members = match &module.types[uniform.ty].inner {
            TypeInner::Struct { members, .. } => members
                .iter()
                .map(|found| member(&found.name, found.ty, found.offset))
                .collect(),
            _ => vec![member(&uniform.name, uniform.ty, 0)],
        };
        uniforms.insert(uniform.name.clone().unwrap_or_default(), members);
    }
    uniforms
}

fn entry_points(
    source: &Source,
    module: &Module,
    info_of_module: &ModuleInfo,
    handles: &[Handle<GlobalVariable>],
    variables: &[Variable],
) -> Vec<EntryPoint> {
    module
        .entry_points
        .iter()
        .enumerate()
        .filter(|(_, entry)| entry.stage == ShaderStage::Compute)
        .map(|(index, entry)| {
            let info = info_of_module.get_entry_point(index);
            let used: Vec<usize> = (0..handles.len())
                .filter(|variable| info[handles[*variable]] != GlobalUse::empty())
                .collect();
            let used_variables = used.iter().map(|index| &variables[*index]);
            let (mut reads, mut writes) = (BTreeSet::new(), BTreeSet::new());
            for Variable { name, role, .. } in used_variables {
                match role {
                    Role::Uniform => {}
                    Role::Read(_) => _ = reads.insert(name.clone()),
                    Role::Write(_) => _ = writes.insert(written(name).to_owned()),
                }
            }
            EntryPoint {
                name: entry.name.clone(),
                workgroup_size: entry.workgroup_size,
                variables: used,
                reads,
                writes,
                draws_noise: reads_frame_index(module, &entry.function),
                demand: Demand::of(module, info_of_module, index),
                line: source.line_of_function(&entry.name),
            }
        })
        .collect()
}
