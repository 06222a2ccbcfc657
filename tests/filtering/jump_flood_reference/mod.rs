//! The jump flood on the GPU against the paper in 64-bit floats.

mod flood;
mod gather;
mod paper;
mod way_back;

use std::sync::LazyLock;

use flood::Chosen;
use paper::{Jitter, Paper, Reference};
use way_back::Source;

use crate::reference::{Case, Run, run_cases};

/// Published presets, and most choices.
#[rustfmt::skip]
const CASES: [Case; 6] = [
    ("jump_flood", "paper", "", 1.0),
    ("jump_flood", "paper", "metric=pixel reach_cap=double", 1.0),
    ("jump_flood", "paper", "kernel=with_centre passes=5 step_multiplier=2", 1.5),
    ("jump_flood", "paper", "fetch=nearest reach_cap=none perpendicular_tolerance=0.05", 1.0),
    ("jump_flood", "july_2024", "", 1.0),
    ("jump_flood", "corrected", "", 1.0),
];

#[rustfmt::skip]
const FURTHER_CASES: [Case; 6] = [
    ("jump_flood", "paper", "jitter=none", 0.5),
    ("jump_flood", "july_2024", "map=float32", 1.0),
    ("jump_flood", "july_2024", "passes=4 depth_match=0.02 probes=5", 1.5),
    ("jump_flood", "paper", "map=float16 passes=5 step_multiplier=2", 1.0),
    ("jump_flood", "july_2024", "fetch=nearest behind_extent=0.01", 0.5),
    ("jump_flood", "corrected", "fetch=bilinear jitter=none probes=5", 0.5),
];

/// A run, its reference, and the reference's dilated map of sources.
struct Flood {
    run: &'static Run,
    reference: Reference<'static>,
    dilated: Vec<Vec<Chosen>>,
}

static FLOODS: LazyLock<Vec<Flood>> = LazyLock::new(|| run_floods(&CASES));

fn run_floods(cases: &[Case]) -> Vec<Flood> {
    let runs: &[Run] = run_cases(cases, &["seeds", "sources"]).leak();
    let floods = runs.iter().map(|run| {
        let reference = Reference::new(read_paper(run), &run.field);
        Flood {
            run,
            dilated: reference.dilate(),
            reference,
        }
    });
    floods.collect()
}

fn read_paper(run: &Run) -> Paper {
    let (integer, real) = (|name| run.integer(name), |name| run.real(name));
    let is = |name: &str, choice: &str| run.choice(name) == choice;
    Paper {
        m: run.field.exposure * real("intensity"),
        passes: integer("passes") as u32,
        step_multiplier: integer("step_multiplier"),
        perpendicular_tolerance: real("perpendicular_tolerance"),
        probes: integer("probes"),
        match_threshold: real("match_threshold"),
        parallel_sensitivity: real("parallel_sensitivity"),
        perpendicular_sensitivity: real("perpendicular_sensitivity"),
        foreground_extent: real("foreground_extent"),
        mismatch_exponent: real("mismatch_exponent"),
        samples: integer("samples") as u32,
        pixel_metric: is("metric", "pixel"),
        reach_factor: match run.choice("reach_cap").as_str() {
            "capped" => 1.0,
            "double" => 2.0,
            _ => f64::INFINITY,
        },
        jitter: match run.choice("jitter").as_str() {
            "step_scale" => Jitter::StepScale,
            "start_offset" => Jitter::StartOffset,
            "step_offset" => Jitter::StepOffset,
            _ => Jitter::None,
        },
        behind_extent: is("tap", "replaced").then(|| real("behind_extent")),
        third_match: is("way_back", "third_match").then(|| real("depth_match")),
        half_map: is("map", "float16"),
        with_centre: is("kernel", "with_centre"),
        nearest: is("fetch", "nearest"),
    }
}

#[test]
#[ignore = "prove: six further choices of parameters"]
fn further_floods_agree_with_the_reference() {
    let floods = run_floods(&FURTHER_CASES);
    check_dilation(&floods);
    check_way_back(&floods);
    check_gather(&floods);
}

#[test]
fn the_dilation_agrees_with_a_64_bit_reference() {
    check_dilation(&FLOODS);
}

fn check_dilation(floods: &[Flood]) {
    let (mut moved, mut all) = (0, 0);
    for Flood { run, dilated, .. } in floods {
        let seeds = &run.texture("seeds").pixels;
        let mut ties = 0;
        for ((pixel, texel), outcomes) in run.pixels().zip(seeds).zip(dilated) {
            let chosen = Chosen {
                pixel: [texel[0].floor() as i64, texel[1].floor() as i64],
                valid: texel[3] == 1.0,
            };
            assert!(
                outcomes.contains(&chosen),
                "{}: pixel {pixel:?} chose {chosen:?}; the reference allows {outcomes:?}",
                run.name
            );
            ties += usize::from(outcomes.len() > 1);
            moved += usize::from(chosen.valid && chosen.pixel != pixel);
        }
        // A decision is a tie within 4e-6 of its threshold. A pixel makes up to 9 x 3 decisions in
        // each of up to 8 passes: one pixel in a thousand has a tie, and most ties do not change
        // the winner. The factor of two is for chance.
        let count = seeds.len();
        assert!(500 * ties <= count, "{}: {ties} ties of {count}", run.name);
        all += count;
    }
    // A dilation that carries nothing proves nothing.
    assert!(4 * moved > all, "only {moved} of {all} found a source");
}

#[test]
fn rejection_and_the_way_back_agree_with_the_reference() {
    check_way_back(&FLOODS);
}

fn check_way_back(floods: &[Flood]) {
    let (mut moved, mut flagged, mut all) = (0, 0, 0);
    for flood in floods {
        let run = flood.run;
        let sources = &run.texture("sources").pixels;
        let mut ties = 0;
        for ((pixel, texel), dilated) in run.pixels().zip(sources).zip(&flood.dilated) {
            let [chosen] = dilated[..] else {
                ties += 1;
                continue;
            };
            let outcomes = flood.reference.backtrack(pixel, chosen);
            let near = |outcome: &Source| {
                // Positions up to 100 pixels after three products in 32-bit floats.
                let distance = (0..2).map(|axis| outcome.position[axis] - f64::from(texel[axis]));
                outcome.flag == f64::from(texel[3]) && distance.map(f64::abs).sum::<f64>() < 1e-3
            };
            assert!(
                outcomes.iter().any(near),
                "{}: pixel {pixel:?} with {chosen:?} ended at {texel:?}; the reference allows {outcomes:?}",
                run.name
            );
            ties += usize::from(outcomes.len() > 1);
            flagged += usize::from(texel[3] == 1.0);
            moved += usize::from(texel[3] == 0.0 && texel[0].floor() as i64 != pixel[0]);
        }
        let count = sources.len();
        // Up to 33 probes per pixel, each with a chance of 2 x 2e-4 per axis to lie on the edge of
        // a texel.
        assert!(37 * ties <= count, "{}: {ties} ties of {count}", run.name);
        all += count;
    }
    // Each of the three endings occurs often.
    assert!(8 * moved > all, "only {moved} of {all} moved");
    assert!(8 * flagged > all, "only {flagged} of {all} flagged");
}

#[test]
fn the_gather_weights_taps_like_the_reference() {
    check_gather(&FLOODS);
}

fn check_gather(floods: &[Flood]) {
    for Flood { run, reference, .. } in floods {
        let sources = run.texture("sources");
        let source = |[x, y]: [i64; 2]| {
            let [x, y, ..] = *sources.at(x as u32, y as u32);
            [x.into(), y.into()]
        };
        let mut compared = 0;
        for pixel in run.pixels() {
            if let Some((expected, misplaced)) = reference.blur(pixel, &source) {
                // Colours are in [0, 2) and change by 2 per pixel at most on both axes. A weight is
                // off by 1e-4 where its tenth root is steepest.
                run.assert_color(pixel, expected, 1e-3 + 4.0 * misplaced);
                compared += 1;
            }
        }
        let count = run.output.pixels.len();
        // Up to 8 taps, each with a chance of 2 x misplaced (0.01 pixels at most) per axis to be
        // undecided.
        let name = &run.name;
        assert!(4 * compared > 3 * count, "{name}: {compared} of {count}");
    }
}
