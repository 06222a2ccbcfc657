//! Runs a filter: uploads the frame, dispatches the passes, reads the image back.

use frame::{Image, Raster};

use super::adapter::Gpu;
use super::kernels::Kernels;
use super::plan::{MARK, Plan, Step};
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
            outputs.push(self.blur(|step| first || step.depends_on_color)?);
        }
        self.check_loops()?;
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
            outputs.push(self.blur(|step| first || step.depends_on_color)?);
        }
        self.check_loops()?;
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
            outputs.push(self.blur(|step| first || step.depends_on_noise)?);
        }
        self.check_loops()?;
        Ok(Some(outputs))
    }

    /// Runs the passes that are due on what has been uploaded, and reads the output.
    fn blur(&self, due: impl Fn(&Step) -> bool) -> Result<Image, FilterError> {
        let place = self.place("upload");
        self.gpu
            .guarded(place, || self.plan.mark_output(self.gpu, &due))?;
        for step in self.plan.steps.iter().filter(|step| due(step)) {
            self.dispatch(step)?;
        }
        self.output().or_else(|error| {
            // A loop that was ended early is the cause, and a broken pixel its effect.
            self.check_loops()?;
            Err(error)
        })
    }

    /// The output, where every pixel was written and is finite.
    fn output(&self) -> Result<Image, FilterError> {
        let target = self.plan.target("output");
        let output = self.gpu.download(target, self.place("read back"))?;
        let broken = |texel: &[f32; 4]| texel[..3].iter().any(|value| !value.is_finite());
        match output.pixels.iter().position(broken) {
            None => Ok(output.map(|[r, g, b, _]| [*r, *g, *b])),
            Some(index) => Err(self.refuse_pixel(index as u32, output.pixels[index])),
        }
    }

    fn refuse_pixel(&self, index: u32, texel: [f32; 4]) -> FilterError {
        let [width, height] = self.size;
        let (x, y) = (index % width, index / width);
        let mut writers = self.plan.steps.iter().filter(|step| step.writes_output);
        let writer = writers.next_back();
        let place = self.place(writer.map_or("output", |step| &step.entry));
        if texel[..3].iter().any(|value| value.to_bits() == MARK) {
            return place.refuse(format!(
                "leaves pixel ({x}, {y}) of the output unwritten; every pixel of {width}x{height} must be written"
            ));
        }
        let [r, g, b, _] = texel;
        place.refuse(format!(
            "writes [{r}, {g}, {b}] to pixel ({x}, {y}); every value must be finite"
        ))
    }

    /// Refuses loops that the adapter may have ended early.
    fn check_loops(&self) -> Result<(), FilterError> {
        let entry = |dispatch: usize| self.place(&self.plan.steps[dispatch].entry);
        match &self.plan.iterations {
            Some(iterations) => iterations.check(self.gpu, entry),
            None => Ok(()),
        }
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

    /// Runs one pass and waits for it: what takes too long is found by its name.
    fn dispatch(&self, step: &Step) -> Result<(), FilterError> {
        let place = self.place(&step.entry);
        self.gpu.guarded(place, || {
            let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
            step.encode(&mut encoder);
            self.gpu.queue.submit([encoder.finish()]);
        })?;
        self.gpu.wait(place, self.plan.time_limit)
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
