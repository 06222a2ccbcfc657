//! Checks of OpenEXR files that this program wrote, and the checksum of their content, which shows
//! a bit that flipped on a disk.

use std::collections::BTreeMap;

use super::file::{Channel, ExrFile, Samples};
use crate::FileError;

/// Name of the attribute that holds the checksum.
pub(crate) const CHECKSUM: &str = "checksum";

impl ExrFile {
    /// Refuses a file of another kind, or with altered content.
    pub fn expect_kind(&self, kind: &str) -> Result<(), FileError> {
        match self.attributes.get("kind").map(String::as_str) {
            Some(file_kind) if file_kind == kind => {
                self.expect_checksum()?;
                self.expect_plain_pixels()?;
                self.expect_finite()
            }
            Some(file_kind) => Err(self.foreign(format!("is a {file_kind}; a {kind} is needed"))),
            None => Err(self.foreign(format!(
                "was not written by shuttertruth (no attribute \"kind\"); a {kind} is needed: make one with \
                 `shuttertruth truths render`"
            ))),
        }
    }

    /// Refuses a file whose pixels are a part of its display window, or extend beyond it, or are
    /// not square.
    pub fn expect_plain_pixels(&self) -> Result<(), FileError> {
        match &self.odd_pixels {
            None => Ok(()),
            Some(reason) => Err(self.foreign(reason.clone())),
        }
    }

    /// Refuses colours if the file's attribute `colorInteropID` calls them other than linear, or
    /// names their primaries without stating them.
    pub(super) fn expect_linear(&self) -> Result<(), FileError> {
        const NAME: &str = "colorInteropID";
        let Some(space) = self.attributes.get(NAME) else {
            return Ok(());
        };
        let is_known = match self.meaning.note() {
            Some(_) => space.starts_with("lin_"),
            None => ["lin_rec709_scene", "data", "unknown"].contains(&space.as_str()),
        };
        if is_known {
            return Ok(());
        }
        Err(self.foreign(format!(
            "states {NAME} = \"{space}\"; allowed: lin_rec709_scene, or other linear colours with the attribute chromaticities; \
             save the picture in linear Rec.709"
        )))
    }

    /// Refuses a channel that holds infinity or NaN.
    pub fn expect_finite(&self) -> Result<(), FileError> {
        for channel in &self.channels {
            let Samples::F32(samples) = &channel.samples else {
                continue;
            };
            // Without an early end, this is a few instructions for many values.
            if (samples.iter()).fold(true, |finite, value| finite & value.is_finite()) {
                continue;
            }
            if let Some(at) = samples.iter().position(|value| !value.is_finite()) {
                let (x, y) = (at % self.width as usize, at / self.width as usize);
                return Err(self.foreign(format!(
                    "channel \"{}\" holds {} at pixel ({x}, {y}); every value must be finite: render it again",
                    channel.name, samples[at]
                )));
            }
        }
        Ok(())
    }

    /// Computes the BLAKE3 hash of size, attributes and channels in any order, without the
    /// attribute that holds it.
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

    /// Refuses altered content.
    fn expect_checksum(&self) -> Result<(), FileError> {
        let checksum: String = self.get(CHECKSUM)?;
        if checksum == self.compute_checksum() {
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

/// Adds samples, the lowest byte of each first, as they lie in memory.
fn update_with_samples(hasher: &mut blake3::Hasher, samples: &Samples) {
    let bytes = match samples {
        Samples::F32(samples) => bytemuck::cast_slice(samples),
        Samples::U32(samples) => bytemuck::cast_slice(samples),
    };
    hasher.update_rayon(bytes);
}
