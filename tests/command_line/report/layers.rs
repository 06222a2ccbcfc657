//! Pages that `run` and `check` write themselves, and the layers of a report.

use std::collections::BTreeMap;
use std::fs;

use frame::{Frame, Truth, read_exr};
use tests::text::assert_contains;

use crate::sandbox::{Sandbox, files_below, quick_command, stdout};

#[test]
fn run_and_check_write_the_page_that_report_writes() {
    let sandbox = Sandbox::new();
    sandbox.write_bound(0.2);
    // A page names the folder next to it.
    let read = |name: &str| {
        let page = fs::read_to_string(sandbox.path(&format!("{name}.html"))).unwrap();
        let page = page.replace(&format!("{name}_files"), "files");
        let files = files_below(&sandbox.path(&format!("{name}_files")));
        let files = files.into_iter().map(|path| fs::read(path).unwrap());
        (page, files.collect::<Vec<_>>())
    };
    let words = ["--filters", "identity", "--html", "own.html"];
    for (command, code) in [("run", 0), ("check", 1)] {
        let output = sandbox.outside_ci(&[&quick_command(command, "64")[..], &words].concat());
        assert_eq!(output.status.code(), Some(code));
        assert_contains(&stdout(&output), &["report: own.html ("]);
        sandbox.done("report out --html page.html");
        let is_same = read("own") == read("page");
        assert!(is_same, "{command} writes another page");
    }
}

#[test]
fn layers_equal_the_files_of_the_case() {
    let sandbox = Sandbox::new();
    sandbox.measure("--filters velocity_gather:fine --guard-band 4");
    sandbox.done("report out --exr layers --quiet");
    let files = files_below(&sandbox.path("layers"));
    assert_eq!(files.len(), sandbox.read_run().cases.len());
    let exr = |name: &str| read_exr(&sandbox.path(name)).unwrap();
    let layers = exr("layers/plate/velocity_gather_fine.exr");
    let output = exr("out/plate/velocity_gather_fine/output.exr");
    let case = &sandbox.read_filter_cases()[0];
    let errors = measure::ErrorMaps::read(case, &sandbox.path("out")).unwrap();
    let truth = Truth::read(&sandbox.path("out/plate/truth_trailing.exr")).unwrap();
    let frame = Frame::read(&sandbox.path("out/plate/frame.exr")).unwrap();
    let (truth, frame) = (truth.mean(), frame.cropped());
    let size = (layers.width, layers.height);
    assert_eq!(size, (64, 32), "the guard band is cropped");
    let color = |name: &str| layers.color(name).unwrap();
    let plane = |name: &str| layers.plane(name).unwrap();
    assert_eq!(color("truth"), truth.color);
    assert_eq!(color("output"), output.color("").unwrap());
    assert_eq!(color("instant"), frame.color);
    assert_eq!(plane("flip"), errors.map("flip").unwrap());
    for (axis, name) in ["velocity.X", "velocity.Y"].into_iter().enumerate() {
        assert_eq!(plane(name), frame.velocity.map(|velocity| velocity[axis]));
    }
    assert_eq!(plane("coverage.plate"), truth.coverage[1]);
    let coverage = output.plane("coverage.plate").unwrap();
    assert_eq!(plane("output_coverage.plate"), coverage);
    assert_eq!(layers.attributes["filter"], "velocity_gather:fine");
    // tev shows the part before the last dot as a group.
    let mut groups: BTreeMap<&str, usize> = BTreeMap::new();
    for channel in &layers.channels {
        let group = channel.name.rsplit_once('.').map_or("", |(group, _)| group);
        *groups.entry(group).or_default() += 1;
    }
    let counts = (groups.iter()).map(|(group, count)| format!("{group} {count}"));
    let due = " 3, coverage 2, depth 1, instant 3, output 3, output_coverage 2, signed 3, truth 3, velocity 2";
    assert_eq!(counts.collect::<Vec<_>>().join(", "), due);
}

#[test]
fn a_report_needs_no_names_and_refuses_missing_files() {
    let sandbox = Sandbox::measured();
    fs::remove_file(sandbox.path("out/report.html")).unwrap();
    // The folder and the page have the names that `run` gives them.
    sandbox.done("report");
    assert!(sandbox.path("out/report.html").is_file());
    let errors = "identity_default/errors.exr";
    fs::remove_file(sandbox.path("out/plate").join(errors)).unwrap();
    sandbox.refuse("report out --exr layers --quiet", &[errors]);
}
