//! Summary and gallery of a run, as newcomers see them.

use frame::read_png;
use tests::filter_folder::one_kernel;
use tests::text::assert_contains;

use crate::sandbox::{Sandbox, split};

/// Checks that a run of many filters prints a short ranking, and all of them with `--table`.
fn assert_ranking(sandbox: &Sandbox, filters: &str, one: &str) {
    let text = sandbox.measure(&format!("--jitter-frames 0 {filters}"));
    assert!(text.lines().count() <= 40, "{text}");
    assert_contains(&text, &["centred shutter", "--table shows all"]);
    let page = sandbox.text("out/report.html");
    assert!(page.contains(one));
    let again = sandbox.measure(&format!("--jitter-frames 0 {filters} --table"));
    assert!(again.lines().count() > 60, "{again}");
    let cases = sandbox.read_run().cases.len();
    let due = format!("cases: {cases}, {cases} of them read back");
    assert_contains(&again, &[&due]);
}

/// Writes a filter that darkens colours, with this many presets.
fn write_presets(sandbox: &Sandbox, name: &str, alignment: &str, count: u32) {
    let head = include_str!("snapshots/dim.toml").replace("\"dim\"", &format!("\"{name}\""));
    let head = head.replace("\"trailing\"", &format!("\"{alignment}\""));
    let preset = |number| {
        let values = format!("values = {{ gain = 0.{number} }}");
        format!("[[preset]]\nname = \"gain_{number}\"\ndoc = \"Darker.\"\n{values}\n")
    };
    let presets: String = (50..50 + count).map(preset).collect();
    let body = "textureStore(output, pixel, parameters.gain * textureLoad(color, pixel, 0));";
    sandbox.write_filter(name, &(head + &presets), &one_kernel("gain: f32", body));
}

#[test]
fn a_run_ranks_filters_in_at_most_40_lines_and_names_the_report() {
    let sandbox = Sandbox::new();
    write_presets(&sandbox, "early", "trailing", 16);
    write_presets(&sandbox, "late", "centred", 16);
    assert_ranking(&sandbox, "--filter ./early,./late", "late:gain_60");
}

/// `terminal::long_work_is_announced` counts the cases of such a run.
#[test]
#[ignore = "prove: all built-in filters"]
fn a_run_without_named_filters_uses_all_and_ranks_them_in_at_most_40_lines() {
    assert_ranking(&Sandbox::new(), "", "jump_flood");
}

#[test]
fn filters_within_noise_share_ranks() {
    let filters = "--filters jump_flood:paper,jump_flood_packed:paper,identity";
    let text = Sandbox::new().measure(filters);
    let is_filter = |line: &&str| line.contains(":paper") || line.contains("- no blur");
    let rows = text.lines().filter(is_filter);
    let ranks: Vec<&str> = rows.map(|line| split(line)[0]).collect();
    assert_eq!(ranks, ["1-2", "1-2", "-"], "{text}");
}

#[test]
fn no_blur_is_a_reference_and_never_the_best_filter() {
    let sandbox = Sandbox::new();
    // The camera is still, so its motion blurs nothing.
    let text = sandbox.measure("--filters identity,camera_gather:default");
    let none = "no filter is clearly better than no blur";
    assert!(
        text.starts_with(&format!("trailing shutter: {none}\n")),
        "{text}"
    );
    assert_contains(&text, &["   - no blur", "   1 camera_gather:default"]);
    let page = sandbox.text("out/report.html");
    let due = format!(
        "With a trailing shutter <strong>{none}</strong>; first: <strong><a href=\"#filter:camera_gather:default\">"
    );
    assert_contains(&page, &[&due]);
    let alone = sandbox.measure("--filters identity");
    assert_contains(
        &alone,
        &["trailing shutter: nothing but no blur was measured"],
    );
    // No blur is known from the references, too.
    let text = sandbox.measure("--filters camera_gather:default");
    assert_contains(&text, &[none]);
    let text = sandbox.measure("--filters identity,jump_flood:paper");
    assert!(!text.contains(none), "{text}");
    assert_contains(
        &sandbox.text("out/report.html"),
        &["Best with a trailing shutter: <strong>"],
    );
}

/// Makes a sandbox with a run of three filters with a trailing shutter, one with a centred shutter
/// and no blur, on two scenes.
fn measured() -> Sandbox {
    Sandbox::once(|sandbox| {
        sandbox.add_slow_scene();
        let trailing = "velocity_gather:fine,velocity_gather:coarse,camera_gather:default";
        sandbox.measure(&format!("--filters identity,{trailing},bevy:default"));
    })
}

#[test]
fn no_blur_has_a_row_in_every_shutter_and_few_scenes_are_said_to_be_few() {
    let sandbox = measured();
    let text = sandbox.measure("--filters velocity_gather:fine,bevy:default");
    assert_eq!(text.matches("   - no blur").count(), 2, "{text}");
    let cases = sandbox.read_run().cases.into_iter();
    let none: Vec<f64> = (cases.filter(|case| case.is_reference && case.filter == "identity"))
        .filter(|case| case.alignment == frame::Alignment::Centred)
        .map(|case| case.estimate(metrics::Metric::FLIP).unwrap())
        .collect();
    let mean = format!("{:.3}", (none[0] + none[1]) / 2.0);
    let (_, centred) = text.split_once("centred shutter\n").unwrap();
    let row = centred
        .lines()
        .find(|line| line.contains("- no blur"))
        .unwrap();
    assert_eq!(split(row)[3], mean, "{text}");
    assert_contains(
        &tests::text::squeeze(&text),
        &["Few scenes: a mean over 2 is uncertain."],
    );
    let table = sandbox.measure("--filters velocity_gather:fine,bevy:default --table");
    assert_contains(
        &table,
        &[
            "  1 velocity_gather:fine",
            "  1 bevy:default",
            "  [identity]",
        ],
    );
}

#[test]
fn a_scene_whose_noise_hides_the_blur_says_how_many_samples_it_needs() {
    let sandbox = Sandbox::gathered();
    let said = "these scenes cannot separate filters";
    let filter = "--filters velocity_gather:fine";
    assert!(!sandbox.measure(filter).contains(said));
    // A thousandth of the motion, as little as the noise.
    sandbox.edit("scenes/plate/scene.toml", "[-1.6, 0, 0]", "[-0.002, 0, 0]");
    let text = tests::text::squeeze(&sandbox.measure(filter));
    assert_contains(&text, &[said, "plate (trailing shutter: "]);
    assert_contains(&sandbox.text("out/report.html"), &[said]);
}

#[test]
fn a_gallery_shows_the_best_and_the_worst_filter_of_each_shutter() {
    let sandbox = measured();
    sandbox.done("report out --gallery shown");
    let page = sandbox.text("shown/README.md");
    let parts = ["](truths.png)", "## plate", "](slow.jpg)", "64x32 pixels"];
    assert_contains(&page, &parts);
    let command = "\n    shuttertruth report out --gallery shown\n";
    let centred = "centred: `bevy:default` 0.";
    // The camera is still, so its motion blurs nothing.
    let trailing = "trailing: `velocity_gather:fine` 0.";
    let worst = ", `camera_gather:default` 0.";
    assert_contains(&page, &[command, centred, trailing, worst]);
    assert!(!page.contains("`identity:default`"), "{page}");
    // Two rows per shutter, with labels of 10 pixels and gaps of 2.
    let picture = image::open(sandbox.path("shown/plate.jpg")).unwrap();
    let size = (picture.width(), picture.height());
    assert_eq!(size, (3 * 66 - 2, 4 * (32 + 12) - 2));
    let sheet = read_png(&sandbox.path("shown/truths.png")).unwrap();
    assert_eq!((sheet.width, sheet.height), (2 * 66 - 2, 32));
    let truth = read_png(&sandbox.path("out/plate/truth_centred.png")).unwrap();
    assert_eq!(sheet.at(10, 10), truth.at(10, 10), "the first truth");
}

#[test]
fn a_run_of_only_references_makes_no_gallery() {
    let messages = ["no best and no worst", "run filters"];
    Sandbox::measured().refuse("report out --gallery shown", &messages);
}
