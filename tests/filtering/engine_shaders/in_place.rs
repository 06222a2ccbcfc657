//! Pictures that shaders read and write in place, as Godot's effects do.

use filters::Input;
use tests::near::assert_near;

use super::{busy_picture, make_declared};
use crate::filter_files::ready;

#[test]
fn a_picture_in_place_begins_with_the_colours_and_keeps_what_is_not_written() {
    let files = make_declared("in_place", "in_place.toml");
    let picture = busy_picture();
    let brighter = picture.color.map(|pixel| pixel.map(|value| 2.0 * value));
    let colors = [&picture.color, &brighter];
    let input = Input {
        color: &colors,
        ..picture.input(&colors)
    };
    let mut blur = ready(&files.load().unwrap(), (61, 43)).unwrap();
    // The second run begins anew.
    for _ in 0..2 {
        let outputs = blur.run(&input).unwrap();
        for (color, output) in colors.into_iter().zip(outputs) {
            for (x, y) in [(12_u32, 9_u32), (40, 30), (10, 8), (3, 3)] {
                let mut row: Vec<f32> = (0..61).map(|x| color.at(x, y)[0]).collect();
                for _ in 0..3 {
                    let before = row.clone();
                    for x in (0..61_u32).filter(|x| moves(picture.velocity.at(*x, y))) {
                        row[x as usize] += 0.5 * before[x.saturating_sub(1) as usize];
                    }
                }
                // Halves have 11 binary digits, four times.
                let actual = output.at(x, y)[0];
                assert_near(
                    actual,
                    row[x as usize],
                    0.002 * f64::from(row[x as usize]) + 1e-6,
                );
            }
        }
    }
    files.assert_refused("in_place");
}

fn moves([x, y]: &[f32; 2]) -> bool {
    x.hypot(*y) >= 0.5
}
