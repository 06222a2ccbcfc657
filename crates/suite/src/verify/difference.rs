//! The first difference between what a file holds and what this program makes.

use std::collections::BTreeMap;

use frame::{Channel, ExrFile, Samples, Tile};

/// Attribute that says how rays were traced, and not what the file holds.
const TRAVERSAL: &str = "traversal";
/// Values of that attribute, as `tracer::Stage` has them.
pub const TRAVERSALS: [&str; 2] = ["avx2", "portable"];

/// Compares a tile of a file with what was made for it, bit by bit; says what differs first, and none if nothing does. Attributes are
/// compared as well.
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

/// Compares the attributes of a file with those that were made for it; says which one differs first.
pub(super) fn find_attribute(found: &ExrFile, made: &ExrFile) -> Option<String> {
    let own = |file: &ExrFile| -> BTreeMap<String, String> {
        let mut attributes = file.attributes.clone();
        // Written with the file; readers compare it with the content.
        attributes.remove("checksum");
        attributes
    };
    let (found, mut made) = (own(found), own(made));
    // Another machine has other instructions, which trace the same bits.
    if let Some(word) = (found.get(TRAVERSAL)).filter(|word| TRAVERSALS.contains(&word.as_str())) {
        made.insert(TRAVERSAL.to_owned(), word.clone());
    }
    let names = found.keys().chain(made.keys());
    let name = names
        .into_iter()
        .find(|name| found.get(*name) != made.get(*name))?;
    let text = |value: Option<&String>| match value {
        Some(value) => format!("\"{value}\""),
        None => "nothing".to_owned(),
    };
    Some(format!(
        "its attribute {name} holds {}, and this program makes {}",
        text(found.get(name)),
        text(made.get(name))
    ))
}

fn find_sample(found: &ExrFile, tile: Tile, made: &ExrFile) -> Option<String> {
    let by_name = |file: &'_ ExrFile| -> BTreeMap<String, usize> {
        let channels = file.channels.iter().enumerate();
        channels
            .map(|(index, channel)| (channel.name.clone(), index))
            .collect()
    };
    let (there, expected) = (by_name(found), by_name(made));
    if let Some(name) = (there.keys().chain(expected.keys()))
        .find(|name| there.contains_key(*name) != expected.contains_key(*name))
    {
        let verb = match expected.contains_key(name) {
            true => "lacks",
            false => "has",
        };
        return Some(format!(
            "it {verb} the channel {name}, other than this program makes it"
        ));
    }
    let pixels = tile.pixels(found.width);
    for (name, index) in &expected {
        let [own, other] = [&found.channels[there[name]], &made.channels[*index]];
        for (place, &pixel) in pixels.iter().enumerate() {
            let [held, expected] = [Sample::of(own, pixel as usize), Sample::of(other, place)];
            if held != expected {
                let (x, y) = (pixel % found.width, pixel / found.width);
                return Some(format!(
                    "pixel ({x}, {y}) of its channel {name} holds {held}, and this program makes {expected}"
                ));
            }
        }
    }
    None
}

/// The bits of a sample.
#[derive(PartialEq)]
enum Sample {
    F32(u32),
    U32(u32),
}

impl Sample {
    fn of(channel: &Channel, index: usize) -> Self {
        match &channel.samples {
            Samples::F32(samples) => Self::F32(samples[index].to_bits()),
            Samples::U32(samples) => Self::U32(samples[index]),
        }
    }
}

impl std::fmt::Display for Sample {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            Self::F32(bits) => write!(f, "{:?} (bits {bits:#010x})", f32::from_bits(*bits)),
            Self::U32(number) => write!(f, "{number}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use frame::Raster;

    use super::*;

    const TILE: Tile = Tile {
        x: 1,
        y: 1,
        width: 2,
        height: 2,
    };

    fn file(width: u32, height: u32, corner: u32) -> ExrFile {
        let mut file = ExrFile::new(width, height);
        let value = |x, y| (x + 10 * y + 11 * corner) as f32;
        file.push_plane("Z", &Raster::from_fn(width, height, value));
        file.set("seed", 1);
        file
    }

    fn change(file: &mut ExrFile, index: usize, bits: u32) {
        let Samples::F32(samples) = &mut file.channels[0].samples else {
            panic!("Z holds floats");
        };
        samples[index] = f32::from_bits(samples[index].to_bits() ^ bits);
    }

    #[test]
    fn the_sign_of_zero_is_a_difference() {
        let mut made = file(1, 1, 0);
        let found = made.clone();
        change(&mut made, 0, 1 << 31);
        assert!(find_difference(&found, Tile::whole(1, 1), &made).is_some());
    }

    #[test]
    fn other_channels_and_sizes_are_differences() {
        let made = file(2, 2, 1);
        let found = file(4, 3, 0);
        assert_eq!(find_difference(&found, TILE, &made), None);
        let mut other = found.clone();
        other.push_plane("more", &Raster::filled(4, 3, 0.0));
        let text = find_difference(&other, TILE, &made).unwrap();
        assert!(text.contains("it has the channel more"), "{text}");
        let text = find_difference(&made, TILE, &made).unwrap();
        assert!(text.contains("2x2 pixels"), "{text}");
    }
}
