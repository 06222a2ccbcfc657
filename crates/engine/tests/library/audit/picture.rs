//! Pictures of another time, another scene, upside down, without an object, or of other colours.

use engine::{Buffer, Capture, Cause};
use frame::Raster;

use super::*;

/// A mistake in a capture.
type Change = fn(&mut Capture);

fn is(cause: Cause) -> impl Fn(&Cause) -> bool {
    move |named| *named == cause
}

/// Reverses the order of the rows.
fn flip<T: Clone>(raster: &mut Raster<T>) {
    let rows = raster.pixels.chunks_exact(raster.width as usize).rev();
    raster.pixels = rows.flatten().cloned().collect();
}

#[test]
fn a_picture_of_another_scene_is_said_before_its_vectors() {
    let verdict = MOVING.audit(&draw(&load_shipped("fan"), 0.0));
    expect(&verdict, Buffer::Picture, None, is(Cause::OtherView));
}

fn assert_time_named(drawn: &DrawnScene, time: f64, cause: Cause) {
    let of_another_time = draw(drawn.scene, time);
    for capture in [without_ids(&of_another_time), of_another_time] {
        let verdict = drawn.audit(&capture);
        assert!(!verdict.shows_scene, "{}", drawn.scene.id);
        expect(&verdict, Buffer::Picture, None, is(cause.clone()));
    }
}

#[test]
fn a_frame_of_another_time_is_named_and_not_compared() {
    assert_time_named(&MOVING, -1.0, Cause::DrawnLate(1));
    assert_time_named(&MOVING, 2.0, Cause::DrawnEarly(2));
}

#[test]
#[ignore = "prove: scenes in which things turn, drive, and the camera moves"]
fn a_frame_of_another_time_of_shipped_scenes_is_named() {
    // Four blades at 45 degrees per frame look the same one frame late and one frame early.
    for (name, time, cause) in [
        ("fan", -1.0, Cause::DrawnLate(1)),
        ("railing", -1.0, Cause::DrawnLate(1)),
        ("railing", 2.0, Cause::DrawnEarly(2)),
        ("roll", -2.0, Cause::DrawnLate(2)),
    ] {
        assert_time_named(&DrawnScene::new(&load_shipped(name)), time, cause);
    }
}

#[test]
fn colour_tells_the_time_where_nothing_else_does() {
    let late = STILL.audit(&draw(STILL.scene, -1.0));
    assert!(late.velocity.iter().all(|object| object.is_right));
    assert!(!late.shows_scene);
    expect(&late, Buffer::Picture, None, is(Cause::DrawnLate(1)));
    // Only the colour is late if all else is of the instant.
    let mut mixed = MOVING.capture.clone();
    mixed.color = draw(MOVING.scene, -1.0).color;
    let verdict = MOVING.audit(&mixed);
    assert!(verdict.shows_scene);
    expect(&verdict, Buffer::Color, None, is(Cause::DrawnLate(1)));
}

#[test]
fn rows_upside_down_are_named() {
    let changed = |changes: &[fn(&mut Capture)]| {
        let mut capture = MOVING.capture.clone();
        changes.iter().for_each(|change| change(&mut capture));
        capture
    };
    let ids: Change = |capture| flip(capture.object_id.as_mut().unwrap());
    let rows: [(Change, Buffer, bool); 4] = [
        (|capture| flip(&mut capture.color), Buffer::Color, true),
        (|capture| flip(&mut capture.depth), Buffer::Depth, true),
        (
            |capture| flip(&mut capture.velocity),
            Buffer::Velocity,
            true,
        ),
        (ids, Buffer::ObjectId, false),
    ];
    let all = changed(&rows.map(|(change, ..)| change));
    let alone = rows.map(|(change, buffer, shows)| (changed(&[change]), buffer, shows));
    let all = [without_ids(&all), all].map(|capture| (capture, Buffer::Picture, false));
    for (capture, buffer, shows) in all.into_iter().chain(alone) {
        let verdict = MOVING.audit(&capture);
        assert_eq!(verdict.shows_scene, shows, "{:#?}", verdict.findings);
        expect(&verdict, buffer, None, is(Cause::UpsideDown));
    }
}

#[test]
fn an_object_that_is_not_drawn_is_no_pass() {
    let disc = id_of(STILL.scene, "disc");
    let mut without_disc = STILL.scene.clone();
    // The disc goes far behind the camera.
    for key in &mut without_disc.objects[disc as usize - 1].motion.keys {
        key.translation.z += 50.0;
    }
    let drawn = draw(&without_disc, 0.0);
    let verdict = STILL.audit(&drawn);
    assert!(!verdict.shows_scene);
    let finding = expect(
        &verdict,
        Buffer::Picture,
        Some("disc"),
        is(Cause::OtherView),
    );
    assert!(finding.text.contains("0.0 % of its "), "{}", finding.text);
    // The rest of the picture agrees.
    assert!(verdict.alike > 0.8, "{}", verdict.alike);
    let without = STILL.audit(&without_ids(&drawn)).findings;
    let text = &without[0].text;
    assert!(text.contains("object.exr would show"), "{text}");
}

#[test]
fn the_colours_of_unlit_scenes_are_compared() {
    let drawn = &UNLIT.capture;
    let recolored = |object: Option<&str>, change: fn([f32; 3]) -> [f32; 3]| {
        let id = object.map(|name| id_of(UNLIT.scene, name));
        let mut capture = drawn.clone();
        let ids = drawn.object_id.iter().flat_map(|ids| &ids.pixels);
        for (color, pixel_id) in capture.color.pixels.iter_mut().zip(ids) {
            if id.is_none_or(|id| id == *pixel_id) {
                *color = change(*color);
            }
        }
        UNLIT.audit(&capture)
    };
    let black = recolored(Some("car"), |_| [0.0; 3]);
    assert!(black.shows_scene && black.compares_color);
    let finding = expect(&black, Buffer::Color, Some("car"), |_| true);
    let words = "colour of `car` is (0.000, 0.000, 0.000) in the mean, not (";
    assert!(finding.text.starts_with(words), "{}", finding.text);
    let swapped = recolored(Some("car"), |[red, green, blue]| [green, red, blue]);
    let is_other = |cause: &Cause| matches!(cause, Cause::OtherColor(..));
    assert!(names(&swapped.findings[0], is_other), "{swapped:#?}");
    let bright = recolored(None, |color| color.map(|value| 2.0 * value));
    let is_twice =
        |cause: &Cause| matches!(cause, Cause::Brightness(by) if (by - 2.0).abs() < 0.05);
    let finding = expect(&bright, Buffer::Color, None, is_twice);
    assert!(finding.text.contains("`color_scale` 2.0"), "{finding:#?}");
    // Light is the engine's own choice.
    let mut dark = STILL.capture.clone();
    dark.color = dark.color.map(|_| [0.0; 3]);
    let dark = STILL.audit(&dark);
    assert!(dark.findings.is_empty(), "{:#?}", dark.findings);
    assert!(!dark.compares_color);
}
