//! Pages that `run` and `check` write themselves, and the layers beside a report.

use std::collections::BTreeMap;
use std::fs;

use frame::{Frame, Truth, read_exr};

use crate::sandbox::{IDENTITY, Sandbox, assert_done, assert_refused, files_below, stdout};

#[test]
fn run_and_check_write_the_page_that_report_writes() {
    let sandbox = Sandbox::new();
    sandbox.write_bound(0.2);
    let make_page = || {
        sandbox.execute(&["report", "out", "--html", "page.html"]);
        fs::read(sandbox.path("page.html")).unwrap()
    };
    let output = sandbox.run(&[&IDENTITY[..], &["--html", "own.html"]].concat());
    assert_done(&output);
    assert!(
        stdout(&output).contains("report: own.html ("),
        "{}",
        stdout(&output)
    );
    assert!(
        fs::read(sandbox.path("own.html")).unwrap() == make_page(),
        "run writes another page"
    );
    let output = sandbox.check(&[&IDENTITY[..], &["--html", "own.html"]].concat());
    assert_eq!(output.status.code(), Some(1), "the bound is broken");
    assert!(
        stdout(&output).contains("report: own.html ("),
        "{}",
        stdout(&output)
    );
    assert!(
        fs::read(sandbox.path("own.html")).unwrap() == make_page(),
        "check writes another page"
    );
}

#[test]
fn layers_equal_the_files_of_the_case() {
    let sandbox = Sandbox::new();
    let words = ["--filters", "velocity_gather:fine", "--guard-band", "4"];
    assert_done(&sandbox.run(&words));
    sandbox.execute(&["report", "out", "--exr", "layers", "--quiet"]);
    let run = sandbox.read_run();
    assert_eq!(
        files_below(&sandbox.path("layers")).len(),
        run.cases.len(),
        "one file a case"
    );
    let layers = read_exr(&sandbox.path("layers/plate/velocity_gather_fine.exr")).unwrap();
    let case = sandbox.path("out/plate/velocity_gather_fine");
    let output = read_exr(&case.join("output.exr")).unwrap();
    let errors = read_exr(&case.join("errors.exr")).unwrap();
    let truth = Truth::read(&sandbox.path("out/plate/truth_trailing.exr")).unwrap();
    let frame = Frame::read(&sandbox.path("out/plate/frame.exr"))
        .unwrap()
        .cropped();
    assert_eq!(
        (layers.width, layers.height),
        (64, 32),
        "the guard band is cropped"
    );
    assert_eq!(layers.color("truth").unwrap(), truth.mean().color);
    assert_eq!(layers.color("output").unwrap(), output.color("").unwrap());
    assert_eq!(layers.color("instant").unwrap(), frame.color);
    assert_eq!(layers.plane("flip").unwrap(), errors.plane("flip").unwrap());
    assert_eq!(
        layers.plane("velocity.X").unwrap(),
        frame.velocity.map(|velocity| velocity[0])
    );
    assert_eq!(
        layers.plane("velocity.Y").unwrap(),
        frame.velocity.map(|velocity| velocity[1])
    );
    assert_eq!(
        layers.plane("coverage.plate").unwrap(),
        truth.mean().coverage[1]
    );
    assert_eq!(
        layers.plane("output_coverage.plate").unwrap(),
        output.plane("coverage.plate").unwrap()
    );
    assert_eq!(layers.attributes["filter"], "velocity_gather:fine");
    // tev shows the part before the last dot as a group.
    let mut groups: BTreeMap<&str, usize> = BTreeMap::new();
    for channel in &layers.channels {
        let group = channel.name.rsplit_once('.').map_or("", |(group, _)| group);
        *groups.entry(group).or_default() += 1;
    }
    let expected = [
        ("", 3),
        ("coverage", 2),
        ("depth", 1),
        ("instant", 3),
        ("output", 3),
        ("output_coverage", 2),
        ("signed", 3),
        ("truth", 3),
        ("velocity", 2),
    ];
    assert_eq!(groups, BTreeMap::from(expected));
}

#[test]
fn a_report_needs_no_names_and_refuses_missing_files() {
    let sandbox = Sandbox::new();
    assert_done(&sandbox.run(&IDENTITY));
    fs::remove_file(sandbox.path("out/report.html")).unwrap();
    // The folder and the page have the names that `run` gives them.
    assert_done(&sandbox.shuttertruth(&["report"]));
    assert!(sandbox.path("out/report.html").is_file());
    fs::remove_file(sandbox.path("out/plate/identity_default/errors.exr")).unwrap();
    let words = ["report", "out", "--exr", "layers", "--quiet"];
    assert_refused(
        &sandbox.shuttertruth(&words),
        2,
        &["identity_default/errors.exr"],
    );
}
