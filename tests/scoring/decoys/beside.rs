//! Errors across the motion: dilation, cores, shifts, isotropic blurs.

use frame::{Picture, Plane, Raster};
use tests::synthetic::{Blur, Sampling, Shape};

use super::{ANGLES, Case, RADIUS, ROW_MASS, ROWS, assert_near, discs, find_value, slide};

#[test]
fn lateral_growth_equals_the_dilation_in_pixels() {
    for (degrees, disc) in discs() {
        let bar = Shape::Bar {
            half: [18.0, 6.0],
            tilt: degrees.to_radians(),
        };
        for (case, name) in [(disc, "disc"), (&Case::new(slide(bar, degrees)), "bar")] {
            let dilations = [0.5, 1.0, 2.0, 6.0];
            let blurs = dilations.map(|dilation| Blur {
                dilation,
                ..Blur::TRUE
            });
            for (scores, dilation) in case.score_blurs(blurs).iter().zip(dilations) {
                let what = format!("growth of a {name} at {degrees} degrees");
                // The silhouette's length is known to 2 % for a disc at any angle, and to 4 % for a bar: its gradients
                // span two pixels. A hundredth of a pixel is gained inside.
                let tolerance = match name {
                    "disc" => (0.01 + 0.02 * dilation).min(0.1),
                    _ => 0.04 * dilation,
                };
                assert_near(
                    &what,
                    find_value(scores, "lateral_growth"),
                    dilation,
                    tolerance,
                );
                assert_near(&what, find_value(scores, "row_gain"), 0.0, ROWS);
                assert_near(&what, find_value(scores, "row_loss"), 0.0, ROWS);
            }
        }
    }
}

#[test]
fn a_dilated_slanted_outline_grows_beside_its_rows_and_gains_inside() {
    for degrees in ANGLES {
        let bar = Shape::Bar {
            half: [18.0, 6.0],
            tilt: degrees.to_radians() + 0.4,
        };
        let dilations = [2.0, 6.0];
        let blurs = dilations.map(|dilation| Blur {
            dilation,
            ..Blur::TRUE
        });
        for (scores, dilation) in
            (Case::new(slide(bar, degrees)).score_blurs(blurs).iter()).zip(dilations)
        {
            let [growth, gain, loss] = ROW_MASS.map(|name| find_value(scores, name));
            let what = format!("dilation of a slanted bar at {degrees} degrees");
            assert_near(&what, growth + gain, dilation, 0.1);
            assert!(
                growth > 0.05 * dilation && gain > 0.05 * dilation,
                "{what}: {growth} and {gain}"
            );
            assert_near(&what, loss, 0.0, ROWS);
        }
    }
}

#[test]
fn a_sharp_mover_over_its_own_smear_makes_rows_heavier_and_does_not_grow() {
    for (degrees, disc) in discs() {
        let (truth, core) = (disc.truth.mean(), &disc.frame.coverage[1]);
        let mut sharp = truth.clone();
        sharp.coverage[1] = truth.coverage[1].zip(core, |truth, core| core + (1.0 - core) * truth);
        let [scores] = &disc.score_pictures([sharp]);
        let gained: f64 = (truth.coverage[1].pixels.iter().zip(&core.pixels))
            .map(|(truth, core)| f64::from(core * (1.0 - truth)))
            .sum();
        let [growth, gain, loss] = ROW_MASS.map(|name| find_value(scores, name));
        let expected = gained / (4.0 * RADIUS);
        assert!(expected > 6.0, "{expected} px make a heavy core");
        // Each lateral silhouette is as long as the disc is wide, to the 2 % of its gradients.
        let what = format!("gain at {degrees} degrees");
        assert_near(&what, gain + growth, expected, 0.02 * expected);
        // Pixels at the rim reach at an angle into rows that the disc hardly touches: measured 2 % at 30 degrees, 0 at
        // 0.
        assert_near(&what, gain, expected, 0.04 * expected);
        assert_near("loss", loss, 0.0, ROWS);
    }
}

#[test]
fn hard_bleed_sees_a_wide_dilation_only_beside_the_support() {
    for (degrees, disc) in discs() {
        let wide = Blur {
            dilation: 6.0,
            ..Blur::TRUE
        };
        let [scores] = disc.score_blurs([wide]);
        // The border allows one pixel, and the faint ends of the smear hide more of six.
        let lateral = find_value(&scores, "bleed_lateral");
        assert!(
            (1.0..4.0).contains(&lateral),
            "{lateral} at {degrees} degrees"
        );
        // The rounded ends: a few pixels at the limit of 45 degrees.
        assert_near("leading", find_value(&scores, "bleed_leading"), 0.0, 0.1);
        assert_near("trailing", find_value(&scores, "bleed_trailing"), 0.0, 0.1);
    }
}

#[test]
fn a_shift_across_the_motion_grows_on_one_side_and_loses_on_the_other() {
    for ((_, disc), shift) in discs().zip([3.0, 3.0, -3.0, -3.0]) {
        let aside = Blur {
            shift: [0.0, shift],
            ..Blur::TRUE
        };
        let [scores] = disc.score_blurs([aside]);
        for name in ["lateral_growth", "row_loss"] {
            assert_near(name, find_value(&scores, name), 1.5, 0.05);
        }
        assert_near("gain", find_value(&scores, "row_gain"), 0.0, ROWS);
        assert_near("centroid", find_value(&scores, "centroid"), 0.0, 0.05);
        assert_near("energy", find_value(&scores, "energy"), 1.0, 1e-3);
    }
}

#[test]
fn an_isotropic_blur_bleeds_to_all_sides_though_its_extent_looks_right() {
    for (degrees, disc) in discs().step_by(2) {
        let instant = disc.scene.render(&Blur::IDENTITY, Sampling::CLEAN);
        let mattes = instant.coverage.iter().map(|matte| gaussian(matte, 9.0));
        let blurred = Picture {
            coverage: mattes.collect(),
            ..instant
        };
        let [scores] = &disc.score_pictures([blurred]);
        assert_near("extent", find_value(scores, "extent"), 1.0, 0.1);
        for name in [
            "bleed_lateral",
            "bleed_leading",
            "lateral_growth",
            "row_loss",
        ] {
            assert!(
                find_value(scores, name) > 1.0,
                "{name} at {degrees} degrees"
            );
        }
    }
}

/// Blurs with a separable Gaussian of `sigma` pixels, and drops light that leaves the picture.
fn gaussian(plane: &Plane, sigma: f64) -> Plane {
    let pass = |plane: &Plane, step: [i64; 2]| {
        Raster::from_fn(plane.width, plane.height, |x, y| {
            let reach = (4.0 * sigma) as i64;
            let total = sigma * std::f64::consts::TAU.sqrt();
            let tap = |offset: i64| {
                let at = [i64::from(x), i64::from(y)];
                let [u, v] = [0, 1].map(|axis| u32::try_from(at[axis] + step[axis] * offset));
                match (u, v) {
                    (Ok(u), Ok(v)) if u < plane.width && v < plane.height => {
                        let distance = offset as f64 / sigma;
                        f64::from(*plane.at(u, v)) * (-0.5 * distance * distance).exp() / total
                    }
                    _ => 0.0,
                }
            };
            (-reach..=reach).map(tap).sum::<f64>() as f32
        })
    };
    pass(&pass(plane, [1, 0]), [0, 1])
}
