//! Candidates for members of self-motions that are none, where no answer is lost without them: [`Strays`].

use crate::mechanism::Found;
use crate::tolerances::DOUBTED;

/// How many kinds are told apart.
const KINDS: usize = 16;
/// A free joint is put at so many places round the circle, or at a multiple of it.
const PLACES: usize = 8;

/// Candidates of one branch with the same free joints.
#[derive(Clone, Copy)]
struct Kind {
    branch: usize,
    free: u32,
    count: usize,
    /// The most that one of them misses the equations by.
    missed: f64,
    is_astray: bool,
}

/// What is known of candidates by kind.
pub(crate) struct Strays {
    kinds: [Kind; KINDS],
    count: usize,
    are_too_many: bool,
}

impl Strays {
    pub const NONE: Self = Strays {
        kinds: [Kind { branch: 0, free: 0, count: 0, missed: 0.0, is_astray: false }; KINDS],
        count: 0,
        are_too_many: false,
    };

    /// Counts a candidate that misses the equations by so much, and tells whether those of its kind have turned out to be no members.
    pub fn are_known(&mut self, found: &Found, missed: f64) -> bool {
        let Some(kind) = self.kind(found) else { return false };
        kind.count += 1;
        kind.missed = f64::max(kind.missed, missed);
        kind.is_astray
    }

    /// Those of this kind are no members.
    pub fn mark(&mut self, found: &Found) {
        if let Some(kind) = self.kind(found) {
            kind.is_astray = true;
        }
    }

    /// Whether an answer may have been lost: a kind is there on a part of the circle only, next to whose end rounding may have hidden one, so near
    /// the stratum are its candidates.
    pub fn are_doubtful(&self) -> bool {
        let is_doubtful = |kind: &Kind| kind.is_astray && kind.missed <= DOUBTED && kind.count % PLACES != 0;
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

/// Branches and free joints of members that are on a self-motion of another branch, as many as there is room for.
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
