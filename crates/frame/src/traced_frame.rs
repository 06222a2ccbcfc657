//! A frame with its noise: the independent renders that its colour and coverage are the mean of.

use std::path::Path;

use crate::exr::{ExrFile, read_exr, write_small_exr};
use crate::{FileError, Frame, Picture};

/// Attribute of a frame's file with the number of its replicates.
const REPLICATES: &str = "frame_replicates";

/// A frame with its noise.
#[derive(Clone, Debug, PartialEq)]
pub struct TracedFrame {
    /// The frame.
    pub frame: Frame,
    /// Independent, complete renders of its colour and coverage, which are their mean. Nothing else
    /// in a frame has noise.
    pub replicates: Vec<Picture>,
}

impl TracedFrame {
    /// Writes the frame as [`Frame::write`] does, and each replicate as a layer: `replicate_0.R`,
    /// `replicate_0.coverage.<object>`.
    pub fn write(&self, path: &Path) -> Result<(), FileError> {
        write_small_exr(path, self.to_exr())
    }

    /// Makes the content of the file that [`TracedFrame::write`] writes.
    pub fn to_exr(&self) -> ExrFile {
        let mut file = self.frame.to_exr();
        for (index, replicate) in self.replicates.iter().enumerate() {
            replicate.push(&mut file, &layer(index), &self.frame.objects);
        }
        file.set(REPLICATES, self.replicates.len());
        file
    }
}

/// Reads the replicates of a frame's file; none if another program made it, or if it was written
/// without them.
pub fn read_frame_replicates(path: &Path) -> Result<Vec<Picture>, FileError> {
    let mut file = read_exr(path)?;
    file.expect_kind("frame")?;
    if !file.attributes.contains_key(REPLICATES) {
        return Ok(Vec::new());
    }
    let (objects, count): (_, usize) = (file.objects()?, file.get(REPLICATES)?);
    (0..count)
        .map(|index| Picture::take_from(&mut file, &layer(index), &objects))
        .collect()
}

fn layer(index: usize) -> String {
    format!("replicate_{index}")
}
