//! Frames that are rendered small and upscaled.

use frame::{Frame, Plane, Raster};
use tracer::{PixelGrid, RenderSettings, Scene, trace_frame_part};

use crate::inputs::resample::{Extent, read_bilinear, read_nearest};
use crate::inputs::traced_again::settings_of;
use crate::{Error, Monitor, named};

named! {
    /// A scale at which a frame is rendered, and whether it is blurred before or after upscaling.
    pub enum RenderScale {
        /// The picture's own size.
        Full = "full",
        /// Half as wide and high; blurred, then upscaled bilinearly.
        HalfBlurFirst = "50_blur_first",
        /// Half as wide and high; upscaled bilinearly, then blurred.
        HalfUpscaleFirst = "50_upscale_first",
        /// 67 % as wide and high; blurred, then upscaled bilinearly.
        TwoThirdsBlurFirst = "67_blur_first",
        /// 67 % as wide and high; upscaled bilinearly, then blurred.
        TwoThirdsUpscaleFirst = "67_upscale_first",
        /// 77 % as wide and high; blurred, then upscaled bilinearly.
        ThreeQuartersBlurFirst = "77_blur_first",
        /// 77 % as wide and high; upscaled bilinearly, then blurred.
        ThreeQuartersUpscaleFirst = "77_upscale_first",
    }
}

impl RenderScale {
    /// Returns the part of the picture's width and height, in percent.
    fn percent(self) -> u32 {
        match self {
            Self::Full => 100,
            Self::HalfBlurFirst | Self::HalfUpscaleFirst => 50,
            Self::TwoThirdsBlurFirst | Self::TwoThirdsUpscaleFirst => 67,
            Self::ThreeQuartersBlurFirst | Self::ThreeQuartersUpscaleFirst => 77,
        }
    }

    /// Tells whether a filter gets the small frame, and its output is upscaled.
    fn blurs_first(self) -> bool {
        matches!(
            self,
            Self::HalfBlurFirst | Self::TwoThirdsBlurFirst | Self::ThreeQuartersBlurFirst
        )
    }

    /// Returns the rendered size of a picture: rounded to whole pixels, and one at least.
    fn rendered_size(self, picture: [u32; 2]) -> [u32; 2] {
        let percent = u64::from(self.percent());
        picture.map(|side| ((u64::from(side) * percent + 50) / 100).max(1) as u32)
    }

    /// Returns the size of the picture that a filter gets, where the whole picture is of such a size.
    pub(crate) fn blurred_size(self, picture: [u32; 2]) -> [u32; 2] {
        match self.blurs_first() {
            true => self.rendered_size(picture),
            false => picture,
        }
    }

    /// Returns the frame as a filter gets it: small, or upscaled. Upscaled colour is bilinear; velocity and depth are those of the
    /// nearest small pixel.
    ///
    /// # Errors
    /// The scene cannot be rendered so, or the monitor interrupts.
    pub(crate) fn apply(
        self,
        frame: &Frame,
        scene: &Scene,
        monitor: Monitor,
    ) -> Result<Frame, Error> {
        if self == Self::Full {
            return Ok(frame.clone());
        }
        let whole = settings_of(frame);
        let to = Extent {
            picture: [whole.width, whole.height],
            band: whole.guard_band,
        };
        let from = Extent {
            picture: self.rendered_size(to.picture),
            band: (to.band * self.percent()).div_ceil(100),
        };
        let settings = RenderSettings {
            guard_band: from.band,
            ..whole
        };
        let grid = PixelGrid {
            size: from.picture,
            offset: [0.0; 2],
        };
        let label = format!("{} frame at {} %", scene.id, self.percent());
        let small = monitor.watch(&label, |watch| {
            trace_frame_part(scene, &settings, &grid, None, watch)
        })?;
        Ok(match self.blurs_first() {
            true => small,
            false => upscale(frame, &small, from, to),
        })
    }
}

/// Upscales a small frame to the size of the whole one.
fn upscale(frame: &Frame, small: &Frame, from: Extent, to: Extent) -> Frame {
    let step = [0, 1].map(|axis| to.picture[axis] as f32 / from.picture[axis] as f32);
    let velocity = read_nearest(&small.velocity, from, to);
    Frame {
        color: read_bilinear(&small.color, from, to),
        coverage: (small.coverage.iter())
            .map(|plane| upscale_plane(plane, from, to))
            .collect(),
        velocity: velocity.map(|velocity| [0, 1].map(|axis| velocity[axis] * step[axis])),
        depth: read_nearest(&small.depth, from, to),
        object_id: read_nearest(&small.object_id, from, to),
        ..frame.clone()
    }
}

/// Upscales a raster of a picture without a guard band to the size of another.
pub(crate) fn upscale_picture<const N: usize>(
    raster: &Raster<[f32; N]>,
    picture: [u32; 2],
) -> Raster<[f32; N]> {
    let [from, to] = [[raster.width, raster.height], picture].map(bare);
    read_bilinear(raster, from, to)
}

fn upscale_plane(plane: &Plane, from: Extent, to: Extent) -> Plane {
    read_bilinear(&plane.map(|value| [*value]), from, to).map(|[value]| *value)
}

fn bare(picture: [u32; 2]) -> Extent {
    Extent { picture, band: 0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inputs::test_frame::test_frame;

    #[test]
    fn sizes_are_rounded() {
        let sizes = |scale: RenderScale| scale.rendered_size([320, 181]);
        assert_eq!(sizes(RenderScale::HalfBlurFirst), [160, 91]);
        assert_eq!(sizes(RenderScale::TwoThirdsUpscaleFirst), [214, 121]);
        assert_eq!(sizes(RenderScale::ThreeQuartersBlurFirst), [246, 139]);
        assert_eq!(RenderScale::HalfBlurFirst.rendered_size([1, 1]), [1, 1]);
        let [small, whole] = [
            RenderScale::HalfBlurFirst.blurred_size([320, 180]),
            RenderScale::HalfUpscaleFirst.blurred_size([320, 180]),
        ];
        assert_eq!([small, whole], [[160, 90], [320, 180]]);
    }

    #[test]
    fn upscaled_velocity_is_in_pixels_of_the_whole_picture() {
        let mut small = test_frame(2, 1);
        small.velocity.pixels = vec![[1.0, 1.0], [3.0, -2.0]];
        small.depth.pixels = vec![5.0, 7.0];
        small.color.pixels = vec![[0.0; 3], [4.0; 3]];
        small.coverage = vec![Raster::filled(2, 1, 0.25)];
        let whole = upscale(&test_frame(4, 3), &small, bare([2, 1]), bare([4, 3]));
        let row = [[2.0, 3.0], [2.0, 3.0], [6.0, -6.0], [6.0, -6.0]];
        assert_eq!(whole.velocity.pixels[4..8], row);
        assert_eq!(whole.depth.pixels[4..8], [5.0, 5.0, 7.0, 7.0]);
        assert_eq!(
            whole.color.pixels[4..8],
            [[0.0; 3], [1.0; 3], [3.0; 3], [4.0; 3]]
        );
        assert_eq!(whole.coverage[0].pixels, [0.25; 12]);
    }
}
