//! A run as its page shows it.

use judge::Verdict;

use crate::addition::Addition;
use crate::case::case_view::CaseView;
use crate::case_table::CaseTable;

/// A run with everything that its overview and the sections of its filters show.
pub struct RunView<'a> {
    pub table: &'a CaseTable<'a>,
    /// The cases in the order of the run.
    pub cases: &'a [CaseView<'a>],
    /// Addresses of the scenes' truths.
    pub thumbnails: &'a [String],
    pub verdict: Option<&'a Verdict>,
    /// Contents of other crates.
    pub additions: &'a [Addition],
}
