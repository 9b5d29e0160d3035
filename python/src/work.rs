//! Long computations on a separate thread, with progress reports to Python and interruption by it. Main function: [`watched`].

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::Duration;

use groebot::{Error, ErrorKind, Result, Watch};
use pyo3::prelude::*;

use crate::errors::{bad_value, raised};

/// Period of progress reports and signal checks.
const PERIOD: Duration = Duration::from_millis(50);
/// Stack size for deep recursions \[bytes\].
const STACK: usize = 64 << 20;

/// Maximum number of threads of a call.
const MOST_THREADS: usize = 256;

/// A stage, the number of completed parts, and the number of known open parts.
type Step = (String, usize, usize);

/// Runs `work` on this number of threads, without holding Python's lock. All threads end before it returns. `progress(stage, done, open)` is called
/// periodically. An exception of `progress` or of a signal handler ends the work.
///
/// # Errors
/// Those of the work, of `progress`, and of signal handlers.
pub fn watched<T: Send>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    threads: usize,
    work: impl FnOnce(&Watch) -> Result<T> + Send,
) -> PyResult<T> {
    let cancel = Arc::new(AtomicBool::new(false));
    let step: Arc<Mutex<Option<Step>>> = Arc::default();
    let heard = Arc::clone(&step);
    let watch = Watch::none().with_cancel(Arc::clone(&cancel)).with_listener(move |progress| {
        let step = (progress.stage.to_owned(), progress.done, progress.open);
        *heard.lock().unwrap_or_else(PoisonError::into_inner) = Some(step);
    });
    let (finished, done) = (Mutex::new(false), Condvar::new());
    let mut interruption = None;
    let result = std::thread::scope(|scope| {
        let worker = scope.spawn(|| {
            let result = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| pooled(threads, || work(&watch))));
            *finished.lock().unwrap_or_else(PoisonError::into_inner) = true;
            done.notify_all();
            result
        });
        while !py.detach(|| wait(&finished, &done)) {
            if interruption.is_none() {
                let latest = step.lock().unwrap_or_else(PoisonError::into_inner).take();
                interruption = look(py, progress, latest).err();
                cancel.store(interruption.is_some(), Ordering::Relaxed);
            }
        }
        worker.join()
    });
    if let Some(interruption) = interruption {
        return Err(interruption);
    }
    match result {
        Ok(Ok(result)) => result.map_err(|error| raised(&error)),
        _ => Err(raised(&Error::new(
            ErrorKind::Unsupported,
            "groebot met a case that it does not expect; please report it",
        ))),
    }
}

/// Waits for the end of the work for one period. Returns whether it has ended.
fn wait(finished: &Mutex<bool>, done: &Condvar) -> bool {
    let ended = finished.lock().unwrap_or_else(PoisonError::into_inner);
    if *ended { true } else { *done.wait_timeout(ended, PERIOD).unwrap_or_else(PoisonError::into_inner).0 }
}

fn look(py: Python<'_>, progress: Option<&Bound<'_, PyAny>>, step: Option<Step>) -> PyResult<()> {
    py.check_signals()?;
    match (progress, step) {
        (Some(progress), Some(step)) => progress.call1(step).map(|_| ()),
        _ => Ok(()),
    }
}

/// Runs work that uses rayon in a separate pool.
fn pooled<T: Send>(threads: usize, work: impl FnOnce() -> Result<T> + Send) -> Result<T> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).stack_size(STACK).build();
    let failed = |error| Error::new(ErrorKind::Io, format!("no threads could be started: {error}"));
    pool.map_err(failed)?.install(work)
}

/// The requested number of threads, at most [`MOST_THREADS`]. By default, and for -1 and 0, it is the number of processors.
///
/// # Errors
/// `BadValueError` below -1.
pub fn threads(requested: Option<i64>) -> PyResult<usize> {
    match requested.unwrap_or(-1) {
        -1 | 0 => Ok(std::thread::available_parallelism().map_or(1, usize::from).min(MOST_THREADS)),
        wrong if wrong < 0 => Err(bad_value(format!("`threads` is {wrong}; give 1 or more, or -1 for all processors"))),
        count => Ok(usize::try_from(count).unwrap_or(MOST_THREADS).min(MOST_THREADS)),
    }
}
