//! Presets against transcriptions of the programs that they follow.

use std::process::{Command, Output};

use tests::root;

use crate::sandbox::{stderr, stdout};

/// Runs examples/fidelity/compare.py. `make test` installs what it needs and names the Python in PYTHON.
fn compare(more: &[&str]) -> Output {
    let python = std::env::var("PYTHON").unwrap_or("python3".to_owned());
    let has_packages = Command::new(&python)
        .args(["-c", "import numpy, OpenEXR"])
        .output();
    assert!(
        has_packages.is_ok_and(|output| output.status.success()),
        "{python} lacks numpy or OpenEXR: `make test` installs them; or pip install numpy OpenEXR, and set PYTHON to the \
         Python that has them"
    );
    let out = tempfile::tempdir().unwrap();
    let mut command = Command::new(python);
    command
        .arg("-B")
        .arg(root().join("examples/fidelity/compare.py"))
        .args(["--program", env!("CARGO_BIN_EXE_shuttertruth")]);
    command.arg("--scenes-dir").arg(tests::scenes());
    command.arg("--out").arg(out.path()).args(more);
    command.output().unwrap()
}

/// Returns the rows of all tables, without the columns of numbers, which depend on the adapter.
fn rows(page: &str) -> Vec<Vec<String>> {
    let cells = |line: &str| -> Vec<String> {
        let cells = line.trim_matches('|').split('|');
        cells.map(|cell| cell.trim().to_owned()).collect()
    };
    let rows = page
        .lines()
        .filter(|line| line.starts_with("| `"))
        .map(cells);
    rows.map(|row| match row.as_slice() {
        [preset, original, .., verdict] => vec![preset.clone(), original.clone(), verdict.clone()],
        short => short.to_vec(),
    })
    .collect()
}

#[test]
fn presets_match_their_originals_as_far_as_the_page_says() {
    let output = compare(&[]);
    let printed = stdout(&output);
    assert!(output.status.success(), "{printed}{}", stderr(&output));
    let page = std::fs::read_to_string(root().join("docs/fidelity.md")).unwrap();
    let kept = page.split("\n## ").next().unwrap();
    assert!(
        rows(kept) == rows(&printed),
        "docs/fidelity.md keeps another table; put there what the script prints:\n{printed}"
    );
    assert!(rows(kept).len() > 20, "{} rows", rows(kept).len());
}

#[test]
fn a_changed_filter_does_not_match_its_original() {
    for (preset, change) in [
        ("bevy:default", "bevy.metric=pixel"),
        ("jimenez:hdrp", "jimenez.extent=0.5"),
        ("jimenez:hdrp_mirrored", "jimenez.mirror=slow_background"),
        ("jimenez:kajiya", "jimenez.noise=shift"),
        ("jimenez:o3de", "jimenez.tile_lookup=nearest"),
        ("jimenez:wicked", "jimenez.border=clamp"),
        ("three:default", "three.divisor=fetches"),
        ("three:default", "three.coordinates=texture"),
        ("babylon:default", "babylon.storage=exact"),
        ("realism_effects:default", "realism_effects.jitter=0.5"),
        ("bevy:msaa", "bevy.fetch=filtered"),
        ("mcguire:g3d", "mcguire.neighbor_rule=all"),
        ("kino:default", "kino.least_motion=1"),
        ("jump_flood:july_2024", "jump_flood.map=float32"),
        ("jump_flood:july_2024", "jump_flood.way_back=first_match"),
    ] {
        let output = compare(&["--only", preset, "--set", change]);
        assert_eq!(output.status.code(), Some(1), "{preset} with {change}");
        assert!(
            stdout(&output).contains("| BROKEN |"),
            "{}",
            stdout(&output)
        );
        assert!(stderr(&output).contains(preset), "{}", stderr(&output));
    }
}
