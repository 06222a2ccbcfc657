//! The rules of bounds.

use std::fs;

use cli::Programs;
use judge::{Level, SceneBounds};
use metrics::{Metric, SequenceMetric};
use suite::Frames;
use tests::text::assert_contains;

/// Reads the bounds of a folder with one scene, `fan`, from texts beside the scenes and beside the scene.
fn read(beside_scenes: &str, beside_scene: &str) -> Result<SceneBounds, String> {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("fan");
    fs::create_dir(&scene).unwrap();
    fs::write(scene.join("scene.toml"), "").unwrap();
    for (place, text) in [(folder.path(), beside_scenes), (&scene, beside_scene)] {
        fs::write(place.join("bounds.toml"), text).unwrap();
    }
    let filters =
        cli::select_filters(&["identity".to_owned()], None, &[], Programs::Refused).unwrap();
    let check = || {
        let bounds = judge::read_bounds(folder.path(), &scene, None)?;
        judge::check_names(folder.path(), std::iter::once(&bounds), &filters)?;
        let fan = tracer::SceneId::new("fan", None);
        let scenes = std::iter::once((&fan, &bounds));
        judge::require_bounds(folder.path(), scenes, &filters, Frames::default())?;
        Ok(bounds)
    };
    check().map_err(|error: suite::Error| {
        let folder = folder.path().display().to_string();
        error.to_string().replace(&folder, "scenes")
    })
}

fn limit(limit: f64) -> String {
    format!("{{ limit = {limit}, why = \"it serves a test\" }}\n")
}

#[test]
fn every_metric_except_those_for_reports_can_have_a_bound() {
    for metric in Metric::all() {
        let bounds = read(&format!("[default]\n{metric} = {}", limit(0.25)), "");
        if metric.row().report_only.is_some() {
            let message = bounds.unwrap_err();
            assert!(message.contains("bounds.toml:2: "), "{message}");
            assert!(message.contains("is for reports and no bound"), "{message}");
            continue;
        }
        let bounds = bounds.unwrap();
        let bounds = bounds.of("identity", "default");
        let names: Vec<_> = bounds.iter().map(|(own, b)| (*own, b.limit)).collect();
        assert_eq!(names, [(metric, 0.25)]);
        assert_eq!(bounds[&metric].level, Level::Required);
    }
}

#[test]
fn limits_hold_only_at_their_own_size() {
    let everywhere = format!("[default]\nflip_moving = {}", limit(0.1));
    let of = |filter: &str, size: &str| {
        let text = format!(
            "[filter.{filter}]\nflip_moving = {{ limit = 0.2, {size} why = \"it serves a test\" }}\n"
        );
        read(&everywhere, &text).unwrap()
    };
    let small = of("identity", "size = [160, 90],");
    let large = of("identity", "size = [320, 180],");
    let any = of("identity", "");
    let another = of("kino", "size = [320, 180],");
    let filters =
        cli::select_filters(&["identity".to_owned()], None, &[], Programs::Refused).unwrap();
    let size = |bounds: &[&SceneBounds], asked| {
        let size = judge::size_for_bounds(bounds.iter().copied(), &filters, asked);
        size.map_err(|error| error.to_string())
    };
    assert_eq!(size(&[&any, &small], None), Ok(Some((160, 90))));
    assert_eq!(
        size(&[&small, &another], Some((160, 90))),
        Ok(Some((160, 90)))
    );
    assert_eq!(size(&[&any, &another], Some((64, 32))), Ok(Some((64, 32))));
    assert_eq!(size(&[&any], None), Ok(None));
    let refused = size(&[&small], Some((320, 180))).unwrap_err();
    for part in [
        "fan/bounds.toml:2: the limit on flip_moving holds for 160x90, and the pictures are to have 320x180",
        "`shuttertruth limits calibrate`",
    ] {
        assert!(refused.contains(part), "{refused}");
    }
    let two = size(&[&small, &large], None).unwrap_err();
    for part in [
        "fan/bounds.toml:2: ",
        "for 320x180, that of",
        "for 160x90; check them apart",
    ] {
        assert!(two.contains(part), "{two}");
    }
    // At another size, the limit for any size is left.
    let left = |size| small.clone().at(size).of("identity", "default")[&Metric::FLIP].limit;
    assert_eq!([left((160, 90)), left((320, 180))], [0.2, 0.1]);
}

#[test]
fn every_metric_of_sequences_can_have_a_bound_for_a_number_of_frames() {
    let single = format!("[default]\nflip_moving = {}", limit(0.1));
    let filters =
        cli::select_filters(&["identity".to_owned()], None, &[], Programs::Refused).unwrap();
    for metric in SequenceMetric::ALL {
        let name = metric.row().name;
        let fps = match metric.depends_on_rate() {
            true => "fps = 60.0, ",
            false => "",
        };
        let text = format!(
            "[filter.identity]\n{name} = {{ limit = 0.25, frames = 4, {fps}why = \"w\" }}\n"
        );
        let bounds = read(&single, &text).unwrap();
        assert_eq!(
            bounds.of("identity", "default")[&Metric::Sequence(metric)].limit,
            0.25
        );
        let at = |count, per_second| Frames { count, per_second };
        let lengths = |frames| {
            let scenes = std::iter::once(&bounds);
            judge::check_lengths(scenes, &filters, frames).map_err(|error| error.to_string())
        };
        // Single frames leave it alone, and another length is refused before anything is rendered.
        assert_eq!(lengths(at(1, 60.0)), Ok(()));
        assert_eq!(lengths(at(4, 60.0)), Ok(()));
        let start =
            format!("fan/bounds.toml:2: the limit on {name} holds for sequences of 4 frames");
        assert_contains(
            &lengths(at(3, 60.0)).unwrap_err(),
            &[&start, "to have 3 frames"],
        );
        assert_eq!(lengths(at(4, 24.0)).is_err(), metric.depends_on_rate());
        // `run` leaves out limits for another length, as it does those for another size.
        let left = |frames| bounds.clone().over(frames).of("identity", "default");
        assert!(left(at(4, 60.0)).contains_key(&Metric::Sequence(metric)));
        assert!(!left(at(1, 60.0)).contains_key(&Metric::Sequence(metric)));
        assert!(left(at(1, 60.0)).contains_key(&Metric::FLIP));
        // Limits that nothing judges are no check.
        assert_contains(
            &read("", &text).unwrap_err(),
            &[
                "fan / identity:default: all its bounds are on sequences of other lengths, such as 4 frames",
            ],
        );
    }
}

#[test]
fn limits_for_a_second_size_stand_in_a_file_of_their_own() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("fan");
    fs::create_dir(&scene).unwrap();
    fs::write(scene.join("scene.toml"), "").unwrap();
    let write = |name: &str, text: &str| fs::write(scene.join(name), text).unwrap();
    let table = |limit: f64, size: &str| {
        format!(
            "[filter.identity]\nflip_moving = {{ limit = {limit}, {size} why = \"it serves a test\" }}\n"
        )
    };
    let filters =
        cli::select_filters(&["identity".to_owned()], None, &[], Programs::Refused).unwrap();
    let read = |asked| {
        let bounds = judge::read_bounds(folder.path(), &scene, asked)?;
        judge::check_names(folder.path(), std::iter::once(&bounds), &filters)?;
        let size = judge::size_for_bounds(std::iter::once(&bounds), &filters, asked)?;
        let limit = bounds.of("identity", "default")[&Metric::FLIP].limit;
        Ok::<_, suite::Error>((limit, size))
    };
    let refused = |asked| read(asked).unwrap_err().to_string();
    write("bounds.toml", &table(0.2, "size = [160, 90],"));
    write("bounds_1280x720.toml", &table(0.1, ""));
    assert_eq!(read(None).unwrap(), (0.2, Some((160, 90))));
    assert_eq!(read(Some((160, 90))).unwrap(), (0.2, Some((160, 90))));
    assert_eq!(read(Some((1280, 720))).unwrap(), (0.1, Some((1280, 720))));
    assert_contains(
        &refused(Some((320, 180))),
        &["put them into bounds_320x180.toml beside the scene"],
    );

    write("bounds_1280x720.toml", &table(0.1, "size = [160, 90],"));
    let other_size = [
        "fan/bounds_1280x720.toml:2: flip_moving: size = [160, 90] in a file for 1280x720",
        "move the limit to bounds_160x90.toml",
    ];
    // Files for sizes that nobody asked for are checked as well.
    assert_contains(&refused(None), &other_size);
    assert_contains(&refused(Some((1280, 720))), &other_size);
    write("bounds_1280x720.toml", "[margin]\nflip_moving = 0.1\n");
    assert_contains(
        &refused(Some((1280, 720))),
        &["bounds_1280x720.toml:2: a margin is for pictures of every size"],
    );
    write("bounds_1280x720.toml", &table(0.1, ""));
    write("bounds_720p.toml", &table(0.1, ""));
    assert_contains(
        &refused(None),
        &[
            "bounds_720p.toml: nothing reads a file of that name; allowed: bounds.toml, and bounds_COLUMNSxROWS.toml",
        ],
    );
}

#[test]
fn bounds_that_mean_nothing_are_refused_with_file_and_line() {
    let good = format!("[default]\nflip_moving = {}", limit(0.1));
    let rows: &[(&str, &str, &[&str])] = &[
        (
            "\n[default]\nflip = { limit = 0.1, why = \"w\" }",
            "",
            &["scenes/bounds.toml:3: metric \"flip\" is unknown; allowed: mse_moving"],
        ),
        (
            "[default]\nflicker = { limit = 0.1, why = \"w\" }",
            "",
            &[
                "scenes/bounds.toml:2: flicker: is a score of a sequence",
                "such as frames = 4",
            ],
        ),
        (
            "[default]\njod = { limit = 9, frames = 4, why = \"w\" }",
            "",
            &[
                "scenes/bounds.toml:2: jod: depends on the rate",
                "such as fps = 60",
            ],
        ),
        (
            "[default]\nflip_moving = { limit = 0.1, frames = 4, why = \"w\" }",
            "",
            &[
                "scenes/bounds.toml:2: flip_moving: is a score of a single frame",
                "leave it out",
            ],
        ),
        (
            "[default]\nflip = { limit = 0.1, why = \"w\" }",
            "",
            &["; of sequences: error, flicker"],
        ),
        (
            "[margin]\nflicker = 0.1",
            "",
            &[
                "scenes/bounds.toml:2: margin of flicker: baselines hold scores of single frames only",
            ],
        ),
        (
            "[default]\nflip_moving = { limit = nan, why = \"w\" }",
            "",
            &["scenes/bounds.toml:2: flip_moving: limit = NaN; allowed: a finite number"],
        ),
        (
            "[default]\nflip_moving = 0.1",
            "",
            &["scenes/bounds.toml:2: ", "a bound is a table", "why"],
        ),
        (
            "[default]\nflip_moving = { limit = 0.1 }",
            "",
            &["scenes/bounds.toml:2: flip_moving: has no why", "one line"],
        ),
        (
            "[default]\nflip_moving = { limit = 0.1, why = \"a\\nb\" }",
            "",
            &["bounds.toml:2: flip_moving: why = \"a\\nb\"", "one line"],
        ),
        (
            "[default]\nflip_moving = { limit = 0.1, why = \"w\", level = \"maybe\" }",
            "",
            &["scenes/bounds.toml:2: ", "maybe", "required", "report"],
        ),
        (
            "[default]\nflip_moving = { limit = 0.1, size = [160, 0], why = \"w\" }",
            "",
            &[
                "scenes/bounds.toml:2: flip_moving: size = [160, 0]; allowed: columns and rows from 16 to 16384",
            ],
        ),
        (
            "[default]\nflip_moving = { limit = 0.1, size = \"160x90\", why = \"w\" }",
            "",
            &["scenes/bounds.toml:2: ", "160x90"],
        ),
        (
            "flip_moving = 0.05",
            "",
            &["scenes/bounds.toml:1: ", "flip_moving", "default"],
        ),
        (
            &good,
            "[filter.jumpflood]\nextent = { limit = 0.1, why = \"w\" }",
            &[
                "scenes/fan/bounds.toml:1: no filter is called \"jumpflood\"; allowed: ",
                "jump_flood",
            ],
        ),
        (
            &good,
            "\n[filter.\"jump_flood:fastest\"]\nextent = { limit = 0.1, why = \"w\" }",
            &[
                "scenes/fan/bounds.toml:2: the filter jump_flood has no preset \"fastest\"",
                "paper",
            ],
        ),
        (
            "[margin]\nflip_moving = -0.1",
            "",
            &["scenes/bounds.toml:2: margin of flip_moving is -0.1; allowed: 0 or more"],
        ),
        (
            &good,
            "[margin]\nflip_moving = 0.1",
            &[
                "scenes/fan/bounds.toml:2: a margin is for all scenes",
                "scenes/bounds.toml",
            ],
        ),
        (
            "",
            "",
            &["fan / identity:default: has no bound", "[default]"],
        ),
        (
            "[filter.jump_flood]\nextent = { limit = 0.1, why = \"w\" }",
            "",
            &["fan / identity:default: has no bound"],
        ),
        (
            "[default]\nflip_moving = { limit = 0.1, why = \"w\", level = \"report\" }",
            "",
            &[
                "no bound of identity:default is required",
                "level = \"required\"",
            ],
        ),
    ];
    for (beside_scenes, beside_scene, parts) in rows {
        let message = read(beside_scenes, beside_scene).unwrap_err();
        assert_contains(&message, parts);
    }
}

#[test]
fn bounds_of_a_scene_that_does_not_exist_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("fna")).unwrap();
    fs::write(folder.path().join("fna/bounds.toml"), "").unwrap();
    let message = judge::check_names(folder.path(), std::iter::empty(), &[]).unwrap_err();
    assert!(
        message.to_string().contains("fna has no scene.toml"),
        "{message}"
    );
}

#[test]
fn a_narrower_bound_overrides_a_wider_one_and_a_scene_s_bound_overrides_the_shared_one() {
    let level = |table: &str, limits: &[(&str, f64)]| {
        let lines = limits
            .iter()
            .map(|(name, value)| format!("{name} = {}", limit(*value)));
        format!("[{table}]\n{}", lines.collect::<String>())
    };
    let names = [
        "flip_moving",
        "mse_moving",
        "extent",
        "energy",
        "hole",
        "deficit",
    ];
    let limits = |count: usize, value: f64| -> Vec<(&str, f64)> {
        names[..count].iter().map(|name| (*name, value)).collect()
    };
    let all = level("default", &limits(6, 1.0))
        + &level("filter.identity", &limits(5, 2.0))
        + &level("filter.\"identity:default\"", &limits(4, 3.0))
        + &level("filter.jump_flood", &limits(6, 7.0));
    let own = level("default", &limits(3, 4.0))
        + &level("filter.identity", &limits(2, 5.0))
        + &level("filter.\"identity:default\"", &limits(1, 6.0));
    let bounds = read(&all, &own).unwrap();
    let found = bounds.of("identity", "default");
    let found: Vec<f64> = names
        .iter()
        .map(|name| found[&name.parse().unwrap()].limit)
        .collect();
    assert_eq!(found, [6.0, 5.0, 4.0, 3.0, 2.0, 1.0]);
    let other = bounds.of("velocity_gather", "fine");
    let found: Vec<f64> = names
        .iter()
        .map(|name| other[&name.parse().unwrap()].limit)
        .collect();
    assert_eq!(found, [4.0, 4.0, 4.0, 1.0, 1.0, 1.0]);
}
