//! Wrong folders, and unsuitable names, settings, sizes, frames and adapters.

use std::path::Path;

use filters::{Blur, Filter, FilterError, Gpu, Input, Value, list_adapters};
use frame::Raster;
use tests::picture::{Picture, make_blur, white};
use tests::shared_gpu;
use tests::text::assert_contains;

use super::documented;
use crate::filter_files::ready;

#[test]
fn unknown_names_are_refused_with_the_known_ones() {
    let filter = Filter::builtin("velocity_gather").unwrap();
    let unknown = Filter::builtin("bokeh").unwrap_err().to_string();
    assert_contains(&unknown, &["bokeh", &Filter::builtin_names().join(", ")]);
    let preset = filter.settings(Some("best")).unwrap_err().to_string();
    assert_contains(&preset, &["best", "departure, coarse, fine"]);
    let mut settings = filter.settings(None).unwrap();
    #[rustfmt::skip]
    let wrong = [
        ("sample", "8", "sample: the filter has no such parameter; allowed: samples, intensity"),
        ("samples", "900", "samples: found 900; allowed: a whole number from 1 to 64"),
        ("samples", "8.5", "samples: found 8.5; allowed: a whole number from 1 to 64"),
        ("intensity", "NaN", "intensity: found NaN; allowed: a number from 0 to 4"),
    ];
    for (parameter, text, says) in wrong {
        let error = settings.set(&filter, parameter, text).unwrap_err();
        assert_eq!(error.to_string(), format!("velocity_gather.{says}"));
    }
    settings.set(&filter, "samples", "12").unwrap();
    assert_eq!(settings.values["samples"], Value::Integer(12));
    let real = settings.set_value(&filter, "samples", Value::Real(12.0));
    let says = "velocity_gather.samples: found 12; allowed: a whole number from 1 to 64";
    assert_eq!(real.unwrap_err().to_string(), says);
    let nothing = Filter::builtin("identity").unwrap();
    let error = (nothing.settings(None).unwrap()).set(&nothing, "samples", "1");
    assert_contains(&error.unwrap_err().to_string(), &["it has none"]);
}

#[test]
fn settings_of_another_filter_are_refused() {
    let [gather, flood] =
        ["velocity_gather", "jump_flood"].map(|name| Filter::builtin(name).unwrap());
    let settings = gather.settings(None).unwrap();
    assert!(matches!(
        Blur::new(shared_gpu(), &flood, &settings, 8, 8),
        Err(FilterError::Parameter { .. })
    ));
}

#[test]
fn sizes_beyond_the_adapter_are_refused_before_allocation() {
    let filter = Filter::builtin("identity").unwrap();
    for (width, height) in [(1 << 20, 1), (1, 1 << 20), (0, 4), (4, 0)] {
        let error = ready(&filter, (width, height)).unwrap_err();
        assert!(matches!(error, FilterError::Size { .. }), "{error}");
        assert_contains(&error.to_string(), &[&format!("{width}x{height}"), "allow"]);
    }
}

#[test]
fn frames_that_cannot_be_blurred_are_refused() {
    let mut blur = make_blur("identity", None, "", (4, 3));
    let picture = Picture::uniform(4, 3, white(1.0));
    let single_color = [&picture.color];
    let input = picture.input(&single_color);
    blur.run(&input).expect("this frame can be blurred");
    let mut broken_velocity = picture.velocity.clone();
    broken_velocity.pixels[6] = [f32::NAN, 0.0];
    let mut broken_depth = picture.depth.clone();
    broken_depth.pixels[3] = 0.0;
    let mut broken_color = picture.color.clone();
    broken_color.pixels[4] = [0.0, f32::INFINITY, 0.0];
    let narrow = Raster::filled(3, 3, 2.0);
    let colors = [&picture.color, &broken_color];
    #[rustfmt::skip]
    let wrong = [
        (Input { exposure: 0.0, ..input }, "exposure is 0 frames"),
        (Input { exposure: f64::NAN, ..input }, "exposure is NaN frames"),
        (Input { velocity: &broken_velocity, ..input }, "velocity at (2, 1) is not finite"),
        (Input { depth: &broken_depth, ..input }, "depth at (3, 0) is not finite and above 0"),
        (Input { color: &colors, ..input }, "color at (0, 1) is not finite"),
        (Input { depth: &narrow, ..input }, "depth has 3x3 pixels; this blur was made for 4x3"),
    ];
    for (input, says) in wrong {
        let error = blur.run(&input).unwrap_err().to_string();
        let begin = format!("filter identity: {says}");
        assert!(error.starts_with(&begin), "{error}");
    }
}

#[test]
fn an_index_or_a_name_selects_an_adapter_and_a_wrong_name_lists_them() {
    let adapters = list_adapters();
    assert!(!adapters.is_empty(), "{}", FilterError::NoAdapter);
    assert_eq!(Gpu::new(Some("0")).unwrap().adapter, adapters[0]);
    let name = &adapters[0].name;
    let part: String = name.to_uppercase().chars().take(5).collect();
    assert_eq!(Gpu::new(Some(&part)).unwrap().adapter.name, *name);
    for wanted in ["no such card", "99"] {
        let error = Gpu::new(Some(wanted)).unwrap_err();
        assert_contains(&error.to_string(), &[wanted, name]);
    }
    let error = FilterError::NoAdapter.to_string();
    assert_contains(&error, &["mesa-vulkan-drivers"]);
}

#[test]
fn a_wrong_folder_is_refused_with_place_and_reason() {
    documented().assert_refused("folder");
}

#[test]
fn a_missing_folder_names_the_file_it_looked_for() {
    let error = Filter::load(Path::new("no/such/folder")).unwrap_err();
    let parts = ["no/such/folder/filter.toml: cannot be read"];
    assert_contains(&error.to_string(), &parts);
}

#[test]
fn an_error_of_the_gpu_names_file_and_pass() {
    let large = documented().changed(
        "centre_blur.wgsl",
        "@workgroup_size(8, 8)\nfn gather",
        "@workgroup_size(999, 999)\nfn gather",
    );
    // Only the adapter knows the largest workgroup.
    let error = ready(&large.load().unwrap(), (8, 8)).unwrap_err();
    assert!(matches!(error, FilterError::Folder { .. }), "{error}");
    let parts = ["centre_blur.wgsl:33: pass \"gather\": @workgroup_size(999, 999, 1)"];
    assert_contains(&error.to_string(), &parts);
}
