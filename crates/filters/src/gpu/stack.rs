//! A thread with a known stack, for code of others that recurses.

use std::{any::Any, thread};

/// Bytes of stack on which kernels are read and compiled. Naga takes less than 2 KB per level of
/// [`MAX_NESTING`](super::MAX_NESTING), and less than 1 KB per declaration that refers to another one.
const STACK_BYTES: usize = 64 << 20;

/// Does the work on a thread with a large stack. An error where no thread can be started, or where the work panics: the
/// text says why.
pub(super) fn on_stack<T: Send>(work: impl FnOnce() -> T + Send) -> Result<T, String> {
    thread::scope(|scope| {
        let thread = thread::Builder::new()
            .name("kernels".into())
            .stack_size(STACK_BYTES)
            .spawn_scoped(scope, work)
            .map_err(|error| format!("no thread could be started: {error}"))?;
        thread.join().map_err(|panic| said(&*panic))
    })
}

/// The message of a panic.
fn said(panic: &(dyn Any + Send)) -> String {
    let text = (panic.downcast_ref::<String>().map(String::as_str))
        .or(panic.downcast_ref::<&str>().copied());
    text.unwrap_or("it gave no reason").to_owned()
}
