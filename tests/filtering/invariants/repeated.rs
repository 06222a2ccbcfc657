//! Runs that must equal other runs bit for bit.

use filters::{Blur, Input};
use frame::Image;
use tests::presets::every_preset;
use tests::shared_gpu;

use super::{FRAME_INDEX, HEIGHT, Subject, WIDTH, random};
use crate::fields::Field;

/// Returns the bits of all values. As numbers, NaN would equal nothing, and -0 would equal 0.
fn bits(image: &Image) -> Vec<u32> {
    let values = image.pixels.as_flattened().iter();
    values.map(|value| value.to_bits()).collect()
}

/// Returns a matte of the bright parts of a field.
fn matte_of(field: &Field) -> Image {
    (field.color).map(|[r, ..]| if *r > 0.5 { [1.0, 0.0, 0.5] } else { [0.0; 3] })
}

/// Every colour image goes through the same weights, alone or with others, also after a run on
/// another field.
pub fn kept_textures_give_the_same_bytes_after_any_other_run(subject: &mut Subject) {
    let (field, other) = (random(6), random(7));
    let matte = matte_of(&field);
    let first = subject.run(&field, &[&field.color, &matte, &field.color]);
    assert_eq!(first.len(), 3);
    assert!(bits(&first[0]) == bits(&first[2]), "{}", subject.name);
    subject.run(&other, &[&other.color]);
    let alone = [(&matte, &first[1]), (&field.color, &first[0])];
    for (color, due) in alone {
        let again = subject.run(&field, &[color]).remove(0);
        assert!(bits(&again) == bits(due), "{}", subject.name);
    }
}

/// Kept kernels and textures give the bytes of fresh ones.
fn assert_as_fresh(subject: &mut Subject) {
    let field = random(6);
    let matte = matte_of(&field);
    let colors = [&field.color, &matte];
    let kept = subject.run(&field, &colors);
    let Subject {
        filter, settings, ..
    } = subject;
    let mut fresh = Blur::new(shared_gpu(), filter, settings, WIDTH, HEIGHT).unwrap();
    let fresh = fresh.run(&field.input(&colors, FRAME_INDEX)).unwrap();
    assert_eq!([kept.len(), fresh.len()], [2, 2]);
    for (kept, fresh) in kept.iter().zip(&fresh) {
        assert!(bits(kept) == bits(fresh), "{}", subject.name);
    }
}

/// The presets of a filter share its kernels: the last one runs after all others.
pub fn kept_kernels_give_the_bytes_of_fresh_ones(subject: &mut Subject) {
    let last = subject.filter.presets.last();
    if last.is_some_and(|last| last.name == subject.settings.preset) {
        assert_as_fresh(subject);
    }
}

#[test]
#[ignore = "prove: kernels compiled anew for every preset"]
fn kept_kernels_and_textures_give_the_bytes_of_fresh_ones() {
    let presets = every_preset().into_iter();
    for mut subject in presets.map(|(filter, settings)| Subject::new(filter, settings)) {
        kept_textures_give_the_same_bytes_after_any_other_run(&mut subject);
        assert_as_fresh(&mut subject);
    }
}

/// Frames of noise in one batch equal single ones. Returns whether the preset draws noise.
pub fn compare_batches_of_noise(subject: &mut Subject) -> bool {
    let field = random(21);
    let colors = [&field.color];
    let input = |frame_index: u32| Input {
        frame_index,
        ..field.input(&colors, FRAME_INDEX)
    };
    let Subject { blur, name, .. } = subject;
    let alone = [0, 1, 5].map(|index| blur.run(&input(index)).unwrap().remove(0));
    let together = blur.run_noise(&input(0), [0, 1, 5]).unwrap();
    match &together {
        Some(together) => assert!(*together == alone, "{name}"),
        None => assert!(
            alone[1..].iter().all(|output| *output == alone[0]),
            "{name}"
        ),
    }
    together.is_some()
}
