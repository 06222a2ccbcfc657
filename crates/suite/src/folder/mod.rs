//! Output folders: who writes there, and what must not lie there.

pub mod claim;
pub mod numbered;
pub mod placed_file;
pub mod scene_folder;
pub mod tracked;
