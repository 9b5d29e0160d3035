//! What is particular to a mechanism and its task ([`Mechanism`]), and what takes its candidates in ([`Candidates`]).

use crate::number::{Guard, Number, Roots, With};
use crate::storage::{Array, Storage};

/// A row with one value for each joint of a mechanism.
pub type Joints<M, T = f64> = <<M as Mechanism>::Storage as Storage>::Joints<T>;
/// A row with one value for each number of a target.
pub type Inputs<M, T = f64> = <<M as Mechanism>::Storage as Storage>::Inputs<T>;
/// A row with one value for each parameter.
pub type Parameters<M, T = f64> = <<M as Mechanism>::Storage as Storage>::Parameters<T>;
/// A row with one value for each number that the equations read of joints.
pub type Places<M, T = f64> = <<M as Mechanism>::Storage as Storage>::Places<T>;
/// A row with one value for each equation.
pub type Equations<M, T = f64> = <<M as Mechanism>::Storage as Storage>::Equations<T>;
/// A row with one value for each size that equations have.
pub type Sizes<M, T = f64> = <<M as Mechanism>::Storage as Storage>::Sizes<T>;
/// A row with one value for each equation of the short way.
pub type Shorts<M, T = f64> = <<M as Mechanism>::Storage as Storage>::Shorts<T>;
/// A row with one value for each candidate of an ordinary target.
pub type Abreast<M, T = f64> = <<M as Mechanism>::Storage as Storage>::Candidates<T>;

/// A row with one value for each answer that a target can have.
pub type Answered<M, T> = <<M as Mechanism>::Storage as Storage>::Answers<T>;

/// A derived solver: the description of a mechanism and its task in a printed file, or in a program that is read. [`crate::solve`] does the rest.
pub trait Mechanism: Sized {
    /// Where its numbers are stored.
    type Storage: Storage;
    /// Whether targets of a batch are solved one after the other.
    const IS_SINGLE: bool = false;
    /// Whether sixteen of them are solved at once, for each operation takes longer to be told than to be done.
    const IS_TOLD: bool = false;

    /// What holds for all targets.
    fn facts(&self) -> Facts<'_>;

    /// The numbers of a target that the walk and the equations read.
    fn parameters<N: Number>(&self, target: &Inputs<Self, N>) -> Parameters<Self, N>
    where
        f64: With<N>;

    /// Walks through the blocks: every case that applies, every root, every sample.
    fn walk<N: Number, C: Candidates<N, Self>>(&self, p: &Parameters<Self, N>, candidates: &mut C)
    where
        f64: With<N>;

    /// What the equations compare with parameters; where they do not, no numbers.
    fn tip<N: Number>(&self, _at: &Places<Self, N>) -> Equations<Self, N>
    where
        f64: With<N>,
    {
        Array::by(self.facts().size_of.len(), |_| N::of(f64::NAN))
    }

    /// The equations' values, zero at a solution.
    #[inline(always)]
    fn values<N: Number>(&self, p: &Parameters<Self, N>, at: &Places<Self, N>) -> Equations<Self, N>
    where
        f64: With<N>,
    {
        let mut values = self.tip(at);
        for (value, &parameter) in values.as_mut().iter_mut().zip(self.facts().compared) {
            *value = *value - p.as_ref()[parameter];
        }
        values
    }

    /// As [`Mechanism::values`], of the mechanism as described, where the equations are those of the ideal one that it means ([`Facts::within`]). Affine in
    /// the numbers of each joint.
    fn described<N: Number>(&self, p: &Parameters<Self, N>, at: &Places<Self, N>) -> Equations<Self, N>
    where
        f64: With<N>,
    {
        self.values(p, at)
    }

    /// The sizes of equations: sums of their terms' magnitudes.
    fn sizes<N: Number>(&self, p: &Parameters<Self, N>, at: &Places<Self, N>) -> Sizes<Self, N>
    where
        f64: With<N>;

    /// The derivative of each equation by each joint, equation by equation; none where they are [found from the values](crate::derivatives), which are affine
    /// in the numbers of each joint, as those of a chain are.
    fn jacobian(&self, _p: &Parameters<Self>, _at: &Places<Self>) -> Option<Equations<Self, Joints<Self>>> {
        None
    }

    /// The equations of the short way to an answer nearby, where there is one ([`Facts::nearby`]).
    fn short<N: Number>(&self, _p: &Parameters<Self, N>, _at: &Places<Self, N>) -> Short<Self, N>
    where
        f64: With<N>,
    {
        let none = || Array::by(0, |_| N::of(0.0));
        let columns = Array::by(self.facts().joints.len(), |_| none());
        Short { value: none(), size: none(), columns }
    }
}

/// As few equations as say the same near a solution.
#[derive(Clone)]
pub struct Short<M: Mechanism, N: Number> {
    /// Their values, zero at a solution.
    pub value: Shorts<M, N>,
    /// What the values are shares of.
    pub size: Shorts<M, N>,
    /// By joint, the derivatives of the values.
    pub columns: Joints<M, Shorts<M, N>>,
}

/// What holds for all targets of a mechanism.
#[derive(Clone, Copy, Debug)]
pub struct Facts<'a> {
    /// How many numbers a target has.
    pub inputs: usize,
    /// The joints of an answer, in order.
    pub joints: &'a [Joint],
    /// The joints, those that are found last first: in these answers differ most.
    pub last_first: &'a [usize],
    /// How many numbers the equations read of joints.
    pub places: usize,
    /// Whether some of them follow from no joint.
    pub has_extras: bool,
    /// By equation, which of the sizes is its own.
    pub size_of: &'a [usize],
    /// How many sizes there are.
    pub sizes: usize,
    /// By equation, the parameter that it compares with the tip; empty where an equation is of another kind.
    pub compared: &'a [usize],
    /// The places whose numbers turn their signs in the second of a pair of candidates.
    pub turned: &'a [usize],
    /// How many candidates an ordinary target has: an even number, at most 16.
    pub candidates: usize,
    /// So many candidates in a row differ in signs alone, and miss the equations by the same.
    pub twins: usize,
    /// By joint: so many candidates of an ordinary target in a row have the same cosine and sine but for signs; empty where many targets are solved one
    /// by one.
    pub runs: &'a [usize],
    /// A length typical of the mechanism.
    pub scale: f64,
    /// The most solutions that a target can have.
    pub capacity: usize,
    /// The most isolated solutions that a target can have, where that is proved.
    pub isolated: Option<usize>,
    /// The joints that some case frees, ascending.
    pub freed: &'a [usize],
    /// What a target must fulfil.
    pub conditions: &'a [Condition],
    /// By number of a target, where the tip gives it; empty where it does not.
    pub reached: &'a [Reached],
    /// The formulas are those of a mechanism near the one that the equations are of: so many equations lead on from there.
    pub nearby: Option<usize>,
    /// The equations are those of the ideal mechanism that a described one means, and ask for more than the joints can do: the least share of their sizes
    /// within which a target is one that the ideal mechanism reaches. It bounds twice the miss of one mechanism where the other holds.
    pub within: Option<f64>,
    /// The source's choice of an answer.
    pub preference: Option<Preference>,
}

impl Facts<'_> {
    /// Those of nothing.
    pub const NONE: Facts<'static> = Facts {
        inputs: 0,
        joints: &[],
        last_first: &[],
        places: 0,
        has_extras: false,
        size_of: &[],
        sizes: 0,
        compared: &[],
        turned: &[],
        candidates: 2,
        twins: 1,
        runs: &[],
        scale: 1.0,
        capacity: 0,
        isolated: None,
        freed: &[],
        conditions: &[],
        reached: &[],
        nearby: None,
        within: None,
        preference: None,
    };
}

/// Where a joint is among the numbers that the equations read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Joint {
    /// It turns: its cosine and its sine.
    Angle([usize; 2]),
    /// It slides: its value.
    Length(usize),
}

/// What numbers of a target must fulfil. Deviations within [`crate::tolerances::CONSISTENT`] are removed; larger ones are an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Condition {
    /// The nine numbers from this one on, by rows, are a rotation matrix.
    Rotation(usize),
    /// The three numbers from this one on are a unit vector.
    Unit(usize),
}

/// Where forward kinematics finds a number of the target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reached {
    /// The value of the tip that this equation compares.
    Value(usize),
    /// The angle whose cosine and sine these equations compare.
    Angle([usize; 2]),
    /// The value of this joint.
    Joint(usize),
}

/// Which solutions are marked as the source's own choice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Preference {
    /// The number that the equations read whose root the source chooses.
    pub place: usize,
    /// The greater root, else the smaller.
    pub greatest: bool,
}

/// How a candidate was found.
#[derive(Clone, Copy, Debug)]
pub struct Found<N: Number = f64> {
    /// Which cases and roots gave it.
    pub branch: usize,
    /// The end of the branch numbers of the first block's case.
    pub last: usize,
    /// Whether roots on the way are so near one another that rounding moves them.
    pub close: N::Doubt,
    /// Joints that may take any value: bit `j` for joint `j`.
    pub free: u32,
    /// Whether it stands for two, of which the second differs in signs alone ([`Facts::turned`]).
    pub is_pair: bool,
}

impl<N: Number> Found<N> {
    /// By a choice of the first block's case whose branch numbers end at `last`.
    #[inline(always)]
    pub fn first(branch: usize, last: usize) -> Self {
        Found { branch, last, close: N::SURE, free: 0, is_pair: false }
    }

    /// By a choice among `radix` of a later block.
    #[inline(always)]
    #[must_use]
    pub fn next(self, radix: usize, number: usize) -> Self {
        Found { branch: radix * self.branch + number, last: radix * self.last, ..self }
    }

    /// By the root with this index.
    #[inline(always)]
    #[must_use]
    pub fn by_root<const D: usize>(self, roots: &Roots<N, D>, index: usize) -> Self {
        Found { close: self.close | roots.doubt(index), ..self }
    }

    /// By both roots.
    #[inline(always)]
    #[must_use]
    pub fn by_pair(self, roots: &Roots<N, 2>) -> Self {
        Found { is_pair: roots.count() == 2, ..self.by_root(roots, 0) }
    }

    /// By an answer of six axes with these bits: joints of which this tells that they are free, and whether it is only near an answer.
    #[must_use]
    pub fn by_answer(self, is_free: &[bool; 6], is_lost: bool, joints: [u32; 6]) -> Self {
        let freed = is_free.iter().zip(joints).filter(|(is_free, _)| **is_free);
        let free = freed.fold(self.free, |all, (_, joint)| all | joint);
        Found { close: self.close | N::doubt_of(is_lost), free, ..self }
    }

    /// On a stratum where these joints are free: bit `j` for joint `j`.
    #[inline(always)]
    #[must_use]
    pub fn freeing(self, joints: u32) -> Self {
        Found { free: self.free | joints, ..self }
    }

    /// The second candidate of a pair.
    #[inline(always)]
    pub(crate) fn second(self) -> Self {
        Found { branch: self.branch + 1, ..self }
    }
}

/// Takes candidates in, and decides which cases run.
pub trait Candidates<N: Number, M: Mechanism> {
    /// Whether a case runs that usually does.
    fn is_usual(&mut self, guard: Guard<N>) -> bool;
    /// Whether a case runs that rarely does.
    fn is_rare(&mut self, guard: Guard<N>) -> bool;
    /// Whether the case of a stratum runs: near it, or beside it where the candidates behind the first `before` have sufficed.
    fn is_due(&mut self, before: usize, guard: Guard<N>) -> bool;
    /// How many candidates there have been.
    fn count(&self) -> usize;
    /// Takes in that a stratum with this number could not be derived, and whether the target lies on it.
    fn is_open(&mut self, number: usize, guard: Guard<N>);
    /// The place of the greatest number that is not negative, the first of equals; their number without one.
    fn elect(&mut self, claims: &[N]) -> usize;
    /// Takes in a candidate.
    fn take(&mut self, found: Found<N>, at: &Places<M, N>);

    /// Takes in a candidate, or a pair.
    #[inline(always)]
    fn finish(&mut self, mechanism: &M, found: Found<N>, at: &Places<M, N>) {
        self.take(found, at);
        if found.is_pair {
            let mut turned = at.clone();
            for &place in mechanism.facts().turned {
                turned.as_mut()[place] = -turned.as_ref()[place];
            }
            self.take(found.second(), &turned);
        }
    }
}

/// The place of the greatest claim that is not negative, the first of equals; the number of claims without one.
#[inline(always)]
pub(crate) fn elected(claims: impl ExactSizeIterator<Item = f64>) -> usize {
    let mut best = (-1.0, claims.len());
    for (place, claim) in claims.enumerate() {
        best = if claim > best.0 { (claim, place) } else { best };
    }
    best.1
}

/// Runs what rarely happens, out of line.
#[cold]
#[inline(never)]
pub fn rarely<T>(what: impl FnOnce() -> T) -> T {
    what()
}
