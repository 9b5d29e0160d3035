//! How a caller follows, stops and bounds long work. Engines never print; they ask a [`Watch`].

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
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
}

type Listener = Arc<dyn Fn(Progress<'_>) + Send + Sync>;

/// Progress listener, cancel flag and budget of a long computation.
#[derive(Clone, Default)]
pub struct Watch {
    listener: Option<Listener>,
    cancel: Option<Arc<AtomicBool>>,
    deadline: Option<(Instant, Duration)>,
    terms: Option<usize>,
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

    /// Tells the listener about `progress`.
    pub fn report(&self, stage: &str, done: usize, open: usize) {
        if let Some(listener) = &self.listener {
            listener(Progress { stage, done, open });
        }
    }

    /// Fails when the work should stop.
    ///
    /// # Errors
    /// [`ErrorKind::Cancelled`] or [`ErrorKind::Budget`].
    pub fn check(&self) -> Result<()> {
        if self.cancel.as_ref().is_some_and(|flag| flag.load(Ordering::Relaxed)) {
            return Err(Error::new(ErrorKind::Cancelled, "cancelled by the caller"));
        }
        match self.deadline {
            Some((end, time)) if Instant::now() >= end => {
                let text = format!("the time budget of {:.1} s is used up; give a larger one", time.as_secs_f64());
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
