//! Measurements beside the filters' own scores: references, a common shutter, noise, coarser frames.

use frame::{Alignment, Frame, Ladder, Picture, Truth};
use metrics::Metric;
use suite::{Case, DepthFormat, FinishedPicture, Overall, Run, VelocityFormat};

use crate::sandbox::{SCENE, Sandbox, assert_done, assert_refused, quick_command, split, stdout};

fn find_case<'a>(cases: &'a [Case], name: &str) -> &'a Case {
    let found = cases.iter().find(|case| case.name() == name);
    found.unwrap_or_else(|| {
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
    assert_done(&sandbox.run(&["--filters", "velocity_gather:fine,bevy"]));
    let run = sandbox.read_run();
    assert_eq!(run.common_alignment, Alignment::Centred);
    for case in &run.cases {
        let own = case.common == case.scores.moving;
        assert_eq!(own, case.alignment == Alignment::Centred, "{}", case.name());
    }
    // The mean of many sub-frames, half an exposure early, does not match the common interval.
    let bars = run.cases.iter().filter(|case| case.preset == "64");
    let many: Vec<&Case> = bars.collect();
    assert_eq!(many.len(), 2, "64 sub-frames of each alignment");
    assert_eq!(many[0].alignment, Alignment::Trailing);
    let late = many[0].common.flip.value().unwrap();
    assert!(late > 4.0 * flip(many[0]), "{late}");
    // A narrower run keeps the cases of the wider one, and so their common shutter.
    assert_done(&sandbox.run(&["--filters", "velocity_gather:fine"]));
    assert_eq!(sandbox.read_run().common_alignment, Alignment::Centred);
    assert_done(&sandbox.run(&["--filters", "velocity_gather:fine", "--no-cache"]));
    assert_eq!(sandbox.read_run().common_alignment, Alignment::Trailing);
}

#[test]
fn a_sharp_sub_frame_of_the_middle_has_no_skill_under_any_shutter() {
    let sandbox = Sandbox::new();
    sandbox.write("scene.toml", &SCENE.replace("-1.6, 0, 0", "-3.2, 0, 0"));
    let filters = ["--filters", "velocity_gather:fine,bevy"];
    let text = sandbox.execute(&[&quick_command("run", "64")[..], &filters].concat());
    let run = sandbox.read_run();
    let find = |bar: &str, alignment: Alignment| {
        let mut found = run.cases.iter();
        found.find(|case| case.name() == bar && case.alignment == alignment)
    };
    // Skill is measured from a sharp picture of the shutter's middle to the one-frame oracle.
    for (bar, alignment, expected) in [
        ("accumulate:1", Alignment::Trailing, 0.0),
        ("identity", Alignment::Centred, 0.0),
        ("scatter_oracle", Alignment::Trailing, 1.0),
        ("scatter_oracle", Alignment::Centred, 1.0),
    ] {
        let found = find(bar, alignment).unwrap();
        let skill = found.scores.get("skill_flip".parse().unwrap());
        assert_eq!(skill.value(), Some(expected), "{bar} {alignment}");
    }
    assert!(find("accumulate:1", Alignment::Centred).is_none());
    // The lag behind the frame has a row of its own.
    let lag = flip(find("identity", Alignment::Trailing).unwrap())
        - flip(find("accumulate:1", Alignment::Trailing).unwrap());
    assert!(lag > 0.05, "{lag}");
    let row = text
        .lines()
        .find(|line| line.contains("lag behind the frame"));
    let cells: Vec<&str> = row.expect(&text).split_whitespace().skip(4).collect();
    assert_eq!(cells, [format!("{lag:.3}").as_str(), "-"]);

    let frame = Frame::read(&sandbox.path("out/plate/frame.exr")).unwrap();
    for alignment in ["trailing", "centred"] {
        let path = |name: &str| sandbox.path(&format!("out/plate/{name}"));
        let truth = Truth::read(&path(&format!("truth_{alignment}.exr"))).unwrap();
        let ladder = Ladder::read_rung(&path(&format!("ladder_{alignment}/n1.exr")), 1).unwrap();
        let sharp = Picture::mean(&ladder.rungs[0].halves);
        let finished = FinishedPicture {
            color: sharp.color,
            mattes: Some(sharp.coverage),
            display_referred: false,
            notes: Vec::new(),
        };
        let scored = suite::score(&finished, &frame, &truth, Some(&ladder)).unwrap();
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
    sandbox.write_bound(0.0001);
    assert_done(&sandbox.run(&["--filters", "identity,velocity_gather:fine"]));
    let cases = sandbox.read_run().cases;
    let oracle = flip(find_case(&cases, "scatter_oracle"));
    let many = flip(find_case(&cases, "accumulate:64"));
    let gather = flip(find_case(&cases, "velocity_gather:fine"));
    // The plate moves evenly before one colour, so it hides nothing that matters. The oracle's only error is the
    // frame's antialiasing of a plate five pixels wide.
    assert!(
        many < oracle && oracle < 0.75 * gather,
        "{many} {oracle} {gather}"
    );
    let findings = sandbox.read_findings();
    for case in &cases {
        let judged = findings.iter().any(|finding| finding.is_of(case));
        assert_ne!(case.is_reference, judged, "{}", case.name());
    }
}

#[test]
fn variance_is_measured_for_filters_with_noise() {
    let sandbox = Sandbox::new();
    let filters = "velocity_gather:fine,jump_flood:paper";
    let output = sandbox.run(&["--filters", filters, "--jitter-frames", "4", "--table"]);
    assert_done(&output);
    let cases = sandbox.read_filter_cases();
    assert_eq!(find_case(&cases, "velocity_gather:fine").jitter, None);
    let jitter = find_case(&cases, "jump_flood:paper").jitter.unwrap();
    assert_eq!(jitter.frames, 4);
    assert!(jitter.variance > 0.0 && jitter.bias > 0.0);
    let noisy = stdout(&output);
    let line = noisy.lines().find(|line| line.contains("jump_flood:paper"));
    assert!(line.unwrap().contains('%'), "{noisy}");

    assert_done(&sandbox.run(&["--filters", filters, "--jitter-frames", "0"]));
    assert!(
        sandbox
            .read_run()
            .cases
            .iter()
            .all(|case| case.jitter.is_none())
    );
}

#[test]
fn defects_of_velocity_cost_what_they_take_away() {
    let sandbox = Sandbox::new();
    let output = sandbox.run(&split(
        "--filters identity,velocity_gather:fine --input defect=zero,double,lag,no_object,jittered",
    ));
    assert_done(&output);
    let cases = sandbox.read_filter_cases();
    assert_eq!(cases.len(), 2 * 6);
    let identity = flip(find_case(&cases, "identity:default"));
    let right = flip(find_case(&cases, "velocity_gather:fine"));
    let changed = |change: &str| flip(find_case(&cases, &format!("velocity_gather:fine {change}")));
    // Nothing is blurred without velocity, and the plate's is the only one.
    assert_eq!(changed("defect=zero"), identity);
    assert!((changed("defect=no_object") - identity).abs() < 1e-6);
    assert!(
        changed("defect=double") > right + 0.01,
        "{}",
        changed("defect=double")
    );
    // The plate moves evenly, so that a frame late is no difference.
    assert!((changed("defect=lag") - right).abs() < 1e-4);
    assert_ne!(changed("defect=jittered"), right);
    let told = stdout(&output);
    let due = format!("{:+.3}", identity - right);
    let row = told
        .lines()
        .find(|line| line.trim_start().starts_with("defect=zero"))
        .unwrap();
    assert!(row.ends_with(&due), "{told}");
    // The ranking is of the right buffer alone.
    assert!(!told.contains("velocity_gather:fine defect"), "{told}");
    let camera_only = split("--filters identity --velocity camera_only --input defect=lag");
    let refused = sandbox.run(&camera_only);
    assert_refused(&refused, 2, &["defect=lag", "the camera alone"]);
}

#[test]
fn coarser_buffers_raise_the_error() {
    let sandbox = Sandbox::new();
    let output = sandbox.run(&split(
        "--filters identity,velocity_gather:fine --input velocity=float16,linear8,kino10,tile_clamped \
         --input depth=float16",
    ));
    assert_done(&output);
    let cases = sandbox.read_filter_cases();
    assert_eq!(cases.len(), 2 * 6);
    let identity = flip(find_case(&cases, "identity:default"));
    for case in &cases[..6] {
        // A filter that reads neither velocity nor depth does not depend on how they are stored.
        assert_eq!(flip(case), identity, "{}", case.name());
    }
    let whole = flip(find_case(&cases, "velocity_gather:fine"));
    let changed = |change: &str| flip(find_case(&cases, &format!("velocity_gather:fine {change}")));
    assert_eq!(changed("depth=float16"), whole);
    // A gather of 20 fetches; a 16-bit float is accurate to 1 part in 2048.
    assert!((changed("velocity=float16") - whole).abs() < 0.002);
    // Kino's half smear ends at 5 % of 32 rows: 1.6 of the plate's 2.8 pixels. Half a tile is longer than all of it.
    let cut = changed("velocity=kino10");
    assert!((cut - whole).abs() > 0.01, "{cut} {whole}");
    assert!((changed("velocity=tile_clamped") - whole).abs() < 0.002);
    let told = stdout(&output);
    assert!(told.contains("velocity=linear8"), "{told}");
    let case = find_case(&cases, "velocity_gather:fine velocity=linear8");
    assert_eq!(case.input.velocity, VelocityFormat::Linear8);
    assert_eq!(case.input.depth, DepthFormat::Float32);
    assert!(
        case.folder
            .ends_with("velocity_gather_fine_velocity_linear8")
    );
}

#[test]
fn a_clamped_border_is_cropped_before_scoring() {
    let sandbox = Sandbox::new();
    let words = [
        "--filters",
        "velocity_gather:fine",
        "--input",
        "border=clamp",
    ];
    assert_done(&sandbox.run(&words));
    let cases = sandbox.read_filter_cases();
    let clamped = find_case(&cases, "velocity_gather:fine border=clamp");
    // The plate stays clear of the border, so nothing there can change its score.
    let whole = find_case(&cases, "velocity_gather:fine");
    assert_eq!(clamped.scores.full, whole.scores.full);
    assert_eq!(clamped.scores.objects, whole.scores.objects);
    let output = sandbox.run(&["--input", "border=mirror"]);
    assert_refused(&output, 2, &["mirror", "leave, clamp"]);
}

#[test]
fn means_over_scenes_have_a_student_interval() {
    let sandbox = Sandbox::new();
    assert_done(&sandbox.run(&["--filters", "identity"]));
    assert!(
        sandbox.read_run().overall.is_empty(),
        "one scene is no mean"
    );
    assert!(!stdout(&sandbox.run(&["--filters", "identity"])).contains("mean over"));

    sandbox.copy_scene("farther", |text| text.replace("-1.6, 0, 0", "-3.2, 0, 0"));
    sandbox.write(
        "../bounds.toml",
        "[default]\nflip_moving = { limit = 0.9, why = \"it serves a test\" }\n",
    );
    let filters = ["--filters", "identity,velocity_gather:fine"];
    let output = sandbox.run(&[&filters[..], &["--table"]].concat());
    assert_done(&output);
    let (scores, mean) = identity_overall(&sandbox.read_run());
    assert_eq!(mean.scenes, 2);
    assert!((mean.mean - 0.5 * (scores[0] + scores[1])).abs() < 1e-12);
    // The standard error of two scores is half of their difference, and t for one degree of freedom is 12.706.
    let half = 12.706 * 0.5 * (scores[1] - scores[0]);
    let [low, high] = mean.interval;
    assert!((0.5 * (high - low) / half - 1.0).abs() < 1e-4, "{mean:?}");
    assert!((0.5 * (high + low) - mean.mean).abs() < 1e-12, "{mean:?}");
    let text = stdout(&output);
    let ranking = &text[text.find("mean over 2 scenes").unwrap()..];
    let place = |name: &str| ranking.find(name).unwrap();
    assert!(place("[accumulate:64]") < place("velocity_gather:fine"));
    assert!(
        place("velocity_gather:fine") < place("identity:default"),
        "{ranking}"
    );
    assert!(
        ranking.contains(&format!("{low:.3} to {high:.3}")),
        "{ranking}"
    );
    assert!(
        text.lines()
            .all(|line| line.chars().count() <= 80 || line.contains(": out"))
    );

    assert_done(&sandbox.check(&filters));
    // The scores contain each truth's noise already: a check, which knows the noise, gives the same mean.
    let (scores, mean) = identity_overall(&sandbox.read_run());
    let half = 12.706 * 0.5 * (scores[1] - scores[0]);
    let [low, high] = mean.interval;
    assert!((0.5 * (high - low) / half - 1.0).abs() < 1e-4, "{mean:?}");
}

/// Returns the identity's FLIP on both scenes, the better one first, and its mean.
fn identity_overall(run: &Run) -> ([f64; 2], Overall) {
    let mut scores: Vec<f64> = (run.cases.iter())
        .filter(|case| case.name() == "identity:default")
        .map(flip)
        .collect();
    scores.sort_by(f64::total_cmp);
    let mean = run
        .overall
        .iter()
        .find(|mean| (&mean.name[..], mean.metric) == ("identity:default", Metric::FLIP));
    (scores.try_into().unwrap(), mean.unwrap().clone())
}
