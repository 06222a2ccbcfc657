//! Runs that must equal other runs bit for bit.

use filters::{Blur, Filter, Input, Kernels};
use frame::Image;
use tests::presets::{every_preset, preset_name};

use super::{Field, HEIGHT, WIDTH, open_gpu};

#[test]
fn two_runs_give_the_same_bytes_after_any_other_run() {
    let gpu = open_gpu();
    let (field, other) = (Field::random(6), Field::random(7));
    for (filter, settings) in every_preset() {
        let mut blur = Blur::new(&gpu, &filter, &settings, WIDTH, HEIGHT).unwrap();
        let first = blur.run(&field.input(&[&field.color])).unwrap();
        blur.run(&other.input(&[&other.color])).unwrap();
        let again = blur.run(&field.input(&[&field.color])).unwrap();
        let fresh = field.blur(&gpu, &filter, &settings);
        let name = preset_name(&filter, &settings);
        assert_eq!(bits(&first[0]), bits(&again[0]), "{name}");
        assert_eq!(bits(&first[0]), bits(&fresh), "{name}");
    }
}

/// Returns the bits of all values. As numbers, NaN would equal nothing, and -0 would equal 0.
fn bits(image: &Image) -> Vec<u32> {
    let values = image.pixels.as_flattened().iter();
    values.map(|value| value.to_bits()).collect()
}

#[test]
fn kernels_kept_on_the_gpu_give_the_same_bytes() {
    let gpu = open_gpu();
    let (field, other) = (Field::random(6), Field::random(7));
    let matte = field.color.map(|[r, ..]| [*r, 0.0, 0.5]);
    let mut filter_before: Option<(Filter, Kernels)> = None;
    for (filter, settings) in every_preset() {
        // The presets of a filter share its kernels.
        if filter_before
            .as_ref()
            .is_none_or(|(before, _)| before.name != filter.name)
        {
            let kernels = Kernels::compile(&gpu, &filter).unwrap();
            filter_before = Some((filter.clone(), kernels));
        }
        let (_, kernels) = filter_before.as_ref().expect("it was compiled above");
        let colors = [&field.color, &matte];
        let mut blur = Blur::with_kernels(kernels, &settings, WIDTH, HEIGHT).unwrap();
        blur.run(&other.input(&[&other.color])).unwrap();
        let kept = blur.run(&field.input(&colors)).unwrap();
        let fresh = field.blur_colors(&gpu, &filter, &settings, &colors);
        for (kept, fresh) in kept.iter().zip(&fresh) {
            assert_eq!(
                bits(kept),
                bits(fresh),
                "{}",
                preset_name(&filter, &settings)
            );
        }
        assert_eq!(kept.len(), 2);
    }
}

#[test]
fn frames_of_noise_in_one_batch_equal_single_ones() {
    let gpu = open_gpu();
    let field = Field::random(21);
    let mut noisy = 0;
    for (filter, settings) in every_preset() {
        let (width, height) = (field.color.width, field.color.height);
        let mut blur = Blur::new(&gpu, &filter, &settings, width, height).unwrap();
        let colors = [&field.color];
        let input = |frame_index: u32| Input {
            frame_index,
            ..field.input(&colors)
        };
        let alone = [0, 1, 5].map(|index| blur.run(&input(index)).unwrap().remove(0));
        match blur.run_noise(&input(0), [0, 1, 5]).unwrap() {
            Some(together) => {
                assert_eq!(together, alone, "{}", preset_name(&filter, &settings));
                noisy += 1;
            }
            None => assert!(
                alone[1] == alone[0] && alone[2] == alone[0],
                "{} has noise",
                preset_name(&filter, &settings)
            ),
        }
    }
    assert!(noisy > 10, "only {noisy} presets draw noise");
}
