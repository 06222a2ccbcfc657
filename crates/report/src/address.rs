//! Addresses of filters and cases in a page.

use measure::{CaseId, FilterId};

/// Formats a filter's unique name as a part of an address: `bevy:high`, `identity@trailing`.
pub fn anchor(filter: &FilterId) -> String {
    if filter.is_reference {
        format!("{}@{}", escape(&filter.name), filter.alignment)
    } else {
        escape(&filter.name)
    }
}

/// Formats the address of the filter's own section: `filter:bevy:high`.
pub fn section_anchor(filter: &FilterId) -> String {
    format!("filter:{}", anchor(filter))
}

/// Formats the address of a case: `railing/bevy:high`.
pub fn case_anchor(case: &CaseId) -> String {
    format!(
        "{}/{}",
        escape(&case.scene.to_string()),
        anchor(&case.filter_id())
    )
}

/// Escapes characters that an address may not contain, or that end a name in it: a space becomes
/// `~20`.
fn escape(name: &str) -> String {
    let escaped = name.chars().map(|letter| match letter {
        'a'..='z' | 'A'..='Z' | '0'..='9' | '_' | '-' | '.' | ':' | '@' => letter.to_string(),
        other => format!("~{:x}", u32::from(other)),
    });
    escaped.collect()
}

#[test]
fn names_in_addresses_are_plain() {
    assert_eq!(escape("panel@64px_45deg"), "panel@64px_45deg");
    assert_eq!(escape("bevy:high a/b&c"), "bevy:high~20a~2fb~26c");
}
