//! A filter as JSON for a program that runs it elsewhere, such as a page in a browser: all that
//! `gpu` binds and dispatches.

mod bindings;
mod expressions;
mod inputs;
mod modules;
mod passes;
mod translated;

use std::collections::BTreeMap;

use serde_json::{Value, json};

use crate::filter::Origin;
use crate::gpu::{FrameValues, output_format};
use crate::load::read_text;
use crate::shader::{FRAME_PREFIX, Role, Variable, Wrap};
use crate::{Expression, Filter, Input, Parameter, Preset, Texture, Unit};
use expressions::{describe, list_names};
use inputs::list_inputs;
use modules::list_modules;
use passes::{describe_pass, list_features};
use translated::rewrite;

impl Filter {
    /// Describes the filter for pictures of a width, without their guard band; `as_written` leaves
    /// the presets' values in pixels unscaled.
    ///
    /// # Errors
    /// It is a program, WGSL cannot say what its shaders do, or its files cannot be read again: a
    /// sentence for the page's reader.
    pub fn live(&self, width: u32, as_written: bool) -> Result<Value, String> {
        if self.command.is_some() {
            return Err("A browser cannot run this filter: it is a program.".into());
        }
        if let Some(reason) = self.find_unsupported() {
            return Err(reason.into());
        }
        let toml = read_text(self, &self.lines.path).map_err(|error| error.to_string())?;
        let mut modules = list_modules(self)?;
        let passes: Vec<Value> = (self.passes.iter())
            .map(|pass| describe_pass(self, pass, &mut modules))
            .collect();
        let preset = |preset: &Preset| {
            let settings = self.settings(Some(&preset.name));
            let mut settings = settings.expect("the filter has its own presets");
            if !as_written {
                settings = settings.scaled_to(self, width);
            }
            let reference_width = settings.reference_width;
            json!({
                "name": preset.name, "doc": preset.doc, "values": settings.values, "reference_width": reference_width,
            })
        };
        let in_pixels = |parameter: &Parameter| parameter.unit == Some(Unit::Pixels);
        Ok(json!({
            "name": self.name,
            "toml": rewrite(self, toml),
            // What a new preset has to name, so that its values in pixels stay as they are.
            "reference_width": self.parameters.iter().any(in_pixels).then_some(width),
            "parameters": self.parameters,
            "presets": self.presets.iter().map(preset).collect::<Vec<_>>(),
            "features": list_features(self),
            "inputs": list_inputs(self),
            "output": output_format(self),
            "output_scale": self.convention.color_scale.unwrap_or(1.0),
            "textures": (self.textures.iter())
                .map(|texture| describe_texture(self, texture))
                .collect::<Vec<_>>(),
            "passes": passes,
            "modules": modules,
        }))
    }

    /// Says what pages lack that the filter needs.
    fn find_unsupported(&self) -> Option<&'static str> {
        let mut variables = self.shaders.iter().flat_map(|shader| &shader.variables);
        let is_bordered = |variable: &Variable| matches!(variable.role, Role::Sampler(sampler) if sampler.wrap == Wrap::Border);
        if variables.any(is_bordered) {
            Some("A browser cannot run this filter: WebGPU's samplers have no border.")
        } else if self.convention.origin() == Origin::BottomLeft {
            Some("This page cannot run the filter: its pictures begin at the bottom left.")
        } else if self.is_in_place() {
            Some("This page cannot run the filter: it writes its picture in place.")
        } else {
            None
        }
    }

    /// Lists the files of a folder that has the filter in WGSL, each with its text: filter.toml,
    /// then its modules.
    ///
    /// # Errors
    /// As [`Filter::live`].
    pub fn wgsl_files(&self) -> Result<Vec<(String, String)>, String> {
        let live = self.live(0, true)?;
        let text = |value: &Value, name: &str| value[name].as_str().map(str::to_owned);
        let toml = text(&live, "toml").map(|text| ("filter.toml".to_owned(), text));
        let modules = live["modules"].as_array().into_iter().flatten();
        let modules =
            modules.filter_map(|module| Some((text(module, "file")?, text(module, "wgsl")?)));
        Ok(toml.into_iter().chain(modules).collect())
    }

    /// Lists the numbers of a frame that the filter's data name, without the run of a pass. Fails
    /// for a frame that lacks one of them.
    pub fn frame_values(&self, input: &Input) -> Result<BTreeMap<String, f64>, String> {
        let frame = FrameValues::of(input, &self.convention);
        let mut known = inputs::list_values(self, input);
        let mut add = |expression: &Expression| {
            let of_run = ["iteration", "iterations"];
            let is_wanted = |name: &str| {
                !of_run.contains(&name.strip_prefix(FRAME_PREFIX).unwrap_or(name))
                    && self
                        .parameters
                        .iter()
                        .all(|parameter| parameter.name != name)
            };
            for name in list_names(expression)
                .into_iter()
                .filter(|name| is_wanted(name))
            {
                let value = frame.find(name);
                let value = value.ok_or_else(|| format!("The frame does not say {name}."))?;
                known.insert(name.to_owned(), value);
            }
            Ok::<_, String>(())
        };
        for (shader, entry) in self.passes.iter().flat_map(|pass| self.stages(pass)) {
            for variable in entry
                .variables
                .iter()
                .map(|index| &shader.variables[*index])
            {
                variable.level.iter().try_for_each(&mut add)?;
                if let Role::Block(block) = variable.role {
                    let mut numbers = shader.blocks[block].numbers.iter();
                    numbers.try_for_each(|number| add(&number.value))?;
                }
            }
        }
        let levels = self.passes.iter().filter_map(|pass| pass.shader.as_ref());
        let levels = levels.flat_map(|shader| &shader.level);
        let divisors = self
            .textures
            .iter()
            .flat_map(|texture| &texture.divided_by)
            .flatten();
        levels.chain(divisors).try_for_each(add)?;
        Ok(known)
    }
}

fn describe_texture(filter: &Filter, texture: &Texture) -> Value {
    let divisors = texture.divided_by.as_ref();
    json!({
        "name": texture.name,
        "format": texture.format,
        "divided_by": divisors.map(|divisors| divisors.each_ref().map(describe)),
        "rounding": texture.rounding,
        "mips": texture.mips,
        "copies": filter.count_copies(&texture.name),
    })
}
