//! Reports of passes' costs. The times depend on the machine, so no test checks them.

use filters::{Blur, BufferCopy, Clock, Filter};
use tests::near::assert_within;
use tests::picture::{Picture, make_blur, white};
use tests::{open_gpu, shared_gpu};

const WIDTH: u32 = 40;
const HEIGHT: u32 = 24;

#[test]
fn every_dispatch_is_timed_once_by_either_clock() {
    let mut gpu = open_gpu();
    let filter = Filter::builtin("jump_flood").unwrap();
    let picture = Picture::uniform(WIDTH, HEIGHT, white(9.0));
    let colors = [&picture.color];
    let input = picture.input(&colors);
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
            // Eight dispatches of 960 pixels: a minute means a wrong clock.
            assert_within(pass.seconds, f64::MIN_POSITIVE..60.0);
        }
        // The timed dispatches are a run's own.
        let seeds = blur.read_texture("seeds").unwrap();
        assert!(seeds.pixels.iter().any(|texel| texel[3] == 1.0));
    }
}

#[test]
fn every_texture_of_a_pass_counts_once() {
    let picture = Picture::uniform(WIDTH, HEIGHT, white(0.0));
    let colors = [&picture.color];
    // Bytes per pixel: 16 each for colours, seeds and sources, 8 for velocities, 4 for depths.
    let step = 16 + 8 + 4 + 16;
    for (filter, expected) in [
        ("identity", vec![16 + 16]),
        ("jump_flood", vec![16, step, step, step, step, 16 + step]),
    ] {
        let mut blur = make_blur(filter, None, "", (WIDTH, HEIGHT));
        let times = blur.load(&picture.input(&colors)).unwrap().time().unwrap();
        let pixels = u64::from(WIDTH * HEIGHT);
        let bytes: Vec<u64> = times.iter().map(|pass| pass.bytes / pixels).collect();
        assert_eq!(bytes, expected, "{filter}");
    }
}

#[test]
fn a_copy_reads_and_writes_its_bytes() {
    let copy = BufferCopy::new(shared_gpu()).unwrap();
    assert_eq!(copy.bytes, 2 * 128 * 1024 * 1024);
    assert!(copy.time().unwrap() > 0.0);
}
