//! The script that searches the smallest change of a preset, and the pages that it printed.

use std::collections::BTreeMap;
use std::fs;
use std::process::{Command, Output};

use tests::root;
use tests::text::assert_contains;

use crate::sandbox::{Sandbox, assert_done, python_with, split, stderr, stdout};

/// Runs examples/changes/search.py on small pictures of some scenes.
fn search(sandbox: &Sandbox, filter: &str, words: &str) -> Output {
    let mut command = Command::new(python_with(&["statistics"]));
    command
        .arg("-B")
        .arg(root().join("examples/changes/search.py"));
    command
        .arg("--filter")
        .arg(root().join("shaders").join(filter));
    command.args(["--program", env!("CARGO_BIN_EXE_shuttertruth")]);
    command.arg("--scenes-dir").arg(tests::scenes());
    command.arg("--out").arg(sandbox.path("out"));
    command.args(split("--size 64x36 --samples-per-pixel 8"));
    command.args(split(words)).output().unwrap()
}

const SIX: &str = "--scenes fan,railing,roll,two_spheres,flag,pan_sky";

#[test]
#[ignore = "prove: a search by hundreds of measurements"]
fn the_search_finds_a_known_mistake() {
    let sandbox = Sandbox::new();
    // The shipped three.js reads motion upside down and twice as long, and brightens by a
    // sixteenth.
    let output = search(
        &sandbox,
        "three",
        &format!("--preset default --set blur_amount=1 --keep blur_amount --keep samples {SIX}"),
    );
    assert_done(&output);
    let printed = stdout(&output);
    assert_contains(
        &printed,
        &[
            "# The smallest change of three:default",
            "--keep blur_amount",
            "6 scenes at 64x36",
            "on 6 sealed scenes:",
            "of two parameters: `coordinates=texture, divisor=fetches`",
        ],
    );
    assert!(!printed.contains("samples="), "{printed}");
}

#[test]
fn a_search_refuses_names_that_do_not_exist_and_too_few_scenes() {
    let sandbox = Sandbox::new();
    for (words, expected) in [
        ("--preset shipped", "--preset shipped: three has default"),
        (
            "--preset default --keep exposure",
            "three has no such parameter; it has samples",
        ),
        (
            "--preset default --change taps=3",
            "taps: three has no such parameter",
        ),
        (
            "--preset default --scenes fan,flag",
            "2 scenes: a CI over scenes needs at least 6",
        ),
    ] {
        let output = search(&sandbox, "three", words);
        assert_eq!(output.status.code(), Some(1), "{words}");
        assert_contains(&stderr(&output), &[expected]);
    }
}

/// Reads `+0.0091 (+0.0021 to +0.0162)`.
fn read_gain(cell: &str) -> [f64; 3] {
    let is_gap = |c: char| " ()to".contains(c);
    let words = cell.split(is_gap).filter(|word| !word.is_empty());
    let numbers: Vec<f64> = words.map(|word| word.parse().unwrap()).collect();
    numbers.try_into().unwrap()
}

/// Returns the gain over the preset or over the best single change, by the change's name.
fn gains(page: &str) -> BTreeMap<&str, [f64; 3]> {
    let rows = page.lines().filter(|line| line.starts_with("| `"));
    let cells = rows.map(|row| row.trim_matches('|').split('|').map(str::trim).collect());
    let gains = cells.map(|cells: Vec<&str>| (cells[0].trim_matches('`'), read_gain(cells[2])));
    gains.collect()
}

#[test]
fn kept_changes_gain_for_certain_by_their_own_tables() {
    let mut published = 0;
    for entry in fs::read_dir(root().join("results/changes")).unwrap() {
        let path = entry.unwrap().path();
        let page = fs::read_to_string(&path).unwrap();
        let name = path.display();
        assert!(page.contains("\nPrinted by `examples/changes/search.py --filter shaders/"));
        let gains = gains(&page);
        let verdict = |begin: &str| {
            let line = page.lines().find_map(|line| line.strip_prefix(begin));
            line.map(|text| text.trim_matches('`'))
        };
        let smallest = verdict("smallest change: ").expect("a verdict");
        if smallest.starts_with("none; no gain's") {
            let certain = gains.iter().find(|(_, gain)| gain[1] > 0.0);
            assert!(certain.is_none(), "{name}: {certain:?} gains");
            continue;
        }
        if smallest.starts_with("none") {
            continue;
        }
        published += 1;
        for change in [Some(smallest), verdict("of two parameters: ")]
            .into_iter()
            .flatten()
        {
            let [mean, low, high] = gains[change];
            assert!(low > 0.0 && low < mean && mean < high, "{name}: {change}");
            let sealed = page.lines().find_map(|line| {
                let gain = line.split_once(&format!("`{change}` gains "))?.1;
                Some(read_gain(gain.trim_end_matches(" over it")))
            });
            assert!(sealed.expect(change)[1] > 0.0, "{name}: {change}");
        }
        let is_certain = |change: &str, gain: &[f64; 3]| !change.contains(',') && gain[1] > 0.0;
        let single = gains
            .iter()
            .filter(|(change, gain)| is_certain(change, gain));
        let best = single.max_by(|a, b| a.1[0].total_cmp(&b.1[0])).unwrap();
        assert!(
            best.1[0] == gains[smallest][0],
            "{name}: {best:?} gains more"
        );
    }
    assert!(published >= 4, "{published} changes");
}

/// Runs Python that may import the script; returns what it prints.
fn run_python(code: &str) -> String {
    let mut command = Command::new(python_with(&["statistics"]));
    command.current_dir(root().join("examples/changes"));
    let output = command.args(["-B", "-c", code]).output().unwrap();
    assert_done(&output);
    stdout(&output)
}

#[test]
fn the_quantile_of_student_s_t_is_that_of_the_tables() {
    let code = "import search; print(*(f'{search.t_quantile(n):.3f}' for n in (5, 10, 25, 100)))";
    assert_eq!(run_python(code).trim(), "2.570 2.228 2.060 1.984");
}

#[test]
fn a_certain_gain_counts_before_a_larger_one_that_is_not() {
    let code = "
import search
from types import SimpleNamespace as Own
ranked = [Own(change=name, gain=Own(low=low)) for name, low in [('wide', -0.01), ('sure', 0.01), ('less', 0.005)]]
print(search.first_certain(ranked).change, search.first_certain(ranked[:1]))";
    assert_eq!(run_python(code).trim(), "sure None");
}

#[test]
fn a_change_without_gain_on_sealed_scenes_is_none() {
    let code = "
import search
from types import SimpleNamespace as Own
scores = {str(n): 0.1 + n / 100 for n in range(6)}
sealed = Own(measure=lambda change: scores)
search.confirm(sealed, Own(change={'taps': 3}), None)";
    assert_contains(
        &run_python(code),
        &[
            "on 6 sealed scenes: `taps=3` gains +0.0000",
            "smallest change: none; its gain does not hold on sealed scenes",
        ],
    );
}
