//! Mip levels that one dispatch reads and writes.

use std::collections::{BTreeMap, BTreeSet};

use super::targets::Targets;
use crate::filter::PassShader;
use crate::shader::{EntryPoint, Role, Shader, Variable};
use crate::{Expression, Filter, Pass};

/// Levels of the textures of one dispatch.
pub(super) struct Levels<'a> {
    /// Level by the index of the variable; none if a variable reads all.
    variables: BTreeMap<usize, Option<u32>>,
    /// Textures that it writes, each with the level.
    written: Vec<(&'a str, u32)>,
}

/// Levels that earlier dispatches have written, with their textures.
#[derive(Default)]
pub(super) struct WrittenLevels(BTreeSet<(String, u32)>);

impl<'a> Levels<'a> {
    /// Finds the levels of a dispatch; `value` knows parameters and the iteration.
    pub fn find(
        filter: &'a Filter,
        pass: &'a Pass,
        targets: &Targets,
        value: &dyn Fn(&str) -> f64,
    ) -> Result<Self, String> {
        let (shader, entry) = (filter.shader(pass), filter.entry_point(pass));
        let evaluate = |level: &Expression| match level.evaluate(value).round() {
            level if (0.0..=f64::from(u16::MAX)).contains(&level) => Ok(level as u32),
            level => Err(format!("level = {level}; allowed: from 0")),
        };
        let mut variables = BTreeMap::new();
        let mut written = Vec::new();
        for index in &entry.variables {
            let Variable {
                resource,
                role,
                level,
                ..
            } = &shader.variables[*index];
            let level = level.as_ref().map(evaluate).transpose()?;
            match role {
                Role::Read(_) => {
                    // A small texture has fewer levels: the pass gets its last.
                    let last = targets.current(resource).texture.mip_level_count() - 1;
                    variables.insert(*index, level.map(|level| level.min(last)));
                }
                Role::Write(_) => {
                    let level = level.unwrap_or(0);
                    variables.insert(*index, Some(level));
                    written.push((&resource[..], level));
                }
                Role::Block(_) | Role::Sampler(_) => {}
            }
        }
        if let Some(PassShader { level, targets, .. }) = &pass.shader {
            let level = level.as_ref().map(evaluate).transpose()?;
            written.extend(targets.iter().map(|name| (&name[..], level.unwrap_or(0))));
        }
        Ok(Self { variables, written })
    }

    /// Returns false if it writes a level that its texture does not have.
    pub fn are_there(&self, targets: &Targets) -> bool {
        (self.written.iter())
            .all(|(name, level)| *level < targets.current(name).texture.mip_level_count())
    }

    /// Returns the level of a variable; none for all.
    pub fn of_variable(&self, index: usize) -> Option<u32> {
        self.variables.get(&index).copied().flatten()
    }

    /// Returns the level of a texture that it writes; 0 for one that it does not.
    pub fn of_written(&self, name: &str) -> u32 {
        let mut written = self.written.iter();
        written
            .find(|(known, _)| *known == name)
            .map_or(0, |(_, level)| *level)
    }

    /// Adds what the dispatch writes. Refuses to read a level that it writes itself, or
    /// that no earlier one has written.
    pub fn write(
        &self,
        shader: &Shader,
        entry: &EntryPoint,
        targets: &Targets,
        ready: &mut WrittenLevels,
    ) -> Result<(), String> {
        for (index, level) in &self.variables {
            let Variable { resource, role, .. } = &shader.variables[*index];
            let count = targets.current(resource).texture.mip_level_count();
            if count == 1 || !matches!(role, Role::Read(_)) {
                continue;
            }
            if level.is_some_and(|level| self.written.contains(&(resource, level))) {
                return Err(format!(
                    "reads level {} of \"{resource}\", which it writes; allowed: a level that an earlier run has written",
                    self.of_written(resource)
                ));
            }
            let is_ready = |level: &u32| ready.0.contains(&(resource.clone(), *level));
            let mut wanted = level.map_or(0..count, |level| level..level + 1);
            if let Some(missing) = wanted.find(|level| !is_ready(level)) {
                return Err(format!(
                    "kernel \"{}\" may read level {missing} of \"{resource}\", which no pass has written before; write it \
                     first, or give the [[pass.binding]] the one `level` that it reads",
                    entry.name
                ));
            }
        }
        let written = self.written.iter();
        (ready.0).extend(written.map(|(name, level)| ((*name).to_owned(), *level)));
        Ok(())
    }
}
