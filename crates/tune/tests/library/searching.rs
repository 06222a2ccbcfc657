//! The space of parameters, and the search through it.

use std::collections::BTreeMap;
use std::convert::Infallible;
use std::f64::consts::PI;

use filters::{Filter, Value};
use tests::text::assert_contains;
use tune::{Search, Space, sobol_indices};

fn jump_flood() -> Filter {
    Filter::builtin("jump_flood").unwrap()
}

fn make_space(vary: &[&str]) -> Result<Space, String> {
    let filter = jump_flood();
    let words: Vec<String> = vary.iter().map(|word| word.to_string()).collect();
    let start = filter.settings(Some("paper")).unwrap();
    Space::new(&filter, start, &words).map_err(|error| error.to_string())
}

#[test]
fn exactly_the_tunable_parameters_are_axes() {
    let axes = make_space(&[]).unwrap().axes;
    let has = |name: &str| axes.iter().any(|axis| axis.name == name);
    assert!(has("samples"));
    for fixed in ["intensity", "metric", "near_plane"] {
        assert!(!has(fixed), "{fixed} is not tunable");
    }
}

#[test]
fn the_values_of_every_preset_come_back_from_their_points() {
    for name in Filter::builtin_names() {
        let filter = Filter::builtin(&name).unwrap();
        for preset in &filter.presets {
            let settings = filter.settings(Some(&preset.name)).unwrap();
            let Ok(space) = Space::new(&filter, settings.clone(), &[]) else {
                continue;
            };
            let back = space.settings(&space.point(&settings));
            assert_eq!(back.values, settings.values, "{name}:{}", preset.name);
        }
    }
}

#[test]
fn the_middle_of_a_logarithmic_range_is_its_geometric_mean() {
    let space = make_space(&["foreground_extent=0.01..1"]).unwrap();
    let middle = space.settings(&[0.5]).values["foreground_extent"].clone();
    assert_eq!(middle, Value::Real(0.1));
}

#[test]
fn the_search_reaches_every_whole_number_and_choice_and_no_other() {
    let space = make_space(&["passes=2..5", "jitter"]).unwrap();
    let mut met: BTreeMap<String, usize> = BTreeMap::new();
    for step in 0..=400 {
        let at = f64::from(step) / 400.0;
        let values = space.settings(&[at, at]).values;
        *met.entry(values["passes"].to_string()).or_default() += 1;
        *met.entry(values["jitter"].to_string()).or_default() += 1;
    }
    let names: Vec<&str> = met.keys().map(String::as_str).collect();
    let due = "2 3 4 5 none start_offset step_offset step_scale";
    assert_eq!(names.join(" "), due);
    for (name, count) in met {
        // A quarter of 401 points each, except for those on the ends.
        assert!((99..=102).contains(&count), "{name} is met {count} times");
    }
}

/// Ranges to search, and parts of the message.
const BAD_RANGES: [(&[&str], &[&str]); 8] = [
    (
        &["sample"],
        &[
            "parameter sample:",
            r#"no parameter "sample""#,
            "allowed: samples",
        ],
    ),
    (
        &["metric"],
        &["parameter metric:", "tunable = false", "allowed: samples"],
    ),
    (
        &["samples=16..4"],
        &[
            "parameter samples=16..4:",
            "the range is empty",
            "from 1 to 64",
            "samples=4..16",
        ],
    ),
    (
        &["samples=4..4"],
        &["parameter samples=4..4:", "the range is empty"],
    ),
    (
        &["samples=0..4"],
        &["parameter samples=0..4:", "no range within", "from 1 to 64"],
    ),
    (&["samples=4"], &["parameter samples=4:", "no range within"]),
    (
        &["jitter=a..b"],
        &["parameter jitter=a..b:", "a choice has no range"],
    ),
    (&["samples", "samples"], &["named twice"]),
];

#[test]
fn fixed_parameters_are_refused_with_the_variable_ones() {
    for (words, parts) in BAD_RANGES {
        assert_contains(&make_space(words).unwrap_err(), parts);
    }
    let identity = Filter::builtin("identity").unwrap();
    let start = identity.settings(None).unwrap();
    let text = Space::new(&identity, start, &[]).unwrap_err().to_string();
    assert!(text.contains("nothing to tune"), "{text}");
}

/// Returns the height of a valley that is narrow along a diagonal, with its lowest point off every
/// axis and off the middle.
fn valley(point: &[f64]) -> f64 {
    let lowest = [0.31, 0.62, 0.18, 0.77];
    let off: Vec<f64> = point.iter().zip(lowest).map(|(at, low)| at - low).collect();
    let across = off[0] + off[1] - off[2] - off[3];
    off.iter().map(|part| part * part).sum::<f64>() + 10.0 * across * across
}

fn search_valley(search: &Search, count: usize) -> (Vec<Vec<f64>>, Vec<f64>) {
    let (mut points, mut losses) = (Vec::new(), Vec::new());
    for _ in 0..count {
        let point = search.ask(&losses);
        losses.push(valley(&point));
        points.push(point);
    }
    (points, losses)
}

fn least(losses: &[f64]) -> f64 {
    losses.iter().copied().fold(f64::INFINITY, f64::min)
}

#[test]
fn the_search_finds_the_lowest_point_of_a_valley() {
    for seed in [1, 2] {
        let search = Search::new(vec![vec![0.9, 0.1, 0.9, 0.1]], 4, seed);
        let (points, losses) = search_valley(&search, 400);
        assert!(points.iter().flatten().all(|at| (0.0..=1.0).contains(at)));
        let preset = [0.9, 0.1, 0.9, 0.1];
        assert_eq!(points[0], preset, "it begins with the presets");
        // Within 0.03 of the lowest point along the valley, and a tenth of that across. Among 400
        // points that fill four dimensions evenly, the nearest is about 0.15 away, mostly across.
        assert!(least(&losses) < 1e-3, "seed {seed}: {}", least(&losses));
        let even = Search::new(Vec::new(), 200, seed).design;
        let even: Vec<f64> = even.iter().map(|point| valley(&point[..4])).collect();
        assert!(least(&even) > 1e-2, "seed {seed}: {}", least(&even));
    }
}

#[test]
fn the_next_point_depends_only_on_the_seed_and_the_losses() {
    let search = |seed| Search::new(vec![vec![0.5; 4]], 4, seed);
    let (points, losses) = search_valley(&search(1), 80);
    let (other, _) = search_valley(&search(2), 60);
    assert_ne!(points[1], other[1], "the design has its own seed");
    assert_ne!(points[59], other[59]);
    for count in [0, 5, 9, 10, 41, 79] {
        let next = search(1).ask(&losses[..count]);
        assert_eq!(next, points[count], "after {count} losses");
    }
}

#[test]
fn a_converged_search_restarts_elsewhere() {
    let search = Search::new(vec![vec![0.5; 2]], 2, 1);
    // A plane without slope ends a climb of two axes after twenty generations of six points: 400
    // points are at least two climbs.
    let mut losses = Vec::new();
    let mut points = Vec::new();
    for _ in 0..400 {
        points.push(search.ask(&losses));
        losses.push(0.25);
    }
    points.sort_by(|a, b| a.partial_cmp(b).unwrap());
    points.dedup();
    assert_eq!(points.len(), 400, "no point is asked for twice");
}

/// Evaluates the function of Ishigami and Homma 1990 with a = 7, b = 0.1, on the unit cube.
fn ishigami(point: &[f64]) -> Result<f64, Infallible> {
    let [x, y, z] = [0, 1, 2].map(|axis| PI * (2.0 * point[axis] - 1.0));
    Ok(x.sin() + 7.0 * y.sin().powi(2) + 0.1 * z.powi(4) * x.sin())
}

/// Coefficients of Sobol's g-function; the first parameters matter most.
const G: [f64; 6] = [0.0, 1.0, 4.5, 9.0, 99.0, 99.0];

fn g_function(point: &[f64]) -> Result<f64, Infallible> {
    let factor = |(x, a): (&f64, f64)| ((4.0 * x - 2.0).abs() + a) / (1.0 + a);
    Ok(point.iter().zip(G).map(factor).product())
}

#[test]
fn the_indices_of_ishigami_s_function_equal_the_published_ones() {
    let indices_of_axes = sobol_indices(3, 1024, 1, ishigami).unwrap();
    // Closed form: variance 13.845; first-order indices 0.3139, 0.4424 and 0; total indices 0.5576,
    // 0.4424 and 0.2437.
    let expected = [(0.3139, 0.5576), (0.4424, 0.4424), (0.0, 0.2437)];
    for (indices, (first, total)) in indices_of_axes.iter().zip(expected) {
        for (estimate, expected) in [(indices.first, first), (indices.total, total)] {
            // Four standard errors of 1024 rows, about a quarter of the intervals' widths.
            let tolerance = estimate.high - estimate.low;
            let off = (estimate.value - expected).abs();
            assert!(off < tolerance && tolerance < 0.25, "{indices:?}");
        }
    }
}

#[test]
fn the_indices_of_sobols_g_function_follow_its_formula() {
    let indices_of_axes = sobol_indices(6, 1024, 1, g_function).unwrap();
    let parts = G.map(|a| 1.0 / (3.0 * (1.0 + a) * (1.0 + a)));
    let variance = parts.iter().map(|part| 1.0 + part).product::<f64>() - 1.0;
    for (axis, indices) in indices_of_axes.iter().enumerate() {
        let others = parts.iter().map(|part| 1.0 + part).product::<f64>() / (1.0 + parts[axis]);
        let (first, total) = (parts[axis] / variance, parts[axis] * others / variance);
        for (estimate, expected) in [(indices.first, first), (indices.total, total)] {
            // The widest interval is 0.15; an index of the wrong axis is off by at least 0.3.
            let off = (estimate.value - expected).abs();
            assert!(off < 0.1, "{axis}: {indices:?}, not {expected}");
        }
    }
    let total = |axis: usize| indices_of_axes[axis].total;
    assert!(total(4).high < 0.02, "it could be a constant");
    assert!(total(1).low > 0.02, "what matters could not");
}

#[test]
fn a_constant_function_has_no_sensitivity() {
    let constant = |_: &[f64]| Ok::<f64, Infallible>(3.0);
    for indices in sobol_indices(2, 16, 1, constant).unwrap() {
        assert_eq!((indices.first.value, indices.total.high), (0.0, 0.0));
    }
}
