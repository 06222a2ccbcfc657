//! The candidate that the dilation keeps. The published comparison looks as if distances along the path mattered.

use frame::Raster;
use tests::picture::make_blur;
use tests::random::Random;

use crate::fields::Field;

/// Candidate of the paper's listing.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Candidate {
    /// Distance along the path: |tau - m/2|.
    from_middle: f64,
    /// Depth, in metres.
    depth: f64,
    valid: bool,
}

/// Candidate that the listing begins with.
const NOTHING: Candidate = Candidate {
    from_middle: f32::MAX as f64,
    depth: f32::MAX as f64,
    valid: false,
};

/// Compares as the listing does: two valid candidates by depth, others by distances times validity.
fn is_better(candidate: Candidate, best: Candidate) -> bool {
    let number = |truth: bool| if truth { 1.0 } else { 0.0 };
    if candidate.valid && best.valid {
        return candidate.depth < best.depth;
    }
    let nearer = number(candidate.depth > best.depth);
    candidate.from_middle * number(best.valid) * nearer < best.from_middle * number(candidate.valid)
}

/// Returns the index that the listing ends with, if any.
fn choose_as_published(candidates: &[Candidate]) -> Option<usize> {
    let mut best = (NOTHING, None);
    for (index, candidate) in candidates.iter().enumerate() {
        if is_better(*candidate, best.0) {
            best = (*candidate, Some(index));
        }
    }
    best.1
}

/// Returns the nearest valid candidate; of equal depths, the first.
fn nearest_valid(candidates: &[Candidate]) -> Option<usize> {
    let valid = (candidates.iter().enumerate()).filter(|(_, candidate)| candidate.valid);
    let nearest = valid.min_by(|(_, a), (_, b)| a.depth.total_cmp(&b.depth));
    nearest.map(|(index, _)| index)
}

#[test]
fn the_published_comparison_keeps_the_nearest_valid_candidate_and_the_first_of_equals() {
    let mut random = Random::new(1);
    let (mut with_ties, mut with_none) = (0, 0);
    for _ in 0..10_000 {
        let odds = random.real(0.0, 1.0);
        let candidates: Vec<Candidate> = (0..8)
            .map(|_| Candidate {
                from_middle: random.real(0.0, 2.0).into(),
                // There are few depths, so that many are equal.
                depth: random.real(1.0, 5.0).floor().into(),
                valid: random.real(0.0, 1.0) < odds,
            })
            .collect();
        let kept = nearest_valid(&candidates);
        assert_eq!(choose_as_published(&candidates), kept, "{candidates:?}");
        let as_near = |candidate: &&Candidate| {
            candidate.valid && kept.is_some_and(|kept| candidates[kept].depth == candidate.depth)
        };
        with_ties += usize::from(candidates.iter().filter(as_near).count() > 1);
        with_none += usize::from(kept.is_none());
    }
    // Ties and empty lists occur often.
    assert!(
        with_ties > 1000 && with_none > 100,
        "{with_ties} {with_none}"
    );
}

#[test]
fn distances_along_the_path_only_separate_valid_from_invalid_candidates() {
    let mut random = Random::new(2);
    let mut draw = || Candidate {
        from_middle: random.real(0.0, 2.0).into(),
        depth: random.real(1.0, 9.0).into(),
        valid: random.real(0.0, 2.0) < 1.0,
    };
    for _ in 0..10_000 {
        let (candidate, best) = (draw(), draw());
        if !(candidate.valid && best.valid) {
            let wins = candidate.valid && !best.valid;
            assert_eq!(is_better(candidate, best), wins, "{candidate:?} {best:?}");
        }
    }
}

/// Offsets of the eight neighbours of one step, in the listing's order.
#[rustfmt::skip]
const NEIGHBOURS: [[i64; 2]; 8] =
    [[1, 1], [0, 1], [-1, 1], [1, 0], [1, -1], [-1, 0], [-1, -1], [0, -1]];

#[test]
fn the_kernel_keeps_the_candidate_of_the_published_comparison() {
    const SIDE: i64 = 64;
    const STEP: i64 = 3;
    let mut random = Random::new(3);
    let mut whole = |low: f32, high: f32| random.real(low, high).floor();
    // Whole pixels and metres make comparisons exact and depths often equal.
    let (width, height) = (SIDE as u32, SIDE as u32);
    let field = Field {
        color: Raster::filled(width, height, [0.5; 3]),
        velocity: Raster::from_fn(width, height, |_, _| [whole(-9.0, 10.0), whole(-9.0, 10.0)]),
        depth: Raster::from_fn(width, height, |_, _| whole(1.0, 4.0)),
        reprojection: None,
        exposure: 1.0,
    };
    // No quotient of whole pixels below 10 equals the tolerance.
    let changes =
        "passes=1 step_multiplier=3 metric=pixel fetch=nearest perpendicular_tolerance=0.3017";
    let mut blur = make_blur("jump_flood", Some("paper"), changes, (width, height));
    field.blur(&mut blur, 0);
    let seeds = blur.read_texture("seeds").unwrap();

    let mut carried = 0;
    for y in STEP..SIDE - STEP {
        for x in STEP..SIDE - STEP {
            let candidates = NEIGHBOURS.map(|[right, down]| {
                let offset = [right * STEP, down * STEP].map(|pixels| pixels as f64);
                let at = [x + right * STEP, y + down * STEP].map(|place| place as u32);
                let motion = field.velocity.at(at[0], at[1]).map(f64::from);
                let square = motion[0] * motion[0] + motion[1] * motion[1];
                let along = (motion[0] * offset[0] + motion[1] * offset[1]) / square;
                let beside = (motion[1] * offset[0] - motion[0] * offset[1]).abs() / square;
                Candidate {
                    from_middle: (along - 0.5).abs(),
                    depth: (*field.depth.at(at[0], at[1])).into(),
                    valid: square > 0.0 && (along - 0.5).abs() <= 0.5 && beside <= 0.3017,
                }
            });
            let expected = choose_as_published(&candidates).map_or([x, y], |index| {
                let [right, down] = NEIGHBOURS[index];
                [x + right * STEP, y + down * STEP]
            });
            let seed = seeds.at(x as u32, y as u32);
            let found = [seed[0].floor() as i64, seed[1].floor() as i64];
            assert_eq!(found, expected, "at {x}, {y} of {candidates:?}");
            carried += usize::from(found != [x, y]);
        }
    }
    assert!(carried > 500, "only {carried} found a source");
}
