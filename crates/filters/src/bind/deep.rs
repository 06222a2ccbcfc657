//! Modules that nest as deeply as the limit allows.

use std::fs;

use crate::Filter;

const MANIFEST: &str =
    "name = \"deep\"\nsummary = \"\"\nalignment = \"centred\"\n[[pass]]\nshader = \"deep.spv\"\n";

/// Writes a kernel of `depth` nested branches that do nothing.
fn nest_branches(depth: u32) -> Vec<u8> {
    let first_label = 20;
    let mut words = vec![0x0723_0203, 0x1_0300, 0, first_label + 2 * depth + 2, 0];
    let mut add = |opcode: u32, operands: &[u32]| {
        words.push((operands.len() as u32 + 1) << 16 | opcode);
        words.extend(operands);
    };
    let main = [u32::from_le_bytes(*b"main"), 0];
    // Ids: 1 void, 2 function type, 3 main, 4 bool, 5 true.
    add(17, &[1]);
    add(14, &[0, 1]);
    add(15, &[5, 3, main[0], main[1]]);
    add(16, &[3, 17, 1, 1, 1]);
    add(19, &[1]);
    add(33, &[2, 1]);
    add(20, &[4]);
    add(41, &[4, 5]);
    add(54, &[1, 3, 0, 2]);
    add(248, &[first_label]);
    let inside = |level: u32| first_label + 1 + 2 * level;
    let after = |level: u32| first_label + 2 + 2 * level;
    for level in 0..depth {
        add(247, &[after(level), 0]);
        add(250, &[5, inside(level), after(level)]);
        add(248, &[inside(level)]);
    }
    for level in (0..depth).rev() {
        add(249, &[after(level)]);
        add(248, &[after(level)]);
    }
    add(253, &[]);
    add(56, &[]);
    words.into_iter().flat_map(u32::to_le_bytes).collect()
}

fn load(module: &[u8]) -> String {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("filter.toml"), MANIFEST).unwrap();
    fs::write(folder.path().join("deep.spv"), module).unwrap();
    Filter::load(folder.path()).unwrap_err().to_string()
}

#[test]
fn branches_may_nest_as_deep_as_the_stack_allows() {
    let shallow = load(&nest_branches(2));
    assert!(shallow.contains("writes nothing"), "{shallow}");
    let deep = load(&nest_branches(10_000));
    assert!(deep.contains("deep"), "{deep}");
    let deeper = load(&nest_branches(10_001));
    assert!(
        deeper.contains("has 10001 branches; allowed: at most 10000"),
        "{deeper}"
    );
}
