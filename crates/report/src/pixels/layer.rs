//! Pictures of a case, which the page draws from their numbers.

use measure::named;

named! {
    /// One picture of a case, in the order of a page.
    pub enum Layer {
        /// what the open shutter saw, path traced
        Truth = "truth",
        /// what our tracer saw of the same scene, through the same shutter; no score here is
        /// against it
        TracedTruth = "traced_truth",
        /// what the filter made of the instant
        Output = "output",
        /// what the filter makes of the instant on this computer, with the values and the shader of
        /// the panel
        Live = "live",
        /// the frame that the filter got: sharp, at one instant
        Instant = "instant",
        /// visible difference from the truth
        Flip = "flip",
        /// visible difference of the live picture from the truth
        LiveFlip = "live_flip",
        /// brightness of the output minus that of the truth
        SignedError = "signed",
        /// mover where the truth never shows it, by the side as seen along its motion
        Bleed = "bleed",
        /// share of the shutter that went to the wrong object
        LabelTotalVariation = "label_tv",
        /// share of the shutter that saw what the instant's frame does not show
        Knowability = "unknowable",
        /// motion of the instant, in pixels per frame
        Velocity = "velocity",
        /// distance along the view axis at the instant, in metres
        Depth = "depth",
        /// the velocity that the filter carried to each pixel before it gathered
        Dilated = "dilated",
    }
}

named! {
    /// Ways to turn numbers into colours, by the words that the script reads.
    pub enum Painter {
        /// Radiance, as a display shows it at the chosen exposure.
        Radiance = "radiance",
        /// The brightness of a difference of radiance, about grey.
        Signed = "signed",
        /// A number from 0 to 1, from dark to bright.
        Share = "share",
        /// One number per side of a mover, each in a colour of its own.
        Sides = "sides",
        /// A direction as a hue, a speed as its strength.
        Motion = "motion",
        /// A distance, near to far.
        Distance = "distance",
    }
}

impl Layer {
    /// Names the picture for a reader.
    pub fn title(self) -> &'static str {
        match self {
            Layer::Truth => "Truth",
            Layer::TracedTruth => "Path-traced truth",
            Layer::Output => "Output",
            Layer::Live => "Live",
            Layer::Instant => "Instant",
            Layer::Flip => "FLIP",
            Layer::LiveFlip => "Live FLIP",
            Layer::SignedError => "Signed error",
            Layer::Bleed => "Bleed",
            Layer::LabelTotalVariation => "Label TV",
            Layer::Knowability => "Knowability",
            Layer::Velocity => "Velocity",
            Layer::Depth => "Depth",
            Layer::Dilated => "Dilated map",
        }
    }

    /// Chooses how it is drawn.
    pub fn painter(self) -> Painter {
        match self {
            Layer::Truth | Layer::TracedTruth | Layer::Output | Layer::Live | Layer::Instant => {
                Painter::Radiance
            }
            Layer::SignedError => Painter::Signed,
            Layer::Flip | Layer::LiveFlip | Layer::LabelTotalVariation | Layer::Knowability => {
                Painter::Share
            }
            Layer::Bleed => Painter::Sides,
            Layer::Velocity | Layer::Dilated => Painter::Motion,
            Layer::Depth => Painter::Distance,
        }
    }

    /// Names its numbers in the read-out, in the order of its planes.
    pub fn components(self) -> &'static [&'static str] {
        match self.painter() {
            Painter::Radiance | Painter::Signed => &["R", "G", "B"],
            Painter::Share => &[],
            Painter::Sides => &["beside", "ahead", "behind"],
            Painter::Motion => &["x", "y"],
            Painter::Distance => &["m"],
        }
    }
}
