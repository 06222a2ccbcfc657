//! The first difference between a file and what this program makes.

use std::collections::{BTreeMap, BTreeSet};

use frame::{ExrFile, Samples, Tile};

/// Values of the attribute `traversal`, as in `tracer::Stage`: how rays were traced, which leaves the file's contents alone.
pub const TRAVERSALS: [&str; 2] = ["avx2", "portable"];

/// Compares a tile of a file with a newly made one, bit by bit, and all attributes; describes the first difference.
pub(super) fn find_difference(found: &ExrFile, tile: Tile, made: &ExrFile) -> Option<String> {
    let fits = tile.x + tile.width <= found.width && tile.y + tile.height <= found.height;
    if !fits || (tile.width, tile.height) != (made.width, made.height) {
        return Some(format!(
            "it has {}x{} pixels, which do not hold the tile at ({}, {})",
            found.width, found.height, tile.x, tile.y
        ));
    }
    find_attribute(found, made).or_else(|| find_sample(found, tile, made))
}

/// Compares a file's attributes with newly made ones; describes the first difference.
pub(super) fn find_attribute(found: &ExrFile, made: &ExrFile) -> Option<String> {
    let names = found.attributes.keys().chain(made.attributes.keys());
    names.collect::<BTreeSet<_>>().into_iter().find_map(|name| {
        let [held, expected] = [found, made].map(|file| file.attributes.get(name));
        let is_equal = match name.as_str() {
            // Written with the file; readers compare it with the content.
            "checksum" => true,
            // Another machine has other instructions, which trace the same bits.
            "traversal" => held.is_some_and(|word| TRAVERSALS.contains(&word.as_str())),
            _ => held == expected,
        };
        let text = |value: Option<&String>| {
            value.map_or_else(|| "nothing".to_owned(), |value| format!("\"{value}\""))
        };
        (!is_equal).then(|| {
            format!(
                "its attribute {name} holds {}, and this program makes {}",
                text(held),
                text(expected)
            )
        })
    })
}

fn find_sample(found: &ExrFile, tile: Tile, made: &ExrFile) -> Option<String> {
    let [there, expected] = [found, made].map(|file| -> BTreeMap<&str, &Samples> {
        let channels = file.channels.iter();
        channels
            .map(|channel| (channel.name.as_str(), &channel.samples))
            .collect()
    });
    let other = |verb: &str, name: &str| {
        format!("it {verb} the channel {name}, other than this program makes it")
    };
    if let Some(name) = there.keys().find(|name| !expected.contains_key(*name)) {
        return Some(other("has", name));
    }
    let pixels = tile.pixels(found.width);
    expected.into_iter().find_map(|(name, made)| {
        let Some(held) = there.get(name) else {
            return Some(other("lacks", name));
        };
        pixels.iter().enumerate().find_map(|(place, &pixel)| {
            let [held, made] = [bits(held, pixel as usize), bits(made, place)];
            (held != made).then(|| {
                format!(
                    "pixel ({}, {}) of its channel {name} holds {}, and this program makes {}",
                    pixel % found.width,
                    pixel / found.width,
                    bits_text(held),
                    bits_text(made)
                )
            })
        })
    })
}

/// Returns the bits of a sample, and true for a float's.
fn bits(samples: &Samples, index: usize) -> (u32, bool) {
    match samples {
        Samples::F32(samples) => (samples[index].to_bits(), true),
        Samples::U32(samples) => (samples[index], false),
    }
}

fn bits_text((bits, is_float): (u32, bool)) -> String {
    match is_float {
        true => format!("{:?} (bits {bits:#010x})", f32::from_bits(bits)),
        false => bits.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use frame::Raster;

    use super::*;

    fn file(width: u32, height: u32, value: f32) -> ExrFile {
        let mut file = ExrFile::new(width, height);
        file.push_plane("Z", &Raster::filled(width, height, value));
        file
    }

    #[test]
    fn the_sign_of_zero_is_a_difference() {
        let [found, made] = [0.0, -0.0].map(|value| file(1, 1, value));
        assert!(find_difference(&found, Tile::whole(1, 1), &made).is_some());
    }

    #[test]
    fn other_channels_and_sizes_are_differences() {
        let (made, mut found) = (file(2, 2, 1.0), file(4, 3, 1.0));
        let tile = Tile {
            x: 1,
            y: 1,
            ..Tile::whole(2, 2)
        };
        assert_eq!(find_difference(&found, tile, &made), None);
        found.push_plane("more", &Raster::filled(4, 3, 0.0));
        for (found, expected) in [(&found, "it has the channel more"), (&made, "2x2 pixels")] {
            let text = find_difference(found, tile, &made).unwrap();
            assert!(text.contains(expected), "{text}");
        }
    }
}
