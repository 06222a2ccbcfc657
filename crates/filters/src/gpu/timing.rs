//! Times and memory traffic of a filter's passes.

use super::blur::Blur;
use crate::{FilterError, Input};

/// A blur with its input on the GPU, ready to be timed again and again.
#[derive(Debug)]
pub struct Loaded<'b, 'g> {
    blur: &'b Blur<'g>,
}

/// One dispatch of a pass.
#[derive(Clone, Debug, PartialEq)]
pub struct PassTime {
    /// Entry point of the kernel.
    pub entry: String,
    /// How long it took.
    pub seconds: f64,
    /// Of the textures that it reads and of those that it writes, each counted once and whole, however often a kernel
    /// fetches from it: the least that has to come from memory and to go there.
    pub bytes: u64,
}

impl<'g> Blur<'g> {
    /// Uploads an input and its first colour image.
    pub fn load(&mut self, input: &Input) -> Result<Loaded<'_, 'g>, FilterError> {
        self.check(input)?;
        self.upload(input)?;
        let color = input.color.first().expect("there is a colour to blur");
        self.upload_color(color)?;
        Ok(Loaded { blur: self })
    }
}

impl Loaded<'_, '_> {
    /// Runs every pass once. The time is that of the kernels: nothing is uploaded or read back.
    pub fn time(&self) -> Result<Vec<PassTime>, FilterError> {
        let Blur { gpu, plan, .. } = self.blur;
        let seconds = gpu.time(
            self.blur.place("timing"),
            plan.steps.len(),
            |index, encoder| {
                plan.steps[index].encode(encoder);
            },
        )?;
        let timed = plan.steps.iter().zip(seconds);
        Ok(timed
            .map(|(step, seconds)| PassTime {
                entry: step.entry.clone(),
                seconds,
                bytes: step.bytes,
            })
            .collect())
    }
}
