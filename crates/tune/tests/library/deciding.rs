//! Choice among candidates: dropped ones, the chosen one, and why.

use std::collections::BTreeMap;

use filters::{Filter, Value};
use tune::{
    Choice, ChoiceLimits, PairedComparison, Preference, SceneScore, Space, Trial, TrialOutcome,
    choose_trial, cross_validate, pareto_front, signed_rank_p_value,
};

#[test]
fn the_signed_rank_test_has_wilcoxons_probabilities() {
    // In Wilcoxon's table for n = 8, the smaller sum 5 is the last one below 5 % on one side, and 3
    // below 2.5 %. Of 2^8 arrangements, 5, 10 and 14 have a sum of at most 3, 5 and 6.
    let eight = |below: i32| {
        let signed = |rank: i32| f64::from(if rank == below { -rank } else { rank });
        (1..=8).map(signed).collect::<Vec<f64>>()
    };
    let rows: [(&[f64], f64); 8] = [
        (&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0], 1.0 / 64.0),
        (&[-1.0, -2.0, -3.0, -4.0, -5.0, -6.0], 1.0),
        // Equal sizes share their ranks, here 1.5 each: the sums 3, 1.5, 1.5 and 0 are equally
        // likely.
        (&[1.0, 1.0], 0.25),
        (&[1.0, -1.0], 0.75),
        // Zeros do not count.
        (&[0.0, 1.0, 0.0, -1.0], 0.75),
        // The ranks are 2, 2, 2 and 4, and the sum is 6: 8 of 16 arrangements reach it. If the
        // three had rank 1, 9 would.
        (&[1.0, 1.0, 1.0, -2.0], 0.5),
        (&[], 1.0),
        (&[0.0], 1.0),
    ];
    for (differences, probability) in rows {
        let actual = signed_rank_p_value(differences);
        assert_eq!(actual, probability, "{differences:?}");
    }
    for (below, count) in [(3, 5.0), (5, 10.0), (6, 14.0)] {
        assert_eq!(signed_rank_p_value(&eight(below)), count / 256.0);
    }
    // Darwin's heights of crossed less self-fertilised plants, in eighths of an inch:
    // scipy.stats.wilcoxon gives W+ = 96 and, with alternative "greater", p = 0.0206.
    let plants = [49, -67, 8, 16, 6, 23, 28, 41, 14, 29, 56, 24, 75, 60, -48];
    let probability = signed_rank_p_value(&plants.map(f64::from));
    assert!((probability - 0.0206).abs() < 1e-4, "{probability}");
}

#[test]
fn the_front_holds_unbeaten_candidates() {
    let rows = [[1, 5], [2, 4], [3, 4], [4, 1], [2, 4], [5, 5]];
    let rows = rows.map(|row| row.map(f64::from).to_vec());
    // The second beats the third, the fifth equals it, and all beat the last.
    assert_eq!(pareto_front(&rows), [0, 1, 3]);
    assert!(pareto_front(&[]).is_empty());
}

/// Makes a start with samples = 8, and trials with other numbers of samples and the given FLIP on
/// scenes a, b, c, d.
fn make_trials(rows: &[(i32, [f64; 4])]) -> Vec<Trial> {
    let scenes = |flips: &[f64; 4]| {
        let names = ["a", "b", "c", "d"].map(str::to_owned).into_iter();
        let bleed = None;
        let scores = flips.map(|flip| SceneScore { flip, bleed });
        names.zip(scores).collect()
    };
    let make = |(trial, (samples, flips)): (usize, &(i32, [f64; 4]))| Trial {
        trial,
        values: BTreeMap::from([("samples".to_owned(), Value::Integer(*samples))]),
        outcome: TrialOutcome::Done,
        loss: 0.0,
        error: None,
        bleed: Some(f64::from(*samples) / 8.0),
        cost: Some(f64::from(*samples) / 8.0),
        scenes: scenes(flips),
    };
    rows.iter().enumerate().map(make).collect()
}

fn space() -> Space {
    let filter = Filter::builtin("jump_flood").unwrap();
    let start = filter.settings(Some("paper")).unwrap();
    Space::new(&filter, start, &["samples".to_owned()]).unwrap()
}

fn choose(trials: &[Trial], limits: ChoiceLimits) -> Choice {
    choose_trial(trials, &space(), limits, |_| true).unwrap()
}

#[test]
fn the_choice_among_equal_candidates_is_the_nearest_to_the_start() {
    let trials = make_trials(&[
        (8, [0.1, 0.1, 0.1, 0.1]),
        // About half the error everywhere: the best.
        (60, [0.05, 0.04, 0.06, 0.05]),
        // Better on one scene and worse on another, and much closer to the start.
        (12, [0.05, 0.042, 0.058, 0.05]),
        // Even closer, and clearly worse.
        (10, [0.08, 0.08, 0.08, 0.08]),
    ]);
    let choice = choose(&trials, ChoiceLimits::default());
    assert_eq!((choice.best, choice.trial), (1, 2));
    // Logs of 1, 1.05, 0.9667 and 1: the mean is 0.0037, the standard deviation 0.0340, and that of
    // the mean 0.0170.
    let loss = choice.loss;
    assert!((loss.mean - 0.00372).abs() < 1e-4, "{loss:?}");
    assert!((loss.standard_error - 0.01702).abs() < 1e-4, "{loss:?}");
    // A start that is not beaten everywhere stays.
    let trials = make_trials(&[(8, [0.1; 4]), (9, [0.05, 0.16, 0.09, 0.11])]);
    let choice = choose(&trials, ChoiceLimits::default());
    assert_eq!((choice.best, choice.trial), (1, 0));
}

#[test]
fn a_choice_that_is_worse_on_every_scene_is_not_excused_by_what_scenes_have_to_gain() {
    // There is much to gain on two scenes, little on the others; the third trial is 2 % worse on
    // each.
    let gained = [0.01, 0.02, 0.08, 0.09];
    let rows = |worse: [f64; 4]| {
        let second = [0, 1, 2, 3].map(|scene| gained[scene] * worse[scene]);
        make_trials(&[(8, [0.1; 4]), (60, gained), (12, second)])
    };
    let trial = |worse| choose(&rows(worse), ChoiceLimits::default()).trial;
    assert_eq!(trial([1.02, 1.021, 1.019, 1.02]), 1);
    // Even a loss below 1 % counts if every scene shows it.
    assert_eq!(trial([1.005, 1.004, 1.006, 1.005]), 1);
    assert_eq!(trial([1.02, 0.99, 1.01, 0.99]), 2);
    // The scenes do not tell a mean loss of 3 % from none, and it is too large to be given away.
    assert_eq!(trial([1.20, 0.95, 1.02, 0.97]), 1);
}

#[test]
fn one_scene_excuses_no_loss_and_two_excuse_one_on_which_they_disagree() {
    let rows = [
        (8, [0.1; 4]),
        (60, [0.05; 4]),
        (12, [0.0499, 0.0502, 0.05, 0.0501]),
    ];
    let on = |scenes: &str| {
        let counts = |scene: &str| scenes.contains(scene);
        let choice = choose_trial(
            &make_trials(&rows),
            &space(),
            ChoiceLimits::default(),
            counts,
        );
        choice.unwrap().trial
    };
    assert_eq!(on("b"), 1, "worse");
    assert_eq!(on("c"), 2, "equal");
    assert_eq!(on("bd"), 1, "worse on both");
    assert_eq!(on("ab"), 2, "worse on one, better on the other");
    assert!(
        choose_trial(
            &make_trials(&rows),
            &space(),
            ChoiceLimits::default(),
            |_| false
        )
        .is_none()
    );
}

#[test]
fn limits_and_failures_keep_trials_out_of_the_choice() {
    let rows = [(8, 0.1), (16, 0.02), (12, 0.05), (4, 0.06)];
    let mut trials = make_trials(&rows.map(|(samples, flip)| (samples, [flip; 4])));
    let chosen = |trials: &[Trial], cost, bleed| choose(trials, ChoiceLimits { cost, bleed }).trial;
    assert_eq!(chosen(&trials, None, None), 1);
    assert_eq!(chosen(&trials, Some(1.5), None), 2);
    assert_eq!(chosen(&trials, None, Some(1.0)), 3);
    trials[1].outcome = TrialOutcome::Dropped;
    assert_eq!(chosen(&trials, None, None), 2);
    let reason = "it serves a test".to_owned();
    trials[2].outcome = TrialOutcome::Failed { reason };
    assert_eq!(chosen(&trials, None, None), 3);
}

#[test]
fn a_choice_that_suits_only_one_family_shows_its_gap() {
    // One trial suits the camera, the other suits thin things; each doubles the other's error.
    let [camera, thin] = [[0.05, 0.05, 0.2, 0.2], [0.2, 0.2, 0.05, 0.05]];
    let trials = make_trials(&[(8, [0.1; 4]), (9, camera), (10, thin)]);
    let validate = |families: &[(&'static str, &str)]| {
        let names = |scenes: &str| scenes.split(' ').map(str::to_owned).collect();
        let families = families.iter().map(|(name, scenes)| (*name, names(scenes)));
        let limits = ChoiceLimits::default();
        cross_validate(&trials, &space(), limits, &families.collect())
    };
    let folds = validate(&[("camera", "a b"), ("thin", "c d")]);
    let two = 2f64.ln();
    assert_eq!(folds.len(), 2);
    for (fold, (family, trial)) in folds.iter().zip([("camera", 2), ("thin", 1)]) {
        assert_eq!((fold.family.as_str(), fold.trial), (family, trial));
        assert_eq!(fold.scenes, 2);
        // Exact except for the logarithm's rounding.
        assert!((fold.others + two).abs() < 1e-12 && (fold.held_out - two).abs() < 1e-12);
        assert!((fold.gap - 2.0 * two).abs() < 1e-12, "{}", fold.gap);
    }
    assert!(validate(&[("camera", "a b c d")]).is_empty());
}

#[test]
fn lower_error_on_every_scene_is_better_and_on_half_of_them_undecided() {
    let compare = |first: &[f64], second: &[f64]| {
        let score = |flip: f64| {
            let bleed = Some(10.0 * flip);
            SceneScore { flip, bleed }
        };
        let pairs = first.iter().zip(second);
        let pairs = pairs.map(|(a, b)| [score(*a), score(*b)]);
        let names = ["a", "b", "c", "d", "e"].map(str::to_owned);
        PairedComparison::new(names.into_iter().zip(pairs).collect())
    };
    let high = [0.2, 0.3, 0.1, 0.2, 0.1];
    let low = [0.1, 0.2, 0.08, 0.15, 0.07];
    let better = compare(&high, &low);
    assert_eq!(better.flip.verdict, Preference::Second);
    let bleed = better.bleed.unwrap();
    assert_eq!(bleed.verdict, Preference::Second);
    // Mean of -1, -1, -0.2, -0.5 and -0.3 pixels.
    assert!((bleed.mean + 0.6).abs() < 1e-9);
    let verdict = |first: &[f64], second: &[f64]| compare(first, second).flip.verdict;
    assert_eq!(verdict(&low, &high), Preference::First);
    let even = verdict(&[0.1, 0.2, 0.1, 0.2, 0.1], &[0.2, 0.1, 0.2, 0.1, 0.1]);
    assert_eq!(even, Preference::Undecided);
    let few = verdict(&high[..4], &low[..4]);
    assert_eq!(few, Preference::Undecided, "four scenes decide nothing");
}
