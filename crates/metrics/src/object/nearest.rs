//! Nearest pixels of a set.

use frame::Raster;

/// Finds for every pixel the column and row of the nearest pixel of `set`, by Euclidean distance
/// between centres; `None` if `set` is empty.
///
/// Exact, in linear time: Felzenszwalb and Huttenlocher, "Distance Transforms of Sampled Functions"
/// (Theory of Computing 8, 2012), section 2. All arithmetic is on integers, so that ties do not
/// depend on rounding.
pub fn find_nearest(set: &Raster<bool>) -> Option<Raster<[u32; 2]>> {
    if !set.pixels.contains(&true) {
        return None;
    }
    let columns = find_in_columns(set);
    let mut nearest = Raster::filled(set.width, set.height, [0, 0]);
    for y in 0..set.height {
        let row = y as usize * set.width as usize..(y as usize + 1) * set.width as usize;
        let parabolas: Vec<(i64, u32)> = (0..set.width)
            .filter_map(|x| {
                columns
                    .at(x, y)
                    .map(|row| (i64::from(row.abs_diff(y)).pow(2), x))
            })
            .collect();
        let sources = find_lowest(&parabolas, set.width);
        for (pixel, x) in nearest.pixels[row].iter_mut().zip(sources) {
            let source_row = columns.at(x, y).expect("a parabola's column has a pixel");
            *pixel = [x, source_row];
        }
    }
    Some(nearest)
}

/// Returns the squared distance between the centres of two pixels, in pixels.
pub fn distance_squared(a: [u32; 2], b: [u32; 2]) -> u64 {
    let [x, y] = [a[0].abs_diff(b[0]), a[1].abs_diff(b[1])].map(u64::from);
    x * x + y * y
}

/// Finds every pixel of `set` on this circle about `at`: all that are equally near, so that a
/// mirrored picture gives mirrored pixels.
pub fn find_on_circle<'a>(
    set: &'a Raster<bool>,
    at: [u32; 2],
    circle: &'a [[i64; 2]],
) -> impl Iterator<Item = [u32; 2]> {
    circle.iter().filter_map(move |[right, down]| {
        let x = u32::try_from(i64::from(at[0]) + right).ok()?;
        let y = u32::try_from(i64::from(at[1]) + down).ok()?;
        (x < set.width && y < set.height && *set.at(x, y)).then_some([x, y])
    })
}

/// Lists every whole offset, right and down, of exactly this squared length above 0.
pub fn list_circle(squared: u64) -> Vec<[i64; 2]> {
    let mut offsets = Vec::new();
    // Along the circle's first quadrant, both ends of an axis counted once.
    let squared = squared as i64;
    let (mut right, mut down) = (squared.isqrt(), 0);
    while right > 0 {
        let excess = right * right + down * down - squared;
        if excess == 0 {
            // Quarter turns of one offset.
            offsets.extend([
                [right, down],
                [-down, right],
                [-right, -down],
                [down, -right],
            ]);
        }
        if excess > 0 {
            right -= 1;
        } else {
            down += 1;
        }
    }
    offsets
}

/// Finds for every pixel the row of the nearest set pixel in its own column.
fn find_in_columns(set: &Raster<bool>) -> Raster<Option<u32>> {
    let mut rows: Raster<Option<u32>> = Raster::filled(set.width, set.height, None);
    for x in 0..set.width {
        let index = |y: u32| y as usize * set.width as usize + x as usize;
        let mut above = None;
        for y in 0..set.height {
            if *set.at(x, y) {
                above = Some(y);
            }
            rows.pixels[index(y)] = above;
        }
        let mut below: Option<u32> = None;
        for y in (0..set.height).rev() {
            if *set.at(x, y) {
                below = Some(y);
            }
            let closer = match (rows.pixels[index(y)], below) {
                (Some(above), Some(below)) if below - y < y - above => Some(below),
                (None, below) => below,
                (above, _) => above,
            };
            rows.pixels[index(y)] = closer;
        }
    }
    rows
}

/// Finds for every column the parabola `height + (column - x)^2` that is lowest there; the leftmost
/// wins a tie.
fn find_lowest(parabolas: &[(i64, u32)], width: u32) -> Vec<u32> {
    // Each parabola of the envelope with the first column where it is below all before it.
    let mut envelope: Vec<(i64, i64, i64)> = Vec::new();
    for &(height, x) in parabolas {
        let x = i64::from(x);
        let mut start = 0;
        while let Some(&(last_height, last_x, last_start)) = envelope.last() {
            // height + (c - x)^2 < last_height + (c - last_x)^2 holds for columns c above this
            // quotient.
            let numerator = height + x * x - last_height - last_x * last_x;
            start = numerator.div_euclid(2 * (x - last_x)) + 1;
            if start > last_start {
                break;
            }
            envelope.pop();
            start = 0;
        }
        envelope.push((height, x, start));
    }
    let mut current = 0;
    (0..i64::from(width))
        .map(|column| {
            while current + 1 < envelope.len() && envelope[current + 1].2 <= column {
                current += 1;
            }
            envelope[current].1 as u32
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_pixel_is_the_one_that_a_search_finds() {
        // A deterministic scatter: sparse, dense and empty columns.
        for (step, width, height) in [(3, 13, 7), (11, 31, 17), (97, 24, 24), (350, 31, 17)] {
            let set = Raster::from_fn(width, height, |x, y| {
                (x * x * 7 + y * 13 + x * y) % step == 0
            });
            let nearest = find_nearest(&set).expect("each scatter has a pixel");
            for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
                let source = *nearest.at(x, y);
                assert!(
                    *set.at(source[0], source[1]),
                    "({x}, {y}) is led outside the set"
                );
                let closest = (0..height)
                    .flat_map(|v| (0..width).map(move |u| [u, v]))
                    .filter(|pixel| *set.at(pixel[0], pixel[1]))
                    .map(|pixel| distance_squared([x, y], pixel))
                    .min();
                assert_eq!(
                    Some(distance_squared([x, y], source)),
                    closest,
                    "at ({x}, {y})"
                );
            }
        }
    }

    #[test]
    fn all_pixels_at_one_distance_are_found_once() {
        let set = Raster::filled(40, 40, true);
        // 25 = 5^2 + 0^2 = 3^2 + 4^2: four and eight offsets.
        let at = |at: [u32; 2], squared: u64| -> Vec<[u32; 2]> {
            find_on_circle(&set, at, &list_circle(squared)).collect()
        };
        let mut pixels = at([20, 20], 25);
        assert!(
            pixels
                .iter()
                .all(|pixel| distance_squared([20, 20], *pixel) == 25)
        );
        pixels.sort_unstable();
        pixels.dedup();
        assert_eq!(pixels.len(), 12);
        assert_eq!(at([0, 0], 25).len(), 4);
        assert_eq!(at([20, 20], 3), Vec::<[u32; 2]>::new());
    }
}
