//! Jimenez 2014 and the engines that follow it. On one surface in even motion all their taps weigh alike.

use super::{Steady, Tap, bilinear, length, own, scaled};

/// What a preset averages.
pub fn taps(preset: &str, steady: &Steady, noise: f64) -> Vec<Tap> {
    let trail = steady.trail();
    match preset {
        "advanced_warfare" => {
            // A quarter of a step to and fro, in turn between pixels.
            let shift = if noise < 0.5 { -0.25 } else { 0.25 };
            pairs(
                8,
                |i| [i + 0.5 + shift, -i - 0.5 - shift],
                scaled(trail, 0.5 / 8.0),
            )
        }
        // Below 2 pixels nothing blurs; 200 are the longest.
        "hdrp" if length(trail) < 2.0 => vec![own(1.0)],
        "hdrp" => {
            let cut = scaled(trail, (200.0 / length(trail)).min(1.0));
            let shift = noise - 0.5;
            pairs(
                4,
                |i| [i + 0.5 + shift, -i - 0.5 - shift],
                scaled(cut, 0.5 / 4.0),
            )
        }
        // Five times the motion to each side, of which whole pixels count.
        "o3de" if length(trail) < 0.2 => vec![own(1.0)],
        "o3de" => {
            let shift = if noise < 0.5 { -0.25 } else { 0.25 };
            let step = scaled(trail, 5.0 / 24.0);
            let sides = (0..24).flat_map(|i| [f64::from(i) + shift, -f64::from(i) - shift]);
            let whole = |steps: f64| scaled(step, steps).map(f64::trunc);
            sides
                .map(|steps| Tap {
                    offset: whole(steps),
                    weight: 1.0,
                })
                .collect()
        }
        "wicked" => {
            // 750 pixels to each side per width and height of motion, scaled by noise; 16 taps from end to end.
            let [width, height] = steady.size();
            let half = [750.0 * trail[0] / width, 750.0 * trail[1] / height];
            let parts = (0..16).map(|i| noise * (2.0 * f64::from(i) - 15.0) / 15.0);
            super::on_trail(half, parts)
        }
        "kajiya" => {
            // The pixel and four steps on each side, shifted together.
            let shift = noise - 0.5;
            let step = scaled(trail, 0.5 / 4.0);
            super::on_trail(step, (-4..=4).map(|i| f64::from(i) + shift))
        }
        _ => panic!("say here what {preset} averages"),
    }
}

fn pairs(count: i32, steps: impl Fn(f64) -> [f64; 2], step: [f64; 2]) -> Vec<Tap> {
    (0..count)
        .flat_map(|i| steps(f64::from(i)))
        .flat_map(|steps| bilinear(scaled(step, steps), 1.0))
        .collect()
}
