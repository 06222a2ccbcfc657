//! Values that engines set every frame: camera matrices, picture size, jitter and times.

use filters::{Filter, Input};
use frame::{Camera, CameraPose, Frame, Image};
use tests::near::assert_near;
use tests::picture::frame_input;
use tests::text::assert_contains;

use super::{blur_busy, busy_picture, make};
use crate::camera_gather::render_frame;
use crate::filter_files::{FilterFiles, ready};

const REVERSED: &str = "depth = \"reversed\"\nnear = 0.1";

/// Makes a filter from a shader that writes the velocity given by depth and the camera, in pixels.
/// `bindings` are those of depth, the picture and the block.
fn declare(file: &str, [depth, picture, block]: [u32; 3], convention: &str) -> FilterFiles {
    // Only GLSL has the texture and its sampler in one variable.
    let sampler = if file.ends_with(".comp") {
        "sampler = \"nearest\"\n"
    } else {
        ""
    };
    let declarations = format!(
        "[convention]\n{convention}\n[[pass]]\nshader = \"{file}\"\n\
         [[pass.binding]]\nbinding = {depth}\ntexture = \"depth\"\n{sampler}\
         [[pass.binding]]\nbinding = {picture}\ntexture = \"output\"\n\
         [[pass.binding]]\nbinding = {block}\nvalues = {{ padding = 0, previous = \"previous_view_projection\" }}\n"
    );
    make("camera", &declarations)
}

fn run(filter: &Filter, frame: &Frame, camera: Option<Camera>) -> Result<Image, String> {
    let mut blur = ready(filter, frame.size()).unwrap();
    let colors = [&frame.color];
    let input = Input {
        reprojection: None,
        camera,
        ..frame_input(frame, &colors)
    };
    let outputs = blur.run(&input).map_err(|error| error.to_string());
    outputs.map(|mut outputs| outputs.remove(0))
}

#[test]
fn depth_and_the_camera_s_matrices_give_its_velocity_in_every_language() {
    let frames = [0, 7].map(render_frame);
    // Row-major engines pass rows.
    for (file, layout, bindings) in [
        ("move.comp", "", [0, 1, 2]),
        ("move.comp", "layout(row_major)", [0, 1, 2]),
        ("move.hlsl", "", [100, 200, 0]),
        ("move.hlsl", "row_major", [100, 200, 0]),
        ("move.wgsl", "", [0, 1, 2]),
    ] {
        let ranges = "near = 0.5\nfar = 40";
        let (forward, ndc) = (
            format!("depth = \"forward\"\n{ranges}"),
            format!("depth = \"ndc\"\n{ranges}"),
        );
        for convention in [REVERSED, &forward, &ndc] {
            let files = declare(file, bindings, convention);
            let text = files.text(file).replace("LAYOUT", layout);
            let filter = files.with(file, text).load().unwrap();
            for frame in &frames {
                let output = run(&filter, frame, frame.camera).unwrap();
                let apart = output.zip(&frame.velocity, |actual, expected| {
                    (actual[0] - expected[0])
                        .abs()
                        .max((actual[1] - expected[1]).abs())
                });
                let compared = apart.pixels.iter().zip(&frame.depth.pixels);
                let near = compared.filter(|(_, depth)| **depth < 30.0);
                let worst = near.map(|(apart, _)| *apart).fold(0.0, f32::max);
                // Depth of 32 bits between 0 and 1, and a division by it.
                assert!(worst < 0.02, "{file}, {layout}, {convention}: {worst}");
            }
        }
    }
}

#[test]
fn matrices_in_structs_lie_as_those_of_the_block_itself() {
    let frame = render_frame(7);
    let names = [
        "inverse_projection",
        "inverse_view",
        "previous",
        "resolution",
        "jitter",
    ];
    let macros = names
        .map(|name| format!("#define {name} GBuffer.{name}\n"))
        .concat();
    let block = format!("jitter;\n}};\ncbuffer Scene : register(b0) {{ View GBuffer; }}\n{macros}");
    let members = [0, 1, 3, 4]
        .map(|at| format!(", GBuffer.{0} = \"{0}\"", names[at]))
        .concat();
    for layout in ["", "row_major"] {
        let files = declare("move.hlsl", [100, 200, 0], REVERSED);
        let flat = files.text("move.hlsl").replace("LAYOUT", layout);
        let nested = flat.replace("cbuffer Scene : register(b0)", "struct View");
        let nested = nested.replace("jitter;\n};", &block);
        let files = files.with("move.hlsl", flat);
        let in_struct = (files.changed(
            "filter.toml",
            "padding = 0, previous",
            "GBuffer.padding = 0, GBuffer.previous",
        ))
        .changed(
            "filter.toml",
            "view_projection\"",
            &format!("view_projection\"{members}"),
        )
        .with("move.hlsl", nested);
        let [due, actual] =
            [files, in_struct].map(|files| run(&files.load().unwrap(), &frame, frame.camera));
        assert_eq!(due.unwrap(), actual.unwrap(), "{layout}");
    }
}

/// Values of a frame by the names of filter.toml, and the numbers of the frame below.
const FRAME_VALUES: [(&str, f32); 22] = [
    ("width", 61.0),
    ("height", 43.0),
    ("resolution[1]", 43.0),
    ("jitter[0]", 0.0),
    ("frame_index", 3.0),
    ("exposure", 0.7),
    ("delta_time", 0.02),
    ("frames_per_second", 50.0),
    ("color_scale", 2.0),
    ("near", 0.5),
    ("iteration", 0.0),
    ("iterations", 1.0),
    ("inverse_view[12]", 5.0),
    ("inverse_view[13]", 6.0),
    ("inverse_view[2]", 1.0),
    ("view[8]", 1.0),
    ("projection[5]", 2.0),
    ("projection[11]", -1.0),
    ("previous_projection[5]", 4.0),
    ("previous_inverse_view[12]", 0.0),
    ("inverse_projection[5]", 0.5),
    ("previous_inverse_view_projection[5]", 0.25),
];

#[test]
fn every_value_of_a_frame_has_the_number_that_its_name_says() {
    let pose = CameraPose {
        to_world: [
            [0.0, 0.0, -1.0, 5.0],
            [0.0, 1.0, 0.0, 6.0],
            [1.0, 0.0, 0.0, 7.0],
        ],
        ..CameraPose::at_origin(43.0)
    };
    let before = CameraPose::at_origin(86.0);
    let names = || FRAME_VALUES.iter().map(|(name, _)| name).enumerate();
    let members: String =
        (names().map(|(index, _)| format!("    value_{index}: f32,\n"))).collect();
    let values: Vec<String> =
        (names().map(|(index, name)| format!("value_{index} = \"{name}\""))).collect();
    let sums: Vec<String> = (names())
        .map(|(index, _)| format!("select(0.0, values.value_{index}, id.x == {index}u)"))
        .collect();
    let shader = format!(
        "struct Values {{\n{members}}}\n@group(0) @binding(0) var<uniform> values: Values;\n\
         @group(0) @binding(1) var output: texture_storage_2d<rgba32float, write>;\n\
         @compute @workgroup_size(8, 8)\nfn main(@builtin(global_invocation_id) id: vec3<u32>) {{\n\
         textureStore(output, id.xy, vec4<f32>({}));\n}}\n",
        sums.join(" + ")
    );
    let declarations = format!(
        "[convention]\nframes_per_second = 50\ncolor_scale = 2\ndepth = \"reversed\"\nnear = 0.5\n\
         [[pass]]\nshader = \"show.wgsl\"\n[[pass.binding]]\nbinding = 0\nvalues = {{ {} }}\n",
        values.join(", ")
    );
    let files = make("camera", &declarations).with("show.wgsl", &shader);
    let picture = busy_picture();
    let colors = [&picture.color];
    let input = Input {
        frame_index: 3,
        camera: Some(Camera { now: pose, before }),
        ..picture.input(&colors)
    };
    let mut blur = ready(&files.load().unwrap(), (61, 43)).unwrap();
    let output = blur.run(&input).unwrap().remove(0);
    for (index, (name, expected)) in FRAME_VALUES.into_iter().enumerate() {
        println!("{name}");
        // Colours are divided by their scale.
        assert_near(
            2.0 * output.at(index as u32, 3)[0],
            f64::from(expected),
            1e-5,
        );
    }
}

#[test]
fn a_frame_without_its_camera_is_refused() {
    let frame = render_frame(0);
    let filter = declare("move.wgsl", [0, 1, 2], REVERSED).load().unwrap();
    let refusal = run(&filter, &frame, None).unwrap_err();
    let parts = [
        "does not say where its camera was",
        "\"camera\"",
        "`render`",
    ];
    assert_contains(&refusal, &parts);
    // A shader without matrices needs no camera.
    let plain = "[[pass]]\nshader = \"plain.wgsl\"\nstage = \"fragment\"\n\
                 [[pass.binding]]\nbinding = 0\nvalues = { \"@0\" = \"resolution\" }\n";
    let shader = "@group(0) @binding(0) var<uniform> size: vec2<f32>;\n\
                  @fragment fn main() -> @location(0) vec4<f32> { return vec4<f32>(size, 0.0, 1.0); }\n";
    let output = blur_busy(&make("camera", plain).with("plain.wgsl", shader));
    assert_eq!(*output.at(4, 4), [61.0, 43.0, 0.0]);
}

#[test]
fn values_that_the_convention_does_not_give_are_refused() {
    let files = declare("move.wgsl", [0, 1, 2], REVERSED);
    files.assert_refused("camera");
}
