//! Scenes: how folders are read and refused, and what the built-in ones show.

mod appearance;
mod built_in;
mod catalogue;
mod reading;
mod refusals;
mod scene_folder;
