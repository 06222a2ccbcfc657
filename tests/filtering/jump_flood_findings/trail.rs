//! Lengths of trails.

use frame::Raster;
use tests::near::assert_near;
use tests::picture::{Picture, column, moving_edge, white};

/// Measures how far ahead the mean of each pixel's taps is, in pixels, away from the border.
/// Returns sorted distances.
fn displacements(preset: &str, jitter: &str, speed: f32) -> Vec<f32> {
    // A pixel's brightness is its column.
    let slope = Picture::new(200, 32, |x, _| white(speed).gray(x as f32));
    let output = slope.blur("jump_flood", preset, &format!("jitter={jitter}"));
    let inner = (0..120).flat_map(|x| (0..32).map(move |y| (x, y)));
    let mut offsets: Vec<f32> = inner.map(|(x, y)| output.at(x, y)[0] - x as f32).collect();
    offsets.sort_by(f32::total_cmp);
    offsets
}

#[test]
fn noise_scales_whole_trails_evenly_by_a_half_to_one_and_a_half() {
    let offsets = displacements("paper", "step_scale", 20.0);
    // The mean of a trail of 20 pixels is 10 ahead.
    for part in [0.0, 0.25, 0.5, 0.75, 1.0] {
        let index = (part * (offsets.len() - 1) as f64) as usize;
        // Noise of 3840 pixels, which is more even than random numbers: 0.024 would be 3 sigma of
        // those.
        assert_near(offsets[index] / 10.0, 0.5 + part, 0.02);
    }
}

/// Returns the brightness this many pixels behind an edge from black to white. Everything moves
/// right by 24 pixels.
fn behind_an_edge(preset: &str, distance: u32) -> f64 {
    let output = moving_edge(240, 64, [24.0, 0.0]).blur("jump_flood", preset, "");
    column(&output, 120 - distance)
}

#[test]
fn the_mean_trail_ends_in_a_ramp_and_not_in_a_step() {
    // Eight taps are at i / 7 of the trail. Taps 5, 6 and 7 exceed its whole length if the scale is
    // above 1.4, 7/6 and 1.
    let expected = (0.1 + 1.0 / 3.0 + 0.5) / 8.0;
    // Noise of 64 rows; half a pixel of the edge.
    assert_near(behind_an_edge("paper", 24), expected, 0.03);
    assert!(behind_an_edge("paper", 34) > 0.0);
    assert_eq!(behind_an_edge("paper", 37), 0.0);
    // A box ends abruptly.
    assert_eq!(behind_an_edge("corrected", 25), 0.0);
}

#[test]
fn a_start_offset_makes_a_box_only_if_the_pixel_itself_shifts_too() {
    // Half a pixel before the edge, a box of 24 pixels is white except for 0.5 / 24.
    let box_filter = 1.0 - 0.5 / 24.0;
    // Two pixels of bilinear fetches, and noise of 64 rows.
    assert_near(behind_an_edge("corrected", 1), box_filter, 0.02);
    // In the version of two days later the pixel's own colour is still one of eight taps, and
    // black.
    assert_near(behind_an_edge("july_2024", 1), 7.0 / 8.0 * box_filter, 0.02);
}

/// Returns the farthest pixel behind an edge in steady motion that still mixes in the other side,
/// along columns or rows.
fn reach(preset: &str, vertical: bool, speed: f32, exposure: f64) -> u32 {
    let velocity = if vertical { [0.0, speed] } else { [speed, 0.0] };
    let mut picture = moving_edge(256, 144, velocity);
    if vertical {
        picture.color = Raster::from_fn(256, 144, |_, y| [if y < 72 { 0.0 } else { 1.0 }; 3]);
    }
    picture.exposure = exposure;
    let output = picture.blur("jump_flood", preset, "jitter=none");
    let lit = |distance: &u32| {
        let pixel = if vertical {
            output.at(20, 72 - distance)
        } else {
            output.at(128 - distance, 20)
        };
        pixel[0] > 0.0
    };
    (1..72).filter(lit).max().unwrap_or(0)
}

#[test]
fn trails_are_cut_at_32_pixels_and_two_days_later_at_64_at_any_speed() {
    for speed in [70.0, 100.0, 150.0] {
        // The last tap is on the cut.
        assert_eq!(reach("paper", false, speed, 1.0), 32, "{speed}");
        assert_eq!(reach("july_2024", false, speed, 1.0), 64, "{speed}");
        assert!(reach("corrected", false, speed, 1.0) > 64, "{speed}");
    }
}

#[test]
fn vertical_trails_of_a_wide_picture_are_cut_shorter() {
    // 144 / 256: the cuts of 32 and 64 pixels are parts of the width, and a vertical path is a part
    // of the height.
    assert_eq!(reach("paper", true, 60.0, 1.0), 18);
    assert_eq!(reach("july_2024", true, 60.0, 1.0), 36);
}

#[test]
fn the_cut_is_right_only_for_an_exposure_of_one_frame() {
    // The cut wrongly divides by the exposure: 32 / 0.5 and 32 / 2 pixels.
    assert_eq!(reach("paper", false, 90.0, 0.5), 45);
    assert_eq!(reach("paper", false, 140.0, 0.5), 64);
    assert_eq!(reach("paper", false, 90.0, 2.0), 16);
}
