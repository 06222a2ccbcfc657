//! SPIR-V of kernels and of vertex stages, translated and bound but not run.

use filters::Filter;

use crate::target::{Shape, Target};

/// SPIR-V modules, with the bindings of the one in the corpus that has the most.
pub static TARGET: Target = Target {
    name: "spirv",
    share: 2_000,
    batch: 500,
    shape: Shape::Spirv,
    tokens: &[],
    seeds: |_| Vec::new(),
    run: |place, input| {
        place.write("spirv/filter.toml", MANIFEST);
        place.write("spirv/gather.spv", input);
        drop(Filter::load(&place.folder.join("spirv")));
        place.write("drawn/filter.toml", DRAWN);
        place.write("drawn/shade.wgsl", SHADE);
        place.write("drawn/corner.spv", input);
        drop(Filter::load(&place.folder.join("drawn")));
    },
};

/// A filter whose vertex stage is the module.
const DRAWN: &str = r#"
name = "drawn"
summary = "A damaged vertex stage."
alignment = "centred"

[[pass]]
shader = "shade.wgsl"
stage = "fragment"
vertex_shader = "corner.spv"
"#;

const SHADE: &str = "@fragment\nfn main(@location(0) uv: vec2<f32>) -> @location(0) vec4<f32> {\n    return vec4<f32>(uv, 0.0, 1.0);\n}\n";

const MANIFEST: &str = r#"
name = "damaged"
summary = "A damaged module."
alignment = "centred"

[[texture]]
name = "tile_motion"
format = "rg32float"

[[pass]]
shader = "gather.spv"

[[pass.binding]]
binding = 0
texture = "color"

[[pass.binding]]
binding = 1
texture = "tile_motion"

[[pass.binding]]
binding = 2
texture = "output"

[[pass.binding]]
binding = 7

[pass.binding.values]
size = ["width", "height"]
shutter_side_samples = ["exposure", 8, 16]
frame = "frame_index"
turned = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
noisy = 1
"#;
