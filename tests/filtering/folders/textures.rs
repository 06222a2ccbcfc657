//! Textures that kernels read and write.

use filters::Blur;
use frame::Raster;
use tests::picture::{BLACK_WALL, Picture};
use tests::shared_gpu;

use crate::filter_files::{FilterFiles, ready};

#[test]
fn a_texture_that_a_pass_reads_and_writes_is_swapped_for_every_colour() {
    let filter = FilterFiles::fixture("filters/shift").load().unwrap();
    for distance in 1..=4 {
        let mut settings = filter.settings(None).unwrap();
        let text = distance.to_string();
        settings.set(&filter, "distance", &text).unwrap();
        let mut blur = Blur::new(shared_gpu(), &filter, &settings, 10, 3).unwrap();
        let colors = [1.0, 2.0]
            .map(|scale| Raster::from_fn(10, 3, |x, y| [scale * x as f32, y as f32, 0.0]));
        let still = Picture::uniform(10, 3, BLACK_WALL);
        let outputs = blur.run(&still.input(&colors.each_ref())).unwrap();
        for (color, output) in colors.iter().zip(&outputs) {
            let expected = Raster::from_fn(10, 3, |x, y| *color.at(x.saturating_sub(distance), y));
            assert_eq!(*output, expected, "by {distance} pixels");
        }
    }
}

#[test]
fn whole_numbers_keep_every_bit_in_a_texture_of_a_fixed_fraction() {
    let filter = FilterFiles::fixture("filters/numbers").load().unwrap();
    let mut blur = ready(&filter, (10, 5)).unwrap();
    let still = Picture::uniform(10, 5, BLACK_WALL);
    let outputs = blur.run(&still.input(&[&still.color])).unwrap();
    let number = |x: u32, y: u32| 1 + x / 4 + 16 * (y / 4);
    let expected = Raster::from_fn(10, 5, |x, y| [255.0, number(x, y) as f32, 0.0]);
    assert_eq!(outputs[0], expected);
    // Rounded up, so that the last, partial block is there.
    let blocks = blur.read_texture("blocks").unwrap();
    assert_eq!((blocks.width, blocks.height), (3, 2));
    assert_eq!(blocks.at(2, 1)[0].to_bits(), 0xff00_0001 + 2 + 16);
}

#[test]
fn a_texture_is_read_in_its_own_format() {
    let shown = "f32(block >> 24u), f32(block & 0xffu)";
    let files = FilterFiles::fixture("filters/numbers").changed("numbers.wgsl", shown, "0.0, 0.0");
    let number = "vec4<u32>(0xff000001u + id.x + 16u * id.y)";
    let stored = files.changed("numbers.wgsl", number, "vec4<f32>(0.0)");
    let float = stored.changed("filter.toml", "r32uint", "r32float");
    let depth = files.changed("numbers.wgsl", "(blocks,", "(depth,");
    files.assert_refused("formats");
    float.assert_refused("read_format");
    stored.assert_refused("stored_format");
    depth.assert_refused("format_of_depth");
}
