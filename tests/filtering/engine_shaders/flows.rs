//! Control flows of shaders, plain and optimised: a right picture, or a refusal.

use tests::picture::{BLACK_WALL, Picture};
use tests::text::assert_contains;

use super::make;
use crate::filter_files::{FilterFiles, ready};

const CHANGED: &str = "naga, which translates it, changes the control flow of its function";
const FALLS: &str =
    "falls through into the next one, in a `switch` in which several labels share a body";

/// Flows that naga gets wrong, as GLSL or as the optimised module, each with words of the refusal.
/// All others come out right.
const REFUSED: [(&str, &str, &str); 7] = [
    ("fall_through_default", "glsl", CHANGED),
    ("fall_through_default", "spv", CHANGED),
    ("return_in_switch_in_loop", "spv", CHANGED),
    ("shared_fall_through", "glsl", FALLS),
    ("shared_fall_through", "spv", FALLS),
    ("switch_in_switch", "spv", CHANGED),
    ("switch_twice_in_loop", "spv", CHANGED),
];

/// Makes a filter that shows a flow.
fn show(shader: &str) -> FilterFiles {
    let pass = format!(
        "[[pass]]\nshader = \"{shader}\"\n[[pass.binding]]\nname = \"result\"\ntexture = \"output\"\n"
    );
    make("flows", &pass)
}

/// Makes the filters of a flow: of its GLSL, and of the optimised module.
fn make_both(name: &str) -> [(&'static str, FilterFiles); 2] {
    let plain = show("flow.comp");
    let text = plain.text(&format!("{name}.glsl"));
    [
        ("glsl", plain.changed("flow.comp", "FLOW", &text)),
        ("spv", show(&format!("{name}.spv"))),
    ]
}

/// Shows a flow; an error if the filter is refused, when it is loaded or when it is compiled.
fn run(files: &FilterFiles) -> Result<Vec<f32>, String> {
    let filter = files.load().map_err(|error| error.to_string())?;
    let picture = Picture::uniform(16, 1, BLACK_WALL);
    let mut blur = ready(&filter, (16, 1)).map_err(|error| error.to_string())?;
    let outputs = blur.run(&picture.input(&[&picture.color]));
    let outputs = outputs.map_err(|error| error.to_string())?;
    Ok(outputs[0].pixels.iter().map(|pixel| pixel[0]).collect())
}

#[test]
fn every_control_flow_is_right_or_refused() {
    let expected = make("flows", "").text("expected.txt");
    for line in expected.lines() {
        let (name, numbers) = line.split_once(' ').unwrap();
        let numbers: Vec<f32> =
            (numbers.split(' ').map(|number| number.parse().unwrap())).collect();
        for (kind, files) in make_both(name) {
            let mut refused = REFUSED
                .iter()
                .filter(|refusal| refusal.0 == name && refusal.1 == kind);
            match (run(&files), refused.next()) {
                (Ok(shown), None) => assert_eq!(shown, numbers, "{name}, {kind}"),
                (Err(error), Some((.., words))) => assert_contains(&error, &[words]),
                (outcome, _) => panic!("{name}, {kind}: {outcome:?}"),
            }
        }
    }
    let names: Vec<&str> = expected
        .lines()
        .map(|line| line.split(' ').next().unwrap())
        .collect();
    assert!(REFUSED.iter().all(|(name, ..)| names.contains(name)));
}
