//! Scores do not depend on orientation, shifts by whole pixels, object numbers and threads.

use std::sync::LazyLock;

use frame::{AtInstant, Frame, Image, Picture, Plane, Raster, Support, Truth};
use metrics::{Measured, Measurement, Metric, ObjectMetric, Scores, Viewing, measure};
use tests::synthetic::{Blur, Object, Sampling, Scene, Shape, VIEWING};

use crate::{assert_near, bar, clean_truth, measure_blur, measure_scores, scene};

/// Blur that is wrong by every score.
const WRONG: Blur = Blur {
    from: -1.25,
    to: 0.25,
    dilation: 1.5,
    ..Blur::TRUE
};

/// Makes a scene whose three objects all differ.
fn varied_scene() -> Scene {
    // The still bar is in the moving region, where nothing touches it.
    let post = Object::sliding(bar([2.0, 20.0], 0.0), [20.9, 30.0], [0.0, 0.0]);
    let disc = Object::sliding(Shape::Disc(8.0), [46.2, 30.3], [12.0, 0.0]);
    let bar = Object::sliding(bar([6.0, 4.0], 0.5), [50.3, 49.4], [12.0, 0.0]);
    scene([80, 60], vec![post, disc, bar])
}

/// Frame, truth and wrong blur of that scene.
static VARIED: LazyLock<(Frame, Truth, Picture)> = LazyLock::new(|| {
    let scene = varied_scene();
    let wrong = scene.render(&WRONG, Sampling::CLEAN);
    (scene.frame(), clean_truth(&scene), wrong)
});

fn measure_varied() -> Measurement {
    let (frame, truth, output) = &*VARIED;
    measure(output, frame, truth, None, &VIEWING).expect("they agree")
}

/// Remaps frame, truth and output pixel by pixel: `source` gives the source pixel of each new one,
/// `turn` changes screen vectors.
fn remap(
    width: u32,
    height: u32,
    source: impl Fn(u32, u32) -> [u32; 2],
    turn: impl Fn([f32; 2]) -> [f32; 2],
) -> Scores {
    let (frame, truth, output) = VARIED.clone();
    let mattes =
        |all: &[Plane]| (all.iter().map(|plane| take(plane, width, height, &source))).collect();
    let picture = |picture: &Picture| Picture {
        color: take(&picture.color, width, height, &source),
        coverage: mattes(&picture.coverage),
    };
    let instant = picture(&frame.picture());
    let frame = Frame {
        color: instant.color,
        coverage: instant.coverage,
        velocity: take(&frame.velocity, width, height, &source).map(|v| turn(*v)),
        depth: take(&frame.depth, width, height, &source),
        object_id: take(&frame.object_id, width, height, &source),
        ..frame
    };
    let truth = Truth {
        halves: truth.halves.each_ref().map(picture),
        standard_error: take(&truth.standard_error, width, height, &source),
        motion: take(&truth.motion, width, height, &source),
        support: Support {
            seen: (truth.support.seen.iter())
                .map(|seen| take(seen, width, height, &source))
                .collect(),
            moving: take(&truth.support.moving, width, height, &source),
            unknowable: take(&truth.support.unknowable, width, height, &source),
        },
        at_instant: truth.at_instant.each_ref().map(|half| AtInstant {
            shift: take(&half.shift, width, height, &source),
            unknowable: take(&half.unknowable, width, height, &source),
            placed: take(&half.placed, width, height, &source),
            offset: take(&half.offset, width, height, &source).map(|v| turn(*v)),
            // No probes are measured here.
            spread: take(&half.spread, width, height, &source),
        }),
        ..truth
    };
    measure_scores(&picture(&output), &frame, &truth)
}

fn take<T: Clone>(
    raster: &Raster<T>,
    width: u32,
    height: u32,
    source: &impl Fn(u32, u32) -> [u32; 2],
) -> Raster<T> {
    Raster::from_fn(width, height, |x, y| {
        let [u, v] = source(x, y);
        raster.at(u, v).clone()
    })
}

#[track_caller]
fn assert_same_scores(actual: &Scores, expected: &Scores, metrics: &[Metric], tolerance: f64) {
    let mut compared = 0;
    for metric in metrics {
        match (actual.get(*metric), expected.get(*metric)) {
            (Measured::Score(actual), Measured::Score(expected)) => {
                compared += 1;
                let tolerance = tolerance * expected.value.abs().max(1.0);
                assert_near(&metric.name(), actual.value, expected.value, tolerance);
            }
            (actual, expected) => assert_eq!(actual, expected, "{metric}"),
        }
    }
    assert!(compared > 10, "only {compared} scores to compare");
}

#[test]
fn a_mirrored_or_turned_scene_has_the_same_scores() {
    let same = remap(80, 60, |x, y| [x, y], |v| v);
    let mirrored = remap(80, 60, |x, y| [79 - x, y], |[x, y]| [-x, y]);
    let flipped = remap(80, 60, |x, y| [x, 59 - y], |[x, y]| [x, -y]);
    // The new pixel (x, y) is the old (y, 59 - x): a quarter turn clockwise, +x becomes +y.
    let turned = remap(60, 80, |x, y| [y, 59 - x], |[x, y]| [-y, x]);
    // Regions follow the height, which a turn changes, so only scores of mattes can be compared.
    let mattes = ObjectMetric::ALL[..11].iter().copied().map(Metric::Object);
    let mattes: Vec<Metric> = mattes.collect();
    // FLIP sums in 32 bits in another order, and rounding may move a pixel at exactly 45 degrees to
    // the other side.
    let tolerance = 1e-4;
    assert_same_scores(&mirrored, &same, &Metric::all(), tolerance);
    assert_same_scores(&flipped, &same, &Metric::all(), tolerance);
    assert_same_scores(&turned, &same, &mattes, tolerance);
}

#[test]
fn a_scene_moved_by_whole_pixels_has_the_same_matte_scores() {
    let mut moved = varied_scene();
    for object in &mut moved.objects {
        object.center = [object.center[0] + 4.0, object.center[1] - 3.0];
    }
    // FLIP on the object is left out, since it depends on the background.
    let mattes = ObjectMetric::ALL
        .into_iter()
        .filter(|metric| *metric != ObjectMetric::Flip);
    let mattes: Vec<Metric> = mattes.map(Metric::Object).collect();
    // Sampling positions are the same in every pixel; only rounding differs.
    let actual = measure_blur(&moved, WRONG).scores;
    assert_same_scores(&actual, &measure_varied().scores, &mattes, 1e-6);
}

#[test]
fn object_numbers_do_not_matter() {
    let mut swapped = varied_scene();
    swapped.objects.reverse();
    // Nothing overlaps, so the order does not matter; sums over objects round.
    let actual = measure_blur(&swapped, WRONG).scores;
    assert_same_scores(&actual, &measure_varied().scores, &Metric::all(), 1e-12);
}

#[test]
fn two_measurements_are_equal_bit_for_bit() {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let single = one.expect("a pool").install(measure_varied);
    for _ in 0..2 {
        assert_eq!(single, measure_varied());
    }
}

#[test]
fn brighter_pictures_seen_through_a_darker_exposure_have_the_same_scores() {
    let (frame, truth, output) = VARIED.clone();
    let expected = measure_varied();
    // A power of two is exact in floats.
    let brighter = |image: &Image| image.map(|color| color.map(|value| 4.0 * value));
    let picture = |picture: &Picture| Picture {
        color: brighter(&picture.color),
        ..picture.clone()
    };
    let truth = Truth {
        halves: truth.halves.each_ref().map(picture),
        at_instant: truth.at_instant.each_ref().map(|half| AtInstant {
            shift: brighter(&half.shift),
            ..half.clone()
        }),
        ..truth
    };
    let frame = Frame {
        color: brighter(&frame.color),
        ..frame
    };
    let darker = Viewing {
        stops: VIEWING.stops - 2.0,
        flip_start: VIEWING.flip_start - 2.0,
        flip_stop: VIEWING.flip_stop - 2.0,
        ..VIEWING
    };
    let actual = measure(&picture(&output), &frame, &truth, None, &darker).expect("they agree");
    // Exposures are powers of two, and FLIP works in 32 bits.
    assert_same_scores(&actual.scores, &expected.scores, &Metric::all(), 1e-5);
}
