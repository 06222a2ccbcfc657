//! Sizes of the textures between passes, and inputs of few bits.

use tests::near::assert_within;
use tests::text::assert_contains;

use super::{blur_busy, busy_picture, make};
use crate::filter_files::ready;

#[test]
fn inputs_of_11_bits_and_sides_that_are_rounded_down() {
    // 61 x 43 pixels.
    for (rounding, size) in [("up", [8.0, 1.0]), ("down", [7.0, 1.0])] {
        let declarations = format!(
            "[convention]\ncolor_format = \"rg11b10ufloat\"\n\
             [[texture]]\nname = \"coarse\"\nformat = \"r32float\"\ndivided_by = [8, 64]\nrounding = \"{rounding}\"\n\
             [[pass]]\nshader = \"clear.wgsl\"\nover = \"coarse\"\n[[pass]]\nshader = \"sides.wgsl\"\n"
        );
        let shown = blur_busy(&make("texture_sizes", &declarations));
        let (texel, color) = (shown.at(3, 5), busy_picture().color.at(3, 5)[2]);
        assert_eq!(texel[..2], size, "{rounding}");
        assert_within(texel[2] / color, 63.0 / 64.0..=65.0 / 64.0);
    }
}

#[test]
fn textures_are_divided_by_what_an_engine_computes_of_the_picture() {
    let declare = |divided_by: &str| {
        let declarations = format!(
            "[[parameter]]\nname = \"unit\"\nkind = \"integer\"\ndefault = 8\nrange = [1, 64]\ndoc = \"Pixels.\"\n\
             [[texture]]\nname = \"coarse\"\nformat = \"r32float\"\ndivided_by = {divided_by}\n\
             [[pass]]\nshader = \"clear.wgsl\"\nover = \"coarse\"\n[[pass]]\nshader = \"sides.wgsl\"\n"
        );
        make("texture_sizes", &declarations)
    };
    // 61 x 43 pixels, divided and rounded up.
    #[rustfmt::skip]
    let divided = [
        ("\"ceil(height / 20) * unit\"", [3.0, 2.0]),
        ("\"ceil(max(1, floor(height / 20)) / 8) * unit\"", [8.0, 6.0]),
        ("[\"min(width, 2 * unit)\", \"height - unit\"]", [4.0, 2.0]),
        ("\"unit\"", [8.0, 6.0]),
    ];
    for (divided_by, size) in divided {
        let shown = blur_busy(&declare(divided_by));
        assert_eq!(shown.at(3, 5)[..2], size, "{divided_by}");
    }
    declare("\"unit\"").assert_refused("divided_by");
    // The picture contains the value.
    for (divided_by, message) in [
        ("\"height / 20 + 0 * unit\"", "is 2.15;"),
        ("\"floor(height / 60) * unit\"", "is 0;"),
        ("\"unit / (height - 43)\"", "is inf;"),
        ("\"unit * 10 ^ 10\"", "is 80000000000;"),
    ] {
        let filter = declare(divided_by).load().unwrap();
        let refused = ready(&filter, (61, 43)).unwrap_err();
        let parts = [
            "61x43",
            "divided_by of texture \"coarse\"",
            "whole numbers from 1",
        ];
        assert_contains(&refused.to_string(), &parts);
        assert_contains(&refused.to_string(), &[message]);
    }
}
