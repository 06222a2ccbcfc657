//! Checksum of a file's content, which tells a bit that flipped on a disk.

use std::collections::BTreeMap;

use super::file::{Channel, ExrFile, Samples};
use crate::FileError;

/// Name of the attribute that holds the checksum.
pub(crate) const CHECKSUM: &str = "checksum";

impl ExrFile {
    /// Computes the BLAKE3 hash of size, attributes and channels in any order, without the attribute that holds it.
    pub(crate) fn compute_checksum(&self) -> String {
        let mut hasher = blake3::Hasher::new();
        hasher.update(&self.width.to_le_bytes());
        hasher.update(&self.height.to_le_bytes());
        let attributes = self.attributes.iter();
        for (name, value) in attributes.filter(|(name, _)| *name != CHECKSUM) {
            update_with_text(&mut hasher, name);
            update_with_text(&mut hasher, value);
        }
        let channels: BTreeMap<&str, &Channel> = (self.channels.iter())
            .map(|channel| (channel.name.as_str(), channel))
            .collect();
        for (name, channel) in channels {
            update_with_text(&mut hasher, name);
            update_with_samples(&mut hasher, &channel.samples);
        }
        hasher.finalize().to_hex().to_string()
    }

    /// Refuses content that is not what was written.
    pub(crate) fn expect_checksum(&self) -> Result<(), FileError> {
        let found: String = self.get(CHECKSUM)?;
        if found == self.compute_checksum() {
            return Ok(());
        }
        Err(self.foreign(
            "its checksum is not that of its content: the file was altered or damaged; delete it and render it again"
                .to_owned(),
        ))
    }
}

/// Adds a text with its length, so that two texts never read as one.
fn update_with_text(hasher: &mut blake3::Hasher, text: &str) {
    hasher.update(&(text.len() as u64).to_le_bytes());
    hasher.update(text.as_bytes());
}

fn update_with_samples(hasher: &mut blake3::Hasher, samples: &Samples) {
    // Rows at a time: one call per sample would take as long as encoding the file.
    const CHUNK: usize = 4096;
    let mut bytes = Vec::with_capacity(4 * CHUNK);
    let mut update = |words: &mut dyn Iterator<Item = u32>| {
        bytes.clear();
        bytes.extend(words.flat_map(u32::to_le_bytes));
        hasher.update(&bytes);
    };
    match samples {
        Samples::F32(samples) => {
            for chunk in samples.chunks(CHUNK) {
                update(&mut chunk.iter().map(|sample| sample.to_bits()));
            }
        }
        Samples::U32(samples) => {
            for chunk in samples.chunks(CHUNK) {
                update(&mut chunk.iter().copied());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Raster, read_exr, write_exr};

    fn file() -> ExrFile {
        let mut file = ExrFile::new(3, 2);
        file.push_plane("Z", &Raster::from_fn(3, 2, |x, y| (x + 3 * y) as f32));
        file.set("kind", "frame");
        file.set("seed", 1);
        file
    }

    #[test]
    fn a_flipped_bit_in_a_channel_or_an_attribute_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("frame.exr");
        write_exr(&path, &file()).unwrap();
        let read = read_exr(&path).unwrap();
        read.expect_kind("frame").unwrap();

        let mut flipped = read.clone();
        let Samples::F32(samples) = &mut flipped.channels[0].samples else {
            panic!("Z holds floats");
        };
        samples[4] = f32::from_bits(samples[4].to_bits() ^ 1);
        let mut renamed = read.clone();
        renamed.set("seed", 2);
        let mut bare = read.clone();
        bare.attributes.remove(CHECKSUM);
        for (name, file) in [("flipped", flipped), ("renamed", renamed), ("bare", bare)] {
            let error = file.expect_kind("frame").unwrap_err().to_string();
            assert!(error.contains(CHECKSUM), "{name}: {error}");
        }
    }
}
