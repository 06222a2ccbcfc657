//! Ranking of filters: within a shutter by FLIP, across shutters by skill.

use std::collections::BTreeMap;

use cli::run_table;
use frame::Alignment;
use judge::compare_runs;
use measure::{Case, CaseId, FORMAT, InputFormat, Overall, Run, StoredRun, overall};
use metrics::{Measured, Metric, Scores};
use scene::{Family, SceneId};
use tests::synthetic::{Blur, Object, Shape};
use tests::text::assert_contains;
use tests::unwatched;

use crate::{measure_blur, scene};

/// Difficulty of a run's scenes relative to one another.
const SCENES: [f64; 5] = [0.6, 0.8, 1.0, 1.2, 1.4];

/// A filter or reference: its alignment, and its mean FLIP and FLIP*.
type Entry = (&'static str, bool, Alignment, f64, f64);

/// Difficulties of the five scenes of `make run`.
const ENTRIES: [Entry; 8] = [
    ("identity", true, Alignment::Trailing, 0.270, 0.154),
    ("scatter_oracle", true, Alignment::Trailing, 0.050, 0.120),
    ("accumulate:1", true, Alignment::Trailing, 0.156, 0.250),
    ("identity", true, Alignment::Centred, 0.154, 0.154),
    ("scatter_oracle", true, Alignment::Centred, 0.024, 0.024),
    ("jump_flood:paper", false, Alignment::Trailing, 0.100, 0.140),
    ("kino:default", false, Alignment::Centred, 0.087, 0.087),
    ("jimenez:wicked", false, Alignment::Centred, 0.253, 0.253),
];

/// Makes scores with arbitrary values.
fn any_scores() -> Scores {
    let disc = Object::sliding(Shape::Disc(6.0), [24.0, 16.0], [12.0, 0.0]);
    measure_blur(&scene([48, 32], vec![disc]), Blur::TRUE).scores
}

fn make_case(scene: usize, scores: &Scores, (name, bar, alignment, flip, common): Entry) -> Case {
    let of = |name: &str| {
        let entry = (ENTRIES.iter()).find(|entry| (entry.0, entry.2) == (name, alignment));
        entry.unwrap().3 * SCENES[scene]
    };
    let flip = flip * SCENES[scene];
    let sharp = match alignment {
        Alignment::Centred => "identity",
        _ => "accumulate:1",
    };
    let [sharp, best] = [sharp, "scatter_oracle"].map(of);
    let mut scores = scores.clone();
    scores.moving.flip = Measured::score(flip, 0.0);
    scores.skill.flip = Measured::score((sharp - flip) / (sharp - best), 1.0);
    let mut moving = scores.moving.clone();
    moving.flip = Measured::score(common * SCENES[scene], 0.0);
    let (filter, preset) = name.split_once(':').unwrap_or((name, ""));
    Case {
        id: CaseId {
            scene: SceneId::new(format!("scene_{scene}"), None),
            filter: filter.to_owned(),
            preset: preset.to_owned(),
            is_reference: bar,
            input: InputFormat::default(),
            overrides: BTreeMap::new(),
            alignment,
        },
        family: Some(Family::Translation),
        drawn: None,
        exposes: "nothing".to_owned(),
        rate: None,
        exposure: 0.5,
        parameters: BTreeMap::new(),
        reference_width: None,
        command: None,
        convention: None,
        nonlinearity: None,
        truth_hash: alignment.to_string(),
        scores,
        intervals: BTreeMap::new(),
        common: moving,
        jitter: None,
        folder: name.replace(':', "_").into(),
    }
}

fn make_run() -> Run {
    let scores = any_scores();
    let cases: Vec<Case> = (0..SCENES.len())
        .flat_map(|scene| ENTRIES.map(|entry| make_case(scene, &scores, entry)))
        .collect();
    Run {
        frames: measure::Frames::default(),
        sequences: Vec::new(),
        format: FORMAT,
        program: measure::PROGRAM.to_owned(),
        command: Vec::new(),
        adapter: None,
        render: tests::settings_of([48, 32], 16, 2),
        common_alignment: Alignment::Centred,
        overall: overall(&cases),
        read_back: 0,
        seconds: Default::default(),
        failures: Vec::new(),
        cases,
    }
}

fn mean<'a>(run: &'a Run, filter: &str, metric: &str) -> &'a Overall {
    let mut all = run.overall.iter();
    let mean = all.find(|mean| mean.name == filter && mean.metric.name() == metric);
    mean.unwrap_or_else(|| panic!("{metric} of {filter} has no mean"))
}

/// Returns the table of means after this many equal headings, up to a text.
fn print_means(run: &Run, heading: usize, end: &str) -> String {
    let text = run_table(run).plain();
    let means = text.split("mean over 5 scenes").nth(heading).unwrap();
    means.split(end).next().unwrap().to_owned()
}

/// Expects names in this order.
fn assert_order(text: &str, names: &[&str]) {
    let places = names.iter().map(|name| text.find(name).expect(name));
    assert!(places.is_sorted(), "{names:?} in {text}");
}

#[test]
fn a_trailing_filter_of_more_skill_ranks_above_a_centred_one_of_less_flip() {
    let run = make_run();
    let [flip, skill] = ["flip_moving", "skill_flip"].map(|metric| {
        ["jump_flood:paper", "kino:default"].map(|filter| mean(&run, filter, metric).mean)
    });
    assert!(flip[0] > flip[1], "{flip:?}");
    // (0.156 - 0.100) / (0.156 - 0.050) and (0.154 - 0.087) / (0.154 - 0.024).
    for (actual, due) in skill.into_iter().zip([0.5283, 0.5154]) {
        assert!((actual - due).abs() < 1e-3, "{skill:?}");
    }
    let ranking = print_means(&run, 2, "Skill is by");
    assert_order(&ranking, &["jump_flood:paper", "kino:default"]);
}

#[test]
fn a_filter_worse_than_doing_nothing_ranks_below_it() {
    let run = make_run();
    let skill = mean(&run, "jimenez:wicked", "skill_flip");
    let due = (0.154 - 0.253) / 0.130;
    assert!((skill.mean - due).abs() < 1e-9, "{skill:?}");
    assert!(skill.interval[1] < 0.0);
    // The filter's FLIP is nevertheless smaller than the identity's against the trailing truth.
    assert!(mean(&run, "jimenez:wicked", "flip_moving").mean < 0.270);
    let ranking = print_means(&run, 2, "Skill is by");
    // The trailing frame lags: it is worse still, and its lag has a line of its own.
    let (above, below) = ranking.split_once("jimenez:wicked").unwrap();
    assert_contains(above, &["[accumulate:1]", "[identity]"]);
    assert_contains(below, &["[identity]"]);
    assert_eq!(
        judge::lag_text(&run.cases).unwrap(),
        // 0.270 - 0.156, since the scenes' difficulties average 1.
        "Lag behind the frame, identity less accumulate:1: FLIP 0.114 under a trailing shutter."
    );
}

#[test]
fn a_ranking_by_flip_stays_within_a_shutter_and_shows_its_references() {
    let run = make_run();
    let means = print_means(&run, 1, "Mean skill");
    let (trailing, centred) = means.split_once("centred shutter").unwrap();
    let centred = centred.split("\n\n").next().unwrap();
    let trailing = trailing.split_once("trailing shutter").unwrap().1;
    let of_trailing = "[scatter_oracle] jump_flood:paper [accumulate:1] [identity]";
    let of_centred = "[scatter_oracle] kino:default [identity] jimenez:wicked";
    for (rows, names) in [(trailing, of_trailing), (centred, of_centred)] {
        let rows = rows.lines().skip(1).filter(|line| line.starts_with("  "));
        let is_name = |word: &&str| word.contains(':') || word.starts_with('[');
        let actual = rows.filter_map(|line| line.split_whitespace().find(is_name));
        assert_eq!(actual.collect::<Vec<_>>().join(" "), names);
    }
    let text = run_table(&run).plain();
    let fits = text.lines().all(|line| line.chars().count() <= 80);
    assert!(fits, "{text}");
}

#[test]
fn skill_over_scenes_is_a_ratio_of_means() {
    let scores = any_scores();
    let mut cases: Vec<Case> = (0..2)
        .flat_map(|scene| ENTRIES.map(|entry| make_case(scene, &scores, entry)))
        .collect();
    // On the second scene nothing can be gained, and the filter's gain there is noise: ten times
    // nearly nothing.
    for case in cases.iter_mut().filter(|case| case.scene.name == "scene_1") {
        let flip = match case.filter.as_str() {
            "identity" => 0.101,
            "scatter_oracle" => 0.100,
            _ => 0.091,
        };
        case.scores.moving.flip = Measured::score(flip, 0.0);
        case.scores.skill.flip = Measured::score((0.101 - flip) / 0.001, 1.0);
    }
    let means = overall(&cases).into_iter();
    let mut means = means.filter(|mean| mean.name == "kino:default");
    let mean = means.find(|mean| mean.metric == Metric::SKILL).unwrap();
    let [way, gained] = [0.6 * (0.154 - 0.024), 0.6 * (0.154 - 0.087)];
    let due = (gained + 0.010) / (way + 0.001);
    assert!((mean.mean - due).abs() < 1e-9, "{mean:?} {due}");
}

#[test]
fn compared_runs_have_the_means_of_skill_of_each_run() {
    let [first, mut second] = [make_run(), make_run()];
    let is_own =
        |case: &&mut Case| case.name() == "jump_flood:paper" && case.scene.name == "scene_0";
    let case = second.cases.iter_mut().find(is_own).unwrap();
    case.scores.skill.flip = Measured::score(1.0, 1.0);
    second.overall = overall(&second.cases);
    // The first scene has 0.6 of 5 parts of what there is to gain, and not a fifth.
    let old = (0.156 - 0.100) / (0.156 - 0.050);
    let due = [old, 0.12 + 0.88 * old];
    let runs = [first, second].map(|run| StoredRun {
        path: "no_such_folder/run.json".into(),
        run,
    });
    let [first, second] = &runs;
    let compared = compare_runs(first, second, &BTreeMap::new(), &unwatched).unwrap();
    let mut means = compared.means.iter();
    let is_own = |mean: &&judge::MeanChange| {
        mean.filter == "jump_flood:paper" && mean.metric == Metric::SKILL
    };
    let change = means.find(is_own).unwrap();
    for (actual, due) in [change.first, change.second].into_iter().zip(due) {
        assert!((actual - due).abs() < 1e-9, "{actual}, not {due}");
    }
    for (run, due) in runs.iter().zip(due) {
        let actual = mean(&run.run, "jump_flood:paper", "skill_flip").mean;
        assert!((actual - due).abs() < 1e-9, "{actual}, not {due}");
    }
}

#[test]
fn one_scene_has_no_mean() {
    let scores = any_scores();
    let cases: Vec<Case> = (0..2)
        .flat_map(|scene| ENTRIES.map(|entry| make_case(scene, &scores, entry)))
        .collect();
    assert!(overall(&cases[..ENTRIES.len()]).is_empty());
    assert!(overall(&cases).iter().all(|mean| mean.scenes == 2));
}

#[test]
fn scenes_without_skill_are_counted() {
    let mut run = make_run();
    assert!(
        !run_table(&run)
            .plain()
            .contains("Scenes that skill applies to")
    );
    let centred = run.cases.iter_mut();
    for case in
        centred.filter(|case| case.scene.name == "scene_2" && case.alignment == Alignment::Centred)
    {
        case.scores.skill.flip = Measured::not_applicable("it serves a test");
    }
    run.overall = overall(&run.cases);
    let text = run_table(&run).plain();
    assert_contains(&text, &["Scenes that skill applies to: 4 of 5 centred."]);
}

#[test]
fn flip_against_the_common_shutter_has_a_mean_of_its_own() {
    let run = make_run();
    assert!((mean(&run, "jump_flood:paper", "flip_common").mean - 0.140).abs() < 1e-12);
    let flip = run.cases[0].scores.get(Metric::FLIP);
    assert_ne!(run.cases[0].common.flip, flip);
}

#[test]
fn bleed_is_the_largest_of_three_and_names_its_side() {
    let mut run = make_run();
    run.cases.truncate(ENTRIES.len());
    run.overall.clear();
    for (pixels, shown) in [
        ([0.0, 4.8, 4.7], " 4.80> "),
        ([0.0, 4.8, 14.72], " 14.7< "),
        ([15.0, 4.8, 14.72], " 15.0 "),
    ] {
        let mover = &mut run.cases[7].scores.objects[0];
        let [lateral, leading, trailing] = pixels.map(|pixels| Measured::score(pixels, 0.0));
        mover.bleed_lateral = lateral;
        mover.bleed_leading = leading;
        mover.bleed_trailing = trailing;
        let text = run_table(&run).plain();
        // A long name has a line of its own, before its scores.
        let row = text.split("jimenez:wicked").nth(1).unwrap();
        let scores = row.lines().take(2).collect::<String>();
        assert!(scores.contains(shown), "{text}");
        assert!(text.contains("ahead (>)"), "{text}");
    }
}
