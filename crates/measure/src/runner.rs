//! Runner of a filter that consists of kernels or a program.

use filters::{Blur, CommandBlur, Filter, FilterError, Gpu, Input, Limits, Settings};
use frame::{Image, Size};

use crate::Monitor;
use crate::filter_choice::FilterChoice;

/// A filter with its parameters, for images of one size.
pub enum Runner<'g> {
    /// Kernels on an adapter.
    Kernels(Box<Blur<'g>>),
    /// A program.
    Command(Box<CommandBlur>),
}

/// Opens the adapter for the filters; none if all of them are commands and none was requested by
/// name. Refuses a filter with kernels that exceed the adapter's limits.
pub fn open_gpu(
    choices: &[FilterChoice],
    adapter: Option<&str>,
    monitor: Monitor,
) -> Result<Option<Gpu>, FilterError> {
    if adapter.is_none() && choices.iter().all(|choice| choice.filter.command.is_some()) {
        return Ok(None);
    }
    let gpu = open_adapter(adapter, monitor)?;
    let limits = Limits::of(&gpu);
    for choice in choices {
        limits.check(&choice.filter)?;
    }
    Ok(Some(gpu))
}

/// Opens an adapter whose work ends if the monitor interrupts it.
pub fn open_adapter(adapter: Option<&str>, monitor: Monitor) -> Result<Gpu, FilterError> {
    let mut gpu = Gpu::new(adapter)?;
    gpu.interrupted = monitor.interrupted;
    Ok(gpu)
}

impl<'g> Runner<'g> {
    /// Prepares a filter; `gpu` is what [`open_gpu`] opened for it.
    pub fn new(
        gpu: Option<&'g Gpu>,
        choice: &FilterChoice,
        size: Size,
    ) -> Result<Self, FilterError> {
        let (filter, settings) = (&choice.filter, &choice.settings);
        if filter.command.is_some() {
            return Self::command(filter, settings, size);
        }
        let gpu = gpu.expect("an adapter was opened for the kernels");
        let blur = Blur::new(gpu, filter, settings, size.width, size.height)?;
        Ok(Self::Kernels(Box::new(blur)))
    }

    /// Prepares a filter with colours that the suite never rounds, for numbers that are not
    /// colours; none if [`Runner::new`] already does that, or if the adapter cannot.
    pub fn with_wide_colors(
        gpu: Option<&'g Gpu>,
        choice: &FilterChoice,
        size: Size,
    ) -> Option<Self> {
        let (gpu, wide) = (gpu?, choice.filter.widen_colors()?);
        let blur = Blur::new(gpu, &wide, &choice.settings, size.width, size.height);
        Some(Self::Kernels(Box::new(blur.ok()?)))
    }

    /// Prepares a program.
    pub fn command(filter: &Filter, settings: &Settings, size: Size) -> Result<Self, FilterError> {
        let blur = CommandBlur::new(filter, settings, size.width, size.height)?;
        Ok(Self::Command(Box::new(blur)))
    }

    /// Blurs the first colour image of the input once per frame index; none if the index changes
    /// nothing, which a program shows by its second picture.
    pub fn run_noise(
        &mut self,
        input: &Input,
        frame_indices: impl Iterator<Item = u32>,
    ) -> Result<Option<Vec<Image>>, FilterError> {
        match self {
            Self::Kernels(blur) => blur.run_noise(input, frame_indices),
            Self::Command(blur) => {
                let mut outputs: Vec<Image> = Vec::new();
                for frame_index in frame_indices {
                    outputs.extend(blur.run(&Input {
                        color: &input.color[..1],
                        frame_index,
                        ..*input
                    })?);
                    if outputs.len() == 2 && outputs[0] == outputs[1] {
                        return Ok(None);
                    }
                }
                Ok(Some(outputs))
            }
        }
    }

    /// Blurs every colour image of the input with the same weights, in order. Kernels with history
    /// read the previous frame.
    pub fn run_after(&mut self, input: &Input, before: &Input) -> Result<Vec<Image>, FilterError> {
        match self {
            Self::Kernels(blur) => blur.run_after(input, before),
            Self::Command(blur) => blur.run(input),
        }
    }

    /// Blurs further colour images of the last run's input, which differed in nothing else, before
    /// as now.
    pub fn run_further(
        &mut self,
        input: &Input,
        before: &Input,
    ) -> Result<Vec<Image>, FilterError> {
        match self {
            Self::Kernels(blur) => blur.run_further(input, before),
            Self::Command(blur) => blur.run(input),
        }
    }

    /// Blurs every colour image of the input with the same weights, in order; the previous frame is
    /// the input itself.
    pub fn run(&mut self, input: &Input) -> Result<Vec<Image>, FilterError> {
        self.run_after(input, input)
    }
}
