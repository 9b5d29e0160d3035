//! Many targets on several threads, into arrays in which the answers stand in the order of the targets. Main function: [`solve_all`].
//!
//! Threads take chunks of targets, solve each into rows of their own, and when it is a chunk's turn get its place in the arrays. No thread outlives the
//! call, and no pool is asked: a process that was forked solves as well.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use pyo3::{PyErr, PyResult, Python};

use crate::choose::Choice;
use crate::kernel::Kernel;
use crate::sink::{Sink, Status};
use crate::targets::Targets;

/// How many targets are one piece of work.
const CHUNK: usize = 512;
/// How long it takes until an interruption is seen.
const PATIENCE: Duration = Duration::from_millis(50);

/// The answers for many targets.
#[derive(Debug, Default)]
pub struct Answers {
    /// Row by row; empty where room was lent.
    pub q: Vec<f64>,
    pub residual: Vec<f64>,
    pub branch: Vec<i32>,
    pub free: Vec<u32>,
    /// Where the answers of each target begin, and behind the last target the number of all.
    pub starts: Vec<i64>,
    /// By target, its [`Status`].
    pub status: Vec<u8>,
}

impl Answers {
    pub fn count(&self) -> usize {
        self.residual.len()
    }
}

/// The arrays from where the next answers go on.
struct Rest<'a> {
    turn: usize,
    q: &'a mut [f64],
    residual: &'a mut [f64],
    branch: &'a mut [i32],
    free: &'a mut [u32],
}

/// Where the numbers of targets that nobody has taken go.
struct Open<'a> {
    next: usize,
    counts: &'a mut [i64],
    status: &'a mut [u8],
}

/// What all threads share.
struct Work<'a> {
    kernel: &'a dyn Kernel,
    targets: &'a Targets<'a>,
    choice: &'a Choice<'a>,
    open: Mutex<Open<'a>>,
    rest: Mutex<Rest<'a>>,
    turned: Condvar,
    is_full: AtomicBool,
    is_stopped: AtomicBool,
}

/// Solves all targets on so many threads, with the joint values in `out` where that is lent; `None` when `out` has too few rows.
///
/// # Errors
/// What a signal raises, such as `KeyboardInterrupt`.
pub fn solve_all(
    kernel: &dyn Kernel,
    targets: &Targets<'_>,
    choice: &Choice<'_>,
    threads: usize,
    mut out: Option<&mut [f64]>,
) -> PyResult<Option<Answers>> {
    let shape = kernel.shape();
    let usual = if choice.near.is_some() { 1 } else { shape.usual };
    let spare = shape.capacity;
    // Targets that have more answers than ordinary ones are rare: only then is there room for all that may be.
    for room in [targets.len() * usual + spare, targets.len() * shape.capacity] {
        let mut lent = Vec::new();
        let q = match out.as_deref_mut() {
            Some(out) => out,
            None => {
                lent = vec![0.0; room * shape.turns.len()];
                &mut lent[..]
            }
        };
        if let Some(mut answers) = solve_in(kernel, targets, choice, threads, room, q)? {
            if out.is_none() {
                lent.truncate(answers.count() * shape.turns.len());
                lent.shrink_to_fit();
                answers.q = lent;
            }
            return Ok(Some(answers));
        }
    }
    Ok(None)
}

/// The same in room for so many answers; `None` when it is too little.
fn solve_in(
    kernel: &dyn Kernel,
    targets: &Targets<'_>,
    choice: &Choice<'_>,
    threads: usize,
    room: usize,
    q: &mut [f64],
) -> PyResult<Option<Answers>> {
    let count = targets.len();
    let mut residual = vec![0.0; room];
    let (mut branch, mut free) = (vec![0; room], vec![0; room]);
    let (mut starts, mut status) = (vec![0; count + 1], vec![0; count]);
    let work = Work {
        kernel,
        targets,
        choice,
        open: Mutex::new(Open { next: 0, counts: &mut starts[1..], status: &mut status }),
        rest: Mutex::new(Rest { turn: 0, q, residual: &mut residual, branch: &mut branch, free: &mut free }),
        turned: Condvar::new(),
        is_full: AtomicBool::new(false),
        is_stopped: AtomicBool::new(false),
    };
    let helpers = threads.min(count.div_ceil(CHUNK)).saturating_sub(1);
    let outcome = std::thread::scope(|scope| {
        for _ in 0..helpers {
            scope.spawn(|| work.run(|| Ok(())));
        }
        let mut looked = Instant::now();
        work.run(|| {
            if looked.elapsed() < PATIENCE {
                return Ok(());
            }
            looked = Instant::now();
            Python::attach(|py| py.check_signals())
        })
    });
    outcome?;
    if work.is_full.into_inner() {
        return Ok(None);
    }
    let mut all = 0;
    for start in &mut starts[1..] {
        all += *start;
        *start = all;
    }
    let all = all as usize;
    residual.truncate(all);
    branch.truncate(all);
    free.truncate(all);
    residual.shrink_to_fit();
    branch.shrink_to_fit();
    free.shrink_to_fit();
    Ok(Some(Answers { q: Vec::new(), residual, branch, free, starts, status }))
}

impl<'a> Work<'a> {
    /// Takes chunks until none is left.
    fn run(&self, mut look: impl FnMut() -> PyResult<()>) -> PyResult<()> {
        let _guard = Guard(self);
        let mut sink = Sink::new(self.kernel.shape().turns.len());
        while let Some((number, counts, status)) = self.take() {
            if let Err(interruption) = look() {
                return Err(self.stop(interruption));
            }
            let rows = number * CHUNK..number * CHUNK + counts.len();
            sink.clear();
            self.kernel.batch(self.targets, rows, &mut sink, &mut |sink, target, begun, why| {
                if self.choice.limits.is_none() && self.choice.near.is_none() {
                    sink.end(begun, why);
                } else {
                    self.choice.end(self.kernel, self.targets, sink, target, begun, why);
                }
            });
            debug_assert_eq!(sink.counts.len(), counts.len());
            for (count, found) in counts.iter_mut().zip(&sink.counts) {
                *count = i64::from(*found);
            }
            status.copy_from_slice(&sink.status);
            let Some(rest) = self.place(number, sink.answers(), sink.joints) else { return Ok(()) };
            rest.q.copy_from_slice(&sink.q);
            rest.residual.copy_from_slice(&sink.residual);
            rest.branch.copy_from_slice(&sink.branch);
            rest.free.copy_from_slice(&sink.free);
        }
        Ok(())
    }

    fn stop(&self, interruption: PyErr) -> PyErr {
        self.is_stopped.store(true, Ordering::Relaxed);
        self.turned.notify_all();
        interruption
    }

    /// The next chunk: its number, and where the numbers of its targets go.
    fn take(&self) -> Option<(usize, &'a mut [i64], &'a mut [u8])> {
        let mut open = locked(&self.open);
        let size = open.counts.len().min(CHUNK);
        if size == 0 || self.is_full.load(Ordering::Relaxed) || self.is_stopped.load(Ordering::Relaxed) {
            return None;
        }
        open.next += 1;
        let number = open.next - 1;
        let counts = open.counts.split_off_mut(..size)?;
        let status = open.status.split_off_mut(..size)?;
        Some((number, counts, status))
    }

    /// The place of a chunk with so many answers, when it is its turn; none where there is no room, or all stops.
    fn place(&self, number: usize, answers: usize, joints: usize) -> Option<Rest<'a>> {
        let mut rest = locked(&self.rest);
        while rest.turn != number {
            if self.is_full.load(Ordering::Relaxed) || self.is_stopped.load(Ordering::Relaxed) {
                return None;
            }
            rest = self.turned.wait_timeout(rest, PATIENCE).unwrap_or_else(PoisonError::into_inner).0;
        }
        let own = rest.cut(number, answers, joints);
        if own.is_none() {
            self.is_full.store(true, Ordering::Relaxed);
        }
        drop(rest);
        self.turned.notify_all();
        own
    }
}

/// Stops all threads where one of them panics, for its chunk's turn does not end.
struct Guard<'w, 'a>(&'w Work<'a>);

impl Drop for Guard<'_, '_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.0.is_stopped.store(true, Ordering::Relaxed);
            self.0.turned.notify_all();
        }
    }
}

impl<'a> Rest<'a> {
    /// The rows of a chunk, off the front; none where there is no room.
    fn cut(&mut self, number: usize, answers: usize, joints: usize) -> Option<Rest<'a>> {
        if self.residual.len() < answers {
            return None;
        }
        let own = Rest {
            turn: number,
            q: self.q.split_off_mut(..answers * joints)?,
            residual: self.residual.split_off_mut(..answers)?,
            branch: self.branch.split_off_mut(..answers)?,
            free: self.free.split_off_mut(..answers)?,
        };
        self.turn += 1;
        Some(own)
    }
}

/// The content of a lock. Nothing is left half-done where a thread panicked: the panic goes on when all are joined.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The word for a status.
pub fn reason(status: u8) -> &'static str {
    const WORDS: [(Status, &str); 6] = [
        (Status::Unreachable, "is out of reach"),
        (Status::NotFinite, "has a number that is infinite or none; give finite numbers"),
        (
            Status::NotRotation,
            "has no rotation; give a right-handed rotation matrix within 1e-9, with last row 0, 0, 0, 1, or a quaternion x, y, z, w of length one",
        ),
        (Status::NotUnit, "has a direction that is not of length one within 1e-9; give a unit vector"),
        (Status::Open, "lies on a stratum that could not be derived"),
        (Status::BeyondLimits, "has solutions beyond the limits only"),
    ];
    WORDS.iter().find(|(known, _)| *known as u8 == status).map_or("is solved", |(_, word)| word)
}
