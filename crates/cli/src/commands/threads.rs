//! Threads of a command.

use suite::Error;

/// Threads that one command may have.
const MAX_THREADS: usize = 1024;

/// Works on a pool of its own: one thread per core, or as many as are asked for.
pub fn work_on_threads<T: Send>(
    threads: Option<usize>,
    work: impl FnOnce() -> Result<T, Error> + Send,
) -> Result<T, Error> {
    if let Some(threads) = threads
        && !(1..=MAX_THREADS).contains(&threads)
    {
        refuse!("--threads {threads}; allowed: 1 to {MAX_THREADS}");
    }
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads.unwrap_or(0))
        .build()
        .map_err(|error| Error::Usage(format!("cannot start the threads: {error}")))?
        .install(work)
}
