//! Velocities of engines that keep the wrong shapes, matrices or cameras of the last frame.

mod pinhole;
mod seen_points;
mod teleport;
mod wrong_draws;

pub use wrong_draws::WrongDraws;
