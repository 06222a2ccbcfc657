//! A filter with all scenes on the GPU, so that a candidate costs its blurs and nothing else.

use filters::{Blur, Filter, FilterError, Gpu, Input, Kernels, Resident, Settings};
use frame::{Image, Plane};

use super::shot::Target;
use crate::measure::probes::{pack, unpack};
use crate::{Monitor, Runner};

/// What candidates of one filter run on.
pub enum Engine<'a> {
    /// Kernels, compiled once, and the scenes' inputs.
    Kernels {
        /// For every size and all settings.
        kernels: Box<Kernels<'a>>,
        /// In the order of the scenes.
        inputs: Vec<Resident>,
    },
    /// A program, which reads files.
    Program(Box<Filter>, Monitor),
}

/// A candidate, ready for scenes of one size after another.
pub struct Candidate<'e, 'a> {
    engine: &'e Engine<'a>,
    settings: &'e Settings,
    made: Option<((u32, u32), Runner<'a>)>,
}

/// The blurred colour, and the blurred coverage of each object where it is asked for.
pub type Blurred = (Image, Option<Vec<Plane>>);

impl<'a> Engine<'a> {
    /// Compiles the kernels and uploads the scenes; with their mattes if `bleed` is to be measured.
    pub fn new(
        gpu: Option<&'a Gpu>,
        filter: &Filter,
        targets: &[Target],
        bleed: bool,
        monitor: Monitor,
    ) -> Result<Self, FilterError> {
        if filter.command.is_some() {
            return Ok(Self::Program(Box::new(filter.clone()), monitor));
        }
        let gpu = gpu.expect("an adapter was opened for the kernels");
        let kernels = Kernels::compile(gpu, filter)?;
        let inputs = (targets.iter())
            .map(|target| with_input(target, bleed, |input| kernels.keep(input)))
            .collect::<Result<_, _>>()?;
        Ok(Self::Kernels {
            kernels: Box::new(kernels),
            inputs,
        })
    }

    /// Nothing is made yet.
    pub fn candidate<'e>(&'e self, settings: &'e Settings) -> Candidate<'e, 'a> {
        Candidate {
            engine: self,
            settings,
            made: None,
        }
    }

    fn runner(&self, settings: &Settings, size: (u32, u32)) -> Result<Runner<'a>, FilterError> {
        match self {
            Self::Kernels { kernels, .. } => {
                let blur = Blur::of(kernels, settings, size.0, size.1)?;
                Ok(Runner::Kernels(Box::new(blur)))
            }
            Self::Program(filter, monitor) => Runner::command(filter, settings, size, *monitor),
        }
    }
}

impl Candidate<'_, '_> {
    /// Blurs a scene, given with its index; its mattes too if the engine was made to measure bleed.
    pub fn blur(
        &mut self,
        (scene, target): (usize, &Target),
        bleed: bool,
    ) -> Result<Blurred, FilterError> {
        let frame = &target.shot.frame;
        let size = frame.size();
        let runner = match &mut self.made {
            Some((made, runner)) if *made == size => runner,
            made => {
                &mut made
                    .insert((size, self.engine.runner(self.settings, size)?))
                    .1
            }
        };
        let outputs = match (runner, self.engine) {
            (Runner::Kernels(blur), Engine::Kernels { inputs, .. }) => {
                blur.run_resident(&inputs[scene])?
            }
            (runner, _) => with_input(target, bleed, |input| runner.run(input))?,
        };
        let outputs: Vec<Image> = (outputs.iter())
            .map(|output| output.cropped(frame.guard_band))
            .collect();
        let coverage = bleed.then(|| unpack(&outputs[1..], frame.coverage.len()));
        Ok((outputs[0].clone(), coverage))
    }
}

/// Hands over the scene's frame; behind its colour the mattes, if they are to be blurred.
fn with_input<T>(target: &Target, bleed: bool, use_it: impl FnOnce(&Input) -> T) -> T {
    let frame = &target.shot.frame;
    let mattes = match bleed {
        true => pack(&frame.coverage),
        false => Vec::new(),
    };
    let color: Vec<&Image> = std::iter::once(&frame.color).chain(&mattes).collect();
    use_it(&Input {
        color: &color,
        velocity: &frame.velocity,
        depth: &frame.depth,
        reprojection: Some(frame.reprojection.moved(f64::from(frame.guard_band))),
        exposure: frame.exposure,
        frame_index: 0,
    })
}
