//! Ranking of sequences: sorted, with intervals over scenes, with ties.

use judge::{RANKED_BY, RankedSequence, rank_sequences, rank_sequences_on};
use metrics::{Measured, PERFECT_JOD, SequenceMetric};
use suite::Run;
use tests::text::assert_contains;
use tracer::SceneId;

use crate::sandbox::{Sandbox, assert_done, split, stdout};

/// Lists the names of a ranking with their ranks: `1 a`, `2-3 b`.
fn names(ranking: &[Vec<RankedSequence>]) -> Vec<String> {
    let ranked = ranking.iter().flatten().map(|own| &own.ranked);
    ranked
        .map(|own| format!("{} {}", own.rank_text(), own.name))
        .collect()
}

/// Replaces the run's scenes with six, where the filters are the given JOD below perfect.
fn with_scores(run: &Run, lost: impl Fn(&str, f64) -> f64, floor: f64) -> Run {
    let mut made = Run {
        cases: Vec::new(),
        sequences: Vec::new(),
        ..run.clone()
    };
    for scene in 0..6 {
        let name = SceneId::new(format!("scene{scene}"), None);
        for case in run.cases.iter().filter(|case| case.scene == "plate") {
            let mut case = case.clone();
            case.id.scene.clone_from(&name);
            made.cases.push(case);
        }
        for own in run.sequences.iter().filter(|own| own.scene == "plate") {
            let mut own = own.clone();
            own.scene.clone_from(&name);
            let value = PERFECT_JOD - lost(&own.name, f64::from(scene));
            *own.scores.get_mut(RANKED_BY) = Measured::score(value, PERFECT_JOD - floor);
            made.sequences.push(own);
        }
    }
    made
}

#[test]
fn sequences_are_ranked_by_means_over_scenes_with_intervals_and_ties() {
    let sandbox = Sandbox::two_scenes();
    let filters = "identity,velocity_gather:fine,velocity_gather:departure";
    let words = format!("--filters {filters} --frames 2 --jitter-frames 0");
    let output = sandbox.run(&split(&words));
    assert_done(&output);
    let run = sandbox.read_run();
    let text = stdout(&output);
    let title = text
        .lines()
        .find(|line| line.contains("2 scenes, 2 frames"))
        .expect("a ranking");
    let parts = ["JOD", "95 % CI", "error", "along", "worst scene"];
    assert_contains(title, &parts);
    let mut lines = text.lines();
    assert!(lines.all(|line| line.chars().count() <= 80), "{text}");
    let ranking = rank_sequences(&run);
    let ranks: usize = ranking.iter().map(Vec::len).sum();
    assert_eq!(ranks, 3, "one rank per filter");
    for own in ranking.iter().flatten() {
        let shown = |scene: &str| {
            let mut sequences = run.sequences.iter().filter(|it| !it.is_reference);
            let found = sequences.find(|it| it.scene == scene && it.name == own.ranked.name);
            RANKED_BY.shown(found.unwrap().scores.get(RANKED_BY).value().unwrap())
        };
        let [plate, slow] = ["plate", "slow"].map(shown);
        let mean = (plate + slow) / 2.0;
        assert!((own.ranked.mean - mean).abs() < 1e-9, "{own:?}");
        // Student's t of one degree of freedom, by the table's digits.
        let half = 12.706 * (plate - slow).abs() / 2.0;
        let [low, high] = own.ranked.interval.unwrap();
        assert!(((high - low) / 2.0 / half - 1.0).abs() < 1e-4, "{own:?}");
        let [mean, low, high] = [mean, low, high].map(|own| RANKED_BY.shown_text(own));
        let due = [mean, format!("{low} to {high}")];
        let mut lines = text.lines().filter(|line| line.contains(&own.ranked.name));
        let is_shown = lines.any(|line| due.iter().all(|part| line.contains(part)));
        assert!(is_shown, "{due:?} is missing from:\n{text}");
    }
    // The page has the same ranking, and every scene its own.
    let page = sandbox.text("out/sequences.html");
    let first = &names(&ranking)[0];
    assert_contains(&page, &["Means over 2 scenes, ranked by jod", first]);
    assert_ties(&run);
}

/// Ranks synthetic scores: filters that are equal in every scene, or on one scene within the floor, share their ranks.
fn assert_ties(run: &Run) {
    let fine = "velocity_gather:fine";
    let departure = "velocity_gather:departure";

    // In every scene fine is a little better than identity, and the third differs from it by chance alone.
    let by = |name: &str, scene: f64| match name {
        "velocity_gather:fine" => 1.0 + 0.1 * scene,
        "identity:default" => 1.1 + 0.101 * scene,
        _ => 1.1 + 0.101 * scene + if scene % 2.0 == 0.0 { 0.05 } else { -0.04 },
    };
    let far = with_scores(run, by, 0.01);
    let noisy = with_scores(run, by, 0.12);
    let first = SceneId::new("scene0", None);
    for (ranking, ranks) in [
        (rank_sequences(&far), ["1", "2-3", "2-3"]),
        // On one scene the floor decides.
        (rank_sequences_on(&far, &first), ["1", "2", "3"]),
        // The losses are 1.00, 1.10 and 1.15: only the first and the last differ by more than the floor.
        (rank_sequences_on(&noisy, &first), ["1-2", "1-3", "2-3"]),
    ] {
        let due = std::iter::zip(ranks, [fine, "identity:default", departure]);
        let due = due.map(|(rank, name)| format!("{rank} {name}"));
        assert_eq!(names(&ranking), due.collect::<Vec<_>>());
    }
    let means = &rank_sequences(&far)[0][0].means;
    assert_eq!(means.len(), SequenceMetric::ALL.len());
    assert_eq!(means[2].1.unwrap().scenes, 6);
}
