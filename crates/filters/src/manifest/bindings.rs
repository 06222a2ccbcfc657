//! `[[pass.binding]]` of filter.toml.

use std::collections::BTreeMap;

use serde::Deserialize;
use toml::Spanned;

use super::file::{File, MAX_ENTRIES};
use super::number::{NumberEntry, NumbersEntry};
use crate::filter::{Binding, BindingPlace};
use crate::shader::{SamplerFilter, Sampling, Wrap};
use crate::{Filter, FilterError};

/// `[[pass.binding]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BindingEntry {
    #[serde(alias = "set")]
    group: Option<u32>,
    binding: Option<u32>,
    name: Option<String>,
    #[serde(default)]
    push_constants: bool,
    #[serde(default)]
    globals: bool,
    texture: Option<String>,
    level: Option<NumberEntry>,
    sampler: Option<SamplerFilter>,
    mip_filter: Option<SamplerFilter>,
    wrap: Option<Wrap>,
    #[serde(default)]
    values: BTreeMap<String, NumbersEntry>,
}

/// Reads the bindings of a pass, each of which has a place of its own.
pub(super) fn read_bindings(
    file: &File,
    entries: &[Spanned<BindingEntry>],
    filter: &Filter,
) -> Result<Vec<Binding>, FilterError> {
    let lines = file.lines("pass.binding", entries)?;
    let mut bindings = Vec::<Binding>::new();
    for (spanned, line) in entries.iter().zip(lines) {
        let refuse = |reason: String| file.at(spanned, format!("binding: {reason}"));
        let binding = read_binding(spanned.get_ref(), filter, line).map_err(refuse)?;
        if let BindingPlace::Named(name) = &binding.place {
            file.check_line(spanned, "binding: name", name)?;
        }
        if bindings.iter().any(|known| known.place == binding.place) {
            return Err(refuse(format!("{} is explained twice", binding.place)));
        }
        bindings.push(binding);
    }
    Ok(bindings)
}

fn read_binding(entry: &BindingEntry, filter: &Filter, line: usize) -> Result<Binding, String> {
    let places = [
        entry.binding.map(|binding| BindingPlace::Bound {
            group: entry.group.unwrap_or(0),
            binding,
        }),
        entry.name.clone().map(BindingPlace::Named),
        entry.push_constants.then_some(BindingPlace::PushConstants),
        entry.globals.then_some(BindingPlace::Globals),
    ];
    let mut places = places.into_iter().flatten();
    let (Some(place), None) = (places.next(), places.next()) else {
        return Err(
            "needs one of `binding` with its number in the group, `name` of its variable, `push_constants = true` and \
             `globals = true`"
                .into(),
        );
    };
    if entry.group.is_some() && entry.binding.is_none() {
        return Err("group is for `binding`, its number in the group; leave group out".into());
    }
    let given = [
        ("texture", entry.texture.is_some()),
        ("level", entry.level.is_some()),
        ("sampler", entry.sampler.is_some()),
        ("mip_filter", entry.mip_filter.is_some()),
        ("wrap", entry.wrap.is_some()),
        ("values", !entry.values.is_empty()),
    ];
    let mut values = Vec::new();
    flatten(&entry.values, "", &mut values);
    if values.len() > MAX_ENTRIES {
        return Err(format!("has more than {MAX_ENTRIES} values"));
    }
    let read_values = |(member, numbers): (String, &[NumberEntry])| {
        let read = numbers.iter().map(|number| filter.read_value(number));
        let read: Result<_, String> = read.collect();
        let read = read.map_err(|reason| format!("{member} = {reason}"))?;
        Ok::<_, String>((member, read))
    };
    let level = entry.level.as_ref().map(|level| filter.read_level(level));
    Ok(Binding {
        place,
        texture: entry.texture.clone(),
        level: (level.transpose()).map_err(|reason| format!("level = {reason}"))?,
        sampling: Sampling {
            filter: entry.sampler.unwrap_or_default(),
            mip_filter: entry.mip_filter.unwrap_or(SamplerFilter::Nearest),
            wrap: entry.wrap.unwrap_or_default(),
        },
        values: (values.into_iter().map(read_values)).collect::<Result<_, _>>()?,
        keys: (given.into_iter().filter(|(_, given)| *given))
            .map(|(key, _)| key)
            .collect(),
        line,
    })
}

/// Lists values by the paths of their members: `{ light.x = 1 }` is `{ "light.x" = 1 }`.
fn flatten<'e>(
    values: &'e BTreeMap<String, NumbersEntry>,
    path: &str,
    flat: &mut Vec<(String, &'e [NumberEntry])>,
) {
    for (name, entry) in values {
        let path = match path {
            "" => name.clone(),
            path => format!("{path}.{name}"),
        };
        match entry {
            NumbersEntry::Members(members) => flatten(members, &path, flat),
            entry => flat.push((path, entry.as_slice())),
        }
    }
}
