//! Runner of a filter, made of kernels or a program.

use filters::{Blur, CommandBlur, Filter, FilterError, Gpu, Input, Limits, Settings};
use frame::Image;

use crate::Monitor;
use crate::filter_choice::FilterChoice;

/// A filter with its parameters, for images of one size.
pub enum Runner<'g> {
    /// Kernels on an adapter.
    Kernels(Box<Blur<'g>>),
    /// A program.
    Command(Box<CommandBlur>),
}

/// Opens the adapter that the filters are to run on; none where all of them are commands and none was asked for by name. Refuses
/// a filter with kernels that the adapter cannot hold.
pub fn open_gpu(
    choices: &[FilterChoice],
    adapter: Option<&str>,
    monitor: Monitor,
) -> Result<Option<Gpu>, FilterError> {
    if adapter.is_none() && choices.iter().all(|own| own.filter.command.is_some()) {
        return Ok(None);
    }
    let gpu = open_adapter(adapter, monitor)?;
    let limits = Limits::of(&gpu);
    for choice in choices {
        limits.check(&choice.filter)?;
    }
    Ok(Some(gpu))
}

/// Opens an adapter whose work ends where the monitor interrupts it.
pub fn open_adapter(adapter: Option<&str>, monitor: Monitor) -> Result<Gpu, FilterError> {
    let mut gpu = Gpu::new(adapter)?;
    gpu.interrupted = monitor.interrupted;
    Ok(gpu)
}

impl<'g> Runner<'g> {
    /// Makes a filter ready; `gpu` is what [`open_gpu`] opened for it.
    pub fn new(
        gpu: Option<&'g Gpu>,
        choice: &FilterChoice,
        (width, height): (u32, u32),
        monitor: Monitor,
    ) -> Result<Self, FilterError> {
        let (filter, settings) = (&choice.filter, &choice.settings);
        if filter.command.is_some() {
            return Self::command(filter, settings, (width, height), monitor);
        }
        let gpu = gpu.expect("an adapter was opened for the kernels");
        let blur = Blur::new(gpu, filter, settings, width, height)?;
        Ok(Self::Kernels(Box::new(blur)))
    }

    /// Makes a filter ready whose colours are rounded nowhere that the suite chooses the format, for numbers that are no colours; none
    /// where [`Runner::new`] makes that already, and where the adapter cannot.
    pub fn with_wide_colors(
        gpu: Option<&'g Gpu>,
        choice: &FilterChoice,
        (width, height): (u32, u32),
    ) -> Option<Self> {
        let (gpu, wide) = (gpu?, choice.filter.widen_colors()?);
        let blur = Blur::new(gpu, &wide, &choice.settings, width, height);
        Some(Self::Kernels(Box::new(blur.ok()?)))
    }

    /// Makes a program ready.
    pub fn command(
        filter: &Filter,
        settings: &Settings,
        (width, height): (u32, u32),
        monitor: Monitor,
    ) -> Result<Self, FilterError> {
        let blur = CommandBlur::new(filter, settings, width, height, monitor.interrupted)?;
        Ok(Self::Command(Box::new(blur)))
    }

    /// Blurs the first colour image of the input once per frame index; none where the index changes nothing. A program shows that
    /// by its second picture.
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

    /// Blurs every colour image of the input with the same weights, in order. Kernels with history read the frame before.
    pub fn run_after(&mut self, input: &Input, before: &Input) -> Result<Vec<Image>, FilterError> {
        match self {
            Self::Kernels(blur) => blur.run_after(input, before),
            Self::Command(blur) => blur.run(input),
        }
    }

    /// Blurs every colour image of the input with the same weights, in order; the frame before is the input itself.
    pub fn run(&mut self, input: &Input) -> Result<Vec<Image>, FilterError> {
        self.run_after(input, input)
    }
}
