//! How a caller follows, stops and bounds long work. Engines never print; they ask a [`Watch`].

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use crate::{Error, ErrorKind, Result};

/// One line of progress: which work, how much is done, how much is known to be left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Progress<'a> {
    /// The stage, such as "basis" or "search of orders".
    pub stage: &'a str,
    /// Units done so far.
    pub done: usize,
    /// Units that are still known to be open; it may grow.
    pub open: usize,
    /// The matrix that is being reduced, in engines that work with one.
    pub matrix: Option<Matrix>,
}

/// The matrix of one step of an engine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Matrix {
    /// The degree of the step.
    pub degree: usize,
    /// Rows.
    pub rows: usize,
    /// Columns.
    pub columns: usize,
    /// The rank as far as it is known: rows that are reduced and not zero.
    pub rank: usize,
}

impl fmt::Display for Progress<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {} done, {} open", self.stage, self.done, self.open)?;
        self.matrix.map_or(Ok(()), |matrix| write!(f, "; {matrix}"))
    }
}

impl fmt::Display for Matrix {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "degree {}, matrix {} x {}, rank {}", self.degree, self.rows, self.columns, self.rank)
    }
}

type Listener = Arc<dyn Fn(Progress<'_>) + Send + Sync>;

/// Progress listener, cancel flag and budget of a long computation.
#[derive(Clone, Default)]
pub struct Watch {
    listener: Option<Listener>,
    cancel: Option<Arc<AtomicBool>>,
    deadline: Option<(Instant, Duration)>,
    terms: Option<usize>,
    memory: Option<usize>,
    meter: Option<Arc<AtomicUsize>>,
    patience: Option<Arc<AtomicUsize>>,
}

impl Watch {
    /// A watch that never stops anything and tells nobody.
    pub fn none() -> Self {
        Watch::default()
    }

    /// Calls `listener` now and then from the working thread.
    #[must_use]
    pub fn with_listener(mut self, listener: impl Fn(Progress<'_>) + Send + Sync + 'static) -> Self {
        self.listener = Some(Arc::new(listener));
        self
    }

    /// Stops with [`ErrorKind::Cancelled`] soon after `flag` becomes true.
    #[must_use]
    pub fn with_cancel(mut self, flag: Arc<AtomicBool>) -> Self {
        self.cancel = Some(flag);
        self
    }

    /// Stops with [`ErrorKind::Budget`] once `time` has passed from now on.
    #[must_use]
    pub fn with_time(mut self, time: Duration) -> Self {
        self.deadline = Some((Instant::now() + time, time));
        self
    }

    /// Stops with [`ErrorKind::Budget`] when more than `terms` polynomial terms are alive:
    /// the memory budget, counted in the engine's own unit.
    #[must_use]
    pub fn with_terms(mut self, terms: usize) -> Self {
        self.terms = Some(terms);
        self
    }

    /// Stops with [`ErrorKind::Budget`] when more than `bytes` bytes are in use, by the engine's own count
    /// ([`Watch::check_memory`]) or by the caller's ([`Watch::with_meter`]).
    #[must_use]
    pub fn with_memory(mut self, bytes: usize) -> Self {
        self.memory = Some(bytes);
        self
    }

    /// Reads the bytes in use from `meter`, which the caller keeps up to date, at each [`Watch::check`].
    #[must_use]
    pub fn with_meter(mut self, meter: Arc<AtomicUsize>) -> Self {
        self.meter = Some(meter);
        self
    }

    /// Stops with [`ErrorKind::Cancelled`] at the call of [`Watch::check`] that finds `left` at zero; each call before takes one off. This
    /// shows how often the work asks, without a clock.
    #[must_use]
    pub fn with_patience(mut self, left: Arc<AtomicUsize>) -> Self {
        self.patience = Some(left);
        self
    }

    /// Tells the listener how far the work is.
    pub fn report(&self, stage: &str, done: usize, open: usize) {
        self.tell(Progress { stage, done, open, matrix: None });
    }

    /// As [`Watch::report`], with the matrix that is being reduced.
    pub fn report_matrix(&self, stage: &str, done: usize, open: usize, matrix: Matrix) {
        self.tell(Progress { stage, done, open, matrix: Some(matrix) });
    }

    fn tell(&self, progress: Progress<'_>) {
        if let Some(listener) = &self.listener {
            listener(progress);
        }
    }

    /// Fails when the work should stop.
    ///
    /// # Errors
    /// [`ErrorKind::Cancelled`] or [`ErrorKind::Budget`].
    pub fn check(&self) -> Result<()> {
        let less = |left: usize| left.checked_sub(1);
        let is_spent = |left: &Arc<AtomicUsize>| left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, less).is_err();
        let is_cancelled = self.cancel.as_ref().is_some_and(|flag| flag.load(Ordering::Relaxed));
        if is_cancelled || self.patience.as_ref().is_some_and(is_spent) {
            return Err(Error::new(ErrorKind::Cancelled, "cancelled by the caller"));
        }
        if let Some(meter) = &self.meter {
            self.check_memory(meter.load(Ordering::Relaxed))?;
        }
        match self.deadline {
            Some((end, time)) if Instant::now() >= end => {
                let text = format!("the time budget of {:.1} s is used up; give a larger one", time.as_secs_f64());
                Err(Error::new(ErrorKind::Budget, text))
            }
            _ => Ok(()),
        }
    }

    /// Fails when `bytes` bytes in use are more than the budget allows.
    ///
    /// # Errors
    /// [`ErrorKind::Budget`].
    pub fn check_memory(&self, bytes: usize) -> Result<()> {
        match self.memory {
            Some(limit) if bytes > limit => {
                let mebibytes = |bytes: usize| bytes as f64 / 1_048_576.0;
                let (used, limit) = (mebibytes(bytes), mebibytes(limit));
                let text =
                    format!("{used:.1} MiB of memory are in use, the budget allows {limit:.1}; give a larger one");
                Err(Error::new(ErrorKind::Budget, text))
            }
            _ => Ok(()),
        }
    }

    /// Fails when `terms` terms are more than the budget allows.
    ///
    /// # Errors
    /// [`ErrorKind::Budget`].
    pub fn check_terms(&self, terms: usize) -> Result<()> {
        match self.terms {
            Some(limit) if terms > limit => {
                let text = format!("{terms} polynomial terms are alive, the budget allows {limit}; give a larger one");
                Err(Error::new(ErrorKind::Budget, text))
            }
            _ => Ok(()),
        }
    }
}
