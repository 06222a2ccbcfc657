//! Filters that fail on a scene: the run goes on, and every output names the lost case.

use tests::text::assert_contains;

use crate::sandbox::{Sandbox, assert_done, assert_refused, split, stderr, stdout};

/// Kernel with an infinite output at one pixel, at the exposure of the scene `dim`.
const BODY: &str = "
    var value = textureLoad(color, pixel, 0);
    if pixel.x == 9 && pixel.y == 4 { value /= frame.exposure - 0.25; }
    textureStore(output, pixel, value);
";

/// Makes two scenes; the filter `torn` fails on one.
fn set_up() -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.copy_scene("dim", |text| {
        text.replace("exposure = 0.5", "exposure = 0.25")
    });
    sandbox.write_kernel("torn", "", &[], BODY);
    sandbox
}

#[test]
fn a_run_names_the_failed_case_and_goes_on() {
    let sandbox = set_up();
    let words = ["--filters", "identity,./torn", "--html", "page.html"];
    let output = sandbox.run(&words);
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    let failures = sandbox.read_run().failures;
    let [failure] = &failures[..] else {
        panic!("one case fails: {failures:?}");
    };
    assert!(failure.scene == "dim" && failure.filter == "torn:default");
    assert_contains(&failure.reason, &["pass work: writes [", "to pixel (9, 4)"]);
    let measured = "dim identity:default, plate identity:default, plate torn:default";
    assert_eq!(sandbox.read_case_names().join(", "), measured);
    let row = "dim / torn:default\n  FAILED filter torn";
    assert_contains(&stdout(&output), &[row]);
    assert_contains(&stderr(&output), &["1 case failed"]);
    let page = sandbox.text("page.html");
    assert!(page.contains("<strong>dim / torn:default</strong>"));
    // Measured cases are kept, and the failed one is tried again.
    assert_eq!(sandbox.run(&words).status.code(), Some(1));
    assert_eq!(sandbox.read_run().failures, failures);
    // A run with failures cannot become a baseline.
    let accept = split("limits accept --out out --baseline base.json --reason none");
    let refused = sandbox.outside_ci(&accept);
    assert_refused(&refused, 1, &["1 case failed", "torn:default on dim"]);
    assert!(!sandbox.path("base.json").exists());
}

#[test]
fn a_check_with_a_failed_case_is_broken() {
    let sandbox = set_up();
    let bounds = "[default]\nflip_moving = { limit = 0.99, why = \"it serves a test\" }\n";
    sandbox.put("scenes/bounds.toml", bounds);
    let check = |more: &str| sandbox.check(&split(&format!("--filters ./torn {more}")));
    let output = check("--junit junit.xml");
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    assert_contains(&stdout(&output), &["dim / torn:default\n  FAILED"]);
    let junit = sandbox.text("junit.xml");
    assert_contains(&junit, &["type=\"failed\""]);
    let verdict: serde_json::Value = serde_json::from_slice(&check("--json").stdout).unwrap();
    assert_eq!(verdict["decision"], "broken");
    assert_eq!(verdict["failures"][0]["scene"], "dim");
    assert_done(&check("--scenes plate"));
}

/// A `switch` that the driver makes an endless loop of, and the device is lost: naga writes a wrong
/// jump.
const FALLING: &str = "#version 450
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D color;
layout(set = 0, binding = 1, rgba32f) uniform writeonly image2D result;
void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, imageSize(result)))) return;
    vec4 sum = texelFetch(color, at, 0);
    switch (at.x % 5) {
    case 3:
    case 2:
        sum *= 2.0;
    default:
        sum *= 3.0;
    }
    imageStore(result, at, sum);
}
";

#[test]
fn a_shader_that_would_lose_the_device_is_refused_and_the_others_are_measured() {
    let sandbox = set_up();
    let bindings = "[[pass]]\nshader = \"falling.comp\"\n[[pass.binding]]\nname = \"color\"\n\
                    [[pass.binding]]\nname = \"result\"\ntexture = \"output\"\n";
    let manifest = format!(
        "name = \"falling\"\nsummary = \"It serves a test.\"\nalignment = \"trailing\"\n{bindings}"
    );
    sandbox.put("falling/filter.toml", &manifest);
    sandbox.put("falling/falling.comp", FALLING);
    let words = "falling/falling.comp: a `case` falls through into the next one";
    sandbox.refuse(
        "list --filter ./falling",
        &[words, "end the case with `break`"],
    );
    let filters = ["--filters", "./falling,identity", "--scenes", "plate"];
    let output = sandbox.run(&filters);
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    assert_contains(&stderr(&output), &["1 case failed", words]);
    assert_eq!(sandbox.read_case_names(), ["plate identity:default"]);
}
