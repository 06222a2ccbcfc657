//! Identity of filters: what a row of every table stands for.

use frame::Alignment;
use suite::{Case, Overall};

/// A filter preset with one form of its input, or a reference with one shutter.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct FilterId {
    /// `jump_flood:paper`.
    pub name: String,
    /// True of a reference: `identity`, `scatter_oracle`, `accumulate:N`.
    pub is_reference: bool,
    /// The shutter alignment that it is scored against.
    pub alignment: Alignment,
}

impl FilterId {
    /// Reads the filter of a case.
    pub fn of(case: &Case) -> Self {
        Self {
            name: case.name(),
            is_reference: case.is_reference,
            alignment: case.alignment,
        }
    }

    /// Writes a name that no other filter shares: references are made anew for every alignment.
    pub fn title(&self) -> String {
        match self.is_reference {
            true => format!("{} ({})", self.name, self.alignment),
            false => self.name.clone(),
        }
    }

    /// Writes the title as a part of an address: `bevy:high`, `identity@trailing`.
    pub fn anchor(&self) -> String {
        match self.is_reference {
            true => format!("{}@{}", escape(&self.name), self.alignment),
            false => escape(&self.name),
        }
    }

    /// Writes the address of the filter's own section: `filter:bevy:high`.
    pub fn section_anchor(&self) -> String {
        format!("filter:{}", self.anchor())
    }

    /// Tells whether a mean over scenes is this filter's.
    pub fn is_of(&self, overall: &Overall) -> bool {
        (self.is_reference, &self.name, &self.alignment)
            == (overall.is_reference, &overall.filter, &overall.alignment)
    }
}

/// Writes the address of a case: `railing/bevy:high`.
pub fn case_anchor(case: &Case) -> String {
    format!("{}/{}", escape(&case.scene), FilterId::of(case).anchor())
}

/// Replaces what an address may not hold, or what ends a name in it: a space becomes `~20`.
fn escape(name: &str) -> String {
    let escaped = name.chars().map(|letter| match letter {
        'a'..='z' | 'A'..='Z' | '0'..='9' | '_' | '-' | '.' | ':' | '@' => letter.to_string(),
        other => format!("~{:x}", u32::from(other)),
    });
    escaped.collect()
}

/// Averages numbers; none of none.
pub fn mean(values: impl Iterator<Item = f64>) -> Option<f64> {
    let (count, sum) = values.fold((0, 0.0), |(count, sum), value| (count + 1, sum + value));
    (count > 0).then(|| sum / f64::from(count))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_in_addresses_are_plain() {
        assert_eq!(escape("panel@64px_45deg"), "panel@64px_45deg");
        assert_eq!(escape("bevy:high a/b&c"), "bevy:high~20a~2fb~26c");
    }
}
