//! Reports of what passes cost. The times themselves depend on the machine, and no test looks at them.

use filters::{Blur, BufferCopy, Clock, Filter, Gpu, Input};
use frame::Raster;

const WIDTH: u32 = 40;
const HEIGHT: u32 = 24;

#[test]
fn every_dispatch_is_timed_once_by_either_clock() {
    let mut gpu = Gpu::new(None).expect("these tests run filters");
    let filter = Filter::builtin("jump_flood").unwrap();
    let color = Raster::filled(WIDTH, HEIGHT, [0.5; 3]);
    let velocity = Raster::filled(WIDTH, HEIGHT, [9.0, 0.0]);
    let depth = Raster::filled(WIDTH, HEIGHT, 3.0);
    let input = Input {
        color: &[&color],
        velocity: &velocity,
        depth: &depth,
        reprojection: None,
        exposure: 1.0,
        frame_index: 0,
    };
    for clock in [gpu.clock, Clock::WallClock] {
        gpu.clock = clock;
        let settings = filter.settings(Some("paper")).unwrap();
        let mut blur = Blur::new(&gpu, &filter, &settings, WIDTH, HEIGHT).unwrap();
        let loaded = blur.load(&input).unwrap();
        let times = loaded.time().unwrap();
        let entries: Vec<&str> = times.iter().map(|pass| &pass.entry[..]).collect();
        let expected = ["seed", "dilate", "dilate", "dilate", "backtrack", "gather"];
        assert_eq!(entries, expected, "{clock:?}");
        for pass in &times {
            // Eight dispatches of 960 pixels: a minute is a clock that ticks wrongly.
            assert!(
                pass.seconds > 0.0 && pass.seconds < 60.0,
                "{clock:?}: {pass:?}"
            );
        }
        // What was timed is what would have been run.
        let seeds = blur.read_texture("seeds").unwrap();
        assert!(seeds.pixels.iter().any(|texel| texel[3] == 1.0));
    }
}

#[test]
fn every_texture_of_a_pass_counts_once() {
    let gpu = Gpu::new(None).expect("these tests run filters");
    let color = Raster::filled(WIDTH, HEIGHT, [0.5; 3]);
    let input = Input {
        color: &[&color],
        velocity: &Raster::filled(WIDTH, HEIGHT, [0.0; 2]),
        depth: &Raster::filled(WIDTH, HEIGHT, 3.0),
        reprojection: None,
        exposure: 1.0,
        frame_index: 0,
    };
    // Bytes per pixel: colours, seeds and sources have 16, velocities 8, depths 4.
    for (filter, expected) in [
        ("identity", vec![16 + 16]),
        (
            "jump_flood",
            vec![
                16,
                16 + 8 + 4 + 16,
                16 + 8 + 4 + 16,
                16 + 8 + 4 + 16,
                16 + 8 + 4 + 16,
                16 + 16 + 8 + 4 + 16,
            ],
        ),
    ] {
        let filter = Filter::builtin(filter).unwrap();
        let settings = filter.settings(None).unwrap();
        let mut blur = Blur::new(&gpu, &filter, &settings, WIDTH, HEIGHT).unwrap();
        let times = blur.load(&input).unwrap().time().unwrap();
        let bytes: Vec<u64> = times.iter().map(|pass| pass.bytes).collect();
        let pixels = u64::from(WIDTH * HEIGHT);
        let expected: Vec<u64> = expected.iter().map(|bytes| bytes * pixels).collect();
        assert_eq!(bytes, expected, "{}", filter.name);
    }
}

#[test]
fn a_copy_reads_and_writes_its_bytes() {
    let gpu = Gpu::new(None).expect("these tests run filters");
    let copy = BufferCopy::new(&gpu).unwrap();
    assert_eq!(copy.bytes, 2 * 128 * 1024 * 1024);
    assert!(copy.time().unwrap() > 0.0);
}
