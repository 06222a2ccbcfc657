//! Run of a filter on the GPU: uploads the frame, dispatches the passes, reads the image back.

use std::sync::Arc;

use frame::{Image, Raster};
use wgpu::naga::ScalarKind;

use super::bound_passes::{BoundPasses, mark_of};
use super::device::Gpu;
use super::dispatch::Dispatch;
use super::kernels::{Kernels, Specialised};
use super::place::Place;
use super::transfer::{row_bytes, velocity_texels};
use super::uniforms::FrameValues;
use crate::filter::{CameraUse, History, Layer, Origin};
use crate::input::find_broken;
use crate::{Filter, FilterError, Format, Input, Settings};

/// A filter ready to run on images of one size.
#[derive(Debug)]
pub struct Blur<'g> {
    pub(super) gpu: &'g Gpu,
    size: [u32; 2],
    kernels: Arc<Specialised>,
    camera: CameraUse,
    pub(super) passes: BoundPasses,
}

impl<'g> Blur<'g> {
    /// Compiles the kernels and makes the textures for one filter, its settings and a size in
    /// pixels.
    pub fn new(
        gpu: &'g Gpu,
        filter: &Filter,
        settings: &Settings,
        width: u32,
        height: u32,
    ) -> Result<Self, FilterError> {
        // An impossible size is refused before anything is compiled.
        check_size(gpu, filter, width, height)?;
        Self::with_kernels(&Kernels::compile(gpu, filter)?, settings, width, height)
    }

    /// Makes the textures for compiled kernels, with other settings or another size than before.
    pub fn with_kernels(
        kernels: &Kernels<'g>,
        settings: &Settings,
        width: u32,
        height: u32,
    ) -> Result<Self, FilterError> {
        let gpu = kernels.gpu;
        settings.check(&kernels.filter)?;
        check_size(gpu, &kernels.filter, width, height)?;
        let camera = kernels.filter.camera_use(settings);
        let kernels = kernels.specialise(settings)?;
        let size = [width, height];
        Ok(Self {
            gpu,
            size,
            camera,
            passes: BoundPasses::new(gpu, &kernels, settings, size)?,
            kernels,
        })
    }

    fn filter(&self) -> &Filter {
        &self.kernels.filter
    }

    /// Blurs every colour image of the input, in order. The same input gives the same bytes on the
    /// same adapter. For filters with history the frame before is the input itself, as at the
    /// beginning of a sequence.
    pub fn run(&mut self, input: &Input) -> Result<Vec<Image>, FilterError> {
        self.run_after(input, input)
    }

    /// Blurs every colour image of the input as [`Blur::run`] does, and gives filters with history
    /// the frame `before`, which has as many colour images, in the same order.
    pub fn run_after(&mut self, input: &Input, before: &Input) -> Result<Vec<Image>, FilterError> {
        self.check(input)?;
        self.check(before)?;
        self.upload_layers(input, before)?;
        // Results that do not depend on colour are kept from the first image.
        self.blur_colors(input, before, |index| index == 0)
    }

    /// Blurs every colour image of the input with the same weights as the last run, whose input
    /// differed in nothing but colours, before as now.
    pub fn run_further(
        &mut self,
        input: &Input,
        before: &Input,
    ) -> Result<Vec<Image>, FilterError> {
        self.blur_colors(input, before, |_| false)
    }

    /// Blurs every colour image of the input, whose layers are uploaded. `is_first` says by the
    /// image's number if results that do not depend on colour are still missing.
    fn blur_colors(
        &mut self,
        input: &Input,
        before: &Input,
        is_first: impl Fn(usize) -> bool,
    ) -> Result<Vec<Image>, FilterError> {
        assert_eq!(
            input.color.len(),
            before.color.len(),
            "every colour has one of the frame before"
        );
        let colors = input.color.iter().zip(before.color).enumerate();
        let outputs = colors.map(|(index, (color, before))| {
            self.upload_color(color, before)?;
            self.blur(|dispatch| is_first(index) || dispatch.depends_on_color)
        });
        let outputs = outputs.collect::<Result<Vec<_>, _>>()?;
        self.check_loops()?;
        Ok(outputs)
    }

    /// Blurs the first colour image of the input once per frame index, as [`Blur::run`] would with
    /// each of them. Returns `None` if the index changes nothing.
    pub fn run_noise(
        &mut self,
        input: &Input,
        frame_indices: impl IntoIterator<Item = u32>,
    ) -> Result<Option<Vec<Image>>, FilterError> {
        let mut dispatches = self.passes.dispatches.iter();
        if !dispatches.any(|dispatch| dispatch.depends_on_noise) {
            return Ok(None);
        }
        self.upload_first(input)?;
        let mut outputs = Vec::new();
        for frame_index in frame_indices {
            let frame = FrameValues::of(
                &Input {
                    frame_index,
                    ..*input
                },
                &self.filter().convention,
            );
            self.passes.upload_frame(self.gpu, frame);
            let first = outputs.is_empty();
            outputs.push(self.blur(|dispatch| first || dispatch.depends_on_noise)?);
        }
        self.check_loops()?;
        Ok(Some(outputs))
    }

    /// Runs the wanted dispatches on what has been uploaded, and reads the output.
    fn blur(&self, is_wanted: impl Fn(&Dispatch) -> bool) -> Result<Image, FilterError> {
        let place = self.place("upload");
        let mut turn = self.gpu.take_turn(place)?;
        self.gpu.catch_errors(place, || {
            (self.passes).mark_output(self.gpu, &mut turn, &is_wanted);
        })?;
        drop(turn);
        for dispatch in self
            .passes
            .dispatches
            .iter()
            .filter(|dispatch| is_wanted(dispatch))
        {
            self.run_dispatch(dispatch)?;
        }
        self.read_output()
    }

    /// Reads the output; fails if a pixel was not written or is not finite.
    fn read_output(&self) -> Result<Image, FilterError> {
        let target = self.passes.target("output");
        let texels = self.gpu.download(target, self.place("read back"))?;
        let output = self.origin().upright(Image::from_texels(&texels));
        match find_broken(&output) {
            None => match self.color_scale() {
                1.0 => Ok(output),
                scale => Ok(output.map(|pixel| pixel.map(|part| part / scale))),
            },
            Some([x, y]) => {
                // A loop that was ended early may have broken the pixel.
                self.check_loops()?;
                Err(self.refuse_pixel([x, y], output.at(x, y)))
            }
        }
    }

    fn refuse_pixel(&self, [x, y]: [u32; 2], [r, g, b]: &[f32; 3]) -> FilterError {
        let mut dispatches = self.passes.dispatches.iter();
        let writer = dispatches.rfind(|dispatch| dispatch.writes("output"));
        let place = self.place(writer.map_or("output", |dispatch| &dispatch.entry));
        let mark = mark_of(self.passes.target("output").format);
        if [r, g, b]
            .iter()
            .any(|component| component.to_bits() == mark.to_bits())
        {
            let [width, height] = self.size;
            return place.refuse(format!(
                "leaves pixel ({x}, {y}) of the output unwritten; every pixel of {width}x{height} must be written"
            ));
        }
        let first = self.find_first_broken().unwrap_or_default();
        place.refuse(format!(
            "writes [{r}, {g}, {b}] to pixel ({x}, {y}); every value must be finite{first}"
        ))
    }

    /// Runs the passes again, and names the first that writes a value that is not finite to a
    /// texture between them.
    fn find_first_broken(&self) -> Option<String> {
        for dispatch in &self.passes.dispatches {
            self.run_dispatch(dispatch).ok()?;
            let between = (dispatch.written.iter()).filter(|(name, target)| {
                name != "output" && target.format.kind() == ScalarKind::Float
            });
            for (name, target) in between {
                let texels = self.gpu.download(target, self.place("read back")).ok()?;
                let broken = find_broken(&texels);
                if let Some([x, y]) = broken {
                    return Some(format!(
                        "; pass {} writes the first that is not, to texel ({x}, {y}) of \"{name}\"",
                        dispatch.entry
                    ));
                }
            }
        }
        None
    }

    /// Refuses loops that the adapter may have ended early.
    fn check_loops(&self) -> Result<(), FilterError> {
        let entry = |dispatch: usize| self.place(&self.passes.dispatches[dispatch].entry);
        match &self.passes.loop_counts {
            Some(counts) => counts.check(self.gpu, entry),
            None => Ok(()),
        }
    }

    /// Reads what the last run left in a texture between the passes. Components that its format
    /// lacks are 0, and a number of `r32uint` is the float of the same bits. Panics if the filter
    /// has no such texture.
    pub fn read_texture(&self, name: &str) -> Result<Raster<[f32; 4]>, FilterError> {
        let target = self.passes.target(name);
        let texels = self.gpu.download(target, self.place("read back"))?;
        Ok(self.origin().upright(texels))
    }

    fn check(&self, input: &Input) -> Result<(), FilterError> {
        input.check(self.filter(), self.camera, self.size)
    }

    /// Names a pass of this filter, for errors.
    pub(super) fn place<'a>(&'a self, pass: &'a str) -> Place<'a> {
        self.filter().place(pass)
    }

    /// Uploads an input and its first colour, as at the beginning of a sequence.
    pub(super) fn upload_first(&self, input: &Input) -> Result<(), FilterError> {
        self.check(input)?;
        self.upload_layers(input, input)?;
        let color = input.color.first().expect("there is a colour to blur");
        self.upload_color(color, color)
    }

    /// Uploads everything but the colour, and what the filter reads of the frame before.
    fn upload_layers(&self, input: &Input, before: &Input) -> Result<(), FilterError> {
        let convention = &self.filter().convention;
        let texels = |layer: Layer, input: &Input| {
            let velocity = |image| velocity_texels(convention, input, image);
            let is_there = "a checked frame has what the filter reads";
            match layer {
                Layer::Color => input.color[0].to_texels(self.color_scale()),
                Layer::Velocity => velocity(input.velocity),
                Layer::Depth => convention.convert_depth(input.depth).pixels,
                Layer::VelocityNext => velocity(input.velocity_next.expect(is_there)),
                Layer::VelocityZ => input.velocity_z.expect(is_there).pixels.clone(),
                Layer::Exclusion => input.exclusion.expect(is_there).pixels.clone(),
            }
        };
        let history = self
            .filter()
            .history
            .iter()
            .filter(|history| **history != History::Color);
        let history = history.map(|history| (history.texture(), history.layer(), before));
        let further = self.filter().further_inputs();
        let current = [Layer::Velocity, Layer::Depth].into_iter().chain(further);
        let current = current.map(|layer| (layer.name(), layer, input));
        self.gpu.catch_errors(self.place("upload"), || {
            let frame = FrameValues::of(input, convention);
            self.passes.upload_frame(self.gpu, frame);
            for (texture, layer, input) in current.chain(history) {
                let target = self.passes.target(texture);
                let texels = self.origin().order_rows(texels(layer, input), self.size[1]);
                self.gpu.upload(target, &texels);
            }
        })
    }

    /// Uploads a colour, and the frame before's if the filter reads it.
    fn upload_color(&self, color: &Image, before: &Image) -> Result<(), FilterError> {
        let upload = |target, color: &Image| {
            let texels = color.to_texels(self.color_scale());
            let texels = self.origin().order_rows(texels, self.size[1]);
            self.gpu.upload(target, &texels);
        };
        self.gpu.catch_errors(self.place("upload"), || {
            upload(self.passes.target("color"), color);
            if self.filter().is_in_place() {
                upload(&self.passes.mark, color);
            }
            if self.filter().history.contains(&History::Color) {
                upload(self.passes.target(History::Color.texture()), before);
            }
        })
    }

    /// Returns the corner where the shaders' textures begin.
    fn origin(&self) -> Origin {
        self.filter().convention.origin()
    }

    /// Returns the factor on colours that the shaders expect.
    fn color_scale(&self) -> f32 {
        self.filter().convention.color_scale.unwrap_or(1.0) as f32
    }

    /// Runs one dispatch and waits for it, so that an error names the pass that takes too long.
    fn run_dispatch(&self, dispatch: &Dispatch) -> Result<(), FilterError> {
        let place = self.place(&dispatch.entry);
        let mut turn = self.gpu.take_turn(place)?;
        self.gpu.catch_errors(place, || {
            let mut encoder = self
                .gpu
                .device()
                .create_command_encoder(&Default::default());
            dispatch.encode(&mut encoder);
            turn.submit(encoder.finish());
        })?;
        turn.wait(place, self.filter().time_limit)
    }
}

fn check_size(gpu: &Gpu, filter: &Filter, width: u32, height: u32) -> Result<(), FilterError> {
    let limits = gpu.device().limits();
    let side = limits.max_texture_dimension_2d;
    let image = row_bytes(width, Format::Rgba32Float) * u64::from(height);
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
