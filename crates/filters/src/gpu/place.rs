//! Place of an error on the GPU: the filter and the pass.

use super::device::Gpu;
use crate::{Filter, FilterError};

/// Filter and pass that an error belongs to.
#[derive(Clone, Copy)]
pub(super) struct Place<'a> {
    pub filter: &'a str,
    pub pass: &'a str,
}

impl Place<'_> {
    /// Makes an error that names the place.
    pub(super) fn refuse(self, reason: impl ToString) -> FilterError {
        FilterError::Gpu {
            filter: self.filter.to_owned(),
            pass: self.pass.to_owned(),
            reason: reason.to_string(),
        }
    }
}

impl Filter {
    /// Names a pass of this filter, for errors.
    pub(super) fn place<'a>(&'a self, pass: &'a str) -> Place<'a> {
        Place {
            filter: &self.name,
            pass,
        }
    }
}

impl Gpu {
    /// Does `work`, and returns an error that names the place if wgpu refuses any of it or the
    /// device gets lost.
    pub(super) fn catch_errors<T>(
        &self,
        place: Place,
        work: impl FnOnce() -> T,
    ) -> Result<T, FilterError> {
        let done = self.catch(work);
        self.check_loss(place)?;
        done.map_err(|error| place.refuse(error))
    }

    /// Returns an error that names the place if the device is lost.
    pub(super) fn check_loss(&self, place: Place) -> Result<(), FilterError> {
        match self.find_loss() {
            None => Ok(()),
            Some(reason) => Err(FilterError::Lost {
                filter: place.filter.to_owned(),
                pass: place.pass.to_owned(),
                adapter: self.adapter.name.clone(),
                reason,
            }),
        }
    }

    /// Does `work`, and returns what wgpu says if it refuses any of it. After a loss of the device,
    /// everything seems to work.
    pub(super) fn catch<T>(&self, work: impl FnOnce() -> T) -> Result<T, String> {
        let [memory, internal, validation] = [
            wgpu::ErrorFilter::OutOfMemory,
            wgpu::ErrorFilter::Internal,
            wgpu::ErrorFilter::Validation,
        ]
        .map(|kind| self.device().push_error_scope(kind));
        let value = work();
        let errors = [validation, internal, memory].map(|scope| pollster::block_on(scope.pop()));
        match errors.into_iter().flatten().next() {
            None => Ok(value),
            Some(error) => Err(error.to_string()),
        }
    }
}
