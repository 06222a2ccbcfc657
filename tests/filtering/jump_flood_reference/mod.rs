//! The jump flood on the GPU against the paper in 64-bit floats.

mod flood;
mod gather;
mod paper;
mod way_back;

use filters::{Blur, Filter, Gpu, Settings, Value};
use flood::Chosen;
use paper::{Jitter, Paper, Reference};
use tests::open_gpu;
use way_back::Source;

use crate::fields::{Field, noise, rectangles};

/// Makes fields of odd sizes, wide and tall; two of random pixels, two of objects.
fn fields() -> Vec<(&'static str, Field)> {
    vec![
        ("noise 61x37", noise(61, 37, 1)),
        ("noise 31x71", noise(31, 71, 2)),
        ("rectangles 97x53", rectangles(97, 53, 3)),
        ("rectangles 61x67", rectangles(61, 67, 4)),
    ]
}

/// Names of parameters and their values.
type Changes = &'static [(&'static str, &'static str)];

/// Changes to a preset, and the exposure in frames.
const CASES: [(&str, Changes, f64); 12] = [
    ("paper", &[], 1.0),
    ("paper", &[("jitter", "none")], 0.5),
    (
        "paper",
        &[("metric", "pixel"), ("reach_cap", "double")],
        1.0,
    ),
    (
        "paper",
        &[
            ("kernel", "with_centre"),
            ("passes", "5"),
            ("step_multiplier", "2"),
        ],
        1.5,
    ),
    (
        "paper",
        &[
            ("fetch", "nearest"),
            ("reach_cap", "none"),
            ("perpendicular_tolerance", "0.05"),
        ],
        1.0,
    ),
    ("july_2024", &[], 1.0),
    ("july_2024", &[("map", "float32")], 1.0),
    (
        "july_2024",
        &[("passes", "4"), ("depth_match", "0.02"), ("probes", "5")],
        1.5,
    ),
    (
        "paper",
        &[
            ("map", "float16"),
            ("passes", "5"),
            ("step_multiplier", "2"),
        ],
        1.0,
    ),
    (
        "july_2024",
        &[("fetch", "nearest"), ("behind_extent", "0.01")],
        0.5,
    ),
    ("corrected", &[], 1.0),
    (
        "corrected",
        &[("fetch", "bilinear"), ("jitter", "none"), ("probes", "5")],
        0.5,
    ),
];

struct Case {
    name: String,
    settings: Settings,
    exposure: f64,
    field: Field,
}

fn cases(filter: &Filter) -> Vec<Case> {
    let mut cases = Vec::new();
    for (preset, changes, exposure) in CASES {
        for (name, field) in fields() {
            let mut settings = filter.settings(Some(preset)).unwrap();
            for (parameter, value) in changes {
                settings.set(filter, parameter, value).unwrap();
            }
            cases.push(Case {
                name: format!("{preset} {changes:?} at {exposure} on {name}"),
                settings,
                exposure,
                field,
            });
        }
    }
    cases
}

const FRAME_INDEX: u32 = 11;

impl Case {
    fn blur<'g>(&self, gpu: &'g Gpu, filter: &Filter) -> (Blur<'g>, frame::Image) {
        let (width, height) = (self.field.color.width, self.field.color.height);
        let mut blur = Blur::new(gpu, filter, &self.settings, width, height).unwrap();
        let output = self.field.blur(&mut blur, self.exposure, FRAME_INDEX);
        (blur, output)
    }

    fn reference(&self) -> Reference<'_> {
        let integer = |name: &str| match self.settings.values[name] {
            Value::Integer(value) => value,
            _ => panic!("{name} is an integer"),
        };
        let real = |name: &str| match self.settings.values[name] {
            Value::Real(value) => value,
            _ => panic!("{name} is a real number"),
        };
        let choice = |name: &str| self.settings.values[name].to_string();
        let paper = Paper {
            m: self.exposure * real("intensity"),
            passes: integer("passes") as u32,
            step_multiplier: integer("step_multiplier").into(),
            perpendicular_tolerance: real("perpendicular_tolerance"),
            probes: integer("probes").into(),
            match_threshold: real("match_threshold"),
            parallel_sensitivity: real("parallel_sensitivity"),
            perpendicular_sensitivity: real("perpendicular_sensitivity"),
            foreground_extent: real("foreground_extent"),
            mismatch_exponent: real("mismatch_exponent"),
            samples: integer("samples") as u32,
            pixel_metric: choice("metric") == "pixel",
            reach_factor: match choice("reach_cap").as_str() {
                "capped" => 1.0,
                "double" => 2.0,
                _ => f64::INFINITY,
            },
            jitter: match choice("jitter").as_str() {
                "step_scale" => Jitter::StepScale,
                "start_offset" => Jitter::StartOffset,
                "step_offset" => Jitter::StepOffset,
                _ => Jitter::None,
            },
            behind_extent: (choice("tap") == "replaced").then(|| real("behind_extent")),
            third_match: (choice("way_back") == "third_match").then(|| real("depth_match")),
            half_map: choice("map") == "float16",
            with_centre: choice("kernel") == "with_centre",
            nearest: choice("fetch") == "nearest",
            frame_index: FRAME_INDEX,
        };
        Reference::new(paper, &self.field)
    }
}

fn pixels(field: &Field) -> impl Iterator<Item = [i64; 2]> {
    let (width, height) = (field.depth.width.into(), field.depth.height.into());
    (0..height).flat_map(move |y| (0..width).map(move |x| [x, y]))
}

#[test]
fn the_dilation_agrees_with_a_64_bit_reference() {
    let (gpu, filter) = (open_gpu(), Filter::builtin("jump_flood").unwrap());
    let (mut found, mut all) = (0, 0);
    for case in cases(&filter) {
        let (blur, _) = case.blur(&gpu, &filter);
        let seeds = blur.read_texture("seeds").unwrap();
        let mut ties = 0;
        for ((pixel, texel), outcomes) in pixels(&case.field)
            .zip(&seeds.pixels)
            .zip(case.reference().dilate())
        {
            let chosen = Chosen {
                pixel: [texel[0].floor() as i64, texel[1].floor() as i64],
                valid: texel[3] == 1.0,
            };
            assert!(
                outcomes.contains(&chosen),
                "{}: pixel {pixel:?} chose {chosen:?}; the reference allows {outcomes:?}",
                case.name
            );
            ties += usize::from(outcomes.len() > 1);
            found += usize::from(chosen.valid && chosen.pixel != pixel);
        }
        // A decision is a tie within 4e-6 of its threshold. A pixel takes up to 9 x 3 decisions in each of up to 8
        // passes: one pixel in a thousand has a tie, and most ties do not change the winner. The factor of two is for
        // chance.
        let count = seeds.pixels.len();
        assert!(500 * ties <= count, "{}: {ties} ties of {count}", case.name);
        all += count;
    }
    // A dilation that carries nothing proves nothing.
    assert!(4 * found > all, "only {found} of {all} found a source");
}

#[test]
fn rejection_and_the_way_back_agree_with_the_reference() {
    let (gpu, filter) = (open_gpu(), Filter::builtin("jump_flood").unwrap());
    let (mut moved, mut flagged, mut all) = (0, 0, 0);
    for case in cases(&filter) {
        let (blur, _) = case.blur(&gpu, &filter);
        let sources = blur.read_texture("sources").unwrap();
        let reference = case.reference();
        let mut ties = 0;
        for ((pixel, texel), dilated) in pixels(&case.field)
            .zip(&sources.pixels)
            .zip(reference.dilate())
        {
            let [chosen] = dilated[..] else {
                ties += 1;
                continue;
            };
            let outcomes = reference.backtrack(pixel, chosen);
            let near = |outcome: &&Source| {
                // Positions up to 100 pixels after three products in 32-bit floats.
                let distance = (0..2).map(|axis| outcome.position[axis] - f64::from(texel[axis]));
                outcome.flag == f64::from(texel[3]) && distance.map(f64::abs).sum::<f64>() < 1e-3
            };
            assert!(
                outcomes.iter().any(|outcome| near(&outcome)),
                "{}: pixel {pixel:?} with {chosen:?} ended at {texel:?}; the reference allows {outcomes:?}",
                case.name
            );
            ties += usize::from(outcomes.len() > 1);
            flagged += usize::from(texel[3] == 1.0);
            moved += usize::from(texel[3] == 0.0 && texel[0].floor() as i64 != pixel[0]);
        }
        let count = sources.pixels.len();
        // Up to 33 probes per pixel, each with a chance of 2 x 2e-4 per axis to lie on the edge of a texel.
        assert!(37 * ties <= count, "{}: {ties} ties of {count}", case.name);
        all += count;
    }
    // Each of the three endings occurs often.
    assert!(8 * moved > all, "only {moved} of {all} moved");
    assert!(8 * flagged > all, "only {flagged} of {all} flagged");
}

#[test]
fn the_gather_weights_taps_like_the_reference() {
    let (gpu, filter) = (open_gpu(), Filter::builtin("jump_flood").unwrap());
    for case in cases(&filter) {
        let (blur, output) = case.blur(&gpu, &filter);
        let sources = blur.read_texture("sources").unwrap();
        let source = |[x, y]: [i64; 2]| {
            let [x, y, ..] = *sources.at(x as u32, y as u32);
            [x.into(), y.into()]
        };
        let reference = case.reference();
        let mut compared = 0;
        for (pixel, found) in pixels(&case.field).zip(&output.pixels) {
            let Some((expected, misplaced)) = reference.blur(pixel, &source) else {
                continue;
            };
            for (expected, found) in expected.iter().zip(found) {
                // Colours lie in [0, 2) and change by 2 per pixel at most on both axes. A weight is off by 1e-4 where
                // its tenth root is steepest.
                let tolerance = 1e-3 + 4.0 * misplaced;
                assert!(
                    (expected - f64::from(*found)).abs() < tolerance,
                    "{}: pixel {pixel:?} is {found}; the reference says {expected} +- {tolerance}",
                    case.name
                );
            }
            compared += 1;
        }
        let count = output.pixels.len();
        // Up to 8 taps, each with a chance of 2 x misplaced (0.01 pixels at most) per axis to be undecided.
        assert!(
            4 * compared > 3 * count,
            "{}: only {compared} of {count} compared",
            case.name
        );
    }
}
