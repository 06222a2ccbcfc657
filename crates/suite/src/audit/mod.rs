//! Audit of an engine's velocity and depth against those of the scene that it drew.

mod audit_pictures;
mod capture_audit;
mod cause;
mod clear_pixels;
mod depth_audit;
mod expected_motion;
mod velocity_audit;

pub use audit_pictures::write_audit_picture;
pub use capture_audit::{CaptureAudit, audit_capture};
pub use cause::{Cause, Defect};
pub use depth_audit::DepthAudit;
pub use velocity_audit::ObjectAudit;
