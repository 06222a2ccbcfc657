//! Filter folders that no device could run, that fail within their own ranges, or that attack their reader.

mod device;
mod text;

use std::process::Output;

use filters::Filter;

use crate::sandbox::Sandbox;

const MANIFEST: &str = r#"name = "mine"
summary = "Averages a few samples."
alignment = "trailing"

[[parameter]]
name = "samples"
kind = "integer"
default = 4
range = [1, 64]
doc = "Taps."

[[parameter]]
name = "gain"
kind = "real"
default = 1.0
range = [0.5, 2.0]
doc = "Times as bright."

[[preset]]
name = "plain"
doc = "As it is."

[[pass]]
entry = "work"
"#;

const KERNELS: &str = "struct Parameters {
    samples: i32,
    gain: f32,
}
@group(0) @binding(1) var<uniform> parameters: Parameters;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var output: texture_storage_2d<rgba32float, write>;
// declarations
@compute @workgroup_size(8, 8)
fn work(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) { return; }
    let here = textureLoad(color, pixel, 0);
    var value = vec4<f32>(0.0);
    for (var i = 0; i < parameters.samples; i++) {
        value += here;
    }
    // statements
    textureStore(output, pixel, parameters.gain * value / f32(parameters.samples));
}
";

/// Makes a sandbox with the filter `mine`, after these replacements in its files.
fn write_mine(changes: &[(&str, &str)]) -> Sandbox {
    let sandbox = Sandbox::new();
    change(&sandbox, changes);
    sandbox
}

fn change(sandbox: &Sandbox, changes: &[(&str, &str)]) {
    let (mut manifest, mut kernels) = (MANIFEST.to_owned(), KERNELS.to_owned());
    for (from, to) in changes {
        assert!(manifest.contains(from) || kernels.contains(from), "{from}");
        manifest = manifest.replacen(from, to, 1);
        kernels = kernels.replacen(from, to, 1);
    }
    sandbox.write_filter("mine", &manifest, &kernels);
}

fn list(sandbox: &Sandbox) -> Output {
    sandbox.shuttertruth(&["list", "--filter", "mine"])
}

fn load(sandbox: &Sandbox) -> Result<Filter, String> {
    Filter::load(&sandbox.path("mine")).map_err(|error| error.to_string())
}
