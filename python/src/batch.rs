//! Many targets on several threads, into arrays in which the answers stand in the order of the targets. Main function: [`solve_all`].
//!
//! One thread writes where answers are to be. Of several each takes chunks of targets, solves them into rows of its own, and gets their place when it is the chunk's
//! turn. No thread outlives the call, and no pool is asked: a process that was forked solves as well.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use pyo3::{PyResult, Python};

use crate::choose::Choice;
use crate::kernel::Kernel;
use crate::sink::{Rows, Sink, Status};
use crate::targets::Targets;

/// How many targets are one piece of work.
const CHUNK: usize = 512;
/// How long it takes until an interruption is seen.
const PATIENCE: Duration = Duration::from_millis(50);

/// Where the answers go.
pub struct Room<'a> {
    pub rows: Rows<'a>,
    /// By target, the number of its answers.
    pub counts: &'a mut [i64],
    /// By target, its [`Status`].
    pub status: &'a mut [u8],
}

/// What is to be done.
#[derive(Clone, Copy)]
pub struct Job<'a> {
    pub kernel: &'a dyn Kernel,
    pub targets: &'a Targets<'a>,
    pub choice: &'a Choice<'a>,
}

/// Solves all targets on so many threads: the number of answers, or `None` when there is too little room.
///
/// # Errors
/// What a signal raises, such as `KeyboardInterrupt`.
pub fn solve_all(job: Job<'_>, threads: usize, room: Room<'_>) -> PyResult<Option<usize>> {
    let helpers = threads.min(job.targets.len().div_ceil(CHUNK)).saturating_sub(1);
    if helpers == 0 { solve_here(job, room) } else { solve_together(job, helpers, room) }
}

impl Job<'_> {
    /// Solves some targets.
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

/// Looks at signals now and then.
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

/// On the calling thread alone.
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

/// With helpers.
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

/// The rows that nobody has got yet.
struct Rest<'a> {
    /// The chunk whose turn it is.
    turn: usize,
    taken: usize,
    rows: Option<Rows<'a>>,
}

/// The targets that nobody has taken yet: where their numbers go.
struct Open<'a> {
    next: usize,
    counts: &'a mut [i64],
    status: &'a mut [u8],
}

/// What all threads share.
struct Work<'a> {
    job: Job<'a>,
    open: Mutex<Open<'a>>,
    rest: Mutex<Rest<'a>>,
    turned: Condvar,
    is_full: AtomicBool,
    is_stopped: AtomicBool,
}

impl<'a> Work<'a> {
    /// Takes chunks until none is left.
    fn run(&self, mut look: impl FnMut() -> PyResult<()>) -> PyResult<()> {
        let _guard = Guard(self);
        let (shape, joints) = (self.job.kernel.shape(), self.job.joints());
        // A chunk of singular targets needs more room than others.
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

    /// Lets all threads stop.
    fn stop(&self, why: &AtomicBool) {
        why.store(true, Ordering::Relaxed);
        self.turned.notify_all();
    }

    fn has_stopped(&self) -> bool {
        self.is_full.load(Ordering::Relaxed) || self.is_stopped.load(Ordering::Relaxed)
    }

    /// The next chunk: its number, and where the numbers of its targets go.
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

    /// The place of a chunk with so many answers, when it is its turn; none where there is no room, or all stops.
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

/// Stops all threads where one of them panics, for its chunk's turn does not end.
struct Guard<'w, 'a>(&'w Work<'a>);

impl Drop for Guard<'_, '_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.0.stop(&self.0.is_stopped);
        }
    }
}

/// The content of a lock. Nothing is left half-done where a thread panicked: the panic goes on when all are joined.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The word for a status.
pub fn reason(status: u8) -> &'static str {
    const WORDS: [(Status, &str); 7] = [
        (Status::Unreachable, "is out of reach"),
        (Status::NotFinite, "has a number that is infinite or none; give finite numbers"),
        (
            Status::NotRotation,
            "has no rotation; give a right-handed rotation matrix within 1e-9, with last row 0, 0, 0, 1, or a quaternion x, y, z, w of length one",
        ),
        (Status::NotUnit, "has a direction that is not of length one within 1e-9; give a unit vector"),
        (Status::Open, "lies on a stratum that could not be derived"),
        (Status::BeyondLimits, "has solutions beyond the limits only"),
        (Status::Unsettled, "took more steps than a target may: not all work on it was done"),
    ];
    WORDS.iter().find(|(known, _)| *known as u8 == status).map_or("is solved", |(_, word)| word)
}
