//! Errors of labels: which object the shutter's time was given to.

pub mod total_variation;
