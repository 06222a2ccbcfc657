//! Measurements in addition to the filters' own scores: references, a common shutter, noise,
//! coarser frames.

use frame::{Alignment, Frame, Ladder, Truth};
use measure::{Case, DepthFormat, FinishedPicture, Run, VelocityFormat};
use metrics::Metric;
use tests::text::assert_contains;

use crate::sandbox::{SCENE, Sandbox, assert_done, quick_command, split};

pub fn find_case<'a>(cases: &'a [Case], name: &str) -> &'a Case {
    let case = cases.iter().find(|case| case.name() == name);
    case.unwrap_or_else(|| {
        let names: Vec<String> = cases.iter().map(|case| case.name()).collect();
        panic!("no {name} among {names:?}")
    })
}

fn flip(case: &Case) -> f64 {
    case.scores.moving.flip.value().unwrap()
}

#[test]
fn filters_of_two_alignments_share_a_common_shutter() {
    let sandbox = Sandbox::new();
    sandbox.measure("--filters velocity_gather:fine,bevy");
    let run = sandbox.read_run();
    assert_eq!(run.common_alignment, Alignment::Centred);
    for case in &run.cases {
        let is_common = case.common == case.scores.moving;
        assert_eq!(
            is_common,
            case.alignment == Alignment::Centred,
            "{}",
            case.name()
        );
    }
    // The mean of many sub-frames, half an exposure early, does not match the common interval.
    let many = run.cases.iter().filter(|case| case.preset == "64");
    let many: Vec<&Case> = many.collect();
    assert_eq!(many.len(), 2, "64 sub-frames of each alignment");
    assert_eq!(many[0].alignment, Alignment::Trailing);
    let late = many[0].common.flip.value().unwrap();
    assert!(late > 4.0 * flip(many[0]), "{late}");
}

#[test]
fn a_sharp_sub_frame_of_the_middle_has_no_skill_under_any_shutter() {
    let sandbox = Sandbox::new();
    sandbox.write("scene.toml", &SCENE.replace("-1.6, 0, 0", "-3.2, 0, 0"));
    let filters = ["--filters", "velocity_gather:fine,bevy"];
    let text = sandbox.execute(&[&quick_command("run", "64")[..], &filters].concat());
    let run = sandbox.read_run();
    let find = |bar: &str, alignment: Alignment| {
        let mut cases = run.cases.iter();
        cases.find(|case| case.name() == bar && case.alignment == alignment)
    };
    // Skill is measured from a sharp picture of the shutter's middle to the one-frame oracle.
    for (bar, alignment, expected) in [
        ("accumulate:1", Alignment::Trailing, 0.0),
        ("identity", Alignment::Centred, 0.0),
        ("scatter_oracle", Alignment::Trailing, 1.0),
        ("scatter_oracle", Alignment::Centred, 1.0),
    ] {
        let case = find(bar, alignment).unwrap();
        let skill = case.scores.get("skill_flip".parse().unwrap());
        assert_eq!(skill.value(), Some(expected), "{bar} {alignment}");
    }
    assert!(find("accumulate:1", Alignment::Centred).is_none());
    // The table has a row for the lag behind the frame.
    let lag = flip(find("identity", Alignment::Trailing).unwrap())
        - flip(find("accumulate:1", Alignment::Trailing).unwrap());
    assert!(lag > 0.05, "{lag}");
    let mut lines = text.lines();
    let row = lines.find(|line| line.contains("lag behind the frame"));
    let cells: Vec<&str> = row.expect(&text).split_whitespace().skip(4).collect();
    assert_eq!(cells, [format!("{lag:.3}").as_str(), "-"]);

    let frame = Frame::read(&sandbox.path("out/plate/frame.exr")).unwrap();
    for alignment in ["trailing", "centred"] {
        let path = |name: &str| sandbox.path(&format!("out/plate/{name}"));
        let truth = Truth::read(&path(&format!("truth_{alignment}.exr"))).unwrap();
        let ladder = Ladder::read_rung(&path(&format!("ladder_{alignment}/n1.exr")), 1).unwrap();
        let sharp = ladder.rungs[0].picture(&truth.mean());
        let finished = FinishedPicture {
            color: sharp.color,
            mattes: Some(sharp.coverage),
            display_referred: false,
            notes: Vec::new(),
        };
        let scored = measure::score(&finished, &frame, &truth, Some(&ladder)).unwrap();
        for metric in ["skill_flip", "skill_mse", "skill_label_tv"] {
            let skill = scored.scores.get(metric.parse().unwrap()).value().unwrap();
            // The frame and the sub-frame have different noise.
            assert!(skill.abs() < 0.03, "{metric}, {alignment}: {skill}");
        }
    }
}

#[test]
fn references_beat_filters_and_have_no_bounds() {
    let sandbox = Sandbox::new();
    let filters = "--filters identity,velocity_gather:fine";
    sandbox.measure(filters);
    let cases = sandbox.read_run().cases;
    let [many, oracle, gather] = ["accumulate:64", "scatter_oracle", "velocity_gather:fine"]
        .map(|name| flip(find_case(&cases, name)));
    // The plate moves evenly in front of one colour, so it hides nothing that matters. The oracle's
    // only error is the frame's antialiasing of a plate five pixels wide.
    assert!(many < oracle && oracle < 0.75 * gather);
    let sandbox = Sandbox::new();
    sandbox.write_bound(0.0001);
    assert_eq!(sandbox.check(&split(filters)).status.code(), Some(1));
    let findings = sandbox.read_findings();
    for case in &sandbox.read_run().cases {
        let judged = findings.iter().any(|finding| finding.is_of(case));
        assert_ne!(case.is_reference, judged, "{}", case.name());
    }
}

#[test]
fn variance_is_measured_for_filters_with_noise() {
    let sandbox = Sandbox::new();
    let filters = "--filters velocity_gather:fine,jump_flood:paper --jitter-frames";
    let noisy = sandbox.measure(&format!("{filters} 4 --table"));
    let cases = sandbox.read_filter_cases();
    assert_eq!(find_case(&cases, "velocity_gather:fine").jitter, None);
    let jitter = find_case(&cases, "jump_flood:paper").jitter.unwrap();
    assert_eq!(jitter.frames, 4);
    assert!(jitter.variance > 0.0 && jitter.bias > 0.0);
    // Long names have a line of their own, before their scores.
    let lines: Vec<&str> = noisy.lines().collect();
    let row = lines
        .iter()
        .position(|line| line.contains("jump_flood:paper"));
    let scores = lines[row.unwrap()..].iter().take(2);
    assert!(scores.clone().any(|line| line.contains('%')), "{noisy}");

    sandbox.measure(&format!("{filters} 0"));
    let cases = sandbox.read_run().cases;
    assert!(cases.iter().all(|case| case.jitter.is_none()));
}

#[test]
fn forms_of_the_input_cost_what_they_take_away() {
    let sandbox = Sandbox::new();
    let filters = "--filters identity,velocity_gather:fine";
    let forms = "--input defect=zero,double,lag,no_object,jittered \
        --input velocity=float16,linear8,kino10,tile_clamped --input depth=float16 --input border=clamp";
    let told = sandbox.measure(&format!("{filters} {forms}"));
    let cases = sandbox.read_filter_cases();
    assert_eq!(cases.len(), 2 * 12);
    let identity = flip(find_case(&cases, "identity:default"));
    let of_identity = cases.iter().filter(|case| case.filter == "identity");
    for case in of_identity.filter(|case| !case.name().ends_with("border=clamp")) {
        // A filter that reads neither velocity nor depth does not depend on how they are stored.
        assert_eq!(flip(case), identity, "{}", case.name());
    }
    let whole = find_case(&cases, "velocity_gather:fine");
    let right = flip(whole);
    let changed = |form: &str| find_case(&cases, &format!("velocity_gather:fine {form}"));
    let differs = |form: &str| (flip(changed(form)) - right).abs();
    // Nothing is blurred without velocity, and the plate's is the only one.
    assert_eq!(flip(changed("defect=zero")), identity);
    assert!((flip(changed("defect=no_object")) - identity).abs() < 1e-6);
    assert!(flip(changed("defect=double")) > right + 0.01);
    // The plate moves evenly, so a late frame makes no difference.
    assert!(differs("defect=lag") < 1e-4);
    assert!(differs("defect=jittered") > 0.0);
    assert_eq!(differs("depth=float16"), 0.0);
    // A gather of 20 fetches; a 16-bit float is accurate to 1 part in 2048.
    assert!(differs("velocity=float16") < 0.002);
    // Kino's half smear ends at 5 % of 32 rows: 1.6 of the plate's 2.8 pixels. Half a tile is
    // longer than all of it.
    assert!(differs("velocity=kino10") > 0.01);
    assert!(differs("velocity=tile_clamped") < 0.002);
    // The plate stays clear of the border, so nothing there can change its score.
    let clamped = &changed("border=clamp").scores;
    assert_eq!(clamped.full, whole.scores.full);
    assert_eq!(clamped.objects, whole.scores.objects);

    let due = format!("{:+.3}", identity - right);
    let mut rows = told.lines().map(str::trim_start);
    let row = rows.find(|line| line.starts_with("defect=zero")).unwrap();
    assert!(row.ends_with(&due), "{told}");
    // The ranking only covers the right buffer.
    assert!(!told.contains("velocity_gather:fine defect"), "{told}");
    assert!(told.contains("velocity=linear8"), "{told}");
    let case = changed("velocity=linear8");
    assert_eq!(case.input.velocity, VelocityFormat::Linear8);
    assert_eq!(case.input.depth, DepthFormat::Float32);
    let folder = "velocity_gather_fine_velocity_linear8";
    assert!(case.folder.ends_with(folder));
}

/// Checks the mean of the identity's FLIP on two scenes; returns its interval.
fn assert_mean(run: &Run) -> [f64; 2] {
    let name = "identity:default";
    let identities = run.cases.iter().filter(|case| case.name() == name);
    let [first, second] = identities.map(flip).collect::<Vec<_>>()[..] else {
        panic!("two scenes");
    };
    let mut means = run.overall.iter();
    let mean = means.find(|mean| mean.name == name && mean.metric == Metric::FLIP);
    let mean = mean.unwrap();
    assert_eq!(mean.scenes, 2);
    // The standard error of two scores is half of their difference, and t for one degree of freedom
    // is 12.706.
    let half = 12.706 * 0.5 * (second - first).abs();
    let [low, high] = mean.interval;
    assert!((0.5 * (high - low) / half - 1.0).abs() < 1e-4, "{mean:?}");
    assert!((0.5 * (high + low) - mean.mean).abs() < 1e-12, "{mean:?}");
    // A check's mean is over estimates.
    if run.cases.iter().all(|case| case.intervals.is_empty()) {
        assert!((mean.mean - 0.5 * (first + second)).abs() < 1e-12);
    }
    mean.interval
}

#[test]
fn means_over_scenes_have_a_student_interval() {
    let sandbox = Sandbox::measured();
    // A run of one scene has no mean over scenes.
    assert!(sandbox.read_run().overall.is_empty());
    assert!(!sandbox.measure("--filters identity").contains("mean over"));

    sandbox.copy_scene("farther", |text| text.replace("-1.6, 0, 0", "-3.2, 0, 0"));
    let bounds = "[default]\nflip_moving = { limit = 0.9, why = \"it serves a test\" }\n";
    sandbox.write("../bounds.toml", bounds);
    let filters = "--filters identity,velocity_gather:fine";
    let text = sandbox.measure(&format!("{filters} --table"));
    let [low, high] = assert_mean(&sandbox.read_run());
    let ranking = &text[text.find("mean over 2 scenes").unwrap()..];
    let names = ["[accumulate:64]", "velocity_gather:", "identity:"];
    let places = names.map(|name| ranking.find(name).unwrap());
    assert!(places.is_sorted(), "{ranking}");
    assert_contains(ranking, &[&format!("{low:.3} to {high:.3}")]);
    let mut lines = text.lines();
    assert!(lines.all(|line| line.chars().count() <= 80 || line.contains(": out")));

    // The scores contain each truth's noise already: a check, which knows the noise, gives the same
    // mean.
    assert_done(&sandbox.check(&split(filters)));
    assert_mean(&sandbox.read_run());
}
