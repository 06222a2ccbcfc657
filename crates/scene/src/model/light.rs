//! Light from infinity: the background and the sun.

use std::f64::consts::PI;
use std::path::PathBuf;

use glam::{DVec3, Vec3};

/// Radiance from infinity.
#[derive(Clone, Debug, PartialEq)]
pub enum Background {
    /// Radiance that is the same from everywhere.
    Constant(Vec3),
    /// Piecewise linear in the height (y) of the unit direction: `ground` at -1, `horizon` at 0,
    /// `zenith` at +1.
    Gradient {
        /// Radiance straight down.
        ground: Vec3,
        /// Radiance at eye level.
        horizon: Vec3,
        /// Radiance straight up.
        zenith: Vec3,
    },
    /// An image of all directions.
    Map(EnvironmentMap),
}

/// Radiance by direction, in longitude (from left to right) and latitude (from +Y at the top to
/// -Y).
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentMap {
    /// The image file.
    pub path: PathBuf,
    /// Texels around the horizon, twice as many as rows. The middle of the image is towards -Z, its
    /// right quarter towards +X.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Linear radiance, row-major from the top left; not negative, finite.
    pub texels: Vec<[f32; 3]>,
    /// Factor on the texels.
    pub strength: f32,
    /// Turn of the map about +Y, in radians.
    pub rotation: f64,
}

/// A distant disc of constant radiance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    /// Unit vector from the scene to the sun.
    pub direction: DVec3,
    /// Irradiance on a surface that faces it.
    pub irradiance: Vec3,
    /// Radius of its disc in radians; 0 is a point at infinity, which no camera ray and no bounce
    /// can hit.
    pub angular_radius: f64,
}

impl Background {
    /// Radiance from a unit direction.
    #[inline]
    pub fn radiance(&self, direction: DVec3) -> Vec3 {
        match self {
            Background::Constant(radiance) => *radiance,
            Background::Gradient {
                ground,
                horizon,
                zenith,
            } => {
                let height = direction.y as f32;
                let end = if height < 0.0 { ground } else { zenith };
                horizon.lerp(*end, height.abs())
            }
            Background::Map(map) => map.radiance(direction),
        }
    }
}

impl Sun {
    /// The radiance of the disc: its irradiance on a facing surface is radiance x pi sin^2(radius).
    pub fn radiance(&self) -> Vec3 {
        if self.angular_radius == 0.0 {
            return self.irradiance;
        }
        let sine = self.angular_radius.sin();
        self.irradiance * (1.0 / (PI * sine * sine)) as f32
    }

    /// Returns true if a ray that leaves the scene in this unit direction ends on the disc.
    #[inline]
    pub fn covers(&self, direction: DVec3) -> bool {
        self.angular_radius > 0.0 && 1.0 - direction.dot(self.direction) <= self.cap()
    }

    /// 1 - cos(radius), without cancellation.
    #[inline]
    pub fn cap(&self) -> f64 {
        let sine = (0.5 * self.angular_radius).sin();
        2.0 * sine * sine
    }
}
