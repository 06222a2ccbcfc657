//! The rules of bounds.

use std::fs;
use std::path::PathBuf;

use cli::{Programs, select_filters};
use frame::Size;
use judge::{Level, SceneBounds, check_names, read_bounds, size_for_bounds};
use measure::{Error, FilterChoice, Frames};
use metrics::{Metric, SequenceMetric};
use tests::text::assert_contains;

/// Folder of scenes with one scene, `fan`.
struct Scenes(tempfile::TempDir);

impl Scenes {
    fn new() -> Self {
        let scenes = Self(tempfile::tempdir().unwrap());
        fs::create_dir(scenes.fan()).unwrap();
        scenes.write("fan/scene.toml", "");
        scenes
    }

    fn fan(&self) -> PathBuf {
        self.0.path().join("fan")
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.0.path().join(name), text).unwrap();
    }

    /// Reads the bounds of `fan` for pictures of a size, and checks the names in them.
    fn read(&self, size: Option<Size>) -> Result<SceneBounds, Error> {
        let bounds = read_bounds(self.0.path(), self.fan(), size)?;
        check_names(self.0.path(), std::iter::once(&bounds), &identity())?;
        Ok(bounds)
    }
}

fn identity() -> Vec<FilterChoice> {
    select_filters(&["identity".to_owned()], None, &[], Programs::Refused).unwrap()
}

/// Reads bounds from texts for all scenes and for `fan`, as `check` does before it measures the
/// identity.
fn read(shared: &str, of_fan: &str) -> Result<SceneBounds, String> {
    let scenes = Scenes::new();
    scenes.write("bounds.toml", shared);
    scenes.write("fan/bounds.toml", of_fan);
    let root = scenes.0.path();
    let check = || {
        let bounds = scenes.read(None)?;
        let fan = scene::SceneId::new("fan", None);
        let all = std::iter::once((&fan, &bounds));
        judge::require_bounds(root, all, &identity(), Frames::default())?;
        Ok(bounds)
    };
    check()
        .map_err(|error: Error| (error.to_string()).replace(&root.display().to_string(), "scenes"))
}

/// Writes a line that limits a metric; `keys` are more keys for it, each followed by a comma.
fn line(metric: &str, limit: f64, keys: &str) -> String {
    format!("{metric} = {{ limit = {limit}, {keys} why = \"w\" }}\n")
}

#[test]
fn every_metric_except_those_for_reports_can_have_a_bound() {
    for metric in Metric::all() {
        let text = line(&metric.name(), 0.25, "");
        let bounds = read(&format!("[default]\n{text}"), "");
        if metric.row().report_only.is_some() {
            let parts = ["bounds.toml:2: ", "is for reports and no bound"];
            assert_contains(&bounds.unwrap_err(), &parts);
            continue;
        }
        let bounds = bounds.unwrap().of("identity", "default");
        let limits = bounds
            .iter()
            .map(|(bounded_metric, b)| (*bounded_metric, b.limit, b.level));
        assert!(limits.eq([(metric, 0.25, Level::Required)]), "{metric}");
    }
}

#[test]
fn limits_hold_only_at_their_own_size() {
    let everywhere = format!("[default]\n{}", line("flip_moving", 0.1, ""));
    let of = |filter: &str, size: &str| {
        let limit = line("flip_moving", 0.2, size);
        read(&everywhere, &format!("[filter.{filter}]\n{limit}")).unwrap()
    };
    let small = of("identity", "size = [160, 90],");
    let large = of("identity", "size = [320, 180],");
    let any = of("identity", "");
    let another = of("kino", "size = [320, 180],");
    let size = |bounds: &[&SceneBounds], asked| {
        let size = size_for_bounds(bounds.iter().copied(), &identity(), asked);
        size.map_err(|error| error.to_string())
    };
    let asked = Some(Size::new(160, 90));
    assert_eq!(size(&[&any, &small], None), Ok(asked));
    assert_eq!(size(&[&small, &another], asked), Ok(asked));
    assert_eq!(
        size(&[&any, &another], Some(Size::new(64, 32))),
        Ok(Some(Size::new(64, 32)))
    );
    assert_eq!(size(&[&any], None), Ok(None));
    let parts = [
        "fan/bounds.toml:2: the limit on flip_moving holds for 160x90, and the pictures are to have 320x180",
        "`shuttertruth limits calibrate`",
    ];
    let refused = size(&[&small], Some(Size::new(320, 180)));
    assert_contains(&refused.unwrap_err(), &parts);
    let parts = [
        "fan/bounds.toml:2: ",
        "for 320x180, that of",
        "for 160x90; check them apart",
    ];
    let refused = size(&[&small, &large], None);
    assert_contains(&refused.unwrap_err(), &parts);
    // At another size, the limit for any size remains.
    let left = |size| small.clone().at(size).of("identity", "default")[&Metric::FLIP].limit;
    assert_eq!(
        [left(Size::new(160, 90)), left(Size::new(320, 180))],
        [0.2, 0.1]
    );
}

#[test]
fn every_metric_of_sequences_can_have_a_bound_for_a_number_of_frames() {
    let single = format!("[default]\n{}", line("flip_moving", 0.1, ""));
    let at = |count, per_second| Frames { count, per_second };
    for metric in SequenceMetric::ALL {
        let name = metric.row().name;
        let has_rate = metric.depends_on_rate();
        let keys = ["frames = 4,", "frames = 4, fps = 60.0,"][usize::from(has_rate)];
        let text = format!("[filter.identity]\n{}", line(name, 0.25, keys));
        let bounds = read(&single, &text).unwrap();
        let metric = Metric::Sequence(metric);
        assert_eq!(bounds.of("identity", "default")[&metric].limit, 0.25);
        // Single frames ignore it, and another length is refused before anything is rendered.
        let lengths = |frames| judge::check_lengths(std::iter::once(&bounds), &identity(), frames);
        assert!(lengths(at(1, 60.0)).is_ok());
        assert!(lengths(at(4, 60.0)).is_ok());
        let start =
            format!("fan/bounds.toml:2: the limit on {name} holds for sequences of 4 frames");
        let refused = lengths(at(3, 60.0)).unwrap_err().to_string();
        assert_contains(&refused, &[&start, "to have 3 frames"]);
        assert_eq!(lengths(at(4, 24.0)).is_err(), has_rate);
        // `run` leaves out limits for another length, like limits for another size.
        let left = |frames| bounds.clone().over(frames).of("identity", "default");
        assert!(left(at(4, 60.0)).contains_key(&metric));
        assert!(!left(at(1, 60.0)).contains_key(&metric));
        assert!(left(at(1, 60.0)).contains_key(&Metric::FLIP));
        // Limits that nothing judges are no check.
        let none = "fan / identity:default: all its bounds are on sequences of other lengths, such as 4 frames";
        assert_contains(&read("", &text).unwrap_err(), &[none]);
    }
}

#[test]
fn limits_for_a_second_size_stand_in_a_file_of_their_own() {
    let scenes = Scenes::new();
    let write = |size: &str, text: &str| scenes.write(&format!("fan/bounds{size}.toml"), text);
    let table =
        |limit, size: &str| format!("[filter.identity]\n{}", line("flip_moving", limit, size));
    let read = |asked| {
        let bounds = scenes.read(asked)?;
        let size = size_for_bounds(std::iter::once(&bounds), &identity(), asked)?;
        let limit = bounds.of("identity", "default")[&Metric::FLIP].limit;
        Ok::<_, Error>((limit, size))
    };
    let refused =
        |asked, part: &str| assert_contains(&read(asked).unwrap_err().to_string(), &[part]);
    let large = Some(Size::new(1280, 720));
    write("", &table(0.2, "size = [160, 90],"));
    write("_1280x720", &table(0.1, ""));
    assert_eq!(read(None).unwrap(), (0.2, Some(Size::new(160, 90))));
    assert_eq!(
        read(Some(Size::new(160, 90))).unwrap(),
        (0.2, Some(Size::new(160, 90)))
    );
    assert_eq!(read(large).unwrap(), (0.1, large));
    let way_out = "put them into bounds_320x180.toml beside the scene";
    refused(Some(Size::new(320, 180)), way_out);

    write("_1280x720", &table(0.1, "size = [160, 90],"));
    // Files for other sizes are checked as well.
    let says = "fan/bounds_1280x720.toml:2: flip_moving: size = [160, 90] in a file for 1280x720";
    for asked in [None, large] {
        refused(asked, says);
        refused(asked, "move the limit to bounds_160x90.toml");
    }
    write("_1280x720", "[margin]\nflip_moving = 0.1\n");
    let says = "bounds_1280x720.toml:2: a margin is for pictures of every size";
    refused(large, says);
    write("_1280x720", &table(0.1, ""));
    write("_720p", &table(0.1, ""));
    let name = "bounds_720p.toml: nothing reads a file of that name; allowed: bounds.toml, and bounds_COLUMNSxROWS.toml";
    refused(None, name);
}

/// Each row has bounds of all scenes (valid ones if none are given), bounds of the scene, and parts
/// of the error.
#[test]
fn bounds_that_mean_nothing_are_refused_with_file_and_line() {
    let good = format!("[default]\n{}", line("flip_moving", 0.1, ""));
    let table: toml::Table = include_str!("refused_bounds.toml").parse().unwrap();
    for row in table["refused"].as_array().unwrap() {
        let text = |key: &str| row.get(key).map(|text| text.as_str().unwrap());
        let (shared, of_fan) = (text("shared").unwrap_or(&good), text("own").unwrap_or(""));
        let says: Vec<String> = row["says"].clone().try_into().unwrap();
        assert_contains(&read(shared, of_fan).unwrap_err(), &says);
    }
}

#[test]
fn bounds_of_a_scene_that_does_not_exist_are_refused() {
    let scenes = Scenes::new();
    scenes.write("fan/bounds.toml", "");
    fs::remove_file(scenes.fan().join("scene.toml")).unwrap();
    let refused = check_names(scenes.0.path(), std::iter::empty(), &[]).unwrap_err();
    assert_contains(&refused.to_string(), &["fan has no scene.toml"]);
}

#[test]
fn a_narrower_bound_overrides_a_wider_one_and_a_scene_s_bound_overrides_the_shared_one() {
    let names = "flip_moving mse_moving extent energy hole deficit".split(' ');
    let names: Vec<&str> = names.collect();
    let table = |name: &str, count: usize, limit: f64| {
        let lines = names[..count].iter().map(|metric| line(metric, limit, ""));
        format!("[{name}]\n{}", lines.collect::<String>())
    };
    let shared = table("default", 6, 1.0)
        + &table("filter.identity", 5, 2.0)
        + &table("filter.\"identity:default\"", 4, 3.0)
        + &table("filter.jump_flood", 6, 7.0);
    let of_fan = table("default", 3, 4.0)
        + &table("filter.identity", 2, 5.0)
        + &table("filter.\"identity:default\"", 1, 6.0);
    let bounds = read(&shared, &of_fan).unwrap();
    let limits = |filter, preset| {
        let bounds_there = bounds.of(filter, preset);
        let limits = names
            .iter()
            .map(|name| bounds_there[&name.parse().unwrap()].limit);
        limits.collect::<Vec<f64>>()
    };
    let due = [6.0, 5.0, 4.0, 3.0, 2.0, 1.0];
    assert_eq!(limits("identity", "default"), due);
    let due = [4.0, 4.0, 4.0, 1.0, 1.0, 1.0];
    assert_eq!(limits("velocity_gather", "fine"), due);
}
