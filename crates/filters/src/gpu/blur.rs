//! Runs a filter: uploads the frame, dispatches the passes, reads the image back.

use frame::{Image, Raster};

use super::adapter::Gpu;
use super::kernels::Kernels;
use super::plan::{Plan, Step};
use super::resident::Resident;
use super::transfer::{Place, padded_row, texels};
use super::uniforms::FrameUniform;
use crate::{Filter, FilterError, Format, Input, Settings};

/// A filter ready to run on images of one size.
#[derive(Debug)]
pub struct Blur<'g> {
    pub(super) gpu: &'g Gpu,
    filter: String,
    size: [u32; 2],
    reads_reprojection: bool,
    pub(super) plan: Plan,
}

impl<'g> Blur<'g> {
    /// Compiles the kernels and makes the textures for one filter, its settings and a size in pixels.
    pub fn new(
        gpu: &'g Gpu,
        filter: &Filter,
        settings: &Settings,
        width: u32,
        height: u32,
    ) -> Result<Self, FilterError> {
        // A size that cannot be is refused before anything is compiled.
        check_size(gpu, filter, width, height)?;
        Self::of(&Kernels::compile(gpu, filter)?, settings, width, height)
    }

    /// Makes the textures for kernels that are compiled already, for other settings or another size than before.
    pub fn of(
        kernels: &Kernels<'g>,
        settings: &Settings,
        width: u32,
        height: u32,
    ) -> Result<Self, FilterError> {
        let Kernels { gpu, filter, .. } = kernels;
        settings.check(filter)?;
        check_size(gpu, filter, width, height)?;
        Ok(Self {
            gpu,
            filter: filter.name.clone(),
            size: [width, height],
            reads_reprojection: filter.shader.reads_reprojection,
            plan: Plan::new(kernels, settings, [width, height])?,
        })
    }

    /// Refuses an input that the filter cannot read.
    pub(super) fn check(&self, input: &Input) -> Result<(), FilterError> {
        input.check(&self.filter, self.size, self.reads_reprojection)
    }

    /// Blurs every colour image of the input, in order. The same input gives the same bytes on the same adapter.
    pub fn run(&mut self, input: &Input) -> Result<Vec<Image>, FilterError> {
        self.check(input)?;
        self.upload(input)?;
        let mut outputs = Vec::new();
        for color in input.color {
            self.upload_color(color)?;
            // What does not depend on colour is still there from the first image.
            let first = outputs.is_empty();
            self.dispatch(|step| first || step.depends_on_color)?;
            outputs.push(self.output()?);
        }
        Ok(outputs)
    }

    /// As [`Blur::run`], on an input that is on the GPU already.
    pub fn run_resident(&mut self, input: &Resident) -> Result<Vec<Image>, FilterError> {
        assert_eq!(
            (&self.filter, self.size),
            (&input.filter, input.size),
            "an input stays on the GPU for one filter and size"
        );
        let place = self.place("upload");
        self.gpu.guarded(place, || {
            self.plan.upload_frame(self.gpu, input.frame);
            self.gpu.copy(&input.velocity, self.plan.target("velocity"));
            self.gpu.copy(&input.depth, self.plan.target("depth"));
        })?;
        let mut outputs = Vec::new();
        for color in &input.color {
            self.gpu
                .guarded(place, || self.gpu.copy(color, self.plan.target("color")))?;
            let first = outputs.is_empty();
            self.dispatch(|step| first || step.depends_on_color)?;
            outputs.push(self.output()?);
        }
        Ok(outputs)
    }

    /// Blurs the first colour image of the input once per index of a frame, as [`Blur::run`] would with each of them. None where
    /// the index changes nothing.
    pub fn run_noise(
        &mut self,
        input: &Input,
        frame_indices: impl IntoIterator<Item = u32>,
    ) -> Result<Option<Vec<Image>>, FilterError> {
        if !self.plan.steps.iter().any(|step| step.depends_on_noise) {
            return Ok(None);
        }
        self.check(input)?;
        let color = input.color.first().expect("there is a colour to blur");
        self.upload_color(color)?;
        let mut outputs = Vec::new();
        for frame_index in frame_indices {
            self.upload(&Input {
                frame_index,
                ..*input
            })?;
            let first = outputs.is_empty();
            self.dispatch(|step| first || step.depends_on_noise)?;
            outputs.push(self.output()?);
        }
        Ok(Some(outputs))
    }

    fn output(&self) -> Result<Image, FilterError> {
        let target = self.plan.target("output");
        let output = self.gpu.download(target, self.place("read back"))?;
        Ok(output.map(|[r, g, b, _]| [*r, *g, *b]))
    }

    /// What the last run left in a texture between the passes; components that its format lacks are 0, and a whole
    /// number is the float of the same bits. For tests and for looking inside. Panics where the filter has no such texture.
    pub fn texture(&self, name: &str) -> Result<Raster<[f32; 4]>, FilterError> {
        let target = self.plan.target(name);
        self.gpu.download(target, self.place("read back"))
    }

    pub(super) fn place<'a>(&'a self, pass: &'a str) -> Place<'a> {
        Place {
            filter: &self.filter,
            pass,
        }
    }

    pub(super) fn upload(&self, input: &Input) -> Result<(), FilterError> {
        self.gpu.guarded(self.place("upload"), || {
            let velocity = bytemuck::cast_slice(&input.velocity.pixels);
            self.gpu.upload(self.plan.target("velocity"), velocity);
            self.gpu
                .upload(self.plan.target("depth"), &input.depth.pixels);
            self.plan.upload_frame(self.gpu, FrameUniform::of(input));
        })
    }

    pub(super) fn upload_color(&self, color: &Image) -> Result<(), FilterError> {
        self.gpu.guarded(self.place("upload"), || {
            self.gpu.upload(self.plan.target("color"), &texels(color));
        })
    }

    fn dispatch(&self, due: impl Fn(&Step) -> bool) -> Result<(), FilterError> {
        for step in self.plan.steps.iter().filter(|step| due(step)) {
            self.gpu.guarded(self.place(&step.entry), || {
                let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
                step.encode(&mut encoder);
                self.gpu.queue.submit([encoder.finish()]);
            })?;
        }
        Ok(())
    }
}

fn check_size(gpu: &Gpu, filter: &Filter, width: u32, height: u32) -> Result<(), FilterError> {
    let limits = gpu.device.limits();
    let side = limits.max_texture_dimension_2d;
    let image = padded_row(width, Format::Rgba32Float) * u64::from(height);
    let reason = if width == 0 || height == 0 {
        "allowed: at least 1x1".to_owned()
    } else if width > side || height > side {
        format!(
            "adapter \"{}\" allows {side} on a side; render a smaller frame or choose another adapter",
            gpu.adapter.name
        )
    } else if image > limits.max_buffer_size {
        format!(
            "it takes {image} bytes, and adapter \"{}\" allows {} in one buffer; render a smaller frame or choose \
             another adapter",
            gpu.adapter.name, limits.max_buffer_size
        )
    } else {
        return Ok(());
    };
    Err(FilterError::Size {
        filter: filter.name.clone(),
        width,
        height,
        reason,
    })
}
