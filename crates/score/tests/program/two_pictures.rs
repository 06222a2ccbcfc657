//! `score --reference`: two pictures, and nothing else.

use std::process::Command;
use std::time::{Duration, Instant};

use frame::{ExrFile, Image, Raster, display_srgb, write_exr, write_jpeg, write_png};
use image::{ImageBuffer, Rgb};
use metrics::{Metric, Scores};
use tests::text::assert_contains;

use crate::sandbox::{Sandbox, assert_done, python_with, stdout};

const PNG: &str = "score --reference ref.png --image mine.png";
const EXR: &str = "score --reference ref.exr --image mine.exr";

/// Draws a bright disc over checks, that moves right by `length` pixels while the shutter is open.
fn disc(width: u32, height: u32, length: u32) -> Image {
    let middle = [width / 2, height / 2];
    let radius = height / 4;
    Image::from_fn(width, height, |x, y| {
        let check = 0.2 + 0.2 * ((x / 6 + y / 5) % 2) as f32;
        let inside = (0..length).filter(|step| {
            let center = middle[0] + step - length / 2;
            x.abs_diff(center).pow(2) + y.abs_diff(middle[1]).pow(2) < radius.pow(2)
        });
        let share = inside.count() as f32 / length as f32;
        [check * (1.0 - share) + 1.5 * share, 0.3 - 0.2 * share, 0.1]
    })
}

fn write_radiance(sandbox: &Sandbox, name: &str, color: &Image) {
    let mut file = ExrFile::new(color.width, color.height);
    file.push_color("", color);
    write_exr(&sandbox.path(name), &file).unwrap();
}

/// Writes the reference, a smear of half its length and the sharp picture, as PNG and as OpenEXR.
fn write_pictures(width: u32, height: u32) -> Sandbox {
    let sandbox = Sandbox::of(&Vec::new());
    for (name, length) in [("ref", 12), ("mine", 6), ("sharp", 1)] {
        let color = disc(width, height, length);
        write_radiance(&sandbox, &format!("{name}.exr"), &color);
        let png = sandbox.path(&format!("{name}.png"));
        write_png(&png, &display_srgb(&color, 0.0)).unwrap();
    }
    sandbox
}

fn set_up() -> Sandbox {
    write_pictures(96, 60)
}

fn scores(sandbox: &Sandbox, line: &str) -> Scores {
    let json: serde_json::Value =
        serde_json::from_str(&sandbox.done(&format!("{line} --json"))).unwrap();
    serde_json::from_value(json["scores"].clone()).unwrap()
}

#[test]
fn flip_of_two_pictures_is_that_of_the_tool_of_its_authors() {
    let sandbox = set_up();
    let evaluate = |kind: &str, ending: &str, exposures: &str| -> f64 {
        let script = format!(
            "import flip_evaluator, numpy; error, _, _ = flip_evaluator.evaluate('ref.{ending}', 'mine.{ending}', '{kind}', \
             applyMagma=False, parameters={{{exposures}}}); print(numpy.asarray(error, dtype=numpy.float64).mean())"
        );
        let mut python = Command::new(python_with(&["flip_evaluator", "numpy"]));
        let output = python
            .current_dir(sandbox.path(""))
            .args(["-c", &script])
            .output()
            .unwrap();
        assert_done(&output);
        stdout(&output).trim().parse().unwrap()
    };
    let hdr = "'startExposure': -2.0, 'stopExposure': 2.0, 'numExposures': 5";
    let of_display = scores(&sandbox, PNG).full;
    let linear = scores(&sandbox, EXR).full;
    for (mine, theirs) in [
        (of_display.flip, evaluate("LDR", "png", "")),
        (linear.flip_hdr, evaluate("HDR", "exr", hdr)),
    ] {
        let mine = mine.value().unwrap();
        assert!(theirs > 0.01, "the pictures differ: {theirs}");
        // Both compute in 32 bits, and their rounding grows to about 1e-7 through FLIP's powers. A
        // wrong constant makes 1e-4.
        assert!(
            (mine - theirs).abs() < 1e-6,
            "{mine}, their tool says {theirs}"
        );
    }
}

#[test]
fn two_pictures_have_scores_of_colour_and_the_rest_says_what_it_needs() {
    let sandbox = set_up();
    let text = sandbox.done(PNG);
    assert_contains(
        &text,
        &[
            "ref.png: 8-bit PNG, read as sRGB",
            "mine.png: 8-bit PNG, read as sRGB",
            "FLIP p95    PSNR   SSIM",
            "whole picture",
            "*_moving, *_support, *_static: needs --velocity",
            "flip_hdr_full: needs two scene-linear pictures",
            "unity, gather_offset, gather_spread: needs the filter itself",
        ],
    );
    let scores = scores(&sandbox, PNG);
    // Equal to the last bit: everything but what is named is left out.
    for metric in Metric::all() {
        let is_whole = metric.name().ends_with("_full") && metric.name() != "flip_hdr_full";
        assert_eq!(scores.get(metric).value().is_some(), is_whole, "{metric}");
        // Errors of a region have one name.
        let region = metric
            .name()
            .rsplit('_')
            .next()
            .map(|region| format!("*_{region}"));
        let is_listed = text.contains(&metric.name()) || text.contains(&region.unwrap());
        let is_alone = matches!(
            metric,
            Metric::Sequence(_) | Metric::CommonFlip | Metric::Bleed
        );
        assert!(
            is_whole || is_listed || is_alone,
            "{metric} is not listed in:\n{text}"
        );
    }
}

#[test]
fn a_picture_equals_itself() {
    let sandbox = set_up();
    let scores = scores(&sandbox, "score --reference ref.exr --image ref.exr").full;
    let values =
        [scores.flip, scores.mse, scores.flip_hdr, scores.grain].map(|score| score.value());
    assert_eq!(values, [Some(0.0); 4]);
    assert_eq!(scores.ssim.value(), Some(1.0));
    assert_eq!(scores.psnr.value(), Some(metrics::PSNR_LIMIT));
}

#[test]
fn frame_velocity_and_mattes_add_scores() {
    let sandbox = set_up();
    // The disc of the frame moves by 24 pixels per frame.
    let sharp = disc(96, 60, 1);
    let mut file = ExrFile::new(96, 60);
    file.push_vectors(
        "velocity",
        &sharp.map(|[red, ..]| [if *red > 1.0 { 24.0 } else { 0.0 }, 0.0]),
    );
    write_exr(&sandbox.path("velocity.exr"), &file).unwrap();
    for (name, length) in [("ref", 12), ("mine", 6)] {
        let matte = disc(96, 60, length).map(|[_, green, _]| (0.3 - green) / 0.2);
        let mut file = ExrFile::new(96, 60);
        file.push_plane("coverage.disc", &matte);
        write_exr(&sandbox.path(&format!("{name}_mattes.exr")), &file).unwrap();
    }
    let line = format!(
        "{EXR} --velocity velocity.exr --frame sharp.exr --mattes ref_mattes.exr mine_mattes.exr"
    );
    let text = sandbox.done(&line);
    assert_contains(&text, &["what moves, ", "[no blur: sharp.exr]"]);
    let scores = scores(&sandbox, &line);
    // The checks are the frame's.
    assert_eq!(scores.static_contamination.value(), Some(0.0));
    let [whole, moving] = [&scores.full, &scores.moving].map(|scores| scores.flip.value().unwrap());
    // Nothing differs where nothing moves.
    assert!(moving > 1.2 * whole, "{moving} {whole}");
    // Half of the smear gives some of the shutter to the wrong object.
    let label = scores.label_total_variation.mean.value().unwrap();
    assert!(label > 0.01, "{label}");
    let left_out = ["*_moving", "static_contamination:", " label_tv,"];
    assert!(!left_out.iter().any(|name| text.contains(name)), "{text}");
}

#[test]
fn every_kind_of_file_is_read_as_it_says() {
    let sandbox = set_up();
    let color = disc(96, 60, 6);
    let values = color.pixels.as_flattened().to_vec();
    let picture: ImageBuffer<Rgb<f32>, Vec<f32>> = ImageBuffer::from_raw(96, 60, values).unwrap();
    picture.save(sandbox.path("mine.hdr")).unwrap();
    write_jpeg(&sandbox.path("mine.JPG"), &display_srgb(&color, 0.0)).unwrap();
    let score = |image: &str| {
        let line = format!("score --reference ref.exr --image {image}");
        (
            sandbox.done(&line),
            scores(&sandbox, &line).full.flip.value().unwrap(),
        )
    };
    let (text, exact) = score("mine.exr");
    assert_contains(
        &text,
        &[
            "mine.exr: OpenEXR, read as scene-linear Rec.709",
            "HDR-FLIP",
        ],
    );
    let (text, hdr) = score("mine.hdr");
    assert_contains(
        &text,
        &[
            "mine.hdr: Radiance HDR, read as scene-linear Rec.709",
            "HDR-FLIP",
        ],
    );
    let (text, jpeg) = score("mine.JPG");
    assert_contains(
        &text,
        &[
            "mine.JPG: 8-bit JPEG, read as sRGB",
            "mine.JPG: a JPEG's compression is a part of its scores",
            "ends at display white, which ref.exr exceeds in",
        ],
    );
    assert!(!text.contains("HDR-FLIP "), "{text}");
    // Radiance HDR has 8 bits per channel and one exponent for all three, and a JPEG adds its blocks.
    for (other, allowed) in [(hdr, 0.02), (jpeg, 0.04)] {
        assert!((other - exact).abs() < allowed, "{other} {exact}");
    }
    assert!(jpeg > exact, "{jpeg} {exact}");
}

#[test]
fn linear_pictures_are_compared_at_the_exposure_that_is_asked_for() {
    let sandbox = set_up();
    for name in ["ref", "mine"] {
        let dark = sandbox
            .read_color(&format!("{name}.exr"))
            .map(|pixel| pixel.map(|value| value / 8.0));
        write_radiance(&sandbox, &format!("dark_{name}.exr"), &dark);
    }
    let dark = "score --reference dark_ref.exr --image dark_mine.exr --stops";
    let [bright, lifted, as_is] =
        [EXR, &format!("{dark} 3"), &format!("{dark} -1")].map(|line| scores(&sandbox, line).full);
    assert_eq!(
        [&bright.flip, &bright.flip_hdr],
        [&lifted.flip, &lifted.flip_hdr]
    );
    assert!(as_is.flip.value() < bright.flip.value());
}

#[test]
fn the_page_is_one_file_of_both_pictures_and_the_map() {
    let sandbox = set_up();
    let text = sandbox.done(&format!("{PNG} --frame sharp.png --html p.html"));
    assert_contains(&text, &["written: p.html"]);
    let page = sandbox.text("p.html");
    assert_contains(
        &page,
        &[
            "mine.png against ref.png",
            "truth:0,1,2 output:",
            "instant:",
            "flip:",
        ],
    );
}

/// Words after the command, and parts of the message.
const REFUSED: [(&str, &[&str]); 12] = [
    (
        "--image mine.exr --reference broken.exr",
        &["broken.exr: holds [NaN, ", "at pixel (7, 2)", "finite"],
    ),
    ("--image mine.png", &["--truth <FILE>|--reference <FILE>"]),
    ("--reference ref.png", &["--image"]),
    (
        "--image mine.png --reference ref.png --truth t.exr",
        &["'--reference <FILE>' cannot be used with '--truth <FILE>'"],
    ),
    (
        "--image small.png --reference ref.png",
        &[
            "small.png: has 5x4 pixels, ref.png has 96x60",
            "without scaling",
        ],
    ),
    (
        "--image mine.png --reference ref.png --frame small.png",
        &["small.png: has 5x4 pixels, ref.png has 96x60"],
    ),
    (
        "--image mine.png --reference ref.png --velocity ref.exr --convention no.toml",
        &["no.toml"],
    ),
    (
        "--image mine.png --reference ref.png --mattes ref.exr mine.exr",
        &["ref.exr: has no mattes", "channels coverage.<object>"],
    ),
    (
        "--image mine.gif --reference ref.png",
        &[
            "mine.gif: cannot be scored",
            ".exr, .hdr, .png, .jpg or .jpeg",
        ],
    ),
    (
        "--image torn.jpg --reference ref.png",
        &["torn.jpg", "not a JPEG that can be read"],
    ),
    (
        "--image mine.exr --reference ref.exr --stops 31",
        &["'31' for '--stops <STOPS>'", "from -30 to 30"],
    ),
    (
        "--image mine.png --truth t.exr --frame f.exr --velocity v.exr",
        &["'--truth <FILE>' cannot be used with '--velocity <FILE>'"],
    ),
];

#[test]
fn what_cannot_be_compared_is_refused() {
    let sandbox = set_up();
    write_png(&sandbox.path("small.png"), &Raster::filled(5, 4, [0.5; 3])).unwrap();
    sandbox.put("torn.jpg", "no picture");
    let mut broken = disc(96, 60, 1);
    broken.pixels[2 * 96 + 7][0] = f32::NAN;
    write_radiance(&sandbox, "broken.exr", &broken);
    sandbox.refuse_each("score", &REFUSED);
}

#[test]
#[ignore = "a time, for `make prove`"]
fn two_pictures_of_an_artist_have_a_page_within_10_seconds() {
    let sandbox = write_pictures(1280, 720);
    let start = Instant::now();
    sandbox.done(&format!("{PNG} --html p.html"));
    let took = start.elapsed();
    println!(
        "two pictures of 1280x720 and their page took {:.1} s",
        took.as_secs_f64()
    );
    assert!(took < Duration::from_secs(10), "{took:?}");
}
