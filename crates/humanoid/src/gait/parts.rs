//! Work on the samples of a walk, in parts, on threads of their own where there are many.

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::{Result, Watch};

/// In how many parts a walk is solved, each on a thread of its own; their number does not depend on the machine, so that the same walk
/// comes out everywhere.
const PARTS: usize = 4;
/// Fewer samples than this are solved part by part on the caller's thread: threads would take longer to start.
const FEW: usize = 1024;
/// After how many samples progress is told.
const REPORTED: usize = 64;

/// What `solve` makes of each sample of `0..count`; it gets the samples of a part and answers for them in turn.
///
/// # Errors
/// Those of `solve`, the earliest part's; [`crate::ErrorKind::Cancelled`] and [`crate::ErrorKind::Budget`].
pub(super) fn in_parts<T: Send, I: Iterator<Item = Result<T>>>(
    count: usize,
    watch: &Watch,
    solve: impl Fn(Range<usize>) -> I + Sync,
) -> Result<Vec<T>> {
    let (done, size) = (AtomicUsize::new(0), count.div_ceil(PARTS).max(1));
    let part = |start: usize| {
        let end = (start + size).min(count);
        let told = solve(start..end).enumerate().map(|(sample, solved)| {
            if sample % REPORTED == 0 {
                watch.check()?;
                let done = done.fetch_add(REPORTED.min(end - start - sample), Ordering::Relaxed);
                watch.report("samples of the walk", done, count - done);
            }
            solved
        });
        told.collect::<Result<Vec<T>>>()
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
