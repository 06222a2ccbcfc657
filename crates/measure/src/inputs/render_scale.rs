//! Frames that are rendered small and upscaled.

use frame::{Frame, Image, Size, Vectors};
use tracer::{PixelGrid, RenderSettings};

use super::renderer::Renderer;
use super::resample::{Extent, mix, read_bilinear, read_nearest};
use crate::render::settings::settings_of;
use crate::{Error, named};

named! {
    /// Scale at which the frame is rendered, and the order of blurring and upscaling.
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
    /// Returns the percentage of the picture's width and height, and true if a filter gets the
    /// small frame and its output is upscaled.
    fn parts(self) -> (u32, bool) {
        match self {
            Self::Full => (100, false),
            Self::HalfBlurFirst => (50, true),
            Self::HalfUpscaleFirst => (50, false),
            Self::TwoThirdsBlurFirst => (67, true),
            Self::TwoThirdsUpscaleFirst => (67, false),
            Self::ThreeQuartersBlurFirst => (77, true),
            Self::ThreeQuartersUpscaleFirst => (77, false),
        }
    }

    /// Returns the rendered size of a picture: rounded to whole pixels, at least one.
    fn rendered_size(self, picture: Size) -> Size {
        let percent = u64::from(self.parts().0);
        picture.map(|side| ((u64::from(side) * percent + 50) / 100).max(1) as u32)
    }

    /// Returns the size that a filter gets for a picture of this size.
    pub(crate) fn blurred_size(self, picture: Size) -> Size {
        match self.parts() {
            (_, true) => self.rendered_size(picture),
            (_, false) => picture,
        }
    }

    /// Returns the frame as a filter gets it: small, or upscaled with bilinear colour and the
    /// nearest small pixel's velocity and depth.
    pub(crate) fn apply(self, frame: Frame, renderer: &Renderer) -> Result<Frame, Error> {
        if self == Self::Full {
            return Ok(frame);
        }
        let (percent, blurs_first) = self.parts();
        let whole = settings_of(&frame);
        let to = Extent {
            picture: whole.size(),
            band: whole.guard_band,
        };
        let from = Extent {
            picture: self.rendered_size(to.picture),
            band: (to.band * percent).div_ceil(100),
        };
        let settings = RenderSettings {
            guard_band: from.band,
            ..whole
        };
        let grid = PixelGrid::of_picture(from.picture.width, from.picture.height);
        let small = renderer.frame(&format!("frame at {percent} %"), &settings, &grid)?;
        Ok(if blurs_first {
            small
        } else {
            upscale(frame, &small, from, to)
        })
    }
}

/// Upscales a small frame to the size of the whole one.
fn upscale(frame: Frame, small: &Frame, from: Extent, to: Extent) -> Frame {
    let [from_sides, to_sides] = [from, to].map(|extent| extent.picture.sides());
    let step = [0, 1].map(|axis| to_sides[axis] as f32 / from_sides[axis] as f32);
    let read_velocity = |vectors: &Vectors| {
        let velocity = read_nearest(vectors, from, to);
        velocity.map(|velocity| [0, 1].map(|axis| velocity[axis] * step[axis]))
    };
    let coverage = small.coverage.iter();
    Frame {
        color: read_bilinear(&small.color, from, to, mix_colors),
        coverage: coverage
            .map(|plane| read_bilinear(plane, from, to, mix))
            .collect(),
        velocity: read_velocity(&small.velocity),
        velocity_next: small.velocity_next.as_ref().map(read_velocity),
        velocity_z: (small.velocity_z.as_ref()).map(|plane| read_nearest(plane, from, to)),
        depth: read_nearest(&small.depth, from, to),
        object_id: read_nearest(&small.object_id, from, to),
        ..frame
    }
}

/// Upscales an image without a guard band to the size of another.
pub(crate) fn upscale_picture(image: &Image, picture: Size) -> Image {
    let [from, to] = [image.size(), picture].map(Extent::bare);
    read_bilinear(image, from, to, mix_colors)
}

fn mix_colors(from: [f32; 3], to: [f32; 3], part: f32) -> [f32; 3] {
    [0, 1, 2].map(|band| mix(from[band], to[band], part))
}

#[cfg(test)]
mod tests {
    use frame::Raster;

    use super::*;
    use crate::inputs::test_frame::test_frame;

    #[test]
    fn sizes_are_rounded() {
        for (scale, picture, rendered, blurred) in [
            (RenderScale::HalfBlurFirst, [320, 181], [160, 91], [160, 91]),
            (
                RenderScale::HalfUpscaleFirst,
                [320, 180],
                [160, 90],
                [320, 180],
            ),
            (
                RenderScale::TwoThirdsUpscaleFirst,
                [320, 181],
                [214, 121],
                [320, 181],
            ),
            (
                RenderScale::ThreeQuartersBlurFirst,
                [320, 181],
                [246, 139],
                [246, 139],
            ),
            (RenderScale::HalfBlurFirst, [1, 1], [1, 1], [1, 1]),
        ] {
            let picture = Size::from(picture);
            assert_eq!(scale.rendered_size(picture).sides(), rendered);
            assert_eq!(scale.blurred_size(picture).sides(), blurred);
        }
    }

    #[test]
    fn upscaled_velocity_is_in_pixels_of_the_whole_picture() {
        let mut small = test_frame(2, 1);
        small.velocity.pixels = vec![[1.0, 1.0], [3.0, -2.0]];
        small.depth.pixels = vec![5.0, 7.0];
        small.color.pixels = vec![[0.0; 3], [4.0; 3]];
        small.coverage = vec![Raster::filled(2, 1, 0.25)];
        let whole = upscale(
            test_frame(4, 3),
            &small,
            Extent::bare(Size::new(2, 1)),
            Extent::bare(Size::new(4, 3)),
        );
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
