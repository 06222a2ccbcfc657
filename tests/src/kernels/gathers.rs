//! Filters that average along a pixel's own motion, or along motion from a nearby pixel.

use super::{Steady, Tap, at_pixels, bilinear, on_trail, tap_here};
use crate::vector::{length, scaled};

/// Places the taps at i/N of the trail: Ctrl-Alt-Test 2011, and the blur by the camera's motion.
pub fn plain(preset: &str, steady: &Steady) -> Vec<Tap> {
    let (count, end) = match preset {
        "departure" => (10, 1.0),
        "coarse" | "default" => (8, 1.0),
        "fine" => (20, 1.0),
        // The last tap is at the end of the exposure.
        "armory" => (9, 1.125),
        _ => panic!("say here how many taps {preset} has"),
    };
    let parts = (0..count).map(|i| end * f64::from(i) / f64::from(count));
    on_trail(steady.trail(), parts)
}

/// Places the taps on both sides of the pixel: in the middles of steps, or from end to end with the
/// pixel itself.
pub fn centred(preset: &str, steady: &Steady) -> Vec<Tap> {
    let has_own = matches!(preset, "armory" | "spartan_2024");
    let (first, last, count) = match preset {
        "even" | "smoothed" => (0.5, 15.5, 16.0),
        "armory" => (0.0, 7.0, 7.0),
        "spartan_2024" => (1.0, 31.0, 31.0),
        _ => panic!("say here where the taps of {preset} are"),
    };
    let taps = (0..64).map(|i| first + f64::from(i));
    let taps = taps.take_while(|tap| *tap <= last);
    let mut taps = on_trail(steady.trail(), taps.map(|tap| tap / count - 0.5));
    taps.extend(has_own.then(|| tap_here(1.0)));
    taps
}

/// Places the taps of Golan's demo of 2024, and of the version two days later.
pub fn jump_flood(preset: &str, steady: &Steady, noise: f64) -> Vec<Tap> {
    let trail = jump_flood_trail(preset, steady);
    match preset {
        // Noise scales the trail of a pixel.
        "paper" => on_trail(trail, (0..8).map(|i| f64::from(i) / 7.0 * (0.5 + noise))),
        // The pixel itself, and an even trail of seven taps.
        "july_2024" => {
            let mut taps = on_trail(trail, (1..8).map(|i| (f64::from(i) + noise - 1.0) / 7.0));
            taps.push(tap_here(1.0));
            taps
        }
        "corrected" | "tuned" => on_trail(trail, (0..8).map(|i| (f64::from(i) + noise) / 8.0)),
        _ => panic!("say here how {preset} gathers"),
    }
}

/// Returns the motion for the gather. It is cut at the largest step of the dilation, 32 pixels, or
/// at twice that, both as parts of the picture's longer side and of a path in parts of width and
/// height.
pub fn jump_flood_trail(preset: &str, steady: &Steady) -> [f64; 2] {
    let cut = match preset {
        "paper" | "tuned" => 32.0,
        "july_2024" => 64.0,
        _ => return steady.trail(),
    };
    let [width, height] = steady.size();
    let path = length([steady.velocity[0] / width, steady.velocity[1] / height]);
    if path == 0.0 {
        return [0.0, 0.0];
    }
    // Divided by the exposure, and again when it becomes a length: right only for one frame.
    let frames = cut / width.max(height) / (path * steady.exposure);
    scaled(steady.velocity, steady.exposure.min(frames))
}

/// Places the taps of Bevy: twice as many as its `samples`, within half the trail to each side.
pub fn bevy(preset: &str, steady: &Steady, noise: f64) -> Vec<Tap> {
    let samples = match preset {
        "default" | "msaa" => 1,
        "high" => 8,
        _ => panic!("say here how many samples {preset} has"),
    };
    if length(steady.velocity) < 1.0 {
        return vec![tap_here(1.0)];
    }
    let parts = (-samples..samples).map(|i| 0.5 * (f64::from(i) + noise) / f64::from(samples));
    match preset {
        "msaa" => at_pixels(steady.trail(), parts),
        _ => on_trail(steady.trail(), parts),
    }
}

/// Places the taps of Blender: from the pixel to both ends of the trail, in even steps. Those along
/// the longest motion nearby are the same.
pub fn blender(preset: &str, steady: &Steady, noise: f64) -> Vec<Tap> {
    let half = scaled(steady.trail(), 0.5);
    if length(half) < 0.5 {
        return vec![tap_here(1.0)];
    }
    let samples = match preset {
        "compositor" => 32,
        _ => 8,
    };
    let parts = (0..samples).flat_map(|i| {
        let part = (f64::from(i) + noise) / f64::from(samples);
        [part, -part]
    });
    match samples {
        8 => at_pixels(half, parts),
        _ => on_trail(half, parts),
    }
}

/// Places the taps of three.js: the pixel itself, and sixteen from one fifteenth after the trail's
/// end to one beyond its other end.
pub fn three(preset: &str, steady: &Steady) -> Vec<Tap> {
    let parts = (1..=16).map(|i| f64::from(i) / 15.0 - 0.5);
    let mut taps = on_trail(three_trail(preset, steady), parts);
    taps.push(tap_here(1.0));
    taps
}

/// Returns the trail of three.js: as shipped, upside down.
pub fn three_trail(preset: &str, steady: &Steady) -> [f64; 2] {
    let [x, y] = steady.trail();
    match preset {
        "default" => [x, -y],
        "corrected" => [x, y],
        _ => panic!("say here what {preset} takes for motion"),
    }
}

/// Places the taps of realism-effects: the pixel itself, and a trail of seventeen that noise moves
/// ahead on each axis.
pub fn realism_effects(steady: &Steady, noise: f64) -> Vec<Tap> {
    let trail = steady.trail();
    // Together they fill the square, like two independent noises.
    let noises = [noise, (617.0 * noise).fract()];
    let taps = (0..=16).flat_map(|i| {
        let part = f64::from(i) / 16.0 - 0.5;
        let offset = [0, 1].map(|axis| (part + noises[axis]) * trail[axis]);
        bilinear(offset, 1.0)
    });
    taps.chain([tap_here(1.0)]).collect()
}

/// Places the taps of Unity's URP, at the nearest pixels: even steps, all shifted back by noise.
pub fn urp(preset: &str, steady: &Steady, noise: f64) -> Vec<Tap> {
    let pairs = match preset {
        "default" | "camera_only" => 2,
        "medium" => 3,
        "high" => 4,
        _ => panic!("say here how many taps {preset} has"),
    };
    let trail = steady.trail();
    let parts = (1 - pairs..=pairs).map(|i| (f64::from(i) - noise) / f64::from(2 * pairs));
    at_pixels(trail, parts)
}

/// Places the taps of vort: an odd number on either side, each half behind the pixel and half in
/// front of it. A few pixels of motion leave the pixel itself a weight among what is behind.
pub fn vort(steady: &Steady, noise: f64) -> Vec<Tap> {
    let half = scaled(steady.trail(), 0.5);
    let reach = length(half).min(f64::from(2 * (steady.size[1] / 27)));
    let half = scaled(half, reach / length(half));
    // 2 pixels of a picture 1920 wide.
    let tap_length = 2.0 * f64::from(steady.size[0]) / 1920.0;
    let count = f64::from((reach / tap_length).ceil().clamp(3.0, 9.0) as u32 | 1);
    let center = (0.05 * count / reach).min(1.0);
    let front = count / (2.0 * count + 1.0);
    let back = (1.0 - front) / (count + center);
    let mut taps = vec![tap_here(back * center)];
    taps.extend((0..count as u32).flat_map(|i| {
        let parts = [f64::from(i) + noise, noise - f64::from(i + 1)];
        let weight = 0.5 * back + 0.5 * front / count;
        parts
            .into_iter()
            .flat_map(move |part| bilinear(scaled(half, part / count), weight))
    }));
    taps
}
