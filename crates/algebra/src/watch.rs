//! Progress, cancellation and budgets of long computations. Engines never print; they call a [`Watch`].

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use crate::{Error, ErrorKind, Result};

/// One progress report: the stage, the units done and the units known to be left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Progress<'a> {
    /// The stage, such as "basis" or "search of orders".
    pub stage: &'a str,
    /// Units done.
    pub done: usize,
    /// Units known to be left. The number may grow.
    pub open: usize,
    /// The matrix that is being reduced, in engines that use matrices.
    pub matrix: Option<Matrix>,
}

/// Size of the matrix of one step of an engine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Matrix {
    /// The degree of the S-polynomials of the step.
    pub degree: usize,
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub columns: usize,
    /// The rank known so far: rows that are reduced and not zero.
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
    /// A watch without listener, cancel flag or budget.
    pub fn none() -> Self {
        Watch::default()
    }

    /// The watch of a function whose watch is optional: the given one, or for `None` one without listener, cancel flag and
    /// budget.
    pub fn or_none<'a>(watch: impl Into<Option<&'a Watch>>) -> &'a Watch {
        static NONE: Watch = Watch {
            listener: None,
            cancel: None,
            deadline: None,
            terms: None,
            memory: None,
            meter: None,
            patience: None,
        };
        watch.into().unwrap_or(&NONE)
    }

    /// Sets a listener. It is called from time to time on the working thread.
    #[must_use]
    pub fn with_listener(mut self, listener: impl Fn(Progress<'_>) + Send + Sync + 'static) -> Self {
        self.listener = Some(Arc::new(listener));
        self
    }

    /// Sets a cancel flag. Work stops with [`ErrorKind::Cancelled`] soon after the flag becomes true.
    #[must_use]
    pub fn with_cancel(mut self, flag: Arc<AtomicBool>) -> Self {
        self.cancel = Some(flag);
        self
    }

    /// Sets a time budget that starts now. Work stops with [`ErrorKind::Budget`] when it is used up.
    #[must_use]
    pub fn with_time(mut self, time: Duration) -> Self {
        self.deadline = Some((Instant::now() + time, time));
        self
    }

    /// Sets a memory budget in polynomial terms, the engine's own unit. Work stops with [`ErrorKind::Budget`] when more
    /// than `terms` terms are stored.
    #[must_use]
    pub fn with_terms(mut self, terms: usize) -> Self {
        self.terms = Some(terms);
        self
    }

    /// Sets a memory budget in bytes. Work stops with [`ErrorKind::Budget`] when the engine ([`Watch::check_memory`])
    /// or the caller ([`Watch::with_meter`]) counts more than `bytes`.
    #[must_use]
    pub fn with_memory(mut self, bytes: usize) -> Self {
        self.memory = Some(bytes);
        self
    }

    /// Reads the bytes in use from `meter` at each [`Watch::check`]. The caller keeps the meter up to date.
    #[must_use]
    pub fn with_meter(mut self, meter: Arc<AtomicUsize>) -> Self {
        self.meter = Some(meter);
        self
    }

    /// Sets a countdown for tests. Each [`Watch::check`] subtracts one from `left`; at zero, work stops with
    /// [`ErrorKind::Cancelled`]. This counts the calls without a clock.
    #[doc(hidden)]
    #[must_use]
    pub fn with_patience(mut self, left: Arc<AtomicUsize>) -> Self {
        self.patience = Some(left);
        self
    }

    /// Reports progress to the listener.
    pub fn report(&self, stage: &str, done: usize, open: usize) {
        self.notify(Progress { stage, done, open, matrix: None });
    }

    /// Same as [`Watch::report`], but with the matrix that is being reduced.
    pub fn report_matrix(&self, stage: &str, done: usize, open: usize, matrix: Matrix) {
        self.notify(Progress { stage, done, open, matrix: Some(matrix) });
    }

    fn notify(&self, progress: Progress<'_>) {
        if let Some(listener) = &self.listener {
            listener(progress);
        }
    }

    /// Checks the cancel flag, the time budget and the meter. Engines call it often.
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
                let text = format!("the time budget of {:.1} s is exhausted; give a larger one", time.as_secs_f64());
                Err(Error::new(ErrorKind::Budget, text))
            }
            _ => Ok(()),
        }
    }

    /// Checks `bytes` bytes in use against the memory budget.
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

    /// Checks `terms` stored terms against the memory budget.
    ///
    /// # Errors
    /// [`ErrorKind::Budget`].
    pub fn check_terms(&self, terms: usize) -> Result<()> {
        match self.terms {
            Some(limit) if terms > limit => {
                let text = format!("{terms} polynomial terms are in use, the budget allows {limit}; give a larger one");
                Err(Error::new(ErrorKind::Budget, text))
            }
            _ => Ok(()),
        }
    }
}
