//! Runs of a filter on a frame: on its colour and, with the same weights, on probes with exact
//! truths.

use filters::{FilterError, Gpu, Input};
use frame::{Image, Picture, Size};
use metrics::{Probes, mix, nonlinearity, pack_planes, unpack_planes};

use crate::filter_choice::FilterChoice;
use crate::inputs::render_scale::upscale_picture;
use crate::render::exclusion::FilterFrame;
use crate::runner::Runner;

/// The output of a filter, without the frame's guard band.
pub(crate) struct FilterOutput {
    /// The colour, and each object's share of each pixel in the filter's output.
    pub picture: Picture,
    /// Blurs of ones and of coordinates.
    pub probes: Probes,
    /// Difference between the blur of a mixture and the mixture of the blurs, relative to the
    /// blur's change (root mean square): 0 for a filter with weights independent of colour.
    pub nonlinearity: f64,
    /// True if the probes came out as 16-bit floats.
    pub is_rounded: bool,
}

/// A filter for colours, and for numbers that are not colours.
pub(crate) struct Runners<'g> {
    /// The filter as it is.
    pub color: Runner<'g>,
    /// The filter with 32-bit colours; none if it has them already, or if the adapter cannot.
    wide: Option<Runner<'g>>,
}

impl<'g> Runners<'g> {
    /// Prepares a filter for pictures of a size.
    pub fn new(
        gpu: Option<&'g Gpu>,
        choice: &FilterChoice,
        size: Size,
    ) -> Result<Self, FilterError> {
        Ok(Self {
            color: Runner::new(gpu, choice, size)?,
            wide: Runner::with_wide_colors(gpu, choice, size),
        })
    }

    /// Returns the filter for numbers that are not colours.
    fn wide(&mut self) -> &mut Runner<'g> {
        self.wide.as_mut().unwrap_or(&mut self.color)
    }
}

/// A frame that a filter gets.
#[derive(Clone, Copy)]
pub(crate) struct FilteredFrame<'a> {
    /// The frame.
    pub now: &'a FilterFrame,
    /// The previous frame, for filters with history.
    pub before: &'a FilterFrame,
    /// Number of the frame, which seeds the filter's noise.
    pub index: u32,
}

impl FilteredFrame<'_> {
    /// Runs a filter on other colours in place of the frame's, and of the previous one's; returns
    /// the outputs without the guard band. `run` is [`Runner::run_after`], or
    /// [`Runner::run_further`] for a filter that has run on this frame before.
    fn run<'g>(
        &self,
        run: fn(&mut Runner<'g>, &Input, &Input) -> Result<Vec<Image>, FilterError>,
        runner: &mut Runner<'g>,
        colors: &[&Image],
        colors_before: &[&Image],
    ) -> Result<Vec<Image>, FilterError> {
        let now = Input {
            frame_index: self.index,
            ..filter_input(self.now, colors)
        };
        let outputs = run(runner, &now, &filter_input(self.before, colors_before))?;
        Ok(crop_all(outputs, self.now.guard_band))
    }
}

/// Runs the filter with the noise of one frame: on the frame's colour and, in the colour's place,
/// on the instant's coverage of each object, on the probes, and on a mixture of colour and probe.
/// All but the picture comes from the filter with 32-bit colours, if there is one. The previous
/// frame's pictures are replaced like the frame's. The output is upscaled to `picture` if the frame
/// shows it smaller.
pub(crate) fn blur_with_probes(
    runners: &mut Runners,
    filtered: FilteredFrame,
    picture: Size,
) -> Result<FilterOutput, FilterError> {
    let (frame, before) = (filtered.now, filtered.before);
    let mattes = pack_planes(&frame.coverage);
    let Size { width, height } = frame.size();
    let step = [
        picture.width as f32 / (width - 2 * frame.guard_band) as f32,
        picture.height as f32 / (height - 2 * frame.guard_band) as f32,
    ];
    let probes = Probes::images_with_step(width, height, step);
    let mixture = mix(&frame.color, &probes[0]);
    let mut colors: Vec<&Image> = vec![&frame.color, &probes[0], &probes[1], &mixture];
    colors.extend(&mattes);
    let mattes_before = pack_planes(&before.coverage);
    let mixture_before = mix(&before.color, &probes[0]);
    let mut colors_before = vec![&before.color, &probes[0], &probes[1], &mixture_before];
    colors_before.extend(&mattes_before);
    let color = match runners.wide {
        None => None,
        Some(_) => {
            let mut outputs = filtered.run(
                Runner::run_after,
                &mut runners.color,
                &colors[..1],
                &colors_before[..1],
            )?;
            Some(outputs.remove(0))
        }
    };
    let outputs = filtered.run(Runner::run_after, runners.wide(), &colors, &colors_before)?;
    let nonlinearity = nonlinearity(
        &mixture.cropped(frame.guard_band),
        &outputs[3],
        &mix(&outputs[0], &outputs[1]),
    );
    let is_rounded = outputs[1..3].iter().all(has_half_floats);
    let outputs = upscale_all(outputs, picture);
    let color = color.map(|color| upscale_all(vec![color], picture).remove(0));
    Ok(FilterOutput {
        nonlinearity,
        is_rounded,
        probes: Probes::of([&outputs[1], &outputs[2]]),
        picture: Picture {
            color: color.unwrap_or_else(|| outputs[0].clone()),
            coverage: unpack_planes(&outputs[4..], frame.coverage.len()),
        },
    })
}

/// Runs the filter on other colours and coverages of the frame, such as those of a part of its
/// replicates, and of the previous one, after [`blur_with_probes`] on the frame itself. Outputs are
/// upscaled to `picture` as there.
pub(crate) fn blur_picture(
    runners: &mut Runners,
    filtered: FilteredFrame,
    [source, source_before]: [&Picture; 2],
    picture: Size,
) -> Result<Picture, FilterError> {
    let color = filtered.run(
        Runner::run_further,
        &mut runners.color,
        &[&source.color],
        &[&source_before.color],
    )?;
    let [mattes, mattes_before] =
        [source, source_before].map(|source| pack_planes(&source.coverage));
    let [mattes, mattes_before]: [Vec<&Image>; 2] =
        [&mattes, &mattes_before].map(|mattes| mattes.iter().collect());
    let mattes = filtered.run(Runner::run_further, runners.wide(), &mattes, &mattes_before)?;
    Ok(Picture {
        color: upscale_all(color, picture).remove(0),
        coverage: unpack_planes(&upscale_all(mattes, picture), source.coverage.len()),
    })
}

/// Returns true if 16-bit floats represent all values exactly.
fn has_half_floats(image: &Image) -> bool {
    // The last 13 of the 23 bits of a mantissa.
    let is_half = |value: &f32| value.to_bits() & 0x1fff == 0;
    image.pixels.iter().flatten().all(is_half)
}

/// Runs the filter on the frame's colour with a number of frames of its noise; none if it has no
/// noise. Outputs are upscaled to `picture` as in [`blur_with_probes`].
pub(crate) fn blur_noise_frames(
    runner: &mut Runner,
    frame: &FilterFrame,
    frames: u32,
    picture: Size,
) -> Result<Option<Vec<Image>>, FilterError> {
    let outputs = runner.run_noise(&filter_input(frame, &[&frame.color]), 0..frames)?;
    Ok(outputs.map(|outputs| upscale_all(crop_all(outputs, frame.guard_band), picture)))
}

/// Upscales smaller outputs.
fn upscale_all(outputs: Vec<Image>, picture: Size) -> Vec<Image> {
    let is_whole = |output: &Image| output.size() == picture;
    if outputs.iter().all(is_whole) {
        outputs
    } else {
        (outputs
            .iter()
            .map(|output| upscale_picture(output, picture)))
        .collect()
    }
}

/// Removes the frame's guard band from outputs.
fn crop_all(outputs: Vec<Image>, guard_band: u32) -> Vec<Image> {
    match guard_band {
        0 => outputs,
        _ => (outputs.iter().map(|output| output.cropped(guard_band))).collect(),
    }
}

/// Makes a filter's input from a frame, with colours in place of the frame's own.
pub fn filter_input<'a>(frame: &'a FilterFrame, color: &'a [&'a Image]) -> Input<'a> {
    Input {
        color,
        velocity: &frame.velocity,
        velocity_next: frame.velocity_next.as_ref(),
        velocity_z: frame.velocity_z.as_ref(),
        exclusion: frame.exclusion.as_ref(),
        depth: &frame.depth,
        // Engines do not record how their camera moved.
        reprojection: (frame.provenance.engine.is_none())
            .then(|| frame.reprojection.moved(f64::from(frame.guard_band))),
        camera: frame.camera,
        exposure: frame.exposure,
        frames_per_second: frame.frames_per_second,
        frame_index: 0,
    }
}
