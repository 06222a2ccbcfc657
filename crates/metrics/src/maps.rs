//! Error maps that scores are pooled from, and their names.

use frame::{Image, Plane};

/// Declares error maps: a plane for each in the struct that holds it, its name as a variant and as
/// a channel of errors.exr.
macro_rules! maps {
    (
        output { $($(#[$doc:meta])* $Map:ident => $field:ident $name:literal)* }
        probes { $($(#[$of_probe:meta])* $Probe:ident => $plane:ident $channel:literal)* }
    ) => {
        /// One error map per kind of score, each of the output's size.
        #[derive(Clone, Debug, PartialEq)]
        pub struct Maps {
            /// Output minus the truth's mean: radiance, signed. It is for looking at; the squared
            /// error comes from the halves.
            pub signed_error: Image,
            $($(#[$doc])* pub $field: Plane,)*
        }

        /// One map per probe score.
        #[derive(Clone, Debug, PartialEq)]
        pub struct ProbeMaps {
            $($(#[$of_probe])* pub $plane: Plane,)*
        }

        /// Name of an error map, of the output or of probes.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum ErrorMap {
            $($(#[$doc])* $Map,)*
            $($(#[$of_probe])* $Probe,)*
        }

        impl ErrorMap {
            /// Every map, in the order of a file.
            pub const ALL: [ErrorMap; [$($name,)* $($channel,)*].len()] =
                [$(ErrorMap::$Map,)* $(ErrorMap::$Probe,)*];

            /// Returns the name of its channel in errors.exr.
            pub fn name(self) -> &'static str {
                match self {
                    $(ErrorMap::$Map => $name,)*
                    $(ErrorMap::$Probe => $channel,)*
                }
            }

            /// Finds this map; `None` for one of probes if none were run.
            pub(crate) fn find<'a>(
                self,
                maps: &'a Maps,
                probes: Option<&'a ProbeMaps>,
            ) -> Option<&'a Plane> {
                match self {
                    $(ErrorMap::$Map => Some(&maps.$field),)*
                    $(ErrorMap::$Probe => probes.map(|probes| &probes.$plane),)*
                }
            }
        }
    };
}

maps! {
    output {
        /// `(F - A)(F - B)` at the viewing exposure, mean over the channels; MSE and PSNR are
        /// pooled from it.
        SquaredError => squared_error "squared_error"
        /// `squared_error` over the squared truth; relMSE is pooled from it.
        RelativeSquaredError => relative_squared_error "relative_squared_error"
        /// `|F - T|` at the viewing exposure, mean over the channels; MAE is pooled from it.
        AbsoluteError => absolute_error "absolute_error"
        /// `absolute_error` over the mean of both values, in [0, 2]; SMAPE is pooled from it.
        SymmetricError => symmetric_error "symmetric_error"
        /// Structural similarity of display values, mean over the channels, in [-1, 1].
        Ssim => ssim "ssim"
        /// LDR-FLIP, in [0, 1].
        Flip => flip "flip"
        /// HDR-FLIP, in [0, 1].
        FlipHdr => flip_hdr "flip_hdr"
        /// Fraction of the shutter given to the wrong object, in [0, 1].
        LabelTotalVariation => label_total_variation "label_tv"
        /// Sum over moving objects of their matte where the truth never shows them.
        Bleed => bleed "bleed"
        /// Sum over moving objects of the squared difference of their mattes' gradient magnitudes,
        /// per square pixel.
        GradientError => gradient_error "gradient_error"
        /// `squared_error` against the truth with frozen shading.
        FrozenSquaredError => frozen_squared_error "frozen_squared_error"
        /// `|F - I|` over the brightness, root mean square of the channels, I being the instant; 0
        /// where anything moves.
        StaticChange => static_change "static_change"
    }
    probes {
        /// Difference of the sum of weights from 1.
        Unity => unity "unity"
        /// Distance between the centres of the gathered and the true origins, in pixels; 0 where
        /// undefined, and outside the knowable region.
        GatherOffset => offset "gather_offset"
        /// Difference of the spreads, in pixels; 0 there too.
        GatherSpread => spread "gather_spread"
    }
}
