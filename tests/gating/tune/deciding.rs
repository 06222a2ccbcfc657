//! Choice among candidates: which are dropped, which is chosen, and why.

use std::collections::BTreeMap;

use filters::{Filter, Value};
use tune::{
    ChoiceLimits, PairedComparison, Preference, SceneScore, Space, Trial, TrialOutcome,
    choose_trial, cross_validate, pareto_front, signed_rank_p_value,
};

#[test]
fn the_signed_rank_test_has_wilcoxons_probabilities() {
    // All six on one side: 1 of 2^6 arrangements.
    assert_eq!(
        signed_rank_p_value(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]),
        1.0 / 64.0
    );
    assert_eq!(
        signed_rank_p_value(&[-1.0, -2.0, -3.0, -4.0, -5.0, -6.0]),
        1.0
    );
    // In Wilcoxon's table for n = 8, the smaller sum 5 is the last one below 5 % on one side, and 3 below 2.5 %.
    let eight = |below: &[usize]| {
        let rank = |rank: usize| if below.contains(&rank) { -1.0 } else { 1.0 } * rank as f64;
        signed_rank_p_value(&(1..=8).map(rank).collect::<Vec<_>>())
    };
    // Subsets of 1 to 8 with a sum of at most 3, 5 and 6.
    assert_eq!(eight(&[3]), 5.0 / 256.0);
    assert_eq!(eight(&[5]), 10.0 / 256.0);
    assert_eq!(eight(&[6]), 14.0 / 256.0);
}

#[test]
fn darwins_plants_have_the_published_probability() {
    // Heights of crossed less self-fertilised plants, in eighths of an inch: scipy.stats.wilcoxon gives W+ = 96 and, with
    // alternative "greater", p = 0.0206.
    let plants = [49, -67, 8, 16, 6, 23, 28, 41, 14, 29, 56, 24, 75, 60, -48];
    let probability = signed_rank_p_value(&plants.map(f64::from));
    assert!((probability - 0.0206).abs() < 1e-4, "{probability}");
}

#[test]
fn equal_sizes_share_their_ranks_and_zeros_do_not_count() {
    // Both ranks are 1.5: the sums 3, 1.5, 1.5 and 0 are equally likely.
    assert_eq!(signed_rank_p_value(&[1.0, 1.0]), 0.25);
    assert_eq!(signed_rank_p_value(&[1.0, -1.0]), 0.75);
    assert_eq!(signed_rank_p_value(&[0.0, 1.0, 0.0, -1.0]), 0.75);
    // The ranks are 2, 2, 2 and 4, and the sum is 6: 8 of 16 arrangements reach it. If the three had rank 1, 9 would.
    assert_eq!(signed_rank_p_value(&[1.0, 1.0, 1.0, -2.0]), 0.5);
    assert_eq!(signed_rank_p_value(&[]), 1.0);
}

#[test]
fn the_front_holds_unbeaten_candidates() {
    let rows = [
        [1.0, 5.0],
        [2.0, 4.0],
        [3.0, 4.0],
        [4.0, 1.0],
        [2.0, 4.0],
        [5.0, 5.0],
    ];
    let rows: Vec<Vec<f64>> = rows.iter().map(|row| row.to_vec()).collect();
    // The second beats the third, the fifth equals it, and all beat the last.
    assert_eq!(pareto_front(&rows), [0, 1, 3]);
    assert!(pareto_front(&[]).is_empty());
}

/// Makes a start with samples = 8, and trials with other numbers of samples and the given FLIP on scenes a, b, c, d.
fn make_trials(rows: &[(i32, [f64; 4])]) -> Vec<Trial> {
    (rows.iter().enumerate())
        .map(|(trial, (samples, flips))| Trial {
            trial,
            values: BTreeMap::from([("samples".to_owned(), Value::Integer(*samples))]),
            outcome: TrialOutcome::Done,
            loss: 0.0,
            error: None,
            bleed: Some(f64::from(*samples) / 8.0),
            cost: Some(f64::from(*samples) / 8.0),
            scenes: (["a", "b", "c", "d"].iter().zip(flips))
                .map(|(name, flip)| {
                    (
                        name.to_string(),
                        SceneScore {
                            flip: *flip,
                            bleed: None,
                        },
                    )
                })
                .collect(),
        })
        .collect()
}

fn space() -> Space {
    let filter = Filter::builtin("jump_flood").unwrap();
    let start = filter.settings(Some("paper")).unwrap();
    Space::new(&filter, start, &["samples".to_owned()]).unwrap()
}

#[test]
fn the_choice_among_equal_candidates_is_the_nearest_to_the_start() {
    let rows = [
        (8, [0.1, 0.1, 0.1, 0.1]),
        // About half the error everywhere: the best.
        (60, [0.05, 0.04, 0.06, 0.05]),
        // Hardly worse, and much nearer to the start.
        (12, [0.05, 0.042, 0.06, 0.05]),
        // Nearer still, and clearly worse.
        (10, [0.08, 0.08, 0.08, 0.08]),
    ];
    let choice = choose_trial(
        &make_trials(&rows),
        &space(),
        ChoiceLimits::default(),
        |_| true,
    )
    .unwrap();
    assert_eq!((choice.best, choice.trial), (1, 2));
    // Logs of 0.5, 0.4, 0.6 and 0.5: the standard deviation is 0.1659, and that of the mean 0.0830.
    assert!(
        (choice.standard_error - 0.0830).abs() < 1e-4,
        "{}",
        choice.standard_error
    );
}

#[test]
fn an_unbeaten_start_stays_the_choice() {
    let rows = [(8, [0.1; 4]), (9, [0.05, 0.16, 0.09, 0.11])];
    let choice = choose_trial(
        &make_trials(&rows),
        &space(),
        ChoiceLimits::default(),
        |_| true,
    )
    .unwrap();
    assert_eq!((choice.best, choice.trial), (1, 0));
}

#[test]
fn limits_and_failures_keep_trials_out_of_the_choice() {
    let rows = [
        (8, [0.1; 4]),
        (16, [0.02; 4]),
        (12, [0.05; 4]),
        (4, [0.06; 4]),
    ];
    let mut trials = make_trials(&rows);
    let chosen = |trials: &[Trial], limits| {
        choose_trial(trials, &space(), limits, |_| true)
            .unwrap()
            .trial
    };
    assert_eq!(chosen(&trials, ChoiceLimits::default()), 1);
    let limits = ChoiceLimits {
        cost: Some(1.5),
        bleed: None,
    };
    assert_eq!(chosen(&trials, limits), 2);
    let limits = ChoiceLimits {
        cost: None,
        bleed: Some(1.0),
    };
    assert_eq!(chosen(&trials, limits), 3);
    trials[1].outcome = TrialOutcome::Dropped;
    assert_eq!(chosen(&trials, ChoiceLimits::default()), 2);
    trials[2].outcome = TrialOutcome::Failed {
        reason: "it serves a test".to_owned(),
    };
    assert_eq!(chosen(&trials, ChoiceLimits::default()), 3);
}

fn names(all: &[&str]) -> Vec<String> {
    all.iter().map(|name| (*name).to_owned()).collect()
}

#[test]
fn a_choice_that_suits_only_one_family_shows_its_gap() {
    let families = BTreeMap::from([("camera", names(&["a", "b"])), ("thin", names(&["c", "d"]))]);
    // One trial suits the camera, the other suits thin things; each doubles the other's error.
    let rows = [
        (8, [0.1; 4]),
        (9, [0.05, 0.05, 0.2, 0.2]),
        (10, [0.2, 0.2, 0.05, 0.05]),
    ];
    let folds = cross_validate(
        &make_trials(&rows),
        &space(),
        ChoiceLimits::default(),
        &families,
    );
    let two = 2f64.ln();
    for (fold, (family, trial)) in folds.iter().zip([("camera", 2), ("thin", 1)]) {
        assert_eq!(
            (fold.family.as_str(), fold.trial, fold.scenes),
            (family, trial, 2)
        );
        // Exact except for the logarithm's rounding.
        assert!((fold.others + two).abs() < 1e-12 && (fold.held_out - two).abs() < 1e-12);
        assert!((fold.gap - 2.0 * two).abs() < 1e-12, "{}", fold.gap);
    }
    assert_eq!(folds.len(), 2);
    let alone = BTreeMap::from([("camera", names(&["a", "b", "c", "d"]))]);
    assert!(
        cross_validate(
            &make_trials(&rows),
            &space(),
            ChoiceLimits::default(),
            &alone
        )
        .is_empty()
    );
}

fn compare_pairs(rows: &[(f64, f64)]) -> PairedComparison {
    let score = |flip| SceneScore {
        flip,
        bleed: Some(10.0 * flip),
    };
    let scenes = rows.iter().enumerate();
    PairedComparison::new(
        scenes
            .map(|(index, (first, second))| (index.to_string(), [score(*first), score(*second)]))
            .collect(),
    )
}

#[test]
fn lower_error_on_every_scene_is_better_and_on_half_of_them_undecided() {
    let better = compare_pairs(&[
        (0.2, 0.1),
        (0.3, 0.2),
        (0.1, 0.08),
        (0.2, 0.15),
        (0.1, 0.07),
    ]);
    assert_eq!(better.flip.verdict, Preference::Second);
    assert_eq!(better.bleed.as_ref().unwrap().verdict, Preference::Second);
    // Mean of -1, -1, -0.2, -0.5 and -0.3 pixels.
    assert!((better.bleed.unwrap().mean + 0.6).abs() < 1e-9);
    let worse = compare_pairs(&[
        (0.1, 0.2),
        (0.2, 0.3),
        (0.08, 0.1),
        (0.15, 0.2),
        (0.07, 0.1),
    ]);
    assert_eq!(worse.flip.verdict, Preference::First);
    let even = compare_pairs(&[(0.1, 0.2), (0.2, 0.1), (0.1, 0.2), (0.2, 0.1), (0.1, 0.1)]);
    assert_eq!(even.flip.verdict, Preference::Undecided);
    let few = compare_pairs(&[(0.2, 0.1), (0.3, 0.2), (0.1, 0.08), (0.2, 0.15)]);
    assert_eq!(
        few.flip.verdict,
        Preference::Undecided,
        "four scenes decide nothing"
    );
}
