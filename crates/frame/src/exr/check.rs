//! Checks of OpenEXR files that this program wrote.

use super::file::{ExrFile, Samples};
use crate::FileError;

impl ExrFile {
    /// Refuses a file of another kind, or whose content is not what was written.
    pub fn expect_kind(&self, kind: &str) -> Result<(), FileError> {
        match self.attributes.get("kind").map(String::as_str) {
            Some(found) if found == kind => {
                self.expect_checksum()?;
                self.expect_no_padding()?;
                self.expect_finite()
            }
            Some(found) => Err(self.foreign(format!("is a {found}; a {kind} is needed"))),
            None => Err(self.foreign(format!(
                "was not written by shuttertruth (no attribute \"kind\"); a {kind} is needed: make one with \
                 `shuttertruth truths render`"
            ))),
        }
    }

    /// Refuses a file whose pixels are a part of its display window, or extend beyond it.
    pub fn expect_no_padding(&self) -> Result<(), FileError> {
        match &self.padding {
            None => Ok(()),
            Some(padding) => Err(self.foreign(format!(
                "{padding}; both must be one: write the picture without cropping or padding"
            ))),
        }
    }

    /// Refuses a channel that holds infinity or NaN.
    pub fn expect_finite(&self) -> Result<(), FileError> {
        for channel in &self.channels {
            let Samples::F32(samples) = &channel.samples else {
                continue;
            };
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
}
