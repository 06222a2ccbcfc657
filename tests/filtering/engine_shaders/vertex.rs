//! Fragment shaders with their own vertex stage.

use tests::near::{assert_near, assert_within};
use tests::text::assert_contains;

use super::{blur_busy, busy_picture, largest_difference, make};

const SAMPLED: &str = "[[pass.binding]]\nname = \"color_sampler\"\nsampler = \"nearest\"\n";

const WGSL_PASS: &str =
    "[[pass]]\nshader = \"draw.wgsl\"\nstage = \"fragment\"\nvertex = \"full_screen\"\n";

const GLSL_PASS: &str = "[[pass]]\nshader = \"draw.frag\"\nvertex_shader = \"corner.vert\"\n\
                         [[pass.binding]]\nbinding = 0\ntexture = \"color\"\nsampler = \"nearest\"\n\
                         [[pass.binding]]\nset = 2\nbinding = 5\nvalues = { side = 1 }\n";

/// Both stages in one file, as Godot has them; the fragment shader alone says `noperspective`.
const GODOT_PASS: &str = "[[pass]]\nshader = \"draw.glsl\"\nstage = \"fragment\"\nvertex = \"main\"\n\
                          [[pass.binding]]\nbinding = 0\ntexture = \"color\"\nsampler = \"nearest\"\n";

const HLSL_PASS: &str = "[[pass]]\nshader = \"draw.hlsl\"\nentry = \"shade\"\nstage = \"fragment\"\nvertex = \"corners\"\n";

#[test]
fn a_vertex_stage_of_the_file_draws_as_the_program_s_own() {
    let picture = busy_picture();
    let pass_of_file = WGSL_PASS.replace("vertex = \"full_screen\"\n", "");
    for pass in [
        &format!("{pass_of_file}{SAMPLED}"),
        &format!("{WGSL_PASS}{SAMPLED}"),
        GLSL_PASS,
        GODOT_PASS,
        &format!("{HLSL_PASS}{SAMPLED}"),
    ] {
        let output = blur_busy(&make("vertex", pass));
        for (x, y) in [(0, 0), (12, 9), (40, 30), (58, 39)] {
            let due = picture.color.at(x + 2, y + 3);
            assert_eq!(output.at(x, y), due, "{pass} at ({x}, {y})");
        }
    }
    // Values reach the blocks of the vertex stage.
    let glsl = make("vertex", GLSL_PASS);
    let output = blur_busy(&glsl.changed("filter.toml", "side = 1", "side = -1"));
    assert_eq!(output.at(12, 9), picture.color.at(60 - 12 + 2, 42 - 9 + 3));
    assert_within(largest_difference(&output, &picture.color), 0.5..);
}

/// Declarations of inputs that the program's triangle fills, and what a pixel of each column shows
/// of them.
const PLACES: [(&str, &str); 5] = [
    ("in float", "place_0, 0, 0, 1"),
    ("noperspective in vec2", "place_1, 0, 1"),
    ("centroid in vec3", "place_2, 1"),
    ("noperspective in vec4", "place_3.yzw, 1"),
    ("flat in vec2", "place_4, 1, 1"),
];

#[test]
fn the_program_s_triangle_has_the_place_of_a_pixel_as_engines_do() {
    let pass = "[[pass]]\nshader = \"place.frag\"\n";
    let files = |inputs: &str, shown: &str| {
        let text = format!(
            "#version 450\n{inputs}layout(location = 0) out vec4 result;\nvoid main() {{\n{shown}}}\n"
        );
        make("vertex", pass).with("place.frag", text)
    };
    let (mut inputs, mut shown) = (String::new(), String::new());
    for (index, (input, values)) in PLACES.iter().enumerate() {
        let (location, column) = (2 + index, 12 + index);
        inputs += &format!("layout(location = {location}) {input} place_{index};\n");
        shown += &format!("if (int(gl_FragCoord.x) == {column}) result = vec4({values});\n");
    }
    let shown = blur_busy(&files(&inputs, &format!("result = vec4(0.0);\n{shown}")));
    for index in 0..PLACES.len() {
        // Texture coordinates from the top left, then clip space with +y up.
        let (u, v) = ((12.5 + index as f64) / 61.0, 9.5 / 43.0);
        let (x, y) = (2.0 * u - 1.0, 1.0 - 2.0 * v);
        let due = [
            [u, 0.0, 0.0],
            [u, v, 0.0],
            [u, v, x],
            [v, x, y],
            [0.0, 0.0, 1.0],
        ];
        println!("{:?}", PLACES[index]);
        for (actual, due) in shown.at(12 + index as u32, 9).iter().zip(due[index]) {
            // Coordinates are interpolated over the triangle.
            assert_near(*actual, due, 1e-4);
        }
    }
    let whole = files(
        "layout(location = 2) flat in int place;\n",
        "result = vec4(place);\n",
    );
    let whole = whole.load().unwrap_err();
    let says = "pass \"place\": the fragment shader reads no floats at location 2; the program's triangle has texture coordinates";
    assert_contains(&whole.to_string(), &["filter.toml:4:", says, "`vertex`"]);
}

#[test]
fn a_pass_of_a_shader_lab_file_draws_as_its_hlsl_alone() {
    let hlsl = include_str!("../../fixtures/filters/vertex/draw.hlsl");
    let (shared, program) = hlsl.split_at(hlsl.find("Corner corners").unwrap());
    let file = format!(
        "Shader \"Blur\" {{\nHLSLINCLUDE\n{shared}ENDHLSL\nSubShader {{\nPass {{\nName \"Black\"\nHLSLPROGRAM\nbroken\n\
         ENDHLSL\n}}\nPass {{\nName \"Draw\"\nHLSLPROGRAM\n#pragma vertex corners\n{program}ENDHLSL\n}} }} }}\n"
    );
    let pass = HLSL_PASS.replace("draw.hlsl\"", "draw.shader\"\nshader_pass = \"Draw\"");
    let lab = make("vertex", &format!("{pass}{SAMPLED}")).with("draw.shader", file);
    let alone = make("vertex", &format!("{HLSL_PASS}{SAMPLED}"));
    assert_eq!(blur_busy(&lab), blur_busy(&alone));
    let by_place = lab.changed("filter.toml", "\"Draw\"", "1");
    assert_eq!(blur_busy(&by_place), blur_busy(&alone));
    lab.assert_refused("shader_lab");
}

#[test]
fn wrong_vertex_stages_are_refused() {
    let wgsl = make("vertex", &format!("{WGSL_PASS}{SAMPLED}"));
    wgsl.assert_refused("vertex_wgsl");
    let glsl = make("vertex", GLSL_PASS);
    let place = "vec2((gl_VertexIndex << 1) & 2, gl_VertexIndex & 2)";
    glsl.changed("corner.vert", place, "corner")
        .assert_refused("vertex_attributes");
    glsl.assert_refused("vertex_glsl");
    let map = "layout(set = 0, binding = 9) uniform sampler2D map;\nvoid main() {";
    glsl.changed("corner.vert", "void main() {", map)
        .assert_refused("vertex_texture");
}
