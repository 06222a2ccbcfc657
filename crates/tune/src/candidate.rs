//! Candidate of a tuning, ready to blur one scene after another.

use filters::{Blur, Filter, FilterError, Gpu, Input, Kernels, Settings, UploadedInput};
use frame::{Frame, Image, Plane};
use suite::{Monitor, Runner, filter_input, pack_planes, unpack_planes};

use crate::target::RenderedScene;

/// A filter's kernels and the inputs of all scenes, on the GPU: every candidate uses them, and so costs its blurs alone.
pub struct SharedKernels<'a> {
    /// Compiled for every size and all settings.
    kernels: Kernels<'a>,
    /// Inputs in the order of the scenes.
    inputs: Vec<UploadedInput>,
}

impl<'a> SharedKernels<'a> {
    /// Compiles the kernels and uploads the scenes; with their mattes if `bleed` is to be measured.
    pub fn compile(
        gpu: &'a Gpu,
        filter: &Filter,
        scenes: &[RenderedScene],
        bleed: bool,
    ) -> Result<Self, FilterError> {
        let kernels = Kernels::compile(gpu, filter)?;
        let inputs = (scenes.iter())
            .map(|scene| with_input(&scene.frame, bleed, |input| kernels.upload(input)))
            .collect::<Result<_, _>>()?;
        Ok(Self { kernels, inputs })
    }
}

/// A filter with settings to try, ready for the pictures of all scenes.
pub struct Candidate<'e, 'a> {
    runner: Runner<'a>,
    shared: Option<&'e SharedKernels<'a>>,
}

/// The blurred colour, and the blurred coverage of each object if it was asked for.
pub type Blurred = (Image, Option<Vec<Plane>>);

impl<'e, 'a> Candidate<'e, 'a> {
    /// Makes a candidate for pictures of one size. `shared` are the filter's kernels, none if it is a program, which the monitor can
    /// end.
    pub fn new(
        filter: &Filter,
        settings: &Settings,
        shared: Option<&'e SharedKernels<'a>>,
        size: (u32, u32),
        monitor: Monitor,
    ) -> Result<Self, FilterError> {
        let runner = match shared {
            Some(SharedKernels { kernels, .. }) => {
                let blur = Blur::with_kernels(kernels, settings, size.0, size.1)?;
                Runner::Kernels(Box::new(blur))
            }
            None => Runner::command(filter, settings, size, monitor)?,
        };
        Ok(Self { runner, shared })
    }

    /// Blurs the frame of a scene, given by its index; its mattes too if `bleed` is to be measured.
    pub fn blur(
        &mut self,
        scene: usize,
        frame: &Frame,
        bleed: bool,
    ) -> Result<Blurred, FilterError> {
        let outputs = match (&mut self.runner, self.shared) {
            (Runner::Kernels(blur), Some(shared)) => blur.run_uploaded(&shared.inputs[scene])?,
            (runner, _) => with_input(frame, bleed, |input| runner.run(input))?,
        };
        let mut outputs = outputs
            .iter()
            .map(|output| output.cropped(frame.guard_band));
        let color = outputs.next().expect("a filter blurs the colour");
        let mattes: Vec<Image> = outputs.collect();
        let coverage = bleed.then(|| unpack_planes(&mattes, frame.coverage.len()));
        Ok((color, coverage))
    }
}

/// Calls `run` with a frame: its colour, and after it the mattes, if they are to be blurred.
fn with_input<T>(frame: &Frame, bleed: bool, run: impl FnOnce(&Input) -> T) -> T {
    let mattes = match bleed {
        true => pack_planes(&frame.coverage),
        false => Vec::new(),
    };
    let color: Vec<&Image> = std::iter::once(&frame.color).chain(&mattes).collect();
    run(&filter_input(frame, &color))
}
