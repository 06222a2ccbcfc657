//! The blur of realism-effects.

use tests::near::assert_near;
use tests::picture::{Picture, white};

/// Returns the taps' average distance ahead, in every pixel of the picture's middle.
fn shifts(jitter: &str) -> Vec<f64> {
    // Brightness is the column, so a mean of taps is their mean position.
    let picture = Picture::new(240, 64, |x, _| white(24.0).gray(x as f32));
    let output = picture.blur("realism_effects", "default", &format!("jitter={jitter}"));
    let pixels = (90..150).flat_map(|x| (0..64).map(move |y| (x, y)));
    pixels
        .map(|(x, y)| f64::from(output.at(x, y)[0]) - f64::from(x))
        .collect()
}

#[test]
fn noise_moves_the_trail_ahead_and_never_back() {
    // Seventeen of the eighteen colours are taps.
    let farthest = 24.0 * 17.0 / 18.0;
    let trail_shifts = shifts("1");
    let mean = trail_shifts.iter().sum::<f64>() / trail_shifts.len() as f64;
    assert!(
        trail_shifts
            .iter()
            .all(|shift| (-1e-3..farthest).contains(shift))
    );
    assert_near(mean, 0.5 * farthest, 0.3);
    // Without noise the trail is centred, as the comments of the original say.
    assert!(shifts("0").iter().all(|shift| shift.abs() < 1e-3));
}

#[test]
fn the_sky_stays_sharp_however_it_moves() {
    let sky = white(12.0).at(frame::FAR_DEPTH);
    let picture = Picture::new(40, 20, |x, _| sky.gray((x % 2) as f32));
    for filter in ["realism_effects", "babylon"] {
        assert!(picture.blur(filter, "default", "") == picture.color);
    }
}
