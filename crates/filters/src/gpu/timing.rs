//! Times and memory traffic of a filter's passes.

use super::blur::Blur;
use crate::{FilterError, Input};

/// A blur with its input on the GPU, ready to be timed.
#[derive(Debug)]
pub struct LoadedBlur<'b, 'g> {
    blur: &'b Blur<'g>,
}

/// Time of one dispatch of a pass.
#[derive(Clone, Debug, PartialEq)]
pub struct PassTime {
    /// Entry point of the kernel.
    pub entry: String,
    /// Duration in seconds.
    pub seconds: f64,
    /// Bytes of the textures that it reads and of those that it writes, each counted once and
    /// whole, however often a kernel fetches from it: the least traffic with memory.
    pub bytes: u64,
}

impl<'g> Blur<'g> {
    /// Uploads an input and its first colour image, for timing.
    pub fn load(&mut self, input: &Input) -> Result<LoadedBlur<'_, 'g>, FilterError> {
        self.upload_first(input)?;
        Ok(LoadedBlur { blur: self })
    }
}

impl LoadedBlur<'_, '_> {
    /// Runs every pass once, and times its kernels alone: nothing is uploaded or read back.
    pub fn time(&self) -> Result<Vec<PassTime>, FilterError> {
        let Blur { gpu, passes, .. } = self.blur;
        let seconds = gpu.time(
            self.blur.place("timing"),
            passes.dispatches.len(),
            |index, encoder| {
                passes.dispatches[index].encode(encoder);
            },
        )?;
        let timed = passes.dispatches.iter().zip(seconds);
        Ok(timed
            .map(|(dispatch, seconds)| PassTime {
                entry: dispatch.entry.clone(),
                seconds,
                bytes: dispatch.bytes,
            })
            .collect())
    }
}
