//! Ranking of filters: within a shutter by FLIP, across shutters by skill.

use std::collections::BTreeMap;

use cli::{run_table, terminal_text};
use frame::Alignment;
use metrics::{ImageMetric, Measured, Metric, Reference, Region, Scores};
use suite::{Case, CaseId, FORMAT, InputFormat, Overall, Run, overall};
use tests::synthetic::{Object, Sampling, Scene, Shape, VIEWING};
use tracer::{Family, RenderSettings, SceneId};

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

/// Makes scores whose values do not matter.
fn any_scores() -> Scores {
    let scene = Scene {
        width: 48,
        height: 32,
        objects: vec![Object::sliding(Shape::Disc(6.0), [24.0, 16.0], [12.0, 0.0])],
    };
    let (frame, truth) = (scene.frame(), scene.truth([Sampling::CLEAN; 2]));
    let reference = Reference::new(&frame, &truth, None, &VIEWING).unwrap();
    reference.measure(&truth.mean()).unwrap().scores
}

fn make_case(scene: usize, scores: &Scores, (name, bar, alignment, flip, common): Entry) -> Case {
    let of = |name: &str| {
        let own = ENTRIES
            .iter()
            .find(|entry| (entry.0, entry.2) == (name, alignment));
        own.unwrap().3 * SCENES[scene]
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
        frames: suite::Frames::default(),
        sequences: Vec::new(),
        format: FORMAT,
        program: suite::PROGRAM.to_owned(),
        command: Vec::new(),
        adapter: None,
        render: RenderSettings {
            width: 48,
            height: 32,
            samples_per_pixel: 16,
            replicates: 2,
            ..RenderSettings::default()
        },
        common_alignment: Alignment::Centred,
        overall: overall(&cases),
        read_back: 0,
        failures: Vec::new(),
        cases,
    }
}

fn mean<'a>(run: &'a Run, filter: &str, metric: &str) -> &'a Overall {
    let mut found = run.overall.iter();
    let found = found.find(|mean| mean.filter == filter && mean.metric.name() == metric);
    found.unwrap_or_else(|| panic!("{metric} of {filter} has no mean"))
}

/// Returns the names of the rows between two texts of the printed table, in order.
fn rows(text: &str, from: &str, to: &str) -> Vec<String> {
    let (_, text) = text.split_once(from).expect(from);
    let text = text.split_once(to).map_or(text, |(text, _)| text);
    let rows = text.lines().skip(1).filter(|line| line.starts_with("  "));
    rows.map(|line| line.split_whitespace().next().unwrap().to_owned())
        .collect()
}

/// Prints the run's table without colour codes.
fn print_table(run: &Run) -> String {
    let mut text = String::new();
    for (index, part) in terminal_text(&run_table(run)).split('\u{1b}').enumerate() {
        text += match index {
            0 => part,
            _ => part.split_once('m').expect("a code of a colour").1,
        };
    }
    text
}

#[test]
fn a_trailing_filter_of_more_skill_ranks_above_a_centred_one_of_less_flip() {
    let run = make_run();
    let [flip, skill] = ["flip_moving", "skill_flip"].map(|metric| {
        ["jump_flood:paper", "kino:default"].map(|filter| mean(&run, filter, metric).mean)
    });
    assert!(flip[0] > flip[1], "{flip:?}");
    // (0.156 - 0.100) / (0.156 - 0.050) and (0.154 - 0.087) / (0.154 - 0.024).
    assert!(
        (skill[0] - 0.5283).abs() < 1e-3 && (skill[1] - 0.5154).abs() < 1e-3,
        "{skill:?}"
    );
    let text = print_table(&run);
    let (_, ranking) = text.rsplit_once("mean over 5 scenes").unwrap();
    let place = |name: &str| ranking.find(name).expect(name);
    assert!(
        place("jump_flood:paper") < place("kino:default"),
        "{ranking}"
    );
}

#[test]
fn a_filter_worse_than_doing_nothing_ranks_below_it() {
    let run = make_run();
    let skill = mean(&run, "jimenez:wicked", "skill_flip");
    assert!(
        (skill.mean - (0.154 - 0.253) / 0.130).abs() < 1e-9,
        "{skill:?}"
    );
    assert!(skill.interval[1] < 0.0);
    // Its FLIP is nevertheless smaller than the identity's against the trailing truth.
    assert!(mean(&run, "jimenez:wicked", "flip_moving").mean < 0.270);
    let text = print_table(&run);
    let (_, ranking) = text.rsplit_once("mean over 5 scenes").unwrap();
    let (ranking, _) = ranking.split_once("Skill is by").unwrap();
    // The trailing frame lags: it is worse still, and its lag is told apart.
    let place = |name: &str| ranking.find(name).unwrap();
    assert!(
        place("[accumulate:1]") < place("jimenez:wicked"),
        "{ranking}"
    );
    assert!(place("[identity]") < place("jimenez:wicked"), "{ranking}");
    assert!(
        place("jimenez:wicked") < ranking.rfind("[identity]").unwrap(),
        "{ranking}"
    );
    assert_eq!(
        judge::lag_text(&run.cases).unwrap(),
        // 0.270 - 0.156, since the scenes' difficulties average 1.
        "Lag behind the frame, identity less accumulate:1: FLIP 0.114 under a trailing shutter."
    );
}

#[test]
fn a_ranking_by_flip_stays_within_a_shutter_and_shows_its_references() {
    let text = print_table(&make_run());
    let (_, means) = text.split_once("mean over 5 scenes").unwrap();
    let (means, _) = means.split_once("mean over 5 scenes").unwrap();
    assert_eq!(
        rows(means, "trailing shutter", "centred shutter"),
        [
            "[scatter_oracle]",
            "jump_flood:paper",
            "[accumulate:1]",
            "[identity]"
        ]
    );
    assert_eq!(
        rows(means, "centred shutter", "\n\n"),
        [
            "[scatter_oracle]",
            "kino:default",
            "[identity]",
            "jimenez:wicked"
        ]
    );
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
}

#[test]
fn skill_over_scenes_is_a_ratio_of_means() {
    let scores = any_scores();
    let mut cases: Vec<Case> = (0..2)
        .flat_map(|scene| ENTRIES.map(|entry| make_case(scene, &scores, entry)))
        .collect();
    // On the second scene nothing can be gained, and the filter's gain there is noise: ten times nearly nothing.
    for case in cases.iter_mut().filter(|case| case.scene.name == "scene_1") {
        let flip = match case.filter.as_str() {
            "identity" => 0.101,
            "scatter_oracle" => 0.100,
            _ => 0.091,
        };
        case.scores.moving.flip = Measured::score(flip, 0.0);
        case.scores.skill.flip = Measured::score((0.101 - flip) / 0.001, 1.0);
    }
    let means = overall(&cases);
    let found = means
        .iter()
        .find(|mean| mean.filter == "kino:default" && mean.metric == Metric::SKILL)
        .unwrap();
    let [way, gained] = [0.6 * (0.154 - 0.024), 0.6 * (0.154 - 0.087)];
    let due = (gained + 0.010) / (way + 0.001);
    assert!((found.mean - due).abs() < 1e-9, "{found:?} {due}");
}

#[test]
fn scenes_without_skill_are_counted() {
    let mut run = make_run();
    assert!(!print_table(&run).contains("Scenes that skill applies to"));
    let centred = run.cases.iter_mut();
    for case in
        centred.filter(|case| case.scene.name == "scene_2" && case.alignment == Alignment::Centred)
    {
        case.scores.skill.flip = Measured::not_applicable("it serves a test");
    }
    run.overall = overall(&run.cases);
    let text = print_table(&run);
    assert!(
        text.contains("Scenes that skill applies to: 4 of 5 centred."),
        "{text}"
    );
}

#[test]
fn flip_against_the_common_shutter_has_a_mean_of_its_own() {
    let run = make_run();
    assert!((mean(&run, "jump_flood:paper", "flip_common").mean - 0.140).abs() < 1e-12);
    let own = run.cases[0]
        .scores
        .get(metrics::Metric::Image(ImageMetric::Flip, Region::Moving));
    assert_ne!(run.cases[0].common.flip, own);
}

#[test]
fn bleed_is_the_largest_of_three_and_names_its_side() {
    let mut run = make_run();
    run.cases.truncate(ENTRIES.len());
    run.overall.clear();
    let mover = &mut run.cases[7].scores.objects[0];
    let sides = [
        &mut mover.bleed_lateral,
        &mut mover.bleed_leading,
        &mut mover.bleed_trailing,
    ];
    for (side, pixels) in sides.into_iter().zip([0.0, 4.8, 4.7]) {
        *side = Measured::score(pixels, 0.0);
    }
    let ahead = print_table(&run);
    let line = |text: &str| {
        let mut lines = text.lines();
        lines
            .find(|line| line.contains("wicked"))
            .unwrap()
            .to_owned()
    };
    assert!(line(&ahead).contains(" 4.80> "), "{ahead}");
    let mover = &mut run.cases[7].scores.objects[0];
    mover.bleed_trailing = Measured::score(14.72, 0.0);
    assert!(
        line(&print_table(&run)).contains(" 14.7< "),
        "{}",
        print_table(&run)
    );
    let mover = &mut run.cases[7].scores.objects[0];
    mover.bleed_lateral = Measured::score(15.0, 0.0);
    assert!(
        line(&print_table(&run)).contains(" 15.0 "),
        "{}",
        print_table(&run)
    );
    assert!(ahead.contains("ahead (>)"), "{ahead}");
}
