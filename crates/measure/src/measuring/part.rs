//! Part of a run for one process, so that others can measure the rest.

use crate::named;

named! {
    /// Part of a run's cases.
    pub enum Part {
        /// References and filters.
        Whole = "whole",
        /// References for the shutters of all filters, and no filter.
        References = "references",
        /// Filters, and no reference.
        Filters = "filters",
    }
}

impl Part {
    /// Returns whether the part includes a reference or a filter's case.
    pub fn holds(self, is_reference: bool) -> bool {
        match self {
            Self::Whole => true,
            Self::References => is_reference,
            Self::Filters => !is_reference,
        }
    }
}
