//! Conversion of velocity, depth and colour between frames and the convention of an engine.

use frame::{ExrFile, FAR_DEPTH, FileError, Image, Plane, Raster, Vectors};

use super::convention::{
    Convention, DepthKind, VelocitySign, VelocityTime, VelocityUnit, VerticalDirection,
};

/// Part of the far plane's distance by which the linear depth of the background may be short of it.
const FAR_ROUNDING: f64 = 1e-5;

impl Convention {
    /// Converts velocity in pixels per frame to the engine's.
    pub fn convert_velocity(&self, velocity: &Vectors, exposure: f64) -> Vectors {
        let [x, y] = self.velocity_factors([velocity.width, velocity.height], exposure);
        let bias = self.velocity_bias.unwrap_or(0.0);
        let convert = |value: f32, factor: f64| (f64::from(value) * factor + bias) as f32;
        velocity.map(|v| [convert(v[0], x), convert(v[1], y)])
    }

    /// Converts the engine's velocity to pixels per frame.
    ///
    /// # Errors
    /// A velocity becomes infinite, or all become 0; the text names keys.
    pub fn restore_velocity(&self, velocity: &Vectors, exposure: f64) -> Result<Vectors, String> {
        let [x, y] = self.velocity_factors([velocity.width, velocity.height], exposure);
        let bias = self.velocity_bias.unwrap_or(0.0);
        let restore = |value: f32, factor: f64| ((f64::from(value) - bias) / factor) as f32;
        let restored = velocity.map(|v| [restore(v[0], x), restore(v[1], y)]);
        check_restored(
            velocity,
            &restored,
            "velocity, velocity_per, velocity_scale and velocity_bias",
        )?;
        Ok(restored)
    }

    /// Returns the engine's velocity of a surface that moves by a pixel per frame to the right and
    /// down.
    pub(crate) fn velocity_factors(&self, [width, height]: [u32; 2], exposure: f64) -> [f64; 2] {
        let sign = match self.velocity_sign {
            VelocitySign::CurrentMinusPrevious => 1.0,
            VelocitySign::PreviousMinusCurrent => -1.0,
        };
        let time = match self.velocity_per {
            VelocityTime::Frame => 1.0,
            VelocityTime::Shutter => exposure,
            VelocityTime::Second => self.frames_per_second.unwrap_or(1.0),
        };
        let y = match self.velocity_y() {
            VerticalDirection::Down => 1.0,
            VerticalDirection::Up => -1.0,
        };
        let unit = match self.velocity {
            VelocityUnit::Pixels => [1.0, 1.0],
            VelocityUnit::Uv => [1.0 / f64::from(width), 1.0 / f64::from(height)],
            VelocityUnit::Ndc => [2.0 / f64::from(width), 2.0 / f64::from(height)],
        };
        let common = sign * time * self.velocity_scale.unwrap_or(1.0);
        [common * unit[0], common * unit[1] * y]
    }

    /// Converts depth in metres to the engine's.
    pub fn convert_depth(&self, metres: &Plane) -> Plane {
        let near = self.near.unwrap_or(1.0);
        let reversed = |z: &f32| {
            let z = f64::from(*z);
            let reversed = match self.far {
                None => near / z,
                Some(far) => near * (far - z) / (z * (far - near)),
            };
            reversed.clamp(0.0, 1.0)
        };
        metres.map(|z| match self.depth {
            DepthKind::Linear => self.far.map_or(*z, |far| z.min(far as f32)),
            DepthKind::Reversed => reversed(z) as f32,
            DepthKind::Forward => (1.0 - reversed(z)) as f32,
            DepthKind::Ndc => (1.0 - 2.0 * reversed(z)) as f32,
        })
    }

    /// Converts the engine's depth to metres. The value of a cleared buffer becomes the background,
    /// and so do distances beyond it, and linear depth at the far plane.
    ///
    /// # Errors
    /// A depth is not above 0; the text names keys.
    pub fn restore_depth(&self, depth: &Plane) -> Result<Plane, String> {
        if self.depth == DepthKind::Linear {
            let far = self.far.unwrap_or(f64::INFINITY) * (1.0 - FAR_ROUNDING);
            let metres = |depth: &f32| {
                if f64::from(*depth) >= far {
                    FAR_DEPTH
                } else {
                    *depth
                }
            };
            return Ok(depth.map(metres));
        }
        let near = self.near.unwrap_or(1.0);
        let restored = depth.map(|depth| {
            let stored = f64::from(*depth);
            let reversed = match self.depth {
                DepthKind::Linear => stored,
                DepthKind::Reversed => stored,
                DepthKind::Forward => 1.0 - stored,
                DepthKind::Ndc => 0.5 - 0.5 * stored,
            };
            match (reversed == 0.0, self.far) {
                (true, _) => FAR_DEPTH,
                (false, None) => ((near / reversed) as f32).min(FAR_DEPTH),
                (false, Some(far)) => (near * far / (near + reversed * (far - near))) as f32,
            }
        });
        let pairs = depth.pixels.iter().zip(&restored.pixels);
        match pairs
            .into_iter()
            .find(|(_, metres)| !(metres.is_finite() && **metres > 0.0))
        {
            None => Ok(restored),
            Some((stored, metres)) => Err(format!(
                "its depth {stored} becomes {metres} m by the [convention]; allowed: finite distances above 0; correct depth, \
                 near and far"
            )),
        }
    }

    /// Converts scene-linear colour to the engine's.
    pub fn convert_color(&self, color: &Image) -> Image {
        let scale = self.color_scale.unwrap_or(1.0) as f32;
        color.map(|pixel| pixel.map(|value| scale * value))
    }

    /// Converts the engine's colour to scene-linear.
    ///
    /// # Errors
    /// A colour becomes infinite, or all become 0; the text names the key.
    pub fn restore_color(&self, color: &Image) -> Result<Image, String> {
        let scale = self.color_scale.unwrap_or(1.0) as f32;
        let restored = color.map(|pixel| pixel.map(|value| value / scale));
        check_restored(color, &restored, "color_scale")?;
        Ok(restored)
    }

    /// Reads the colours of an engine's file as scene-linear Rec.709.
    ///
    /// # Errors
    /// The file lacks colours or says that they are of an unknown kind, or the convention makes
    /// impossible ones of them.
    pub fn read_color(&self, file: &mut ExrFile) -> Result<Image, FileError> {
        // The factor gives colours the unit that they lack.
        if self.color_scale.is_some() {
            file.meaning.white_luminance = None;
        }
        let color = file.color("")?;
        (self.restore_color(&color)).map_err(|reason| FileError::foreign(&file.path, reason))
    }
}

/// Refuses a conversion that makes a finite number infinite, or that leaves only zeros and numbers
/// too small for all digits of a float.
fn check_restored<const N: usize>(
    stored: &Raster<[f32; N]>,
    restored: &Raster<[f32; N]>,
    keys: &str,
) -> Result<(), String> {
    let [from, to] = [stored, restored].map(|raster| raster.pixels.as_flattened());
    let is_lost = |(from, to): &(&f32, &f32)| from.is_finite() && !to.is_finite();
    let lost = from.iter().zip(to).find(is_lost).or_else(|| {
        let vanishes = !to.iter().any(|value| value.is_normal());
        from.iter()
            .zip(to)
            .find(|(from, _)| vanishes && from.is_normal())
    });
    match lost {
        None => Ok(()),
        Some((from, to)) => Err(format!(
            "its {from} becomes {to} by the [convention]; allowed: finite numbers, not all 0; correct {keys}"
        )),
    }
}

#[cfg(test)]
mod tests {
    use frame::Raster;

    use super::*;

    #[test]
    fn velocity_with_a_bias_leads_back() {
        let form = Convention {
            velocity: VelocityUnit::Ndc,
            velocity_scale: Some(0.5),
            velocity_bias: Some(0.5),
            ..Convention::default()
        };
        let pixels = vec![[0.0, 0.0], [40.0, -20.0], [-8.0, 4.0]];
        let velocity = Raster {
            width: 3,
            height: 1,
            pixels,
        };
        let stored = form.convert_velocity(&velocity, 1.0);
        assert_eq!(stored.pixels[0], [0.5, 0.5]);
        let restored = form.restore_velocity(&stored, 1.0).unwrap();
        for (velocity, due) in restored.pixels.iter().zip(&velocity.pixels) {
            assert!((velocity[0] - due[0]).abs() < 1e-4, "{:?}", restored.pixels);
            assert!((velocity[1] - due[1]).abs() < 1e-4, "{:?}", restored.pixels);
        }
    }

    #[test]
    fn linear_depth_of_the_background_is_at_the_far_plane() {
        let form = Convention {
            far: Some(1e5),
            ..Convention::default()
        };
        let row = |pixels| Raster {
            width: 3,
            height: 1,
            pixels,
        };
        let metres = row(vec![0.5, 9e4, FAR_DEPTH]);
        let stored = form.convert_depth(&metres);
        assert_eq!(stored.pixels, [0.5, 9e4, 1e5]);
        assert_eq!(form.restore_depth(&stored).unwrap(), metres);
        let rounded = row(vec![0.5, 9e4, 99_999.99]);
        assert_eq!(form.restore_depth(&rounded).unwrap(), metres);
        let nothing = Convention::default().restore_depth(&stored).unwrap();
        assert_eq!(nothing, stored);
    }

    #[test]
    fn each_form_of_depth_has_its_planes_at_its_ends_and_leads_back() {
        let planes = |depth, far| Convention {
            depth,
            near: Some(0.5),
            far,
            ..Convention::default()
        };
        let metres = Raster {
            width: 4,
            height: 1,
            pixels: vec![0.5, 1.0, 8.0, FAR_DEPTH],
        };
        // (8 - 1) / 1 x 0.5 / 7.5.
        let middle = (0.5 * 7.0 / 7.5) as f32;
        // (form, distance of the far plane, its numbers at the near plane, 1 m, 8 m and beyond)
        let cases = [
            (DepthKind::Reversed, Some(8.0), [1.0, middle, 0.0, 0.0]),
            (DepthKind::Forward, Some(8.0), [0.0, 1.0 - middle, 1.0, 1.0]),
            (
                DepthKind::Ndc,
                Some(8.0),
                [-1.0, 1.0 - 2.0 * middle, 1.0, 1.0],
            ),
            (DepthKind::Reversed, None, [1.0, 0.5, 0.0625, 5e-11]),
            (DepthKind::Forward, None, [0.0, 0.5, 0.9375, 1.0]),
            (DepthKind::Ndc, None, [-1.0, 0.0, 0.875, 1.0]),
        ];
        for (kind, far, expected) in cases {
            let form = planes(kind, far);
            let converted = form.convert_depth(&metres);
            for (depth, expected) in converted.pixels.iter().zip(expected) {
                assert!(
                    (depth - expected).abs() < 1e-6,
                    "{form:?}: {:?}",
                    converted.pixels
                );
            }
            let back = form.restore_depth(&converted).unwrap();
            // A surface at the far plane looks like the background.
            let last = if far.is_some() { FAR_DEPTH } else { 8.0 };
            for (depth, expected) in back.pixels.iter().zip([0.5, 1.0, last, FAR_DEPTH]) {
                let error = (depth / expected - 1.0).abs();
                assert!(error < 1e-5, "{form:?}: {:?}", back.pixels);
            }
        }
    }
}
