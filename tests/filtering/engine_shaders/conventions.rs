//! Shaders that expect velocity, depth and colour in engines' forms.

use tests::near::assert_near;

use super::{blur_busy, busy_picture, make};
use crate::filter_files::FilterFiles;

fn declare(convention: &str) -> FilterFiles {
    make(
        "conventions",
        &format!("{convention}\n[[pass]]\nshader = \"seen.wgsl\"\n"),
    )
}

#[test]
fn a_shader_sees_what_its_engine_would_show_it() {
    let picture = busy_picture();
    // 61 x 43 pixels, exposure 0.7; pixel (12, 9) moves by (9.5, -4.25) at a depth of 14 m.
    let (width, height, exposure) = (61.0, 43.0, 0.7);
    let (x, y, z) = (9.5, -4.25, 14.0);
    let gray = f64::from(picture.color.at(12, 9)[0]);
    // (convention, expected velocity and depth, expected factor on colour)
    #[rustfmt::skip]
    let cases = [
        ("", [x, y, z], 1.0),
        ("velocity = \"uv\"\nvelocity_sign = \"previous_minus_current\"", [-x / width, -y / height, z], 1.0),
        ("velocity = \"ndc\"\nvelocity_y = \"up\"\nvelocity_per = \"shutter\"", [2.0 * x / width * exposure, -2.0 * y / height * exposure, z], 1.0),
        ("velocity_per = \"second\"\nframes_per_second = 60", [60.0 * x, 60.0 * y, z], 1.0),
        ("velocity = \"uv\"\nvelocity_scale = 0.5\nvelocity_bias = 0.5", [0.5 * x / width + 0.5, 0.5 * y / height + 0.5, z], 1.0),
        ("velocity_scale = 0.5\ndepth = \"reversed\"\nnear = 0.1", [0.5 * x, 0.5 * y, 0.1 / z], 1.0),
        ("color_scale = 4.0\ndepth = \"forward\"\nnear = 1\nfar = 29", [x, y, 1.0 - (29.0 - z) / (z * 28.0)], 4.0),
    ];
    for (convention, seen, scale) in cases {
        println!("{convention}");
        let output = blur_busy(&declare(&format!("[convention]\n{convention}")));
        for (actual, seen) in output.at(12, 9).iter().zip(seen) {
            // The output is divided by the factor that colours were multiplied by.
            assert_near(*actual, seen / scale + 100.0 * gray, 1e-3);
        }
    }
}

#[test]
fn an_unknown_convention_is_refused() {
    let files = declare("[convention]\nvelocity = \"uv\"\n");
    files.assert_refused("conventions");
}
