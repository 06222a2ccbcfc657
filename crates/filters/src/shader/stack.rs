//! Thread with a large stack, for libraries that recurse.

use std::any::Any;
use std::path::Path;
use std::sync::Once;
use std::{panic, thread};

use crate::FilterError;

/// Bytes of stack for reading and compiling kernels. Naga takes less than 2 KB per level of
/// the 1000 that `shader_import` allows, and less than 1 KB per declaration that refers to another
/// one.
const STACK_BYTES: usize = 64 << 20;

/// Name of such threads.
const NAME: &str = "kernels";

/// Does the work on a thread with a large stack. Fails if no thread can be started or the work
/// panics, and says why. Such a panic is not printed: it becomes an error.
pub(crate) fn run_on_large_stack<T: Send>(work: impl FnOnce() -> T + Send) -> Result<T, String> {
    keep_panics_unprinted();
    thread::scope(|scope| {
        let thread = thread::Builder::new()
            .name(NAME.into())
            .stack_size(STACK_BYTES)
            .spawn_scoped(scope, work)
            .map_err(|error| format!("no thread could be started: {error}"))?;
        thread.join().map_err(|panic| message_of(&*panic))
    })
}

/// Does work of naga on the shader at `path` on such a thread, and makes an error of a panic.
pub(crate) fn guard<T: Send>(
    path: &Path,
    task: &str,
    work: impl FnOnce() -> Result<T, FilterError> + Send,
) -> Result<T, FilterError> {
    run_on_large_stack(work).unwrap_or_else(|panic| {
        let reason = format!(
            "naga, which {task}, fails on it: {panic}; write it otherwise, or make it smaller"
        );
        Err(FilterError::in_file(path, None, reason))
    })
}

/// Keeps panics of such threads from being printed.
fn keep_panics_unprinted() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let print = panic::take_hook();
        panic::set_hook(Box::new(move |panic| {
            if thread::current().name() != Some(NAME) {
                print(panic);
            }
        }));
    });
}

/// Returns the message of a panic.
fn message_of(panic: &(dyn Any + Send)) -> String {
    let text = (panic.downcast_ref::<String>().map(String::as_str))
        .or(panic.downcast_ref::<&str>().copied());
    text.unwrap_or("it gave no reason").to_owned()
}
