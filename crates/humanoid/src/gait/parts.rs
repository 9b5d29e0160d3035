//! Parallel work on the samples of a walk.

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::{Result, Watch};

/// The number of parts that a walk is solved in, each on its own thread. It does not depend on the machine, so that the
/// result is the same everywhere.
const PARTS: usize = 4;
/// Below this number of samples the parts are solved on the caller's thread, because threads would take longer to
/// start.
const FEW: usize = 1024;
/// The number of samples between two reports of progress.
const REPORTED: usize = 64;

/// Applies `solve` to each sample of `0..count`; it gets the samples of a part and returns their results in order.
///
/// # Errors
/// The first error of `solve` in the order of the samples; [`crate::ErrorKind::Cancelled`] and
/// [`crate::ErrorKind::Budget`].
pub(super) fn in_parts<T: Send, I: Iterator<Item = Result<T>>>(
    count: usize,
    watch: &Watch,
    solve: impl Fn(Range<usize>) -> I + Sync,
) -> Result<Vec<T>> {
    let (done, size) = (AtomicUsize::new(0), count.div_ceil(PARTS).max(1));
    let part = |start: usize| {
        let end = (start + size).min(count);
        let results = solve(start..end).enumerate().map(|(sample, solved)| {
            if sample % REPORTED == 0 {
                watch.check()?;
                let done = done.fetch_add(REPORTED.min(end - start - sample), Ordering::Relaxed);
                watch.report("samples of the walk", done, count - done);
            }
            solved
        });
        results.collect::<Result<Vec<T>>>()
    };
    let starts = (0..count).step_by(size);
    // In the browser there are no threads.
    if count < FEW || cfg!(target_family = "wasm") {
        return Ok(starts.map(part).collect::<Result<Vec<_>>>()?.into_iter().flatten().collect());
    }
    let parts: Vec<Result<Vec<T>>> = std::thread::scope(|scope| {
        let part = &part;
        let spawned: Vec<_> = starts.map(|start| scope.spawn(move || part(start))).collect();
        let joined = spawned.into_iter().map(|part| part.join());
        joined.map(|part| part.unwrap_or_else(|panic| std::panic::resume_unwind(panic))).collect()
    });
    Ok(parts.into_iter().collect::<Result<Vec<_>>>()?.into_iter().flatten().collect())
}
