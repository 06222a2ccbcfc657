//! Wrong blurs of known wrongness: each score says what was done, and stays silent about what was not.

use std::sync::LazyLock;

use frame::{Frame, Picture, Plane, Raster, Truth};
use metrics::{Ideal, ImageMetric, Measured, Metric, Reference, Score, Scores};
use tests::synthetic::{Blur, Object, Sampling, Scene, Shape, VIEWING, constant};

const RADIUS: f64 = 14.0;
const TRAVEL: f64 = 30.0;
const ANGLES: [f64; 4] = [0.0, 30.0, 45.0, 90.0];

/// Rows of pixels at an angle to the motion keep their mass only as well as a box pixel samples the outline: measured
/// below 0.02 px over the angles here; a filter's bleed that matters is above 0.2 px.
const ROWS: f64 = 0.05;
/// Sums of single-precision mattes, sampled 512 times: what is exactly 0 by geometry.
const NOTHING: f64 = 1e-6;

/// What rows along the motion have more or less of.
const ROW_MASS: [&str; 3] = ["lateral_growth", "row_gain", "row_loss"];

fn direction(degrees: f64) -> [f64; 2] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    [cos, sin]
}

/// A shape whose smear has its middle a little off the picture's, and stays inside when it is too long or too late.
fn slide(shape: Shape, degrees: f64) -> Scene {
    let along = direction(degrees);
    Scene {
        width: 128,
        height: 116,
        objects: vec![Object::sliding(
            shape,
            [
                64.3 + along[0] * TRAVEL / 2.0,
                58.2 + along[1] * TRAVEL / 2.0,
            ],
            along.map(|component| component * TRAVEL),
        )],
    }
}

/// A scene with its frame and truth.
struct Case {
    scene: Scene,
    frame: Frame,
    truth: Truth,
}

impl Case {
    fn new(scene: Scene) -> Self {
        Self {
            frame: scene.frame(),
            truth: scene.truth([Sampling::CLEAN; 2]),
            scene,
        }
    }

    fn score_pictures<const N: usize>(&self, pictures: [Picture; N]) -> [Scores; N] {
        let reference = Reference::new(&self.frame, &self.truth, None, &VIEWING)
            .expect("frame and truth belong together");
        pictures.map(|picture| {
            reference
                .measure(&picture)
                .expect("a finite picture")
                .scores
        })
    }

    fn score_blurs<const N: usize>(&self, blurs: [Blur; N]) -> [Scores; N] {
        self.score_pictures(blurs.map(|blur| self.scene.render(&blur, Sampling::CLEAN)))
    }
}

/// A disc that slides at each of the angles.
static DISCS: LazyLock<[Case; 4]> =
    LazyLock::new(|| ANGLES.map(|degrees| Case::new(slide(Shape::Disc(RADIUS), degrees))));

fn discs() -> impl Iterator<Item = (f64, &'static Case)> {
    ANGLES.into_iter().zip(DISCS.iter())
}

fn get(scores: &Scores, name: &str) -> f64 {
    let metric: Metric = name.parse().expect("a metric's name");
    match scores.get(metric) {
        Measured::Score(Score { value, .. }) => value,
        Measured::NotApplicable { reason } => panic!("{name} is not applicable: {reason}"),
    }
}

#[track_caller]
fn assert_near(what: &str, found: f64, expected: f64, tolerance: f64) {
    assert!(
        (found - expected).abs() <= tolerance,
        "{what}: {found}, expected {expected} within {tolerance}"
    );
}

/// Standard deviation along the motion, within rows, of a disc smeared over `travel` pixels.
fn spread_of_disc(travel: f64) -> f64 {
    (RADIUS * RADIUS / 4.0 + travel * travel / 12.0).sqrt()
}

#[test]
fn the_truth_itself_scores_perfectly() {
    let [scores] = DISCS[1].score_blurs([Blur::TRUE]);
    for metric in Metric::all() {
        let Measured::Score(score) = scores.get(metric) else {
            continue;
        };
        let perfect = match (metric, metric.ideal()) {
            (_, Ideal::Lowest) => 0.0,
            (_, Ideal::Target(target)) => target,
            (Metric::Image(ImageMetric::Psnr, _), Ideal::Highest) => metrics::PSNR_LIMIT,
            (_, Ideal::Highest) => 1.0,
        };
        assert_near(&metric.name(), score.value, perfect, 1e-9);
    }
}

#[test]
fn blurs_that_only_err_along_the_motion_neither_grow_nor_gain_nor_lose() {
    for (degrees, disc) in discs() {
        let half = Blur {
            from: -0.5,
            ..Blur::TRUE
        };
        let blurs = [
            Blur::IDENTITY,
            half,
            Blur::accumulation(2),
            Blur::accumulation(4),
            Blur::accumulation(16),
        ];
        for (scores, blur) in disc.score_blurs(blurs).iter().zip(blurs) {
            let what = |name: &str| format!("{name} of {blur:?} at {degrees} degrees");
            for name in ROW_MASS {
                assert_near(&what(name), get(scores, name), 0.0, ROWS);
            }
            for name in ["bleed_lateral", "bleed_leading", "bleed_trailing"] {
                assert_near(&what(name), get(scores, name), 0.0, NOTHING);
            }
            // Sampling of 512 per pixel, over thousands of pixels.
            assert_near(&what("energy"), get(scores, "energy"), 1.0, 1e-3);
        }
    }
}

#[test]
fn the_floor_of_growth_is_what_the_instants_own_rows_differ_by() {
    for (degrees, disc) in discs() {
        let [scores] = disc.score_blurs([Blur::IDENTITY]);
        for name in ROW_MASS {
            let score = scores.get(name.parse().expect("a metric's name"));
            let Measured::Score(Score { value, floor }) = score else {
                panic!("{name} of a translation at {degrees} degrees: {score:?}");
            };
            // The truth has no noise here, and the identity's rows are the instant's.
            assert_near(name, floor, value, 1e-12);
        }
    }
}

#[test]
fn a_blur_of_the_wrong_length_is_misplaced_by_half_of_what_is_missing() {
    for (degrees, disc) in discs() {
        let lengths = [0.0, 0.5, 1.5];
        let blurs = lengths.map(|length| Blur {
            from: -length,
            ..Blur::TRUE
        });
        for (scores, length) in disc.score_blurs(blurs).iter().zip(lengths) {
            let what = |name: &str| format!("{name} of length {length} at {degrees} degrees");
            let ahead = TRAVEL * (1.0 - length) / 2.0;
            // Mattes sampled 512 times, and rows one pixel wide at an angle: hundredths of a pixel.
            assert_near(&what("centroid"), get(scores, "centroid"), ahead, 0.05);
            assert_near(
                &what("misplacement"),
                get(scores, "misplacement"),
                ahead.abs(),
                0.05,
            );
            let extent = spread_of_disc(TRAVEL * length) / spread_of_disc(TRAVEL);
            assert_near(&what("extent"), get(scores, "extent"), extent, 0.01);
        }
    }
}

#[test]
fn too_long_a_blur_bleeds_behind_only() {
    for (degrees, disc) in discs() {
        let long = Blur {
            from: -1.5,
            ..Blur::TRUE
        };
        let [scores] = disc.score_blurs([long]);
        assert!(get(&scores, "bleed_trailing") > 1.0, "{degrees} degrees");
        assert_near("leading", get(&scores, "bleed_leading"), 0.0, NOTHING);
        assert_near("growth", get(&scores, "lateral_growth"), 0.0, ROWS);
    }
}

#[test]
fn a_centred_shutter_against_a_trailing_truth_bleeds_ahead_and_lies_half_the_way_ahead() {
    for (degrees, disc) in discs() {
        let centred = Blur {
            from: -0.5,
            to: 0.5,
            ..Blur::TRUE
        };
        let [scores] = disc.score_blurs([centred]);
        assert!(get(&scores, "bleed_leading") > 1.0, "{degrees} degrees");
        assert_near("trailing", get(&scores, "bleed_trailing"), 0.0, NOTHING);
        assert_near("centroid", get(&scores, "centroid"), TRAVEL / 2.0, 0.05);
        assert_near("extent", get(&scores, "extent"), 1.0, 0.01);
        assert_near("growth", get(&scores, "lateral_growth"), 0.0, ROWS);
    }
}

#[test]
fn lateral_growth_reads_the_dilation_in_pixels() {
    for (degrees, disc) in discs() {
        let bar = Shape::Bar {
            half: [18.0, 6.0],
            tilt: degrees.to_radians(),
        };
        for (case, name) in [(disc, "disc"), (&Case::new(slide(bar, degrees)), "bar")] {
            let dilations = [0.5, 1.0, 2.0, 6.0];
            let blurs = dilations.map(|dilation| Blur {
                dilation,
                ..Blur::TRUE
            });
            for (scores, dilation) in case.score_blurs(blurs).iter().zip(dilations) {
                let what = format!("growth of a {name} at {degrees} degrees");
                // The silhouette's length is known to 2 % of a disc at any angle, to 4 % of a bar: its gradients span two
                // pixels. A hundredth of a pixel is gained within.
                let tolerance = match name {
                    "disc" => (0.01 + 0.02 * dilation).min(0.1),
                    _ => 0.04 * dilation,
                };
                assert_near(&what, get(scores, "lateral_growth"), dilation, tolerance);
                assert_near(&what, get(scores, "row_gain"), 0.0, ROWS);
                assert_near(&what, get(scores, "row_loss"), 0.0, ROWS);
            }
        }
    }
}

#[test]
fn a_slanted_outline_that_is_dilated_grows_beside_its_rows_and_gains_within() {
    for degrees in ANGLES {
        let bar = Shape::Bar {
            half: [18.0, 6.0],
            tilt: degrees.to_radians() + 0.4,
        };
        let dilations = [2.0, 6.0];
        let blurs = dilations.map(|dilation| Blur {
            dilation,
            ..Blur::TRUE
        });
        for (scores, dilation) in
            (Case::new(slide(bar, degrees)).score_blurs(blurs).iter()).zip(dilations)
        {
            let [growth, gain, loss] = ROW_MASS.map(|name| get(scores, name));
            let what = format!("dilation of a slanted bar at {degrees} degrees");
            assert_near(&what, growth + gain, dilation, 0.1);
            assert!(
                growth > 0.05 * dilation && gain > 0.05 * dilation,
                "{what}: {growth} and {gain}"
            );
            assert_near(&what, loss, 0.0, ROWS);
        }
    }
}

#[test]
fn a_sharp_mover_over_its_own_smear_makes_rows_heavier_and_does_not_grow() {
    for (degrees, disc) in discs() {
        let (truth, core) = (disc.truth.mean(), &disc.frame.coverage[1]);
        let mut sharp = truth.clone();
        sharp.coverage[1] = truth.coverage[1].zip(core, |truth, core| core + (1.0 - core) * truth);
        let [scores] = &disc.score_pictures([sharp]);
        let gained: f64 = (truth.coverage[1].pixels.iter().zip(&core.pixels))
            .map(|(truth, core)| f64::from(core * (1.0 - truth)))
            .sum();
        let [growth, gain, loss] = ROW_MASS.map(|name| get(scores, name));
        let expected = gained / (4.0 * RADIUS);
        assert!(expected > 6.0, "{expected} px make a heavy core");
        // Each lateral silhouette is as long as the disc is wide, to the 2 % of its gradients.
        let what = format!("gain at {degrees} degrees");
        assert_near(&what, gain + growth, expected, 0.02 * expected);
        // Pixels at the rim reach aslant into rows that the disc hardly touches: measured 2 % at 30 degrees, 0 at 0.
        assert_near(&what, gain, expected, 0.04 * expected);
        assert_near("loss", loss, 0.0, ROWS);
    }
}

#[test]
fn hard_bleed_sees_a_wide_dilation_beside_the_support_and_nowhere_else() {
    for (degrees, disc) in discs() {
        let wide = Blur {
            dilation: 6.0,
            ..Blur::TRUE
        };
        let [scores] = disc.score_blurs([wide]);
        // One pixel is granted at the border, and the faint ends of the smear hide more of six.
        let lateral = get(&scores, "bleed_lateral");
        assert!(
            (1.0..4.0).contains(&lateral),
            "{lateral} at {degrees} degrees"
        );
        // The rounded ends: a few pixels at the limit of 45 degrees.
        assert_near("leading", get(&scores, "bleed_leading"), 0.0, 0.1);
        assert_near("trailing", get(&scores, "bleed_trailing"), 0.0, 0.1);
    }
}

#[test]
fn a_shift_across_the_motion_grows_on_one_side_and_loses_on_the_other() {
    for ((_, disc), shift) in discs().zip([3.0, 3.0, -3.0, -3.0]) {
        let aside = Blur {
            shift: [0.0, shift],
            ..Blur::TRUE
        };
        let [scores] = disc.score_blurs([aside]);
        for name in ["lateral_growth", "row_loss"] {
            assert_near(name, get(&scores, name), 1.5, 0.05);
        }
        assert_near("gain", get(&scores, "row_gain"), 0.0, ROWS);
        assert_near("centroid", get(&scores, "centroid"), 0.0, 0.05);
        assert_near("energy", get(&scores, "energy"), 1.0, 1e-3);
    }
}

#[test]
fn a_shift_along_the_motion_is_its_centroid_with_its_sign() {
    for (_, disc) in discs() {
        let shifts = [3.0, -3.0];
        let blurs = shifts.map(|shift| Blur {
            shift: [shift, 0.0],
            ..Blur::TRUE
        });
        for (scores, shift) in disc.score_blurs(blurs).iter().zip(shifts) {
            assert_near("centroid", get(scores, "centroid"), shift, 0.05);
            assert_near("misplacement", get(scores, "misplacement"), 3.0, 0.05);
            assert_near("growth", get(scores, "lateral_growth"), 0.0, ROWS);
        }
    }
}

#[test]
fn an_isotropic_blur_bleeds_to_all_sides_though_its_extent_looks_right() {
    for (degrees, disc) in discs().step_by(2) {
        let instant = disc.scene.render(&Blur::IDENTITY, Sampling::CLEAN);
        let mattes = instant.coverage.iter().map(|matte| gaussian(matte, 9.0));
        let blurred = Picture {
            coverage: mattes.collect(),
            ..instant
        };
        let [scores] = &disc.score_pictures([blurred]);
        assert_near("extent", get(scores, "extent"), 1.0, 0.1);
        for name in [
            "bleed_lateral",
            "bleed_leading",
            "lateral_growth",
            "row_loss",
        ] {
            assert!(get(scores, name) > 1.0, "{name} at {degrees} degrees");
        }
    }
}

#[test]
fn a_constant_picture_keeps_the_energy_and_fails_everything_else() {
    let [_, disc, ..] = &*DISCS;
    let [scores] = &disc.score_pictures([constant(&disc.truth.mean())]);
    // The mean matte times the pixels, rounded to 32 bits.
    assert_near("energy", get(scores, "energy"), 1.0, 1e-4);
    for (name, least) in [
        ("bleed_lateral", 1.0),
        ("bleed_leading", 1.0),
        ("bleed_trailing", 1.0),
        ("lateral_growth", 1.0),
        ("row_loss", 1.0),
        ("misplacement", 10.0),
        ("extent", 2.0),
        ("label_tv", 0.1),
        ("flip_moving", 0.1),
    ] {
        assert!(get(scores, name) > least, "{name}: {}", get(scores, name));
    }
}

#[test]
fn a_half_erased_bar_has_half_its_energy_and_half_a_hole() {
    let scene = slide(
        Shape::Bar {
            half: [25.0, 8.0],
            tilt: 0.0,
        },
        0.0,
    );
    let case = Case::new(scene);
    let mut faint = case.truth.mean();
    faint.coverage[1] = faint.coverage[1].map(|matte| 0.5 * matte);
    let [scores] = &case.score_pictures([faint]);
    // Halves of 32-bit numbers are exact.
    for (name, expected) in [("energy", 0.5), ("deficit", 0.5), ("hole", 0.5)] {
        assert_near(name, get(scores, name), expected, 1e-9);
    }
}

#[test]
fn label_total_variation_is_the_time_given_to_the_wrong_object() {
    // A bar as long as its way, moving along itself: at each of its three places the time it is seen is known.
    let scene = slide(
        Shape::Bar {
            half: [15.0, 8.0],
            tilt: 0.0,
        },
        0.0,
    );
    let case = Case::new(scene);
    let [scores] = case.score_blurs([Blur::IDENTITY]);
    // Ahead and behind, the truth ramps over 30 px; the instant covers one of the ramps: |a - a*| sums to 15 px there,
    // and to 15 px where it was, over 16 rows: half of it twice, for bar and background.
    let wrong = 16.0 * (15.0 + 15.0);
    let pixels = metrics::regions(&case.truth).moving.pixels;
    let region = pixels.iter().filter(|inside| **inside).count() as f64;
    // 512 samples per pixel.
    assert_near(
        "label_tv",
        get(&scores, "label_tv"),
        wrong / region,
        2e-3 * wrong / region,
    );
}

#[test]
fn a_filter_that_smears_a_still_bar_contaminates_the_occluder() {
    let post = Object::sliding(
        Shape::Bar {
            half: [3.0, 60.0],
            tilt: 0.0,
        },
        [56.0, 58.0],
        [0.0, 0.0],
    );
    let mut scene = slide(Shape::Disc(RADIUS), 0.0);
    scene.objects.insert(0, post);
    let case = Case::new(scene);
    let clean = case.truth.mean();
    let mut smeared = clean.clone();
    for index in 0..smeared.coverage[1].pixels.len() {
        let quarter = smeared.coverage[1].pixels[index] / 4.0;
        smeared.coverage[1].pixels[index] -= quarter;
        smeared.coverage[2].pixels[index] += quarter;
    }
    let scores = case.score_pictures([clean, smeared]);
    assert_near(
        "clean",
        get(&scores[0], "occluder_contamination"),
        0.0,
        NOTHING,
    );
    assert_near(
        "smeared",
        get(&scores[1], "occluder_contamination"),
        0.25,
        NOTHING,
    );
    let metric = "occluder_contamination".parse().expect("a metric's name");
    let (worst, _) = scores[1].worst_object(metric).expect("a still object");
    assert_eq!(worst, "object1");
}

/// A separable Gaussian of `sigma` pixels; what leaves the picture is lost.
fn gaussian(plane: &Plane, sigma: f64) -> Plane {
    let pass = |plane: &Plane, step: [i64; 2]| {
        Raster::from_fn(plane.width, plane.height, |x, y| {
            let reach = (4.0 * sigma) as i64;
            let total = sigma * std::f64::consts::TAU.sqrt();
            let tap = |offset: i64| {
                let at = [i64::from(x), i64::from(y)];
                let [u, v] = [0, 1].map(|axis| u32::try_from(at[axis] + step[axis] * offset));
                match (u, v) {
                    (Ok(u), Ok(v)) if u < plane.width && v < plane.height => {
                        let distance = offset as f64 / sigma;
                        f64::from(*plane.at(u, v)) * (-0.5 * distance * distance).exp() / total
                    }
                    _ => 0.0,
                }
            };
            (-reach..=reach).map(tap).sum::<f64>() as f32
        })
    };
    pass(&pass(plane, [1, 0]), [0, 1])
}
