//! Where filters meet their limits: borders, brightness, slow and bent motion, slopes, weights.

use std::fs;
use std::path::Path;

use filters::Filter;
use frame::{Alignment, Image, Picture};
use tests::presets::{every_preset, preset_name};

use crate::assert_worse;
use crate::shot::{Shot, Take, value};

#[test]
fn what_lies_beyond_the_border_is_missed() {
    let taken = |guard_band| {
        let take = Take {
            guard_band,
            ..Take::default()
        };
        Shot::taken("frame_edge", take)
    };
    let [cut, whole] = [0, 24].map(taken);
    let border = |x: u32, y: u32| f64::from(u8::from(x.min(159 - x).min(y).min(89 - y) < 6));
    for filter in [
        "jump_flood:corrected",
        "velocity_gather:fine",
        "mcguire:paper",
        "guertin:paper",
    ] {
        let error = [&cut, &whole].map(|shot| shot.error_over(filter, border));
        assert_worse(&format!("border in {filter}"), error, 0.1);
    }
}

#[test]
fn motion_below_a_pixel_is_left_sharp() {
    let take = Take {
        width: 320,
        height: 180,
        ..Take::default()
    };
    let shots = ["creep", "creep@hurried"].map(|name| Shot::taken(name, take));
    for filter in [
        "kino:default",
        "bevy:high",
        "mcguire:paper",
        "velocity_gather:fine",
        "jimenez:kajiya",
    ] {
        let skill = [0, 1].map(|shot: usize| shots[shot].score(filter, "skill_mse"));
        println!("skill of {filter}: {skill:?}");
    }
}

#[test]
fn averages_in_a_display_s_colours_lose_the_light_of_a_neon_sign() {
    let shots = ["neon", "neon@dim"].map(Shot::of);
    let (filter, preset) = crate::shot::chosen("velocity_gather:fine");
    let toned = |shot: &Shot| {
        let compressed = shot
            .frame
            .color
            .map(|pixel| pixel.map(|part| part / (1.0 + part)));
        let output = shot.run(&filter, &preset, &[&compressed]).remove(0);
        let color: Image = output.map(|pixel| pixel.map(|part| part / (1.0 - part)));
        Picture {
            color,
            coverage: shot.frame.coverage.clone(),
        }
    };
    for metric in [
        "relmse_moving",
        "mse_moving",
        "flip_hdr_moving",
        "smape_moving",
    ] {
        let times = [0, 1].map(|shot: usize| {
            let shot = &shots[shot];
            let wrong = value(&shot.measured(&toned(shot), Alignment::Trailing), metric);
            wrong / shot.score("velocity_gather:fine", metric)
        });
        assert_worse(
            &format!("{metric} of averages in a display's colours, in linear ones 1"),
            times,
            0.1,
        );
    }
}

#[test]
fn one_velocity_does_not_tell_a_bounce_or_a_brake() {
    let shots = ["reversal", "reversal@steady"].map(Shot::of);
    for filter in [
        "velocity_gather:fine",
        "jump_flood:corrected",
        "mcguire:paper",
        "jimenez:hdrp",
    ] {
        let variation = [0, 1].map(|shot: usize| shots[shot].score(filter, "label_tv"));
        assert_worse(&format!("label_tv of {filter}"), variation, 0.1);
    }
}

#[test]
fn slopes_are_blurred_too_little_where_depth_is_compared_softly() {
    let shots = ["ramp_floor", "ramp_floor@facing"].map(Shot::of);
    for (filter, preset) in every_preset()
        .iter()
        .map(|(filter, settings)| (filter.name.clone(), settings.preset.clone()))
    {
        let filter = format!("{filter}:{preset}");
        let skill = [0, 1].map(|shot: usize| shots[shot].score(&filter, "skill_mse"));
        println!("skill of {filter}: {skill:?}");
    }
}

#[test]
fn light_that_is_the_same_everywhere_comes_out_unchanged_and_weights_that_amplify_show() {
    let flat = Shot::of("flat_field");
    for (filter, settings) in every_preset() {
        let output = flat
            .run(&filter, &settings.preset, &[&flat.frame.color])
            .remove(0);
        let differences = output.pixels.iter().zip(&flat.frame.color.pixels);
        let worst = differences
            .map(|(a, b)| (a[0] - b[0]).abs())
            .fold(0.0, f32::max);
        // Sums of up to some hundred weights in 32 bits.
        assert!(worst < 1e-5, "{}: {worst}", preset_name(&filter, &settings));
    }
    let folder = tempfile::tempdir().unwrap();
    let planted = amplifying(folder.path());
    let painted = Shot::of("flat_field@painted");
    let error = |shot: &Shot, filter: &Filter| {
        let color = shot.run(filter, "paper", &[&shot.frame.color]).remove(0);
        let coverage = shot.frame.coverage.clone();
        let scores = shot.measured(&Picture { color, coverage }, Alignment::Centred);
        value(&scores, "mae_moving")
    };
    let sound = Filter::builtin("mcguire").unwrap();
    let times = [&flat, &painted].map(|shot| error(shot, &planted) / error(shot, &sound).max(1e-7));
    assert_worse("error of amplifying weights, of sound ones 1", times, 0.1);
}

/// A copy of a shipped filter whose weights add up to 1.05.
fn amplifying(folder: &Path) -> Filter {
    let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shaders/mcguire");
    let copy = folder.join("mcguire");
    fs::create_dir(&copy).unwrap();
    fs::copy(shipped.join("filter.toml"), copy.join("filter.toml")).unwrap();
    let kernels = fs::read_to_string(shipped.join("mcguire.wgsl")).unwrap();
    let sound = "textureStore(output, pixel, mean);\n}";
    assert_eq!(kernels.matches(sound).count(), 1);
    let broken = kernels.replace(sound, "textureStore(output, pixel, mean * 1.05);\n}");
    fs::write(copy.join("mcguire.wgsl"), broken).unwrap();
    Filter::load(&copy).unwrap()
}
