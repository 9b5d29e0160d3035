//! What solving takes, by phase: calls, steps, evaluations of the equations and time. With the feature `counters` these are counted for the whole process, and
//! `take` reads them; without it nothing is counted, and no instruction is left of it.

/// A phase of solving. What a phase calls that is a phase itself counts there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// The walk through the blocks, and all that no other phase has.
    Walk,
    /// Candidates measured side by side, or led by short steps.
    Waiting,
    /// A candidate polished that does not hold where it was found.
    Polish,
    /// Starts around a singular candidate.
    Around,
    /// The second answer looked for next to a steep one.
    Twin,
    /// Whether a candidate is a member of a self-motion.
    Member,
    /// Walks along curves next to self-motions.
    Curve,
    /// A new answer compared with those that are near.
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

/// What is counted of each phase.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// How often the phase began.
    Call,
    /// Newton steps by a triangle of reflections, damped ones too.
    Step,
    /// Newton steps by normal equations; of candidates side by side each counts once.
    Short,
    /// Evaluations of the equations beside those of steps.
    Evaluation,
    /// Time of the clock \[ns\].
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

    /// Nothing: phases are not counted.
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

    /// Until this is dropped, what happens counts for a phase; then for the one before.
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

    /// Ends the phase, and returns it.
    fn change(next: usize) -> usize {
        static START: OnceLock<Instant> = OnceLock::new();
        let now = START.get_or_init(Instant::now).elapsed().as_nanos() as u64;
        add(Event::Time, now.saturating_sub(SINCE.swap(now, Relaxed)));
        PHASE.swap(next, Relaxed)
    }

    /// What has been counted since the last call: by [`Phase::ALL`], by [`Event::ALL`]. Of one thread at a time this makes sense.
    pub fn take() -> [[u64; Event::ALL.len()]; Phase::ALL.len()] {
        change(PHASE.load(Relaxed));
        core::array::from_fn(|phase| core::array::from_fn(|event| COUNTS[phase][event].swap(0, Relaxed)))
    }
}
