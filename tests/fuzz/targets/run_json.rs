//! Files that `run`, `accept` and `bench` wrote and other commands read again.

use std::collections::BTreeMap;
use std::fs;
use std::ops::ControlFlow;
use std::path::Path;

use cli::{annotations, check_text, compare_table, junit, run_table, summary};
use judge::{
    Acceptance, Baseline, Finding, Judgement, Margin, RunBounds, Side, accept_scores, add_evidence,
    check, compare_runs, compare_with_baseline, judge, read_bounds,
};
use metrics::{Metric, ObjectMetric};
use report::{LARGEST_PAGE, compare_page, write_report};
use suite::{Run, write_layers};

use crate::place::Place;
use crate::seeds::Seed;
use crate::target::{Shape, Target};
use crate::{huge, tokens};

/// run.json.
pub static RUN: Target = Target {
    name: "run_json",
    share: 600,
    batch: 70,
    shape: Shape::Text,
    tokens: tokens::JSON,
    seeds: |place| vec![of(place, "out/run.json"), Seed::Made(huge::deep_json)],
    run: |place, input| {
        let folder = place.copy("out");
        let path = place.write("out/run.json", input);
        let Ok(run) = Run::read(&path) else {
            return;
        };
        read_by_all(&run, &folder, place);
        let first = place.fixture.join("out");
        if let (Ok(first), Ok(second)) = (Side::read(&first), Side::read(&path)) {
            compare_both(&first, &second);
            compare_both(&second, &first);
        }
    },
};

/// A baseline.
pub static BASELINE: Target = Target {
    name: "baseline",
    share: 450,
    batch: 250,
    shape: Shape::Text,
    tokens: tokens::JSON,
    seeds: |place| vec![of(place, "base.json"), Seed::Made(huge::deep_json)],
    run: |place, input| {
        let path = place.write("base.json", input);
        let Ok(baseline) = Baseline::read(&path) else {
            return;
        };
        let run = Run::read(&place.fixture.join("out/run.json")).unwrap();
        if let Ok(comparisons) = compare_with_baseline(&run, &baseline, &margins(), &path) {
            show(&run, Vec::new(), comparisons, &place.folder);
        }
        accept_run(&run, Some(baseline));
    },
};

/// bench.json, which a report reads.
pub static BENCH: Target = Target {
    name: "bench_json",
    share: 150,
    batch: 75,
    shape: Shape::Text,
    tokens: tokens::JSON,
    seeds: |place| vec![of(place, "out/bench.json"), Seed::Made(huge::deep_json)],
    run: |place, input| {
        let folder = place.copy("out");
        place.write("out/bench.json", input);
        let run = Run::read(&folder.join("run.json")).unwrap();
        write_page(&run, &[], &folder);
    },
};

/// judgement.json, which a report reads.
pub static JUDGEMENT: Target = Target {
    name: "judgement",
    share: 250,
    batch: 75,
    shape: Shape::Text,
    tokens: tokens::JSON,
    seeds: |place| vec![of(place, "out/judgement.json"), Seed::Made(huge::deep_json)],
    run: |place, input| {
        let folder = place.copy("out");
        place.write("out/judgement.json", input);
        let run = Run::read(&folder.join("run.json")).unwrap();
        if let Ok(Some(judgement)) = Judgement::read(&run, &folder) {
            write_page(&run, &judgement.findings, &folder);
        }
    },
};

/// Reads a file of the fixture as a seed.
pub fn of(place: &Place, name: &str) -> Seed {
    // The self-test has no fixture, and needs none of these.
    Seed::Bytes(fs::read(place.fixture.join(name)).unwrap_or_default())
}

fn read_by_all(run: &Run, folder: &Path, place: &Place) {
    drop(run_table(run));
    let mut findings = judge(run, &bounds(run, place));
    drop(add_evidence(run, &mut findings, folder));
    write_page(run, &findings, folder);
    show(run, findings, Vec::new(), folder);
    accept_run(run, None);
    let watch = &|_| ControlFlow::Continue(());
    let layers = place.folder.join("layers");
    drop(write_layers(run, folder, &layers, watch));
    let _ = fs::remove_dir_all(layers);
}

/// Reads the fixture's bounds for every scene that the run names.
fn bounds(run: &Run, place: &Place) -> RunBounds {
    let root = place.fixture.join("scenes");
    let own = read_bounds(&root, root.join("plate"), None).unwrap();
    let scenes = run.cases.iter().map(|case| case.scene.clone());
    scenes.map(|scene| (scene, own.clone())).collect()
}

fn write_page(run: &Run, findings: &[Finding], folder: &Path) {
    let page = folder.join("page.html");
    drop(write_report(run, findings, folder, &page, LARGEST_PAGE));
}

fn show(
    run: &Run,
    findings: Vec<Finding>,
    comparisons: Vec<judge::BaselineComparison>,
    out: &Path,
) {
    let checked = check(run, findings, comparisons);
    drop(check_text(&checked, out, true));
    drop(junit(&checked));
    drop(summary(&checked));
    drop(annotations(&checked));
    drop(checked.verdict());
}

fn accept_run(run: &Run, old: Option<Baseline>) {
    let how = Acceptance {
        only: None,
        reason: "a reason",
        forced: true,
    };
    if let Ok(baseline) = accept_scores(run, old, &how) {
        drop(compare_with_baseline(
            run,
            &baseline,
            &margins(),
            Path::new("base.json"),
        ));
    }
}

fn margins() -> BTreeMap<Metric, Margin> {
    let metrics = [
        Metric::FLIP,
        Metric::SKILL,
        Metric::Object(ObjectMetric::Extent),
    ];
    let margins = metrics.map(|metric| {
        let margin = Margin {
            width: 0.01,
            place: "bounds.toml:1".to_owned(),
        };
        (metric, margin)
    });
    margins.into()
}

fn compare_both(first: &Side, second: &Side) {
    let watch = &|_| ControlFlow::Continue(());
    if let Ok(compared) = compare_runs(first, second, watch) {
        drop(compare_table(&compared));
        drop(compare_page(&compared, first, second));
    }
}
