//! Counters of the work of solving, by phase: calls, steps, evaluations of the equations and time. With the feature `counters` they count for the whole
//! process, and `take` reads them. Without it they compile to no instruction.

/// A phase of solving. A phase that another one calls counts separately.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// Evaluation of the blocks, and everything that belongs to no other phase.
    Walk,
    /// Measurement of several candidates side by side, and their Newton steps by normal equations.
    Waiting,
    /// Polishing of a candidate with a residual above rounding.
    Polish,
    /// Restarts around a singular candidate.
    Around,
    /// Search for a second solution next to an ill-conditioned one.
    Twin,
    /// Test whether a candidate is a member of a self-motion.
    Member,
    /// Continuation along curves next to self-motions.
    Curve,
    /// Comparison of a new solution with those nearby.
    Compare,
}

impl Phase {
    /// All phases, in the order of `take`'s rows.
    pub const ALL: [Phase; 8] = [
        Phase::Walk,
        Phase::Waiting,
        Phase::Polish,
        Phase::Around,
        Phase::Twin,
        Phase::Member,
        Phase::Curve,
        Phase::Compare,
    ];
}

/// A quantity that is counted in each phase.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// Number of times the phase began.
    Call,
    /// Newton steps by QR factorisation, damped ones included.
    Step,
    /// Newton steps by normal equations; each of several candidates side by side counts once.
    Short,
    /// Evaluations of the equations outside of steps.
    Evaluation,
    /// Elapsed time \[ns\].
    Time,
}

impl Event {
    /// All events, in the order of `take`'s columns.
    pub const ALL: [Event; 5] = [Event::Call, Event::Step, Event::Short, Event::Evaluation, Event::Time];
}

#[cfg(feature = "counters")]
pub use of_feature::take;

#[cfg(not(feature = "counters"))]
mod of_feature {
    use super::{Event, Phase};

    /// Does nothing: phases are not counted.
    pub(crate) struct Within;

    impl Phase {
        #[inline(always)]
        pub(crate) fn begin(self) -> Within {
            Within
        }
    }

    impl Event {
        #[inline(always)]
        pub(crate) fn count(self) {}
    }
}

#[cfg(feature = "counters")]
mod of_feature {
    use core::sync::atomic::{AtomicU64, AtomicUsize, Ordering::Relaxed};
    use std::sync::OnceLock;
    use std::time::Instant;

    use super::{Event, Phase};

    type Row = [AtomicU64; Event::ALL.len()];

    static COUNTS: [Row; Phase::ALL.len()] =
        [const { [const { AtomicU64::new(0) }; Event::ALL.len()] }; Phase::ALL.len()];
    static PHASE: AtomicUsize = AtomicUsize::new(0);
    static SINCE: AtomicU64 = AtomicU64::new(0);

    /// Guard of a phase: until it is dropped, events count for this phase, afterwards for the phase before.
    pub(crate) struct Within(usize);

    impl Drop for Within {
        fn drop(&mut self) {
            change(self.0);
        }
    }

    impl Phase {
        pub(crate) fn begin(self) -> Within {
            let before = change(self as usize);
            Event::Call.count();
            Within(before)
        }
    }

    impl Event {
        pub(crate) fn count(self) {
            add(self, 1);
        }
    }

    fn add(event: Event, amount: u64) {
        COUNTS[PHASE.load(Relaxed)][event as usize].fetch_add(amount, Relaxed);
    }

    /// Ends the current phase and returns it.
    fn change(next: usize) -> usize {
        static START: OnceLock<Instant> = OnceLock::new();
        let now = START.get_or_init(Instant::now).elapsed().as_nanos() as u64;
        add(Event::Time, now.saturating_sub(SINCE.swap(now, Relaxed)));
        PHASE.swap(next, Relaxed)
    }

    /// The counts since the last call, by [`Phase::ALL`] and [`Event::ALL`]. Meaningful only while one thread solves.
    pub fn take() -> [[u64; Event::ALL.len()]; Phase::ALL.len()] {
        change(PHASE.load(Relaxed));
        core::array::from_fn(|phase| core::array::from_fn(|event| COUNTS[phase][event].swap(0, Relaxed)))
    }
}
