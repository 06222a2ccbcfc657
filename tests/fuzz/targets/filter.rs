//! Filter folders: filter.toml, and shaders in WGSL, SPIR-V and GLSL.

use std::path::PathBuf;

use cli::{Programs, select_filters};
use filters::Filter;

use crate::place::{CANARY, Place};
use crate::seeds::shipped;

/// Loads a filter.toml together with the kernels of all built-in filters.
pub fn manifest(place: &mut Place, input: &[u8]) -> Option<()> {
    let folder = place.folder.join("filter");
    if !folder.exists() {
        for name in Filter::builtin_names() {
            place.write(&format!("filter/{name}.wgsl"), only_file(&name, ".wgsl"));
        }
    }
    place.write("filter/filter.toml", input);
    let filter = Filter::load(&folder).ok()?;
    for preset in &filter.presets {
        let settings = filter.settings(Some(&preset.name)).unwrap();
        for width in [1, 320, 16_384] {
            drop(settings.clone().scaled_to(&filter, width));
        }
    }
    let word = folder.display().to_string();
    drop(select_filters(&[word], None, &[], Programs::Refused));
    Some(())
}

/// Loads kernels.
pub fn wgsl(place: &mut Place, input: &[u8]) -> Option<()> {
    Filter::load(&write(place, input)).ok().map(drop)
}

/// Translates and binds a SPIR-V module as a kernel and as a vertex stage.
pub fn spirv(place: &mut Place, input: &[u8]) -> Option<()> {
    let (kernel, vertex) = (place.copy("spirv"), place.copy("drawn"));
    place.write("spirv/gather.spv", input);
    drop(Filter::load(&kernel));
    place.write("drawn/corner.spv", input);
    Filter::load(&vertex).ok().map(drop)
}

/// Loads GLSL with includes; a file outside the filter's folder is never read. A line `//// NAME` begins another one of its files.
pub fn includes(place: &mut Place, input: &[u8]) -> Option<()> {
    const FILES: [&str; 3] = ["top.h", "p/near.h", "p/q/deep.h"];
    let folder = place.copy("includes");
    // Compilers work on copies, where a path that begins at the root leads there.
    let outside = format!("{}{}", "../".repeat(12), place.canary().display());
    let text = String::from_utf8_lossy(input).replace("@canary@", &outside);
    let mut parts = text.split("//// ");
    place.write("includes/blur.comp", parts.next().unwrap_or_default());
    for name in FILES {
        place.write(&format!("includes/{name}"), "float other;\n");
    }
    for (name, text) in parts.filter_map(|part| part.split_once('\n')) {
        if FILES.contains(&name) {
            place.write(&format!("includes/{name}"), text);
        }
    }
    let said = Filter::load(&folder).err()?.to_string();
    // A compiler quotes the word where it fails.
    for word in CANARY.split(' ') {
        let quoted = format!("'{word}'");
        let is_said = said.contains(&quoted) || (word.len() > 5 && said.contains(word));
        assert!(!is_said, "a file outside was read: {said}");
    }
    Some(())
}

/// Returns the kernels of all built-in filters, each with a line that names its filter.
pub fn kernels(_: &Place) -> Vec<Vec<u8>> {
    let source = |name: &String| format!("{MARK}{name}\n{}", only_file(name, ".wgsl")).into_bytes();
    Filter::builtin_names().iter().map(source).collect()
}

const MARK: &str = "// filter: ";

/// Makes a filter folder from kernels, with the manifest of the filter named in their first line, or the identity's.
pub fn write(place: &Place, input: &[u8]) -> PathBuf {
    let text = String::from_utf8_lossy(input);
    let line = text.split('\n').next().unwrap_or_default();
    let named = line.strip_prefix(MARK).unwrap_or_default();
    let names = Filter::builtin_names();
    let name = (names.iter().find(|known| *known == named)).map_or("identity", String::as_str);
    place.write(&format!("{name}/{name}.wgsl"), input);
    // No pass may run longer.
    let manifest = format!("time_limit = 5\n{}", only_file(name, "filter.toml"));
    place.write(&format!("{name}/filter.toml"), manifest);
    place.folder.join(name)
}

/// Reads the only file of a built-in filter with this ending.
fn only_file(name: &str, end: &str) -> String {
    let mut found = shipped(&format!("shaders/{name}"), end);
    assert_eq!(found.len(), 1, "shaders/{name} has one {end}");
    String::from_utf8(found.remove(0)).expect("it is UTF-8")
}
