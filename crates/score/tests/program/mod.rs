//! `score` as its user sees it.

mod truth;
mod two_pictures;
