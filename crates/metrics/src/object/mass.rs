//! Mass of an object's matte, and holes in its core.

use frame::{Plane, Raster};

/// Mass of a whole matte.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mass {
    /// Mean of `1 - a` over the core; `None` if that is empty.
    pub hole: Option<f64>,
    /// Missing mass over the truth's mass.
    pub deficit: f64,
    /// Mass over the truth's mass: 1 = kept.
    pub energy: f64,
}

/// Compares sums of mattes; `core` is where only the object is seen throughout the shutter. `None`
/// if the truth never shows the object.
pub fn measure_mass(output: &Plane, truth: &Plane, core: &Raster<bool>) -> Option<Mass> {
    let (mut total, mut deficit, mut energy) = (0.0, 0.0, 0.0);
    let (mut hole, mut inside) = (0.0, 0_u32);
    let pixels = output.pixels.iter().zip(&truth.pixels);
    for ((output, truth), is_core) in pixels.zip(&core.pixels) {
        let (output, truth) = (f64::from(*output), f64::from(*truth));
        total += truth;
        deficit += (truth - output).max(0.0);
        energy += output;
        if *is_core {
            hole += 1.0 - output;
            inside += 1;
        }
    }
    (total > 0.0).then(|| Mass {
        hole: (inside > 0).then(|| hole / f64::from(inside)),
        deficit: deficit / total,
        energy: energy / total,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mass_that_is_missing_is_not_made_up_by_mass_elsewhere() {
        let matte = |values: [f32; 4]| Plane {
            width: 4,
            height: 1,
            pixels: values.to_vec(),
        };
        let truth = matte([1.0, 0.5, 0.0, 0.0]);
        let output = matte([0.75, 0.75, 0.25, 0.0]);
        let mut core = truth.map(|_| false);
        let measure = |core: &Raster<bool>| measure_mass(&output, &truth, core).unwrap();
        assert_eq!(measure(&core).hole, None);
        (core.pixels[0], core.pixels[1]) = (true, true);
        let mass = measure(&core);
        // Both core pixels lack a quarter of an opaque object, even where the truth lacks more.
        assert_eq!(mass.hole, Some(0.25));
        assert_eq!(mass.deficit, 0.25 / 1.5);
        assert_eq!(mass.energy, 1.75 / 1.5);
        let empty = matte([0.0; 4]);
        assert_eq!(measure_mass(&output, &empty, &core), None);
    }
}
