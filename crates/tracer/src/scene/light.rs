//! Light from infinity: the background and the sun.

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
