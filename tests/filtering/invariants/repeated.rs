//! Runs that must equal other runs bit for bit.

use filters::{Blur, Input};
use frame::Image;
use tests::presets::{every_preset, preset_name};
use tests::{ready_blur, shared_gpu};

use super::{FRAME_INDEX, HEIGHT, WIDTH, random};

/// Returns the bits of all values. As numbers, NaN would equal nothing, and -0 would equal 0.
fn bits(images: &[Image]) -> Vec<u32> {
    let values = images.iter().flat_map(|image| image.pixels.as_flattened());
    values.map(|value| value.to_bits()).collect()
}

#[test]
fn kept_kernels_and_textures_give_the_bytes_of_fresh_ones_after_any_other_run() {
    let (field, other) = (random(6), random(7));
    let matte = field.color.map(|[r, ..]| [*r, 0.0, 0.5]);
    let colors = [&field.color, &matte];
    for (filter, settings) in every_preset() {
        // The presets of a filter share its kernels.
        let mut kept = ready_blur(&filter, &settings, (WIDTH, HEIGHT));
        let first = kept.run(&field.input(&colors, FRAME_INDEX)).unwrap();
        kept.run(&other.input(&[&other.color], FRAME_INDEX))
            .unwrap();
        let again = kept.run(&field.input(&colors, FRAME_INDEX)).unwrap();
        let mut fresh = Blur::new(shared_gpu(), &filter, &settings, WIDTH, HEIGHT).unwrap();
        let fresh = fresh.run(&field.input(&colors, FRAME_INDEX)).unwrap();
        let name = preset_name(&filter, &settings);
        assert_eq!(bits(&first), bits(&again), "{name}");
        assert_eq!(bits(&first), bits(&fresh), "{name}");
        assert_eq!(first.len(), 2);
    }
}

#[test]
fn frames_of_noise_in_one_batch_equal_single_ones() {
    let field = random(21);
    let mut noisy = 0;
    for (filter, settings) in every_preset() {
        let name = preset_name(&filter, &settings);
        let mut blur = ready_blur(&filter, &settings, (WIDTH, HEIGHT));
        let colors = [&field.color];
        let input = |frame_index: u32| Input {
            frame_index,
            ..field.input(&colors, FRAME_INDEX)
        };
        let alone = [0, 1, 5].map(|index| blur.run(&input(index)).unwrap().remove(0));
        match blur.run_noise(&input(0), [0, 1, 5]).unwrap() {
            Some(together) => {
                assert_eq!(together, alone, "{name}");
                noisy += 1;
            }
            None => assert!(
                alone[1..].iter().all(|output| *output == alone[0]),
                "{name}"
            ),
        }
    }
    assert!(noisy > 10, "only {noisy} presets draw noise");
}
