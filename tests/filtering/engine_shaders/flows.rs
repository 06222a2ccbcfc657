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

/// A flow and its numbers, from left to right.
struct Flow {
    name: String,
    numbers: Vec<f32>,
}

fn read_flows() -> Vec<Flow> {
    let expected = make("flows", "").text("expected.txt");
    let read = |line: &str| {
        let (name, numbers) = line.split_once(' ').unwrap();
        let numbers = numbers.split(' ').map(|number| number.parse().unwrap());
        Flow {
            name: name.to_owned(),
            numbers: numbers.collect(),
        }
    };
    expected.lines().map(read).collect()
}

/// Makes a filter of a flow's GLSL.
fn show_plain(name: &str) -> FilterFiles {
    let files = show("flow.comp");
    let text = files.text(&format!("{name}.glsl"));
    files.changed("flow.comp", "FLOW", &text)
}

/// Makes one filter of several flows, a row of the picture for each: one start of the compiler.
fn show_rows(flows: &[&Flow]) -> FilterFiles {
    let files = show("flow.comp");
    let (mut functions, mut calls) = (String::new(), String::new());
    for (row, Flow { name, .. }) in flows.iter().enumerate() {
        let text = files.text(&format!("{name}.glsl"));
        assert!(text.starts_with("float f("), "{name}");
        functions += &text.replacen("float f(", &format!("float f_{row}("), 1);
        calls += &format!("    if (gl_GlobalInvocationID.y == {row}u) s = f_{row}(a);\n");
    }
    let all =
        format!("{functions}float f(float a) {{\n    float s = 0.0;\n{calls}    return s;\n}}\n");
    files.changed("flow.comp", "FLOW", &all)
}

/// Returns the words of the refusal of a flow; none if naga gets it right.
fn refusal(name: &str, kind: &str) -> Option<&'static str> {
    let mut refused = REFUSED.iter();
    let refusal = refused.find(|refusal| refusal.0 == name && refusal.1 == kind)?;
    Some(refusal.2)
}

/// Fails unless a flow alone has its numbers, or is refused as it should be.
fn check_alone(flow: &Flow, kind: &str, files: &FilterFiles) {
    let name = &flow.name;
    match (run(files, 1), refusal(name, kind)) {
        (Ok(rows), None) => assert_eq!(rows[0], flow.numbers, "{name}, {kind}"),
        (Err(error), Some(words)) => assert_contains(&error, &[words]),
        (outcome, _) => panic!("{name}, {kind}: {outcome:?}"),
    }
}

/// Shows a flow; an error if the filter is refused, when it is loaded or when it is compiled.
fn run(files: &FilterFiles, rows: u32) -> Result<Vec<Vec<f32>>, String> {
    let filter = files.load().map_err(|error| error.to_string())?;
    let picture = Picture::uniform(16, rows, BLACK_WALL);
    let mut blur = ready(&filter, (16, rows)).map_err(|error| error.to_string())?;
    let outputs = blur.run(&picture.input(&[&picture.color]));
    let outputs = outputs.map_err(|error| error.to_string())?;
    let rows = outputs[0].pixels.chunks(16);
    Ok(rows
        .map(|row| row.iter().map(|pixel| pixel[0]).collect())
        .collect())
}

#[test]
fn every_control_flow_is_right_or_refused() {
    let flows = read_flows();
    let is_known = |name| flows.iter().any(|flow| flow.name == name);
    assert!(REFUSED.iter().all(|(name, ..)| is_known(*name)));
    for flow in &flows {
        check_alone(flow, "spv", &show(&format!("{}.spv", flow.name)));
    }
    let is_right = |flow: &&Flow| refusal(&flow.name, "glsl").is_none();
    let (right, refused): (Vec<&Flow>, Vec<&Flow>) = flows.iter().partition(is_right);
    for flow in refused {
        check_alone(flow, "glsl", &show_plain(&flow.name));
    }
    let rows = run(&show_rows(&right), right.len() as u32).unwrap();
    for (flow, row) in right.iter().zip(rows) {
        assert_eq!(row, flow.numbers, "{}", flow.name);
    }
}

#[test]
#[ignore = "prove: the shader of each control flow alone"]
fn every_plain_control_flow_is_right_or_refused_alone() {
    for flow in read_flows() {
        check_alone(&flow, "glsl", &show_plain(&flow.name));
    }
}
