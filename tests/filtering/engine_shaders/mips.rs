//! Textures with mip levels: a pyramid of the fastest motions, level by level.

use filters::Filter;
use frame::{Image, Raster};
use tests::near::assert_within;
use tests::picture::{Picture, white};
use tests::text::assert_contains;

use super::{blur, busy_picture, largest_difference};
use crate::filter_files::{FilterFiles, ready};

const DRAWN: (&str, &str) = (
    "shader = \"halve.comp\"\nover = \"pyramid\"\nrepeat = 4\n",
    "shader = \"halve.wgsl\"\nstage = \"fragment\"\ntargets = [\"pyramid\"]\nlevel = \"iteration + 1\"\nrepeat = 4\n",
);

const WRITTEN: &str =
    "[[pass.binding]]\nbinding = 1\ntexture = \"pyramid\"\nlevel = \"iteration + 1\"\n";

fn pyramid() -> FilterFiles {
    FilterFiles::fixture("filters/mips")
}

/// Makes the pyramid with fragment shaders.
fn drawn() -> FilterFiles {
    let drawn = pyramid().changed("filter.toml", DRAWN.0, DRAWN.1);
    let drawn = drawn.changed("filter.toml", WRITTEN, "");
    // The fragment shader reads without a sampler.
    let read = "level = \"iteration\"\n";
    drawn.changed(
        "filter.toml",
        &format!("{read}sampler = \"nearest\"\n"),
        read,
    )
}

/// Computes the level of the pyramid by hand.
fn expected_level(level: u32) -> Raster<f32> {
    let speed = |v: &[f32; 2]| v[0].hypot(v[1]);
    let mut finer = busy_picture().velocity.map(speed);
    for _ in 0..level {
        let size = [finer.width, finer.height].map(|side| (side / 2).max(1));
        finer = Raster::from_fn(size[0], size[1], |x, y| {
            let reach = |at: u32, size: u32| if at == size - 1 { 2 } else { 1 };
            let mut fastest = 0.0_f32;
            for row in 0..=reach(y, size[1]) {
                for column in 0..=reach(x, size[0]) {
                    let (x, y) = (2 * x + column, 2 * y + row);
                    let texel = finer.at(x.min(finer.width - 1), y.min(finer.height - 1));
                    fastest = fastest.max(*texel);
                }
            }
            fastest
        });
    }
    finer
}

fn show(filter: &Filter, level: f64) -> Image {
    let mut settings = filter.settings(None).unwrap();
    settings.set(filter, "level", &level.to_string()).unwrap();
    blur(filter, &settings, &busy_picture())
}

#[test]
fn a_pyramid_of_the_fastest_motions_is_that_of_the_cpu() {
    for files in [pyramid(), drawn()] {
        let filter = files.load().unwrap();
        for level in 0..5 {
            let expected = expected_level(level);
            let shown = show(&filter, f64::from(level));
            let shown_of = |at: u32, side: u32, texels: u32| {
                ((f64::from(at) + 0.5) / f64::from(side) * f64::from(texels)) as u32
            };
            let expected = Raster::from_fn(61, 43, |x, y| {
                let column = shown_of(x, 61, expected.width);
                [*expected.at(column, shown_of(y, 43, expected.height)); 3]
            });
            let difference = largest_difference(&shown, &expected);
            assert!(difference < 1e-5, "level {level}: {difference}");
        }
    }
}

#[test]
fn samplers_take_the_nearest_level_or_mix_two() {
    let shown = "sampler = \"nearest\"\n\n[[pass.binding]]\nbinding = 1\ntexture = \"output\"";
    let linear = shown.replacen('\n', "\nmip_filter = \"linear\"\n", 1);
    let mixed = pyramid().changed("filter.toml", shown, &linear);
    let [plain, mixed] = [pyramid(), mixed].map(|files| files.load().unwrap());
    let [low, high] = [1.0, 2.0].map(|level| show(&plain, level));
    assert_eq!(show(&plain, 1.25), low);
    let between = low.zip(&high, |a, b| [0, 1, 2].map(|i| 0.75 * a[i] + 0.25 * b[i]));
    // Samplers have 8 binary digits between levels, of speeds up to 25.
    assert_within(largest_difference(&show(&mixed, 1.25), &between), ..0.1);
    assert_within(largest_difference(&low, &between), 1.0..);
}

#[test]
fn small_pictures_have_fewer_levels() {
    let filter = pyramid().load().unwrap();
    let small = Picture::uniform(5, 3, white(4.0));
    // Three levels: 5 x 3, 2 x 1 and 1 x 1.
    let output = blur(&filter, &filter.settings(None).unwrap(), &small);
    assert!(output.pixels.iter().all(|pixel| *pixel == [4.0; 3]));
}

#[test]
fn wrong_levels_are_refused() {
    pyramid().assert_refused("levels");
    drawn().assert_refused("drawn_levels");
    // (text, replacement, words): only the settings' numbers reveal these.
    #[rustfmt::skip]
    let wrong = [
        ("level = \"iteration + 1\"", "level = \"iteration\"", "reads level 0 of \"pyramid\", which it writes"),
        ("level = \"iteration + 1\"", "level = \"iteration - 1\"", "level = -1; allowed: from 0"),
        ("repeat = 4", "repeat = 3", "may read level 4 of \"pyramid\", which no pass has written"),
        ("level = \"iteration\"\n", "", "may read level 1 of \"pyramid\", which no pass has written"),
    ];
    for (from, to, says) in wrong {
        let filter = pyramid().changed("filter.toml", from, to).load().unwrap();
        let refused = ready(&filter, (61, 43)).unwrap_err();
        assert_contains(&refused.to_string(), &["pass ", says]);
    }
}
