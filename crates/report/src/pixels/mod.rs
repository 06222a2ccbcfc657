//! Numbers of a page's pictures, and the files that contain them.

pub mod layer;
pub mod planes;
pub mod png;
pub mod report_files;
pub mod scene_files;
