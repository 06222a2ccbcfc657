//! Adapters with compiled kernels, which the tests of a program pass on to one another.

use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

use filters::{Blur, Filter, Gpu, Kernels, Settings};
use frame::Size;

use crate::open_gpu;

/// An adapter and its compiled kernels.
struct Device {
    gpu: &'static Gpu,
    kernels: Mutex<BTreeMap<String, Kernels<'static>>>,
}

/// A device that one thread owns until its end. No two threads may catch errors of a device at the
/// same time.
struct Lent(&'static Device);

static IDLE: Mutex<Vec<&'static Device>> = Mutex::new(Vec::new());

thread_local! {
    static LENT: Lent = Lent::new();
}

impl Lent {
    fn new() -> Self {
        let idle = lock(&IDLE).pop();
        Self(idle.unwrap_or_else(|| {
            Box::leak(Box::new(Device {
                gpu: Box::leak(Box::new(open_gpu())),
                kernels: Mutex::default(),
            }))
        }))
    }
}

impl Drop for Lent {
    fn drop(&mut self) {
        lock(&IDLE).push(self.0);
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Returns an adapter for this thread alone, which later tests reuse.
pub fn shared_gpu() -> &'static Gpu {
    LENT.with(|lent| lent.0.gpu)
}

/// Prepares a built-in filter for pictures of a size, in pixels. Its kernels are compiled once per
/// adapter.
pub fn ready_blur(filter: &Filter, settings: &Settings, size: impl Into<Size>) -> Blur<'static> {
    let Size { width, height } = size.into();
    LENT.with(|lent| {
        let mut compiled = lock(&lent.0.kernels);
        let compile = || Kernels::compile(lent.0.gpu, filter).expect("built-in filters compile");
        let kernels = (compiled.entry(filter.name.clone())).or_insert_with(compile);
        Blur::with_kernels(kernels, settings, width, height).expect("settings and size fit")
    })
}
