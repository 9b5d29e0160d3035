//! Kinds of candidates that are not members of self-motions ([`RejectedKinds`]), known members ([`KnownMembers`]), and isolated solutions ([`IsolatedSolutions`]).

use crate::mechanism::{Facts, Found, Joints, Mechanism};
use crate::tolerances::ACCEPTANCE;

/// Maximal number of kinds that are distinguished.
const KINDS: usize = 16;
/// Number of places round the circle at which a free joint is sampled; a multiple of it is possible.
const PLACES: usize = 8;

/// Candidates of one branch with the same free joints.
#[derive(Clone, Copy)]
struct Kind {
    branch: usize,
    free: u32,
    count: usize,
    /// The largest relative residual of such a candidate.
    missed: f64,
    is_rejected: bool,
}

/// Counts of candidates by kind, and the kinds that are known not to be members of a self-motion.
pub(crate) struct RejectedKinds {
    kinds: [Kind; KINDS],
    count: usize,
    are_too_many: bool,
}

impl RejectedKinds {
    pub const NONE: Self = RejectedKinds {
        kinds: [Kind { branch: 0, free: 0, count: 0, missed: 0.0, is_rejected: false }; KINDS],
        count: 0,
        are_too_many: false,
    };

    /// Counts a candidate with its relative residual. Returns whether candidates of its kind are known not to be members.
    pub fn are_known(&mut self, found: &Found, missed: f64) -> bool {
        let Some(kind) = self.kind(found) else { return false };
        kind.count += 1;
        kind.missed = f64::max(kind.missed, missed);
        kind.is_rejected
    }

    /// Whether candidates of this kind are known not to be members.
    pub fn are_rejected(&self, found: &Found) -> bool {
        let is_it = |kind: &&Kind| (kind.branch, kind.free) == (found.branch, found.free);
        self.kinds[..self.count].iter().find(is_it).is_some_and(|kind| kind.is_rejected)
    }

    /// Records that candidates of this kind are not members.
    pub fn mark(&mut self, found: &Found) {
        if let Some(kind) = self.kind(found) {
            kind.is_rejected = true;
        }
    }

    /// Whether a solution may have been lost. This is possible where a kind exists only on a part of the circle and its candidates are close to the stratum:
    /// rounding may have hidden a solution at the end of that part.
    pub fn are_doubtful(&self) -> bool {
        let is_doubtful =
            |kind: &Kind| kind.is_rejected && kind.missed <= ACCEPTANCE.unsettled && !kind.count.is_multiple_of(PLACES);
        self.are_too_many || self.kinds[..self.count].iter().any(is_doubtful)
    }

    fn kind(&mut self, found: &Found) -> Option<&mut Kind> {
        let is_it = |kind: &Kind| (kind.branch, kind.free) == (found.branch, found.free);
        let place = self.kinds[..self.count].iter().position(is_it).unwrap_or(self.count);
        if place == KINDS {
            self.are_too_many = true;
            return None;
        }
        if place == self.count {
            self.kinds[place] = Kind { branch: found.branch, free: found.free, ..Self::NONE.kinds[0] };
            self.count += 1;
        }
        Some(&mut self.kinds[place])
    }
}

/// Branches and free joints of members that are on a self-motion of another branch, up to a maximal number.
pub(crate) struct Merged {
    kinds: [(usize, u32); KINDS],
    count: usize,
}

impl Merged {
    pub const NONE: Self = Merged { kinds: [(0, 0); KINDS], count: 0 };

    pub fn remember(&mut self, found: &Found) {
        if self.count < KINDS {
            self.kinds[self.count] = (found.branch, found.free);
            self.count += 1;
        }
    }

    pub fn contains(&self, found: &Found) -> bool {
        self.kinds[..self.count].contains(&(found.branch, found.free))
    }
}

/// Maximal number of stored members; when it is exceeded, the first is removed.
const MEMBERS: usize = 32;

/// A member of a self-motion: its branch and free joints, and the tangent once it has been computed.
pub(crate) struct Known<M: Mechanism> {
    branch: usize,
    pub free: u32,
    pub q: Joints<M>,
    pub tangent: Option<Joints<M>>,
}

/// Candidates known to be members of self-motions in the list. Strata repeat each other, and the next candidate of a branch is usually near the last one.
pub(crate) struct KnownMembers<M: Mechanism> {
    list: [Option<Known<M>>; MEMBERS],
    count: usize,
}

impl<M: Mechanism> KnownMembers<M> {
    pub const NONE: Self = KnownMembers { list: [const { None }; MEMBERS], count: 0 };

    pub fn remember(&mut self, found: &Found, q: &Joints<M>, tangent: Option<Joints<M>>) {
        let Found { branch, free, .. } = *found;
        self.list[self.count % MEMBERS] = Some(Known { branch, free, q: q.clone(), tangent });
        self.count += 1;
    }

    /// Whether joint values within a distance of these were found before.
    pub fn contains(&self, facts: &Facts<'_>, q: &Joints<M>, free: u32, distance: f64) -> bool {
        self.latest_first().any(|known| known.free == free && facts.is_within(known.q.as_ref(), q.as_ref(), distance))
    }

    /// The last one of a branch whose set of free joints satisfies `is_free`.
    pub fn last(&self, branch: usize, is_free: impl Fn(u32) -> bool) -> Option<&Known<M>> {
        self.latest_first().find(|known| known.branch == branch && is_free(known.free))
    }

    fn latest_first(&self) -> impl Iterator<Item = &Known<M>> {
        let latest = (1..=self.count.min(MEMBERS)).map(|k| (self.count - k) % MEMBERS);
        latest.filter_map(|place| self.list[place].as_ref())
    }
}

/// Maximal number of stored isolated solutions; when it is exceeded, the first is removed.
const ISOLATED: usize = 8;

/// Isolated solutions known not to be on a self-motion of these joints.
pub(crate) struct IsolatedSolutions<M: Mechanism> {
    list: [Option<(Joints<M>, u32)>; ISOLATED],
    next: usize,
}

impl<M: Mechanism> IsolatedSolutions<M> {
    pub const NONE: Self = IsolatedSolutions { list: [const { None }; ISOLATED], next: 0 };

    pub fn remember(&mut self, q: &Joints<M>, free: u32) {
        self.list[self.next % ISOLATED] = Some((q.clone(), free));
        self.next += 1;
    }

    pub fn contains(&self, q: &Joints<M>, free: u32) -> bool {
        self.list.iter().flatten().any(|(other, of)| *of == free && other.as_ref() == q.as_ref())
    }
}
