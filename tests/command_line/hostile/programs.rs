//! Filters that are programs, and output folders of runs.

mod evidence;
#[cfg(unix)]
mod folder;
#[cfg(unix)]
mod run;
