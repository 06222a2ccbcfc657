//! Part of a run that one process measures, so that others can measure the rest.

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
    /// Tells whether a reference, or a filter's case, belongs to it.
    pub fn holds(self, is_reference: bool) -> bool {
        match self {
            Self::Whole => true,
            Self::References => is_reference,
            Self::Filters => !is_reference,
        }
    }
}
