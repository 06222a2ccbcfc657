//! What must hold for every filter that the program brings, with every preset.

use filters::{Blur, Filter, Gpu, Input, Kernels, Settings};
use frame::{Alignment, FAR_DEPTH, Image, Plane, Raster, Reprojection, Vectors};
use tests::kernels::{Steady, expected_ramp};
use tests::presets::{every_preset, preset_name};
use tests::ramp::Ramp;
use tests::random::Random;

fn gpu() -> Gpu {
    Gpu::new(None).expect("these tests run filters")
}

#[derive(Clone)]
struct Field {
    color: Image,
    velocity: Vectors,
    depth: Plane,
    reprojection: Reprojection,
    exposure: f64,
}

const WIDTH: u32 = 71;
const HEIGHT: u32 = 43;

impl Field {
    /// Highlights up to 10000, still pixels, motion up to 60 pixels, near surfaces and far background.
    fn random(seed: u64) -> Self {
        let mut random = Random::new(seed);
        let color = Raster::from_fn(WIDTH, HEIGHT, |_, _| {
            let highlight = random.real(0.0, 20.0) < 1.0;
            let top = if highlight { 1e4 } else { 1.0 };
            std::array::from_fn(|_| random.real(0.0, top))
        });
        let velocity = Raster::from_fn(WIDTH, HEIGHT, |_, _| {
            let still = random.real(0.0, 4.0) < 1.0;
            let top = if still { 0.0 } else { 60.0 };
            std::array::from_fn(|_| random.real(-1.0, 1.0) * top)
        });
        let depth = Raster::from_fn(WIDTH, HEIGHT, |_, _| {
            let far = random.real(0.0, 8.0) < 1.0;
            let near = random.real(0.2, 40.0);
            if far { FAR_DEPTH } else { near }
        });
        Self {
            color,
            velocity,
            depth,
            // A pan, a zoom, and a step aside.
            reprojection: Reprojection {
                rows: [
                    [1.02, 0.0, 9.0, 15.0],
                    [0.0, 1.02, -5.0, 3.0],
                    [0.0, 0.0, 1.0, 0.1],
                ],
            },
            exposure: 0.8,
        }
    }

    fn blurred(&self, gpu: &Gpu, filter: &Filter, settings: &Settings) -> Image {
        let mut outputs = self.blurred_colors(gpu, filter, settings, &[&self.color]);
        outputs.remove(0)
    }

    fn blurred_colors(
        &self,
        gpu: &Gpu,
        filter: &Filter,
        settings: &Settings,
        color: &[&Image],
    ) -> Vec<Image> {
        let (width, height) = (self.color.width, self.color.height);
        let mut blur = Blur::new(gpu, filter, settings, width, height).unwrap();
        blur.run(&self.input(color)).unwrap()
    }

    fn input<'a>(&'a self, color: &'a [&'a Image]) -> Input<'a> {
        Input {
            color,
            velocity: &self.velocity,
            depth: &self.depth,
            reprojection: Some(self.reprojection),
            exposure: self.exposure,
            frame_index: 3,
        }
    }
}

#[test]
fn a_still_frame_comes_out_unchanged() {
    let gpu = gpu();
    let mut field = Field::random(1);
    field.velocity = Raster::filled(WIDTH, HEIGHT, [0.0, 0.0]);
    field.reprojection = Reprojection::STILL;
    for (filter, settings) in every_preset() {
        let output = field.blurred(&gpu, &filter, &settings);
        // Bit for bit: a pixel that does not move has nothing to average.
        assert!(output == field.color, "{}", preset_name(&filter, &settings));
    }
}

#[test]
fn a_constant_colour_comes_out_constant() {
    let gpu = gpu();
    for color in [[0.2, 0.7, 0.0], [1e4, 3.3e-5, 1.0]] {
        let mut field = Field::random(2);
        field.color = Raster::filled(WIDTH, HEIGHT, color);
        for (filter, settings) in every_preset() {
            let output = field.blurred(&gpu, &filter, &settings);
            // Bit for bit: a running mean of equal values adds nothing.
            assert!(output == field.color, "{}", preset_name(&filter, &settings));
        }
    }
}

#[test]
fn output_stays_finite_and_within_the_colours_of_the_frame() {
    let gpu = gpu();
    for seed in 3..6 {
        let field = Field::random(seed);
        for (filter, settings) in every_preset() {
            let output = field.blurred(&gpu, &filter, &settings);
            for channel in 0..3 {
                let values = |image: &Image| -> Vec<f32> {
                    image.pixels.iter().map(|pixel| pixel[channel]).collect()
                };
                let brightest = values(&field.color).into_iter().fold(0.0, f32::max);
                for value in values(&output) {
                    // Weights are not negative; rounding of a mean of 20 taps may pass the ends by a few parts in 1e6.
                    let slack = 1e-5 * brightest;
                    assert!(
                        value.is_finite() && value >= -slack && value <= brightest + slack,
                        "{}: {value} from colours of 0 to {brightest}",
                        preset_name(&filter, &settings)
                    );
                }
            }
        }
    }
}

#[test]
fn two_runs_give_the_same_bytes_whatever_ran_before() {
    let gpu = gpu();
    let (field, other) = (Field::random(6), Field::random(7));
    for (filter, settings) in every_preset() {
        let mut blur = Blur::new(&gpu, &filter, &settings, WIDTH, HEIGHT).unwrap();
        let first = blur.run(&field.input(&[&field.color])).unwrap();
        blur.run(&other.input(&[&other.color])).unwrap();
        let again = blur.run(&field.input(&[&field.color])).unwrap();
        let fresh = field.blurred(&gpu, &filter, &settings);
        let name = preset_name(&filter, &settings);
        assert_eq!(bits(&first[0]), bits(&again[0]), "{name}");
        assert_eq!(bits(&first[0]), bits(&fresh), "{name}");
    }
}

/// Compared as bits: NaN would equal nothing, and -0 equals 0.
fn bits(image: &Image) -> Vec<u32> {
    let values = image.pixels.as_flattened().iter();
    values.map(|value| value.to_bits()).collect()
}

#[test]
fn inputs_and_kernels_that_stay_on_the_gpu_give_the_bytes_of_fresh_ones() {
    let gpu = gpu();
    let (field, other) = (Field::random(6), Field::random(7));
    let matte = field.color.map(|[r, ..]| [*r, 0.0, 0.5]);
    let mut filter_before: Option<(Filter, Kernels)> = None;
    for (filter, settings) in every_preset() {
        // The presets of a filter share its kernels.
        if filter_before
            .as_ref()
            .is_none_or(|(before, _)| before.name != filter.name)
        {
            let kernels = Kernels::compile(&gpu, &filter).unwrap();
            filter_before = Some((filter.clone(), kernels));
        }
        let (_, kernels) = filter_before.as_ref().expect("it was compiled above");
        let colors = [&field.color, &matte];
        let [input, between] = [field.input(&colors), other.input(&[&other.color])]
            .map(|input| kernels.upload(&input).unwrap());
        let mut blur = Blur::with_kernels(kernels, &settings, WIDTH, HEIGHT).unwrap();
        blur.run_uploaded(&between).unwrap();
        let kept = blur.run_uploaded(&input).unwrap();
        let fresh = field.blurred_colors(&gpu, &filter, &settings, &colors);
        for (kept, fresh) in kept.iter().zip(&fresh) {
            assert_eq!(
                bits(kept),
                bits(fresh),
                "{}",
                preset_name(&filter, &settings)
            );
        }
        assert_eq!(kept.len(), 2);
    }
}

#[test]
fn every_colour_goes_through_the_same_weights() {
    let gpu = gpu();
    let field = Field::random(8);
    let matte = field
        .color
        .map(|[r, ..]| if *r > 0.5 { [1.0, 0.0, 0.5] } else { [0.0; 3] });
    for (filter, settings) in every_preset() {
        let colors = [&field.color, &matte, &field.color];
        let together = field.blurred_colors(&gpu, &filter, &settings, &colors);
        let alone = field.blurred_colors(&gpu, &filter, &settings, &[&matte]);
        assert!(
            together[1] == alone[0],
            "{}",
            preset_name(&filter, &settings)
        );
        assert!(
            together[0] == together[2],
            "{}",
            preset_name(&filter, &settings)
        );
    }
}

#[test]
fn a_mixture_of_images_comes_out_as_the_mixture_of_their_blurs() {
    let gpu = gpu();
    let [field, other] = [Field::random(11), Field::random(12)];
    let mix = |a: &Image, b: &Image| a.zip(b, |a, b| [0, 1, 2].map(|c| 0.25 * a[c] + 0.75 * b[c]));
    let mixture = mix(&field.color, &other.color);
    let brightest = field
        .color
        .pixels
        .as_flattened()
        .iter()
        .copied()
        .fold(0.0, f32::max);
    for (filter, settings) in every_preset() {
        let colors = [&field.color, &other.color, &mixture];
        let outputs = field.blurred_colors(&gpu, &filter, &settings, &colors);
        let expected = mix(&outputs[0], &outputs[1]);
        let deviation = expected
            .zip(&outputs[2], |a, b| [0, 1, 2].map(|c| (a[c] - b[c]).abs()))
            .pixels
            .as_flattened()
            .iter()
            .copied()
            .fold(0.0, f32::max);
        println!(
            "{}: {:.1e} of the brightest",
            preset_name(&filter, &settings),
            deviation / brightest
        );
        // Up to a hundred taps, each a product and a sum in 32-bit floats.
        assert!(
            deviation <= 1e-5 * brightest,
            "{}",
            preset_name(&filter, &settings)
        );
    }
}

fn mirrored(field: &Field, horizontal: bool) -> Field {
    fn turn<T: Copy>(raster: &Raster<T>, horizontal: bool) -> Raster<T> {
        Raster::from_fn(raster.width, raster.height, |x, y| match horizontal {
            true => *raster.at(raster.width - 1 - x, y),
            false => *raster.at(x, raster.height - 1 - y),
        })
    }
    let velocity = turn(&field.velocity, horizontal);
    Field {
        color: turn(&field.color, horizontal),
        velocity: velocity.map(|[x, y]| if horizontal { [-x, *y] } else { [*x, -y] }),
        depth: turn(&field.depth, horizontal),
        reprojection: mirrored_camera(field, usize::from(!horizontal)),
        exposure: field.exposure,
    }
}

/// With x = side - x' on both sides, along one axis.
fn mirrored_camera(field: &Field, axis: usize) -> Reprojection {
    let side = f64::from([field.color.width, field.color.height][axis]);
    let mut rows = field.reprojection.rows.map(|mut row| {
        row[2] += side * row[axis];
        row[axis] = -row[axis];
        row
    });
    let common = rows[2];
    for (value, common) in rows[axis].iter_mut().zip(common) {
        *value = side * common - *value;
    }
    Reprojection { rows }
}

/// Pixels that differ by more than 1e-3 of the brightest tap: many times the rounding of positions (1e-5 pixels) times
/// the contrast of neighbours, and far below the weight of one tap of twenty.
fn asymmetric_pixels(gpu: &Gpu, field: &Field, filter: &Filter, settings: &Settings) -> usize {
    let output = field.blurred(gpu, filter, settings);
    let mut count = 0;
    for horizontal in [true, false] {
        let turned = mirrored(field, horizontal);
        let back = mirrored(
            &Field {
                color: turned.blurred(gpu, filter, settings),
                ..turned.clone()
            },
            horizontal,
        );
        count += output
            .pixels
            .iter()
            .zip(&back.color.pixels)
            .filter(|(a, b)| (0..3).any(|c| (a[c] - b[c]).abs() > 1e-3))
            .count();
    }
    count
}

/// Colours up to 1 and no two depths alike, so that nothing but the geometry decides.
fn distinct_depths(seed: u64) -> Field {
    let mut field = Field::random(seed);
    let mut random = Random::new(seed);
    field.color = field.color.map(|pixel| pixel.map(|value| value.min(1.0)));
    field.depth = field.depth.map(|_| random.real(0.2, 40.0));
    field
}

#[test]
fn a_mirrored_frame_gives_the_mirrored_output() {
    let gpu = gpu();
    let field = distinct_depths(9);
    let symmetric = every_preset()
        .into_iter()
        .filter(|(filter, _)| filter.mirror_symmetric);
    let mut tried = 0;
    for (filter, settings) in symmetric {
        let count = asymmetric_pixels(&gpu, &field, &filter, &settings);
        assert_eq!(count, 0, "{}", preset_name(&filter, &settings));
        tried += 1;
    }
    assert!(
        tried >= 4,
        "identity and three presets of velocity_gather declare themselves symmetric"
    );
}

#[test]
fn the_jump_flood_is_symmetric_but_for_noise_equal_depths_and_rounded_places() {
    let gpu = gpu();
    let filter = Filter::builtin("jump_flood").unwrap();
    for preset in &filter.presets {
        let mut settings = filter.settings(Some(&preset.name)).unwrap();
        settings.set(&filter, "jitter", "none").unwrap();
        // Between texels of random depth, rounding of a position moves replaced taps by tenths of a pixel.
        if settings.values["tap"].to_string() == "replaced" {
            settings.set(&filter, "fetch", "nearest").unwrap();
        }
        // 16 bits round places towards the top left.
        settings.set(&filter, "map", "float32").unwrap();
        let count = asymmetric_pixels(&gpu, &distinct_depths(10), &filter, &settings);
        // Of 2 x 3053 pixels; a tap on the edge of a texel, or a decision within rounding of its threshold, may fall
        // either way.
        assert!(count <= 6, "preset {}: {count} pixels differ", preset.name);
    }
}

#[test]
fn frames_of_noise_made_together_are_those_made_one_by_one() {
    let gpu = gpu();
    let field = Field::random(21);
    let mut noisy = 0;
    for (filter, settings) in every_preset() {
        let (width, height) = (field.color.width, field.color.height);
        let mut blur = Blur::new(&gpu, &filter, &settings, width, height).unwrap();
        let colors = [&field.color];
        let input = |frame_index: u32| Input {
            frame_index,
            ..field.input(&colors)
        };
        let alone = [0, 1, 5].map(|index| blur.run(&input(index)).unwrap().remove(0));
        match blur.run_noise(&input(0), [0, 1, 5]).unwrap() {
            Some(together) => {
                assert_eq!(together, alone, "{}", preset_name(&filter, &settings));
                noisy += 1;
            }
            None => assert!(
                alone[1] == alone[0] && alone[2] == alone[0],
                "{} has noise",
                preset_name(&filter, &settings)
            ),
        }
    }
    assert!(noisy > 10, "only {noisy} presets draw noise");
}

const EDGE: u32 = 120;

/// A white wall left or right of an edge; `whole` says whether the black beside it moves along, at the same depth.
fn wall(left: bool, whole: bool, speed: f32, exposure: f64) -> Field {
    let (width, height) = (2 * EDGE, 31);
    let wall = |x: u32| (x < EDGE) == left;
    Field {
        color: Raster::from_fn(width, height, |x, _| [if wall(x) { 1.0 } else { 0.0 }; 3]),
        velocity: Raster::from_fn(width, height, |x, _| {
            [if whole || wall(x) { speed } else { 0.0 }, 0.0]
        }),
        depth: Raster::from_fn(width, height, |x, _| {
            if whole || wall(x) { 2.0 } else { FAR_DEPTH }
        }),
        // A camera past which everything at the wall's depth moves so.
        reprojection: Reprojection {
            rows: [
                [1.0, 0.0, 0.0, -2.0 * f64::from(speed)],
                [0.0, 1.0, 0.0, 0.0],
                [0.0, 0.0, 1.0, 0.0],
            ],
        },
        exposure,
    }
}

/// What became of the edge, along the motion.
fn ramp(output: &Image) -> Ramp {
    // Over all rows, noise becomes the distribution that it is drawn from.
    let mean = |x: u32| {
        (0..output.height)
            .map(|y| f64::from(output.at(x, y)[0]))
            .sum::<f64>()
    };
    // What a filter does at the border of the image is not of the edge.
    let profile: Vec<(f64, f64)> = (11..output.width - 12)
        .map(|x| (f64::from(x) + 0.5 - f64::from(EDGE), mean(x)))
        .collect();
    Ramp::of(&profile)
}

#[test]
fn an_edge_in_steady_motion_smears_to_the_right_side_and_length() {
    let gpu = gpu();
    // Two presets smear farther than this wall is wide; tests of their own measure them.
    let longer = |(filter, settings): &(Filter, Settings)| {
        filter.name == "jimenez" && ["o3de", "wicked"].contains(&settings.preset.as_str())
    };
    for (filter, settings) in every_preset().into_iter().filter(|it| !longer(it)) {
        // Trails of 24 and 12 pixels are below the jump flood's cut of 32, and their halves below most tiles.
        for (speed, exposure) in [(24.0, 1.0), (24.0, 0.5), (-24.0, 1.0)] {
            let field = wall(true, true, speed, exposure);
            let found = ramp(&field.blurred(&gpu, &filter, &settings));
            let steady = Steady {
                velocity: [speed.into(), 0.0],
                exposure,
                size: [field.color.width, field.color.height],
            };
            let expected = expected_ramp(&filter.name, &settings.preset, &steady);
            let said = format!(
                "{} at {speed} x {exposure}",
                preset_name(&filter, &settings)
            );
            // Half a pixel: the edge is between texels, and 8 taps of noise in 31 rows place it to a tenth of a step.
            assert!(
                (found.length - expected.length).abs() < 0.5,
                "{said}: {} pixels long, expected {}",
                found.length,
                expected.length
            );
            let middle = expected.middle * f64::from(speed.signum());
            assert!(
                (found.middle - middle).abs() < 0.5,
                "{said}: in the middle of {}, expected {middle}",
                found.middle
            );
        }
    }
}

/// Light that a white wall with its edge at the left or right, moving right over black, leaves on the black.
fn light_beside_a_wall(gpu: &Gpu, filter: &Filter, settings: &Settings, left: bool) -> f32 {
    let output = wall(left, false, 24.0, 1.0).blurred(gpu, filter, settings);
    let black = if left { EDGE..output.width } else { 0..EDGE };
    black.map(|x| output.at(x, 15)[0]).sum()
}

#[test]
fn no_trailing_filter_smears_ahead_of_a_mover() {
    let gpu = gpu();
    for (filter, settings) in every_preset() {
        if filter.alignment == Alignment::Trailing {
            let light = light_beside_a_wall(&gpu, &filter, &settings, true);
            // What lies ahead of the edge has not been touched yet.
            assert_eq!(light, 0.0, "{}", preset_name(&filter, &settings));
        }
    }
}

#[test]
fn filters_that_carry_motion_smear_over_what_lies_beside_a_mover() {
    let gpu = gpu();
    for (filter, settings) in every_preset() {
        let light = |left: bool| light_beside_a_wall(&gpu, &filter, &settings, left);
        let name = preset_name(&filter, &settings);
        // An even trail of 24 pixels leaves the light of 12 behind the wall; a centred one that of 3 on either side.
        match filter.name.as_str() {
            "jump_flood" | "jump_flood_packed" => {
                assert!(light(false) > 6.0, "{name}: {}", light(false))
            }
            "mcguire" | "guertin" | "jimenez" => {
                let sides = [light(true), light(false)];
                // Seven sixteenths of that, and noise that shortens most trails.
                let least = match settings.preset.as_str() {
                    "kajiya" | "wicked_scaled" => 0.6,
                    _ => 1.5,
                };
                assert!(
                    sides.iter().all(|light| *light > least),
                    "{name}: {sides:?}"
                );
            }
            _ => assert_eq!(light(false), 0.0, "{name}"),
        }
    }
}

#[test]
fn the_corrected_jump_flood_makes_whole_trails_where_the_paper_cuts_them() {
    let gpu = gpu();
    let filter = Filter::builtin("jump_flood").unwrap();
    let trail_behind = |preset: &str, speed: f32| {
        let settings = filter.settings(Some(preset)).unwrap();
        let field = wall(false, false, speed, 1.0);
        ramp(&field.blurred(&gpu, &filter, &settings)).length
    };
    for speed in [3.0f32, 8.0, 24.0, 48.0, 90.0] {
        let found = trail_behind("corrected", speed);
        // The texel adds one pixel of its own: sqrt(speed^2 + 1). Then half a pixel for the noise.
        let expected = f64::from(speed.hypot(1.0));
        assert!(
            (found - expected).abs() < 0.5,
            "{speed}: {found} instead of {expected}"
        );
    }
    // Its smallest step is 8 pixels, which is further than a slow mover goes.
    assert_eq!(trail_behind("paper", 7.0), 0.0);
    // Its largest step is 32 pixels, and noise may make half as much again of it.
    assert!(trail_behind("paper", 90.0) < 48.0);
}
