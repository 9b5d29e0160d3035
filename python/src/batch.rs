//! Solution of many targets on several threads, into arrays in the order of the targets. Main function: [`solve_all`].
//!
//! One thread writes directly to the output. With several, each takes chunks of targets, solves them into its own rows, and copies them to the output in the
//! order of the chunks. All threads end before the call returns. No thread pool is used, so a forked process can also solve.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use pyo3::{PyResult, Python};

use crate::choose::Choice;
use crate::kernel::Kernel;
use crate::sink::{Rows, Sink, Status};
use crate::targets::Targets;

/// Number of targets in a chunk.
const CHUNK: usize = 512;
/// Interval between checks for an interruption.
const PATIENCE: Duration = Duration::from_millis(50);

/// The output arrays.
pub struct Room<'a> {
    pub rows: Rows<'a>,
    /// Number of solutions of each target.
    pub counts: &'a mut [i64],
    /// [`Status`] of each target.
    pub status: &'a mut [u8],
}

/// The work: solver, targets and options.
#[derive(Clone, Copy)]
pub struct Job<'a> {
    pub kernel: &'a dyn Kernel,
    pub targets: &'a Targets<'a>,
    pub choice: &'a Choice<'a>,
}

/// Solves all targets on this number of threads. Returns the number of solutions, or `None` when the output has too few
/// rows.
///
/// # Errors
/// The exception that a signal handler raises, such as `KeyboardInterrupt`.
pub fn solve_all(job: Job<'_>, threads: usize, room: Room<'_>) -> PyResult<Option<usize>> {
    let helpers = threads.min(job.targets.len().div_ceil(CHUNK)).saturating_sub(1);
    if helpers == 0 { solve_here(job, room) } else { solve_together(job, helpers, room) }
}

impl Job<'_> {
    /// Solves a range of targets.
    fn solve(&self, rows: std::ops::Range<usize>, sink: &mut Sink<'_>) {
        let wants_all = self.choice.limits.is_none() && self.choice.near.is_none();
        self.kernel.batch(self.targets, rows, sink, &mut |sink, target, begun, why| {
            if wants_all {
                sink.end(begun, why);
            } else {
                self.choice.end(self.kernel, self.targets, sink, target, begun, why);
            }
        });
    }

    fn joints(&self) -> usize {
        self.kernel.shape().turns.len()
    }
}

/// Periodic check for signals.
struct Lookout(Instant);

impl Lookout {
    fn look(&mut self) -> PyResult<()> {
        if self.0.elapsed() < PATIENCE {
            return Ok(());
        }
        self.0 = Instant::now();
        Python::attach(|py| py.check_signals())
    }
}

/// Solves on the calling thread alone.
fn solve_here(job: Job<'_>, room: Room<'_>) -> PyResult<Option<usize>> {
    let mut sink = Sink::new(job.joints(), room.rows, room.counts, room.status);
    let mut lookout = Lookout(Instant::now());
    for first in (0..job.targets.len()).step_by(CHUNK) {
        lookout.look()?;
        job.solve(first..job.targets.len().min(first + CHUNK), &mut sink);
        if sink.is_full {
            return Ok(None);
        }
    }
    Ok(Some(sink.taken))
}

/// Solves with additional threads.
fn solve_together(job: Job<'_>, helpers: usize, room: Room<'_>) -> PyResult<Option<usize>> {
    let work = Work {
        job,
        open: Mutex::new(Open { next: 0, counts: room.counts, status: room.status }),
        rest: Mutex::new(Rest { turn: 0, taken: 0, rows: Some(room.rows) }),
        turned: Condvar::new(),
        is_full: AtomicBool::new(false),
        is_stopped: AtomicBool::new(false),
    };
    let mut lookout = Lookout(Instant::now());
    std::thread::scope(|scope| {
        for _ in 0..helpers {
            scope.spawn(|| work.run(|| Ok(())));
        }
        work.run(|| lookout.look())
    })?;
    let rest = work.rest.into_inner().unwrap_or_else(PoisonError::into_inner);
    Ok((!work.is_full.into_inner()).then_some(rest.taken))
}

/// The rows that are not assigned yet.
struct Rest<'a> {
    /// The chunk that is copied next.
    turn: usize,
    taken: usize,
    rows: Option<Rows<'a>>,
}

/// The targets that no thread has taken yet: the output for their counts and status.
struct Open<'a> {
    next: usize,
    counts: &'a mut [i64],
    status: &'a mut [u8],
}

/// The data that all threads share.
struct Work<'a> {
    job: Job<'a>,
    open: Mutex<Open<'a>>,
    rest: Mutex<Rest<'a>>,
    turned: Condvar,
    is_full: AtomicBool,
    is_stopped: AtomicBool,
}

impl<'a> Work<'a> {
    /// Solves chunks until none is left.
    fn run(&self, mut look: impl FnMut() -> PyResult<()>) -> PyResult<()> {
        let _guard = Guard(self);
        let (shape, joints) = (self.job.kernel.shape(), self.job.joints());
        // A chunk of singular targets needs more rows than others.
        let mut room = CHUNK * shape.usual + shape.capacity;
        let (mut q, mut residual) = (vec![0.0; room * joints], vec![0.0; room]);
        let (mut branch, mut free) = (vec![0; room], vec![0; room]);
        while let Some((number, counts, status)) = self.take() {
            if let Err(interruption) = look() {
                self.stop(&self.is_stopped);
                return Err(interruption);
            }
            let targets = number * CHUNK..number * CHUNK + counts.len();
            let taken = loop {
                let rows = Rows { q: &mut q, residual: &mut residual, branch: &mut branch, free: &mut free };
                let mut sink = Sink::new(joints, rows, counts, status);
                self.job.solve(targets.clone(), &mut sink);
                if !sink.is_full {
                    break sink.taken;
                }
                room = CHUNK * shape.capacity;
                q.resize(room * joints, 0.0);
                residual.resize(room, 0.0);
                branch.resize(room, 0);
                free.resize(room, 0);
            };
            let Some(mut place) = self.place(number, taken, joints) else { return Ok(()) };
            let rows = Rows { q: &mut q, residual: &mut residual, branch: &mut branch, free: &mut free };
            place.copy_from(&rows, taken, joints);
        }
        Ok(())
    }

    /// Stops all threads.
    fn stop(&self, why: &AtomicBool) {
        why.store(true, Ordering::Relaxed);
        self.turned.notify_all();
    }

    fn has_stopped(&self) -> bool {
        self.is_full.load(Ordering::Relaxed) || self.is_stopped.load(Ordering::Relaxed)
    }

    /// Takes the next chunk: its number, and the output for its counts and status.
    fn take(&self) -> Option<(usize, &'a mut [i64], &'a mut [u8])> {
        let mut open = locked(&self.open);
        let size = open.counts.len().min(CHUNK);
        if size == 0 || self.has_stopped() {
            return None;
        }
        open.next += 1;
        let number = open.next - 1;
        let counts = open.counts.split_off_mut(..size)?;
        let status = open.status.split_off_mut(..size)?;
        Some((number, counts, status))
    }

    /// The output rows for the solutions of a chunk, when the chunks before it have their rows. `None` when there are
    /// too few rows, or the threads are stopped.
    fn place(&self, number: usize, answers: usize, joints: usize) -> Option<Rows<'a>> {
        let mut rest = locked(&self.rest);
        while rest.turn != number {
            if self.has_stopped() {
                return None;
            }
            rest = self.turned.wait_timeout(rest, PATIENCE).unwrap_or_else(PoisonError::into_inner).0;
        }
        let Some(rows) = rest.rows.take().filter(|rows| rows.len() >= answers) else {
            self.stop(&self.is_full);
            return None;
        };
        let (own, later) = rows.split(answers, joints);
        rest.rows = Some(later);
        rest.turn += 1;
        rest.taken += answers;
        self.turned.notify_all();
        Some(own)
    }
}

/// Stops all threads when one of them panics, because its chunk is never completed.
struct Guard<'w, 'a>(&'w Work<'a>);

impl Drop for Guard<'_, '_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.0.stop(&self.0.is_stopped);
        }
    }
}

/// The content of a lock, also after a panic of another thread. The data are consistent, and the panic is propagated
/// when all threads are joined.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The text for a status.
pub fn reason(status: u8) -> &'static str {
    const WORDS: [(Status, &str); 7] = [
        (Status::Unreachable, "is out of reach"),
        (Status::NotFinite, "has a number that is infinite or none; give finite numbers"),
        (
            Status::NotRotation,
            "has no rotation; give a right-handed rotation matrix with last row 0, 0, 0, 1, or a quaternion x, y, z, w of length one, within `tolerance` (default 1e-5, at most 0.1)",
        ),
        (Status::NotUnit, "has a direction that is not of length one within 1e-9; give a unit vector"),
        (Status::Open, "is on a stratum that could not be derived"),
        (Status::BeyondLimits, "has solutions beyond the limits only"),
        (Status::Unsettled, "took more steps than a target may: not all work on it was done"),
    ];
    WORDS.iter().find(|(known, _)| *known as u8 == status).map_or("is solved", |(_, word)| word)
}
