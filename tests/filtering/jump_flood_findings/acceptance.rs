//! The candidate that the published comparison keeps; it looks as if distances along the path
//! mattered. `jump_flood_reference` shows that the kernel keeps the same one.

use tests::random::Random;

/// Candidate in the paper's listing.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Candidate {
    /// Distance along the path: |tau - m/2|.
    from_middle: f64,
    /// Depth, in metres.
    depth: f64,
    valid: bool,
}

/// The listing's first candidate.
const NOTHING: Candidate = Candidate {
    from_middle: f32::MAX as f64,
    depth: f32::MAX as f64,
    valid: false,
};

/// Compares like the listing: two valid candidates by depth, others by distances times validity.
fn is_better(candidate: Candidate, best: Candidate) -> bool {
    let number = |truth: bool| if truth { 1.0 } else { 0.0 };
    if candidate.valid && best.valid {
        return candidate.depth < best.depth;
    }
    let nearer = number(candidate.depth > best.depth);
    candidate.from_middle * number(best.valid) * nearer < best.from_middle * number(candidate.valid)
}

/// Returns the listing's final index, if any.
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
    assert!(with_ties > 1000, "{with_ties}");
    assert!(with_none > 100, "{with_none}");
}
