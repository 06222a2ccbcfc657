//! Numbers behind the pictures of a page, and the files that hold them.

pub mod layer;
pub mod planes;
pub mod png;
pub mod report_files;
pub mod scene_files;
