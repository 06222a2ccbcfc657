//! Cameras that move.

use frame::Alignment;

use crate::assert_worse;
use crate::shot::{Shot, Take};

#[test]
fn a_sky_without_velocity_stays_sharp_above_a_fast_pan() {
    let taken = |sky_velocity| {
        Shot::taken(
            "pan_sky",
            Take {
                sky_velocity,
                ..Take::default()
            },
        )
    };
    let [without, with] = [taken(false), taken(true)];
    let sky = with.truth(Alignment::Trailing).mean().coverage[0].clone();
    // Where the sky is seen all the time.
    let above = |x: u32, y: u32| f64::from(u8::from(*sky.at(x, y) > 0.999));
    for filter in ["velocity_gather:fine", "jump_flood:corrected"] {
        let error = [&without, &with].map(|shot| shot.error_over(filter, above));
        // Measured 14 and 7.8.
        assert_worse(&format!("sky in {filter}"), error, 4.0);
    }
}

#[test]
fn a_roll_bends_trails_away_from_straight_smears_far_from_the_axis() {
    let shots = ["roll@40deg", "roll@5deg"].map(Shot::of);
    let radius = |x: u32, y: u32| (f64::from(x) - 79.5).hypot(f64::from(y) - 44.5);
    // Of the ground: in the sky there is little to tell trails by.
    let between = |from: f64, to: f64| {
        move |x: u32, y: u32| f64::from(u8::from((from..to).contains(&radius(x, y)) && y > 45))
    };
    for filter in ["velocity_gather:fine", "jump_flood:corrected"] {
        let error =
            |from, to| [0, 1].map(|shot: usize| shots[shot].error_over(filter, between(from, to)));
        let far = error(60.0, 92.0);
        assert_worse(&format!("far from the axis in {filter}"), far, 2.0);
        let near = error(0.0, 25.0);
        assert_worse(
            &format!("far from the axis and near it in {filter}"),
            [far[0], near[0]],
            1.2,
        );
    }
}

#[test]
fn the_world_that_rushes_by_smears_the_dashboard() {
    let shots = ["cockpit", "cockpit@crawling"].map(Shot::of);
    for (filter, times) in [
        ("jimenez:o3de", 8.0),
        ("jimenez:kajiya", 0.1),
        ("mcguire:aliari", 0.1),
        ("kino:default", 0.1),
    ] {
        let dashboard = [0, 1].map(|shot: usize| shots[shot].object_label_tv(filter, "dashboard"));
        assert_worse(&format!("dashboard in {filter}"), dashboard, times);
    }
    let kept = shots[0].object_label_tv("jimenez:hdrp", "dashboard");
    println!("dashboard in jimenez:hdrp: {kept}");
    assert!(kept < 0.05, "{kept}");
}

#[test]
fn the_road_that_comes_nearer_smears_over_the_car_ahead() {
    let shots = ["dolly", "dolly@crawling"].map(Shot::of);
    for (filter, times) in [
        ("jimenez:kajiya", 0.1),
        ("jimenez:o3de", 0.1),
        ("mcguire:aliari", 0.1),
        ("mcguire:paper", 0.1),
        ("jimenez:wicked", 0.1),
        ("kino:default", 0.1),
        ("jump_flood:corrected", 0.1),
    ] {
        let car = [0, 1].map(|shot: usize| shots[shot].object_label_tv(filter, "car"));
        assert_worse(&format!("car in {filter}"), car, times);
    }
    let kept = shots[0].object_label_tv("jimenez:hdrp", "car");
    println!("car in jimenez:hdrp: {kept}");
    assert!(kept < 0.05, "{kept}");
}
