//! Questions that people are asked.

use suite::named;

named! {
    /// A question about two clips.
    pub enum Question {
        /// Which of the two looks more like the truth shown above them.
        Truth = "truth",
        /// Which of the two looks better; no truth is shown.
        Better = "better",
    }
}

impl Question {
    /// Returns the words that people read.
    pub fn text(self) -> &'static str {
        match self {
            Self::Truth => "Which looks more like the truth?",
            Self::Better => "Which looks better?",
        }
    }
}
