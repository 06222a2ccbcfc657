//! Pictures of a case, which the page draws from their numbers.

use serde::Serialize;

/// One picture of a case, which its hint explains.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Layer {
    Truth,
    TracedTruth,
    Output,
    Instant,
    Flip,
    SignedError,
    Bleed,
    LabelTotalVariation,
    Knowability,
    Velocity,
    Depth,
    Dilated,
}

/// Ways to turn numbers into colours, by the words that the script reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Painter {
    /// Radiance, as a display shows it at the chosen exposure.
    Radiance,
    /// The brightness of a difference of radiance, about grey.
    Signed,
    /// A number from 0 to 1, from dark to bright.
    Share,
    /// One number per side of a mover, each in a colour of its own.
    Sides,
    /// A direction as a hue, a speed as its strength.
    Motion,
    /// A distance, near to far.
    Distance,
}

impl Layer {
    /// Every picture, in the order of a page.
    pub const ALL: [Layer; 12] = [
        Layer::Truth,
        Layer::TracedTruth,
        Layer::Output,
        Layer::Instant,
        Layer::Flip,
        Layer::SignedError,
        Layer::Bleed,
        Layer::LabelTotalVariation,
        Layer::Knowability,
        Layer::Velocity,
        Layer::Depth,
        Layer::Dilated,
    ];

    /// The word in attributes.
    pub fn name(self) -> &'static str {
        match self {
            Layer::Truth => "truth",
            Layer::TracedTruth => "traced_truth",
            Layer::Output => "output",
            Layer::Instant => "instant",
            Layer::Flip => "flip",
            Layer::SignedError => "signed",
            Layer::Bleed => "bleed",
            Layer::LabelTotalVariation => "label_tv",
            Layer::Knowability => "unknowable",
            Layer::Velocity => "velocity",
            Layer::Depth => "depth",
            Layer::Dilated => "dilated",
        }
    }

    /// Names the picture for a reader.
    pub fn title(self) -> &'static str {
        match self {
            Layer::Truth => "Truth",
            Layer::TracedTruth => "Path-traced truth",
            Layer::Output => "Output",
            Layer::Instant => "Instant",
            Layer::Flip => "FLIP",
            Layer::SignedError => "Signed error",
            Layer::Bleed => "Bleed",
            Layer::LabelTotalVariation => "Label TV",
            Layer::Knowability => "Knowability",
            Layer::Velocity => "Velocity",
            Layer::Depth => "Depth",
            Layer::Dilated => "Dilated map",
        }
    }

    /// Explains the picture.
    pub fn hint(self) -> &'static str {
        match self {
            Layer::Truth => "what the open shutter saw, path traced",
            Layer::TracedTruth => {
                "what our tracer saw of the same scene, through the same shutter; no score here is against it"
            }
            Layer::Output => "what the filter made of the instant",
            Layer::Instant => "the frame that the filter got: sharp, at one instant",
            Layer::Flip => "visible difference from the truth",
            Layer::SignedError => "brightness of the output minus that of the truth",
            Layer::Bleed => {
                "mover where the truth never shows it, by the side as seen along its motion"
            }
            Layer::LabelTotalVariation => "share of the shutter that went to the wrong object",
            Layer::Knowability => {
                "share of the shutter that saw what the instant's frame does not show"
            }
            Layer::Velocity => "motion of the instant, in pixels per frame",
            Layer::Depth => "distance along the view axis at the instant, in metres",
            Layer::Dilated => {
                "the velocity that the filter carried to each pixel before it gathered"
            }
        }
    }

    /// Chooses how it is drawn.
    pub fn painter(self) -> Painter {
        match self {
            Layer::Truth | Layer::TracedTruth | Layer::Output | Layer::Instant => Painter::Radiance,
            Layer::SignedError => Painter::Signed,
            Layer::Flip | Layer::LabelTotalVariation | Layer::Knowability => Painter::Share,
            Layer::Bleed => Painter::Sides,
            Layer::Velocity | Layer::Dilated => Painter::Motion,
            Layer::Depth => Painter::Distance,
        }
    }

    /// Names its numbers in the read-out, in the order of its planes.
    pub fn components(self) -> &'static str {
        match self.painter() {
            Painter::Radiance | Painter::Signed => "R G B",
            Painter::Share => "",
            Painter::Sides => "beside ahead behind",
            Painter::Motion => "x y",
            Painter::Distance => "m",
        }
    }
}
