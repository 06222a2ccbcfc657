//! Names, settings, sizes, frames and adapters that do not fit.

use filters::{Blur, Filter, FilterError, Gpu, Input, Value, list_adapters};
use frame::Raster;
use tests::open_gpu;
use tests::picture::{Picture, gray_moving_by};

#[test]
fn unknown_names_are_refused_with_the_known_ones() {
    let filter = Filter::builtin("velocity_gather").unwrap();
    let unknown = Filter::builtin("bokeh").unwrap_err().to_string();
    assert!(
        unknown.contains("bokeh") && unknown.contains(&Filter::builtin_names().join(", ")),
        "{unknown}"
    );
    let preset = filter.settings(Some("best")).unwrap_err().to_string();
    assert!(
        preset.contains("best") && preset.contains("departure, coarse, fine"),
        "{preset}"
    );
    let mut settings = filter.settings(None).unwrap();
    for (parameter, text, says) in [
        (
            "sample",
            "8",
            "velocity_gather.sample: the filter has no such parameter; allowed: samples, intensity",
        ),
        (
            "samples",
            "900",
            "velocity_gather.samples: found 900; allowed: a whole number from 1 to 64",
        ),
        (
            "samples",
            "8.5",
            "velocity_gather.samples: found 8.5; allowed: a whole number from 1 to 64",
        ),
        (
            "intensity",
            "NaN",
            "velocity_gather.intensity: found NaN; allowed: a number from 0 to 4",
        ),
    ] {
        let message = settings
            .set(&filter, parameter, text)
            .unwrap_err()
            .to_string();
        assert_eq!(message, says);
    }
    settings.set(&filter, "samples", "12").unwrap();
    assert_eq!(settings.values["samples"], Value::Integer(12));
    assert_eq!(
        settings
            .set_value(&filter, "samples", Value::Real(12.0))
            .unwrap_err()
            .to_string(),
        "velocity_gather.samples: found 12; allowed: a whole number from 1 to 64"
    );
    let nothing = Filter::builtin("identity").unwrap();
    let message = nothing
        .settings(None)
        .unwrap()
        .set(&nothing, "samples", "1")
        .unwrap_err();
    assert!(message.to_string().contains("it has none"), "{message}");
}

#[test]
fn settings_of_another_filter_are_refused() {
    let gpu = open_gpu();
    let (gather, flood) = (
        Filter::builtin("velocity_gather").unwrap(),
        Filter::builtin("jump_flood").unwrap(),
    );
    let settings = gather.settings(None).unwrap();
    assert!(matches!(
        Blur::new(&gpu, &flood, &settings, 8, 8),
        Err(FilterError::Parameter { .. })
    ));
}

#[test]
fn sizes_beyond_the_adapter_are_refused_before_allocation() {
    let gpu = open_gpu();
    let filter = Filter::builtin("identity").unwrap();
    let settings = filter.settings(None).unwrap();
    for (width, height) in [(1 << 20, 1), (1, 1 << 20), (0, 4), (4, 0)] {
        let error = Blur::new(&gpu, &filter, &settings, width, height).unwrap_err();
        let message = error.to_string();
        assert!(matches!(error, FilterError::Size { .. }), "{message}");
        assert!(message.contains(&format!("{width}x{height}")), "{message}");
        assert!(message.contains("allow"), "{message}");
    }
}

#[test]
fn frames_that_cannot_be_blurred_are_refused() {
    let gpu = open_gpu();
    let filter = Filter::builtin("identity").unwrap();
    let mut blur = Blur::new(&gpu, &filter, &filter.settings(None).unwrap(), 4, 3).unwrap();
    let picture = Picture::uniform(4, 3, gray_moving_by(1.0));
    let own = [&picture.color];
    let input = picture.input(&own);
    blur.run(&input).expect("this frame can be blurred");
    let mut broken_velocity = picture.velocity.clone();
    broken_velocity.pixels[6] = [f32::NAN, 0.0];
    let mut broken_depth = picture.depth.clone();
    broken_depth.pixels[3] = 0.0;
    let mut broken_color = picture.color.clone();
    broken_color.pixels[4] = [0.0, f32::INFINITY, 0.0];
    let narrow = Raster::filled(3, 3, 2.0);
    let colors = [&picture.color, &broken_color];
    for (input, says) in [
        (
            Input {
                exposure: 0.0,
                ..input
            },
            "exposure is 0 frames",
        ),
        (
            Input {
                exposure: f64::NAN,
                ..input
            },
            "exposure is NaN frames",
        ),
        (
            Input {
                velocity: &broken_velocity,
                ..input
            },
            "velocity at (2, 1) is not finite",
        ),
        (
            Input {
                depth: &broken_depth,
                ..input
            },
            "depth at (3, 0) is not finite and above 0",
        ),
        (
            Input {
                color: &colors,
                ..input
            },
            "color at (0, 1) is not finite",
        ),
        (
            Input {
                depth: &narrow,
                ..input
            },
            "depth has 3x3 pixels; this blur was made for 4x3",
        ),
    ] {
        let message = blur.run(&input).unwrap_err().to_string();
        assert!(
            message.starts_with(&format!("filter identity: {says}")),
            "{message}"
        );
    }
}

#[test]
fn an_index_or_a_name_selects_an_adapter_and_a_wrong_name_lists_them() {
    let adapters = list_adapters();
    assert!(
        !adapters.is_empty(),
        "these tests run filters: {}",
        FilterError::NoAdapter
    );
    assert_eq!(Gpu::new(Some("0")).unwrap().adapter, adapters[0]);
    let part: String = adapters[0].name.to_uppercase().chars().take(5).collect();
    assert_eq!(
        Gpu::new(Some(&part)).unwrap().adapter.name,
        adapters[0].name
    );
    for wanted in ["no such card", "99"] {
        let message = Gpu::new(Some(wanted)).unwrap_err().to_string();
        assert!(
            message.contains(wanted) && message.contains(&adapters[0].name),
            "{message}"
        );
    }
    assert!(
        FilterError::NoAdapter
            .to_string()
            .contains("mesa-vulkan-drivers")
    );
}
