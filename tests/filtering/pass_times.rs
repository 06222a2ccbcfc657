//! Reports of what passes cost. The times depend on the machine, so no test checks them.

use filters::{Blur, BufferCopy, Clock, Filter};
use tests::open_gpu;
use tests::picture::{Picture, gray_moving_by};

const WIDTH: u32 = 40;
const HEIGHT: u32 = 24;

#[test]
fn every_dispatch_is_timed_once_by_either_clock() {
    let mut gpu = open_gpu();
    let filter = Filter::builtin("jump_flood").unwrap();
    let picture = Picture::uniform(WIDTH, HEIGHT, gray_moving_by(9.0));
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
            assert!(
                pass.seconds > 0.0 && pass.seconds < 60.0,
                "{clock:?}: {pass:?}"
            );
        }
        // The timed dispatches are the ones that a run has.
        let seeds = blur.read_texture("seeds").unwrap();
        assert!(seeds.pixels.iter().any(|texel| texel[3] == 1.0));
    }
}

#[test]
fn every_texture_of_a_pass_counts_once() {
    let gpu = open_gpu();
    let picture = Picture::uniform(WIDTH, HEIGHT, gray_moving_by(0.0));
    let colors = [&picture.color];
    let input = picture.input(&colors);
    // Bytes per pixel: colours, seeds and sources take 16, velocities 8, depths 4.
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
    let gpu = open_gpu();
    let copy = BufferCopy::new(&gpu).unwrap();
    assert_eq!(copy.bytes, 2 * 128 * 1024 * 1024);
    assert!(copy.time().unwrap() > 0.0);
}
