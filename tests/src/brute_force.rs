//! Search trees against a test of every triangle.

use scene::Scene;
use tracer::{Ray, Stage};

use crate::random::Numbers;

/// Sends `count` rays through a scene at times in `[open, close]`: from among its objects and from
/// far away, towards everything within `size` metres of the origin. Every search method must find
/// the same hit as a test of every triangle. At least a tenth of the rays must hit something.
pub fn expect_what_every_triangle_gives(
    scene: &Scene,
    [open, close]: [f64; 2],
    size: f64,
    count: u32,
) {
    let stages = [
        Stage::new(scene, open, close),
        Stage::new(scene, open, close).portable(),
    ];
    let mut poses = stages[0].poses();
    let mut numbers = Numbers(7 << 32);
    let mut hits = 0;
    for index in 0..count {
        // Ends, borders of slices, and any time.
        let time = match index % 4 {
            0 => open + (close - open) * f64::from(index / 4 % 17) / 16.0,
            _ => open + (close - open) * 0.5 * (1.0 + numbers.next()),
        };
        let distance = size * if index % 2 == 0 { 1.3 } else { 60.0 };
        let origin = distance * numbers.vector();
        let direction = (size * numbers.vector() - origin).normalize();
        let ray = Ray { origin, direction };
        let expected = stages[0].closest_of_all(poses.at(time), &ray);
        hits += u32::from(expected.is_some());
        for stage in &stages {
            let said = || format!("{}, time {time}, {ray:?}", stage.traversal());
            // Computed anew each time, since known poses change the way to the hit.
            assert_eq!(stage.closest(poses.at(time), &ray), expected, "{}", said());
            let mut is_blocked = |reach: f64| stage.is_blocked(poses.at(time), &ray, reach);
            match expected {
                Some(hit) => {
                    assert!(is_blocked(hit.t * (1.0 + 1e-9)), "{}", said());
                    assert!(!is_blocked(hit.t), "{}", said());
                }
                None => assert!(!is_blocked(f64::INFINITY), "{}", said()),
            }
        }
    }
    // Rays that miss everything prove little.
    assert!(hits > count / 10, "only {hits} of {count} rays hit");
}
