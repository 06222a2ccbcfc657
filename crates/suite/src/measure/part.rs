//! Part of a run that one process measures, so that others can measure the rest.

/// Part of a run's cases.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Part {
    /// References and filters.
    #[default]
    Whole,
    /// The references alone.
    References,
    /// The filters alone.
    Filters,
}

impl Part {
    /// The parts that are not the whole.
    pub const PARTS: &'static [Self] = &[Self::References, Self::Filters];

    /// The word on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Whole => "whole",
            Self::References => "references",
            Self::Filters => "filters",
        }
    }

    /// What it holds, in one line.
    pub fn help(self) -> &'static str {
        match self {
            Self::Whole => "References and filters",
            Self::References => "References for the shutters of all filters, and no filter",
            Self::Filters => "Filters, and no reference",
        }
    }

    /// Tells whether a reference, or a filter's case, belongs to it.
    pub fn holds(self, is_reference: bool) -> bool {
        match self {
            Self::Whole => true,
            Self::References => is_reference,
            Self::Filters => !is_reference,
        }
    }
}
