//! Filters that are programs, and the folders that runs write to.

mod evidence;
#[cfg(unix)]
mod folder;
#[cfg(unix)]
mod run;
mod service;
