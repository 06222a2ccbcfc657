//! Sequences: consecutive frames of a scene, with scores from frame to frame, and their ranking
//! over scenes.

use std::collections::BTreeMap;
use std::fs;
use std::time::SystemTime;

use judge::{RANKED_BY, RankedSequence, rank_sequences, rank_sequences_on};
use measure::{Run, Sequence};
use metrics::{Measured, PERFECT_JOD, SequenceMetric};
use scene::SceneId;
use tests::text::assert_contains;

use crate::sandbox::{
    IDENTITY, SCENE, Sandbox, assert_done, assert_refused, files_below, split, stdout,
};

const TWO: &str = "--filters identity --frames 2";
const THREE: &str = "--filters identity --frames 3";

/// Finds the sequence of a filter.
#[track_caller]
fn find<'a>(run: &'a Run, filter: &str) -> &'a Sequence {
    let mut sequences = run
        .sequences
        .iter()
        .filter(|sequence| !sequence.is_reference);
    sequences
        .find(|sequence| sequence.name == format!("{filter}:default"))
        .expect("the run has a sequence of the filter")
}

/// Reads the modification times of all measured and rendered files below `out/plate`.
fn read_times(sandbox: &Sandbox) -> BTreeMap<String, SystemTime> {
    let out = sandbox.path("out/plate");
    let mut times = BTreeMap::new();
    for path in files_below(&out) {
        let name = path.strip_prefix(&out).unwrap().display().to_string();
        if name.ends_with("case.json") || name.ends_with(".exr") {
            times.insert(name, fs::metadata(path).unwrap().modified().unwrap());
        }
    }
    times
}

#[test]
fn a_sequence_begins_with_the_frame_without_one_and_goes_on_where_it_ended() {
    let sandbox = Sandbox::measured();
    let single = sandbox.read_run();
    let read = || {
        let names = "frame.exr truth_trailing.exr identity_default/output.exr";
        let files = split(names).into_iter();
        let read = files.map(|name| fs::read(sandbox.path("out/plate").join(name)).unwrap());
        read.collect::<Vec<_>>()
    };
    let before = read();
    sandbox.measure("--filters identity --frames 1");
    let text = |run: &Run| serde_json::to_string(&run.cases).unwrap();
    let one = sandbox.read_run();
    assert_eq!(text(&one), text(&single));
    assert!(one.sequences.is_empty() && one.frames.is_one());

    fs::remove_dir_all(sandbox.path("out")).unwrap();
    sandbox.measure(TWO);
    let times = read_times(&sandbox);
    sandbox.measure(TWO);
    assert_eq!(read_times(&sandbox), times);
    let printed = sandbox.measure(THREE);
    let after = read_times(&sandbox).into_iter();
    let (new, kept): (BTreeMap<_, _>, BTreeMap<_, _>) =
        after.partition(|(name, _)| name.starts_with("0002/"));
    assert_eq!(kept, times);
    assert!(new.len() > 10, "{new:?}");
    let run = sandbox.read_run();
    assert_eq!(text(&run), text(&single), "bit for bit");
    assert!(read() == before, "bit for bit");
    let sequence = find(&run, "identity");
    let hashes = [0, 1, 2].map(|at| &sequence.frames[at].truth_hash);
    assert_eq!(*hashes[0], single.cases[0].truth_hash);
    assert!(hashes[1] != hashes[0] && hashes[2] != hashes[1]);
    // The plate moves at a constant speed and looks the same in every frame.
    let [first, last] = [0, 2].map(|at| sequence.frames[at].error.unwrap());
    assert!((first / last - 1.0).abs() < 0.1, "{first} {last}");
    assert_page(&sandbox, &printed);
    // JOD depends on the rate: sequences of two rates cannot be one run.
    let other = "--filters velocity_gather:fine --frames 3 --fps 24";
    let parts = [
        "number of frames was 3 at 60 per second, now 3 at 24 per second",
        "--out",
    ];
    assert_refused(&sandbox.run(&split(other)), 2, &parts);
}

/// Three frames have a page, and an animation for each case.
fn assert_page(sandbox: &Sandbox, printed: &str) {
    let parts = [
        "3 frames",
        "plate, trailing shutter",
        "flick",
        "along",
        "dirt",
        "- no blur",
        "out/sequences.html",
    ];
    assert_contains(printed, &parts);
    let mut lines = printed.lines();
    assert!(lines.all(|line| line.chars().count() <= 80), "{printed}");
    let page = sandbox.text("out/sequences.html");
    let paths = [
        "plate/0001/frame.png",
        "plate/0002/identity_default/change.png",
        "plate/truth_trailing.png",
    ];
    assert_contains(&page, &paths);
    for path in paths {
        assert!(sandbox.path("out").join(path).is_file(), "{path}");
    }
    assert!(page.contains("img-src data: 'self' file:"));
    let report = sandbox.text("out/report.html");
    assert!(report.contains("href=\"sequences.html\""));
    let animation = fs::read(sandbox.path("out/plate/identity_default/sequence.png")).unwrap();
    let chunks = |name: &[u8]| animation.windows(4).filter(|bytes| *bytes == name).count();
    assert_eq!((chunks(b"acTL"), chunks(b"fcTL")), (1, 3));
}

#[test]
fn a_filter_with_history_reads_the_frame_before() {
    let sandbox = Sandbox::new();
    let body = "let before = textureLoad(color_before, pixel, 0).rgb;
    let motion = textureLoad(velocity_before, pixel, 0).xy;
    let depth = textureLoad(depth_before, pixel, 0).x;
    let now = textureLoad(color, pixel, 0).rgb;
    let unseen = 0.0 * (now + motion.x + min(depth, 1.0));
    textureStore(output, pixel, vec4<f32>(before + unseen + f32(frame.frame_index), 1.0));";
    let textures = ["color_before", "velocity_before", "depth_before"];
    let write = |history: &str| sandbox.write_kernel("before", history, &textures, body);
    write("history = [\"color\", \"velocity\", \"depth\"]");
    sandbox.measure("--filter ./before --frames 3");
    let [frames, outputs] = ["frame.exr", "before_default/output.exr"].map(|name| {
        let paths = ["", "0001/", "0002/"].map(|frame| format!("out/plate/{frame}{name}"));
        paths.map(|path| sandbox.read_color(&path))
    });
    // The first frame serves as its own previous frame.
    for (index, before) in [0, 0, 1].into_iter().enumerate() {
        let due = frames[before].map(|pixel| pixel.map(|value| value + index as f32));
        assert!(outputs[index] == due, "frame {index}");
    }
    assert!(frames[1] != frames[0]);

    write("");
    let parts = ["\"color_before\" is no known input", "`history` names them"];
    assert_refused(&sandbox.run(&["--filter", "./before"]), 2, &parts);
    write("history = [\"color\", \"color\"]");
    let parts = ["filter.toml:4", "history names \"color\" twice"];
    assert_refused(&sandbox.run(&["--filter", "./before"]), 2, &parts);
}

#[test]
fn frames_at_which_a_scene_is_not_defined_are_refused() {
    let sandbox = Sandbox::new();
    let path = SCENE.replace(
        "{ time = 0, translation = [0, 0, 0] },",
        "{ time = 0, translation = [0, 0, 0] },\n    { time = 2.5, translation = [1, 0, 0] },",
    );
    sandbox.write("scene.toml", &path);
    let refused = sandbox.run(&[&IDENTITY[..], &["--frames", "4"]].concat());
    let parts = [
        "scene plate/0003",
        "the motion of object plate at frame 3",
        "end at frame 2.5",
        "two keys",
    ];
    assert_refused(&refused, 2, &parts);
    assert!(!sandbox.path("out/plate").exists(), "nothing was rendered");
    sandbox.done("truths render --quiet --size 64x32 --samples-per-pixel 16 --frames 3");
}

/// `merge::truths` joins the parts of a frame.
#[test]
#[ignore = "prove: the parts of a sequence"]
fn parts_of_a_rendered_sequence_merge_to_what_a_run_reads_back() {
    let sandbox = Sandbox::new();
    for part in ["0..3 --out one", "3..8 --out two"] {
        let words = "truths render --quiet --size 64x32 --samples-per-pixel 16 --frames 2";
        sandbox.done(&format!("{words} --replicates {part}"));
    }
    sandbox.done("truths merge --quiet one two --out out");
    let written = || sandbox.written("out/plate/0001/truth_trailing.exr");
    let before = written();
    sandbox.measure(TWO);
    assert_eq!(written(), before);
}

/// Lists the names of a ranking with their ranks: `1 a`, `2-3 b`.
fn names(ranking: &[Vec<RankedSequence>]) -> Vec<String> {
    let ranked = ranking.iter().flatten().map(|entry| &entry.ranked);
    ranked
        .filter(|ranked| ranked.is_ranked())
        .map(|ranked| format!("{} {}", ranked.rank_text(), ranked.name))
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
        for original in run
            .sequences
            .iter()
            .filter(|sequence| sequence.scene == "plate")
        {
            let mut sequence = original.clone();
            sequence.scene.clone_from(&name);
            let value = PERFECT_JOD - lost(&sequence.name, f64::from(scene));
            *sequence.scores.get_mut(RANKED_BY) = Measured::score(value, PERFECT_JOD - floor);
            made.sequences.push(sequence);
        }
    }
    made
}

#[test]
fn sequences_are_ranked_by_means_over_scenes_with_intervals_and_ties() {
    let sandbox = Sandbox::two_scenes();
    let filters = "velocity_gather:coarse,velocity_gather:fine,velocity_gather:departure";
    let words = format!("--filters identity,{filters} --frames 2 --jitter-frames 0");
    let output = sandbox.run(&split(&words));
    assert_done(&output);
    let run = sandbox.read_run();
    let text = stdout(&output);
    let mut lines = text.lines();
    let title = lines.find(|line| line.contains("2 scenes, 2 frames"));
    let parts = ["JOD", "95 % CI", "error", "along", "worst scene"];
    assert_contains(title.expect("a ranking"), &parts);
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
    let ranking = rank_sequences(&run);
    let is_ranked = |entry: &&RankedSequence| entry.ranked.is_ranked();
    let ranks = ranking.iter().flatten().filter(is_ranked).count();
    assert_eq!(ranks, 3, "one rank per filter");
    assert_eq!(ranking.concat().len(), 4, "and no blur");
    for entry in ranking.iter().flatten() {
        let shown = |scene: &str| {
            let mut sequences = run.sequences.iter();
            let sequence = sequences
                .find(|sequence| sequence.scene == scene && sequence.name == entry.ranked.name);
            RANKED_BY.shown(sequence.unwrap().scores.get(RANKED_BY).value().unwrap())
        };
        let [plate, slow] = ["plate", "slow"].map(shown);
        let mean = (plate + slow) / 2.0;
        assert!((entry.ranked.mean - mean).abs() < 1e-9, "{entry:?}");
        // Student's t of one degree of freedom, by the table's digits.
        let half = 12.706 * (plate - slow).abs() / 2.0;
        let [low, high] = entry.ranked.interval.unwrap();
        assert!(((high - low) / 2.0 / half - 1.0).abs() < 1e-4, "{entry:?}");
        let [mean, low, high] = [mean, low, high].map(|jod| RANKED_BY.shown_text(jod));
        let due = [mean, format!("{low} to {high}")];
        let mut lines = text
            .lines()
            .filter(|line| line.contains(entry.ranked.shown_name()));
        let is_shown = lines.any(|line| due.iter().all(|part| line.contains(part)));
        assert!(is_shown, "{due:?} is missing from:\n{text}");
    }
    // The page has the same ranking, and every scene its own.
    let page = sandbox.text("out/sequences.html");
    let opened = page.split(" selected>").nth(1).unwrap();
    let opened = opened.split('<').next().unwrap();
    assert!(opened.contains("velocity_gather"), "{opened}");
    let first = &names(&ranking)[0];
    assert_contains(&page, &["Means over 2 scenes, ranked by jod", first]);
    assert_ties(&run);
}

/// Ranks synthetic scores: filters that are equal in every scene, or on one scene within the floor,
/// share their ranks.
fn assert_ties(run: &Run) {
    let fine = "velocity_gather:fine";
    let departure = "velocity_gather:departure";

    // In every scene fine is a little better than coarse, and the third differs from it by chance
    // alone.
    let by = |name: &str, scene: f64| match name {
        "velocity_gather:fine" => 1.0 + 0.1 * scene,
        "velocity_gather:coarse" => 1.1 + 0.101 * scene,
        _ => 1.1 + 0.101 * scene + if scene % 2.0 == 0.0 { 0.05 } else { -0.04 },
    };
    let far = with_scores(run, by, 0.01);
    let noisy = with_scores(run, by, 0.12);
    let first = SceneId::new("scene0", None);
    for (ranking, ranks) in [
        (rank_sequences(&far), ["1", "2-3", "2-3"]),
        // On one scene the floor decides.
        (rank_sequences_on(&far, &first), ["1", "2", "3"]),
        // The losses are 1.00, 1.10 and 1.15: only the first and the last differ by more than the
        // floor.
        (rank_sequences_on(&noisy, &first), ["1-2", "1-3", "2-3"]),
    ] {
        let due = std::iter::zip(ranks, [fine, "velocity_gather:coarse", departure]);
        let due = due.map(|(rank, name)| format!("{rank} {name}"));
        assert_eq!(names(&ranking), due.collect::<Vec<_>>());
    }
    let means = &rank_sequences(&far)[0][0].means;
    assert_eq!(means.len(), SequenceMetric::ALL.len());
    assert_eq!(means[2].1.unwrap().scenes, 6);
}
