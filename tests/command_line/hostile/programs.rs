//! Filters that are programs, and the folders that runs write to.
