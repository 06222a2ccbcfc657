//! Sources of presets, and their original picture widths.

use filters::{Filter, Settings, Value};
use tests::filter_folder::one_kernel;

use crate::filter_files::FilterFiles;

fn files() -> FilterFiles {
    let kernels = one_kernel(
        "tile_size: i32, threshold: f32, samples: i32",
        "let used = f32(parameters.tile_size) + parameters.threshold + f32(parameters.samples);
        textureStore(output, pixel, textureLoad(color, pixel, 0) + 0.0 * used);",
    );
    FilterFiles::fixture("filters/still").with("still.wgsl", kernels)
}

fn load_unchanged() -> Filter {
    files().load().unwrap()
}

fn scale(filter: &Filter, settings: &Settings, width: u32) -> [Value; 3] {
    let values = settings.scaled_to(filter, width).values;
    ["tile_size", "threshold", "samples"].map(|name| values[name].clone())
}

fn values(tile_size: i32, threshold: f64, samples: i32) -> [Value; 3] {
    [
        Value::Integer(tile_size),
        Value::Real(threshold),
        Value::Integer(samples),
    ]
}

#[test]
fn a_source_names_repository_commit_files_and_differences() {
    let filter = load_unchanged();
    let source = filter.presets[0].source.as_ref().unwrap();
    let code = source.code.as_ref().unwrap();
    assert_eq!(code.repository, "https://example.org/engine");
    assert_eq!(code.commit, "0123456789abcdef0123456789abcdef01234567");
    assert_eq!(code.paths, ["blur.hlsl", "shared/noise.hlsl"]);
    assert_eq!(source.publication.as_deref(), Some("A talk."));
    assert_eq!(source.differs, ["Noise is another."]);
    assert_eq!(filter.presets[1].source, None);
}

#[test]
fn a_wrong_source_is_refused_with_place_and_reason() {
    files().assert_refused("sources");
}

#[test]
fn only_parameters_in_pixels_can_be_scaled() {
    let one = files().changed("filter.toml", "unit = \"pixels\"\n", "");
    one.assert_refused("no_unit");
    files().assert_refused("unit_of_choice");
}

#[test]
fn lengths_scale_with_the_width_within_their_range_unless_asked_for_as_written() {
    let filter = load_unchanged();
    let engine = filter.settings(Some("engine")).unwrap();
    assert_eq!(scale(&filter, &engine, 1920), values(20, 1.5, 9));
    assert_eq!(scale(&filter, &engine, 960), values(10, 0.75, 9));
    // 20 x 600 / 1920 = 6.25 and 20 x 1000 / 1920 = 10.42.
    assert_eq!(scale(&filter, &engine, 600)[0], Value::Integer(6));
    assert_eq!(scale(&filter, &engine, 1000)[0], Value::Integer(10));
    // 1.67 tiles and 0.125 pixels are below the ranges; 400 and 30 are above.
    assert_eq!(scale(&filter, &engine, 160), values(2, 0.25, 9));
    assert_eq!(scale(&filter, &engine, 38_400), values(256, 4.0, 9));
    let anywhere = filter.settings(Some("anywhere")).unwrap();
    assert_eq!(scale(&filter, &anywhere, 160), values(20, 1.5, 8));
    let written = engine.as_written();
    assert_eq!(written.reference_width, None);
    assert_eq!(scale(&filter, &written, 160), values(20, 1.5, 9));
}

#[test]
fn a_user_s_value_is_not_scaled_and_no_value_is_scaled_twice() {
    let filter = load_unchanged();
    let mut settings = filter.settings(Some("engine")).unwrap();
    settings.set(&filter, "tile_size", "20").unwrap();
    assert_eq!(scale(&filter, &settings, 960), values(20, 0.75, 9));
    let once = settings.scaled_to(&filter, 960);
    assert_eq!(once.scaled_to(&filter, 480), once);
    let value = Value::Real(1.5);
    settings.set_value(&filter, "threshold", value).unwrap();
    assert_eq!(scale(&filter, &settings, 960), values(20, 1.5, 9));
}

#[test]
fn the_width_of_a_filter_holds_for_presets_without_one_of_their_own() {
    let first = "[[parameter]]\nname = \"tile_size\"";
    let width_key = |width: u32| format!("reference_width = {width}\n{first}");
    let filter = files()
        .changed("filter.toml", first, &width_key(640))
        .load()
        .unwrap();
    let widths = filter.presets.iter().map(|preset| preset.reference_width);
    assert_eq!(widths.collect::<Vec<_>>(), [Some(1920), Some(640)]);
    let anywhere = filter.settings(Some("anywhere")).unwrap();
    assert_eq!(scale(&filter, &anywhere, 160), values(5, 0.375, 8));
    files().assert_refused("width");
    // A filter without presets has one, with every parameter at its default.
    let text = files().text("filter.toml");
    let (head, presets) = text.split_once("[[preset]]").unwrap();
    let (_, passes) = presets.split_once("[[pass]]").unwrap();
    let without = format!("reference_width = 640\n{head}[[pass]]{passes}");
    let filter = files().with("filter.toml", without).load().unwrap();
    let default = filter.settings(None).unwrap();
    assert_eq!(scale(&filter, &default, 160), values(5, 0.375, 8));
}
