//! Pictures that begin at the bottom left, as in OpenGL.

use filters::Filter;
use tests::near::assert_near;
use tests::text::assert_contains;

use super::{blur_busy, busy_picture, make, make_declared};
use crate::filter_files::FilterFiles;

const HEIGHT: u32 = 43;

/// Shows rows, texture coordinates and clip space of a shader, with more keys of its pass.
fn show_rows(origin: &str, keys: &str) -> FilterFiles {
    let pass =
        format!("[convention]\norigin = \"{origin}\"\n[[pass]]\nshader = \"rows.frag\"\n{keys}");
    make("opengl", &pass)
}

#[test]
fn rows_coordinates_and_clip_space_count_from_the_origin() {
    let vertex_key = "vertex_shader = \"corner.vert\"\n";
    for (origin, keys) in [
        ("top_left", ""),
        ("bottom_left", ""),
        ("bottom_left", vertex_key),
    ] {
        let shown = blur_busy(&show_rows(origin, keys));
        for y in [0, 7, HEIGHT - 1] {
            let below = y as f32 + 0.5;
            let above = HEIGHT as f32 - below;
            let row = if origin == "top_left" { below } else { above };
            let [found_row, v, clip] = *shown.at(5, y);
            assert_near(found_row, row, 1e-4);
            assert_near(v, row / HEIGHT as f32, 1e-5);
            // Clip space has +y up in the picture, whatever the origin.
            assert_near(clip, 2.0 * above / HEIGHT as f32 - 1.0, 1e-5);
        }
    }
}

#[test]
fn textures_and_the_picture_are_turned_over_together() {
    let shows = "#version 450\nlayout(binding = 0) uniform sampler2D color;\nlayout(binding = 1) uniform sampler2D velocity;\n\
                 layout(binding = 2) uniform sampler2D depth;\nlayout(location = 0) out vec4 shown;\nvoid main() {\n\
                 ivec2 pixel = ivec2(gl_FragCoord.xy);\n\
                 shown = vec4(texelFetch(color, pixel, 0).r, texelFetch(velocity, pixel, 0).y, texelFetch(depth, pixel, 0).r, 1.0);\n}\n";
    let pass = "[convention]\norigin = \"bottom_left\"\n[[pass]]\nshader = \"shows.frag\"\n";
    let shown = blur_busy(&make("opengl", pass).with("shows.frag", shows));
    let picture = busy_picture();
    for (x, y) in [(12, 9), (40, 30), (0, 0)] {
        // Velocity has +y away from the origin.
        let due = [
            picture.color.at(x, y)[0],
            -picture.velocity.at(x, y)[1],
            *picture.depth.at(x, y),
        ];
        for (actual, due) in shown.at(x, y).iter().zip(due) {
            assert_near(*actual, due, 1e-6);
        }
    }
}

#[test]
fn glsl_of_opengl_says_its_origin_and_its_loose_uniforms() {
    make_declared("opengl", "tutorial.toml").assert_refused("opengl");
    // With bindings, only the velocity shows that it may be of OpenGL.
    let bound = show_rows("top_left", "");
    bound.load().unwrap();
    let unsure = bound.changed(
        "filter.toml",
        "origin = \"top_left\"",
        "velocity_y = \"up\"",
    );
    let error = unsure.load().unwrap_err().to_string();
    let parts = [
        "rows.frag:7: has gl_FragCoord, and [convention] has velocity_y = \"up\" and no origin",
        "write origin = \"bottom_left\" if it is of OpenGL",
    ];
    assert_contains(&error, &parts);
}

#[test]
fn what_counts_from_the_top_left_refuses_another_origin() {
    let files = FilterFiles::read(&tests::root().join("shaders/velocity_gather"));
    let with = |files: &FilterFiles| {
        let text = files.text("filter.toml");
        let (head, tail) = text.split_once("[[").unwrap();
        files.clone().with(
            "filter.toml",
            format!("{head}[convention]\norigin = \"bottom_left\"\n[[{tail}"),
        )
    };
    let refusal = |result: Result<Filter, filters::FilterError>| result.unwrap_err().to_string();
    let error = refusal(with(&files).load());
    assert_contains(
        &error,
        &["kernels of velocity_gather.wgsl count rows from the top left"],
    );
}
