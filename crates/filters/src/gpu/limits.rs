//! Limits of a device, and the check of a filter against them.

use super::device::Gpu;
use crate::shader::{EntryPoint, Role, Shader, Wrap};
use crate::{Filter, FilterError, Format, Pass};

/// The limits of a device.
#[derive(Clone, Debug)]
pub struct Limits {
    /// Owner of the limits, as a message names it.
    owner: String,
    limits: wgpu::Limits,
    /// True if samplers interpolate 32-bit floats.
    interpolates_floats: bool,
    /// Formats in which shaders can store textures.
    stored_formats: Vec<Format>,
    /// True if shaders convert between floats of 32 and of 16 bits.
    packs_halves: bool,
    /// True if samplers have a border.
    has_border: bool,
}

impl Limits {
    /// Returns the limits of every adapter that supports WebGPU.
    pub fn lowest() -> Self {
        Self {
            owner: "the lowest common limits, those that WebGPU promises everywhere".into(),
            limits: wgpu::Limits::default(),
            interpolates_floats: false,
            // WebGPU promises few of these, but adapters have most of them.
            stored_formats: Format::ALL.to_vec(),
            packs_halves: true,
            has_border: false,
        }
    }

    /// Returns the limits of an opened adapter.
    pub fn of(gpu: &Gpu) -> Self {
        Self {
            owner: format!("adapter \"{}\"", gpu.adapter.name),
            limits: gpu.device().limits(),
            interpolates_floats: (gpu.device().features())
                .contains(wgpu::Features::FLOAT32_FILTERABLE),
            stored_formats: gpu.stored_formats.clone(),
            packs_halves: gpu.packs_halves,
            has_border: (gpu.device().features())
                .contains(wgpu::Features::ADDRESS_MODE_CLAMP_TO_BORDER),
        }
    }

    /// Refuses a filter with a pass that asks for more. Accepts every filter that is a command.
    pub fn check(&self, filter: &Filter) -> Result<(), FilterError> {
        for pass in &filter.passes {
            let entry = filter.entry_point(pass);
            let shader = filter.shader(pass);
            let mut stages = filter.stages(pass).into_iter();
            let broken = stages.find_map(|(shader, entry)| self.find_broken(shader, entry));
            if let Some(reason) = broken.or_else(|| self.find_uninterpolated(filter, pass)) {
                let reason = format!("pass \"{}\": {reason}", pass.entry);
                return Err(FilterError::in_file(&shader.path, entry.line, reason));
            }
        }
        Ok(())
    }

    /// Describes the first texture of 32-bit floats that a pass interpolates although the device
    /// cannot.
    fn find_uninterpolated(&self, filter: &Filter, pass: &Pass) -> Option<String> {
        if self.interpolates_floats {
            return None;
        }
        let variables = &filter.shader(pass).variables;
        let interpolated = filter.entry_point(pass).interpolated.iter();
        let mut names = interpolated.map(|index| &variables[*index].resource);
        let name = names.find(|name| filter.read_format(name).is_full_float())?;
        Some(format!(
            "a sampler interpolates the 32-bit floats of \"{name}\", not allowed by {}; give the texture a format of \
             16-bit floats ([convention] has color_format, velocity_format and depth_format), or take sampler = \"nearest\"",
            self.owner
        ))
    }

    /// Describes the first limit that a kernel breaks.
    fn find_broken(&self, shader: &Shader, entry: &EntryPoint) -> Option<String> {
        let limits = &self.limits;
        let count = |is: fn(Role) -> bool| {
            let used = entry.variables.iter();
            used.filter(|index| is(shader.variables[**index].role))
                .count() as u64
        };
        let bindings = entry
            .variables
            .iter()
            .map(|index| shader.variables[*index].binding);
        let reasons = [
            self.find_broken_size(entry.workgroup_size),
            self.find_unstored(shader, entry),
            self.find_lacking(shader, entry),
            self.exceed(
                entry.usage.workgroup_bytes,
                limits.max_compute_workgroup_storage_size,
                "bytes of var<workgroup>",
                "keep less in it, or divide the pass",
            ),
            self.exceed(
                count(|role| matches!(role, Role::Write(_))),
                limits.max_storage_textures_per_shader_stage,
                "textures that it writes",
                "divide the pass",
            ),
            self.exceed(
                count(|role| matches!(role, Role::Read(_))),
                limits.max_sampled_textures_per_shader_stage,
                "textures that it reads",
                "divide the pass",
            ),
            self.exceed(
                u64::from(bindings.max().unwrap_or(0)),
                limits.max_bindings_per_bind_group - 1,
                "as a number of @binding",
                "number the bindings from 1",
            ),
        ];
        reasons.into_iter().flatten().next()
    }

    /// Describes the first texture that a shader stores in a format that the adapter cannot store.
    fn find_unstored(&self, shader: &Shader, entry: &EntryPoint) -> Option<String> {
        let used = entry
            .variables
            .iter()
            .map(|index| &shader.variables[*index]);
        let mut stored = used.filter_map(|variable| match variable.role {
            Role::Write(format) => Some((&variable.resource, format)),
            _ => None,
        });
        let (name, format) = stored.find(|(_, format)| !self.stored_formats.contains(format))?;
        let allowed = self
            .stored_formats
            .iter()
            .filter(|candidate| candidate.kind() == format.kind());
        let allowed: Vec<&str> = allowed.map(|format| format.name()).collect();
        Some(format!(
            "stores \"{name}\" as {}, not allowed by {}; give the texture one of {}",
            format.name(),
            self.owner,
            allowed.join(", ")
        ))
    }

    /// Describes the first ability that an entry point needs and the adapter lacks.
    fn find_lacking(&self, shader: &Shader, entry: &EntryPoint) -> Option<String> {
        let owner = &self.owner;
        if entry.usage.packs_halves && !self.packs_halves {
            return Some(format!(
                "converts to or from 16-bit floats, as pack2x16float, packHalf2x16 and f32tof16 do, not allowed by {owner}; \
                 choose another adapter, or keep the numbers in a [[texture]] of 16-bit floats"
            ));
        }
        let has_border = |index: &usize| match shader.variables[*index].role {
            Role::Sampler(sampling) => sampling.wrap == Wrap::Border,
            _ => false,
        };
        let bordered = entry.variables.iter().find(|index| has_border(index))?;
        let name = &shader.variables[*bordered].name;
        (!self.has_border).then(|| {
            format!(
                "sampler \"{name}\" has wrap = \"border\", not allowed by {owner}; choose another adapter, or take wrap = \
                 \"clamp\" and test the coordinates in the shader"
            )
        })
    }

    /// Describes the first limit that the size of a workgroup breaks.
    fn find_broken_size(&self, [x, y, z]: [u32; 3]) -> Option<String> {
        let limits = &self.limits;
        let [along_x, along_y, along_z] = [x, y, z].map(u64::from);
        let all = along_x * along_y * along_z;
        let mut counts = [
            (
                all,
                limits.max_compute_invocations_per_workgroup,
                "in a workgroup",
            ),
            (along_x, limits.max_compute_workgroup_size_x, "along x"),
            (along_y, limits.max_compute_workgroup_size_y, "along y"),
            (along_z, limits.max_compute_workgroup_size_z, "along z"),
        ]
        .into_iter();
        let broken = counts.find_map(|(count, allowed, place)| {
            let what = format!("invocations {place}");
            self.exceed(count, allowed, &what, "make @workgroup_size smaller")
        });
        broken.map(|reason| format!("@workgroup_size({x}, {y}, {z}): {reason}"))
    }

    /// Describes a number above its limit.
    fn exceed(&self, count: u64, allowed: u32, what: &str, way_out: &str) -> Option<String> {
        let owner = &self.owner;
        (count > u64::from(allowed))
            .then(|| format!("{count} {what}; allowed: at most {allowed} by {owner}; {way_out}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_adapter_that_cannot_pack_halves_refuses_to() {
        let folder = tempfile::tempdir().unwrap();
        let write =
            |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
        let head = "name = \"packs\"\nsummary = \"Packs halves.\"\nalignment = \"centred\"\n[[pass]]\nentry = \"pack\"\n";
        write("filter.toml", head);
        let kernel = "@group(0) @binding(1) var output: texture_storage_2d<rgba32float, write>;\n\
                      @compute @workgroup_size(8, 8) fn pack(@builtin(global_invocation_id) id: vec3<u32>) {\n\
                      let packed = pack2x16float(vec2<f32>(id.xy));\n\
                      textureStore(output, vec2<i32>(id.xy), vec4<f32>(f32(packed)));\n}\n";
        write("packs.wgsl", kernel);
        let filter = Filter::load(folder.path()).unwrap();
        Limits::lowest().check(&filter).unwrap();
        let lacking = Limits {
            packs_halves: false,
            ..Limits::lowest()
        };
        let refusal = lacking.check(&filter).unwrap_err().to_string();
        let says = "converts to or from 16-bit floats, as pack2x16float, packHalf2x16 and f32tof16 do, not allowed by the lowest";
        assert!(refusal.contains(says), "{refusal}");
    }

    #[test]
    fn a_format_that_the_adapter_cannot_store_is_refused_with_those_that_it_can() {
        let limits = Limits {
            stored_formats: vec![Format::R32Sint, Format::R32Float],
            ..Limits::lowest()
        };
        let filter = Filter::builtin("identity").unwrap();
        let refusal = limits.check(&filter).unwrap_err().to_string();
        let says = "stores \"output\" as rgba32float, not allowed by the lowest common limits";
        assert!(refusal.contains(says), "{refusal}");
        let way_out = "give the texture one of r32float";
        assert!(refusal.ends_with(way_out), "{refusal}");
    }
}
