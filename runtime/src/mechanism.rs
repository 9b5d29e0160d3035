//! Interface of a derived solver ([`Mechanism`]) and the receiver of its candidates ([`Candidates`]).

use crate::number::{Guard, Number, Roots, With};
use crate::storage::{Array, Storage};

/// A row with one value for each joint of a mechanism.
pub type Joints<M, T = f64> = <<M as Mechanism>::Storage as Storage>::Joints<T>;
/// A row with one value for each target number.
pub type Inputs<M, T = f64> = <<M as Mechanism>::Storage as Storage>::Inputs<T>;
/// A row with one value for each parameter.
pub type Parameters<M, T = f64> = <<M as Mechanism>::Storage as Storage>::Parameters<T>;
/// A row with one value for each number that the equations read of joints.
pub type Places<M, T = f64> = <<M as Mechanism>::Storage as Storage>::Places<T>;
/// A row with one value for each equation.
pub type Equations<M, T = f64> = <<M as Mechanism>::Storage as Storage>::Equations<T>;
/// A row with one value for each size that equations have.
pub type Sizes<M, T = f64> = <<M as Mechanism>::Storage as Storage>::Sizes<T>;
/// A row with one value for each equation of the normal-equation steps.
pub type Shorts<M, T = f64> = <<M as Mechanism>::Storage as Storage>::Shorts<T>;
/// A row with one value for each candidate of an ordinary target.
pub type Abreast<M, T = f64> = <<M as Mechanism>::Storage as Storage>::Candidates<T>;

/// A row with one value for each possible solution of a target.
pub type Answered<M, T> = <<M as Mechanism>::Storage as Storage>::Answers<T>;

/// A derived solver: a mechanism and its task, in a printed file or in a program that is interpreted. [`crate::solve`] does the rest.
pub trait Mechanism: Sized {
    /// Storage of its numbers.
    type Storage: Storage;
    /// Whether targets of a batch are solved one after the other.
    const IS_SINGLE: bool = false;
    /// Whether sixteen targets are solved at once, because the interpreter spends more time on decoding an operation than on computing it.
    const INTERPRETED: bool = false;

    /// Constants that hold for all targets.
    fn facts(&self) -> Facts<'_>;

    /// The parameters that the blocks and the equations read, computed from a target.
    fn parameters<N: Number>(&self, target: &Inputs<Self, N>) -> Parameters<Self, N>
    where
        f64: With<N>;

    /// Evaluates the blocks: every case that applies, every root, every sample.
    fn walk<N: Number, C: Candidates<N, Self>>(&self, p: &Parameters<Self, N>, candidates: &mut C)
    where
        f64: With<N>;

    /// Passes all solutions of an ordinary target to `take`, ordered by branch: joint values, the residual and the relative residual, and the branch. The target
    /// fulfils its conditions. Returns false, and passes none, where the target is not ordinary, and for a mechanism without separate code for ordinary targets.
    #[inline(always)]
    fn ordinary(&self, _target: &Inputs<Self>, _take: &mut impl FnMut(Joints<Self>, [f64; 2], usize)) -> bool {
        false
    }

    /// The values that the equations compare with parameters, or NaN where equations are of another kind.
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

    /// Same as [`Mechanism::values`], but for the mechanism as described, where the equations are those of its ideal ([`Facts::within`]). Affine in the numbers
    /// of each joint.
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

    /// The derivative of each equation by each joint, equation by equation. `None` where the derivatives are [computed from the values](crate::derivatives),
    /// because these are affine in the numbers of each joint, as for a chain.
    fn jacobian(&self, _p: &Parameters<Self>, _at: &Places<Self>) -> Option<Equations<Self, Joints<Self>>> {
        None
    }

    /// The equations of the normal-equation steps to a solution nearby, for formulas of a [nearby](Facts::nearby) mechanism.
    fn short<N: Number>(&self, _p: &Parameters<Self, N>, _at: &Places<Self, N>) -> Short<Self, N>
    where
        f64: With<N>,
    {
        let none = || Array::by(0, |_| N::of(0.0));
        let columns = Array::by(self.facts().joints.len(), |_| none());
        Short { value: none(), size: none(), columns }
    }

    /// The values of [`Mechanism::short`] alone.
    #[inline(always)]
    fn short_value<N: Number>(&self, p: &Parameters<Self, N>, at: &Places<Self, N>) -> Shorts<Self, N>
    where
        f64: With<N>,
    {
        self.short(p, at).value
    }
}

/// A minimal set of equations, equivalent to all equations near a solution.
#[derive(Clone)]
pub struct Short<M: Mechanism, N: Number> {
    /// Their values, zero at a solution.
    pub value: Shorts<M, N>,
    /// The magnitudes to which the values are relative.
    pub size: Shorts<M, N>,
    /// By joint, the derivatives of the values.
    pub columns: Joints<M, Shorts<M, N>>,
}

/// Constants of a mechanism that hold for all targets.
#[derive(Clone, Copy, Debug)]
pub struct Facts<'a> {
    /// Number of target numbers.
    pub inputs: usize,
    /// The joints of a solution, in order.
    pub joints: &'a [Joint],
    /// The joints, those found last first: solutions differ most often in these.
    pub last_first: &'a [usize],
    /// Number of numbers that the equations read of joints.
    pub places: usize,
    /// Whether some of these numbers follow from no joint.
    pub has_extras: bool,
    /// By equation, the index of its size.
    pub size_of: &'a [usize],
    /// Number of sizes.
    pub sizes: usize,
    /// By equation, the parameter that it compares with the tip; empty where an equation is of another kind.
    pub compared: &'a [usize],
    /// The places whose numbers change sign in the second candidate of a pair.
    pub turned: &'a [usize],
    /// Number of candidates of an ordinary target: even, and at most 16.
    pub candidates: usize,
    /// Number of consecutive candidates that differ only in signs and have equal residuals.
    pub twins: usize,
    /// By joint: number of consecutive candidates of an ordinary target whose cosine and sine differ only in sign. Empty where targets of a batch are solved
    /// one by one.
    pub runs: &'a [usize],
    /// Characteristic length of the mechanism.
    pub scale: f64,
    /// Maximal number of solutions of a target.
    pub capacity: usize,
    /// Maximal number of isolated solutions of a target, where that is proved.
    pub isolated: Option<usize>,
    /// The joints that at least one case frees, ascending.
    pub freed: &'a [usize],
    /// The conditions on a target.
    pub conditions: &'a [Condition],
    /// By target number, where forward kinematics finds it. Empty where it does not.
    pub reached: &'a [Reached],
    /// The formulas belong to a mechanism near the one of the equations. This many equations define the Newton steps from its solutions.
    pub nearby: Option<usize>,
    /// The equations are those of the ideal of a described mechanism, and have more conditions than joints. A target counts as reached by the ideal mechanism
    /// when its relative residual is at most this. It bounds twice the residual of one mechanism at a solution of the other.
    pub within: Option<f64>,
    /// The solution that the source of the mechanism selects.
    pub preference: Option<Preference>,
}

impl Facts<'_> {
    /// Facts of an empty mechanism.
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

/// The place of a joint among the numbers that the equations read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Joint {
    /// A revolute joint: its cosine and its sine.
    Angle([usize; 2]),
    /// A prismatic joint: its value.
    Length(usize),
}

/// A condition on numbers of a target. Deviations within `tolerances::ACCEPTANCE.input` are corrected; larger ones are an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Condition {
    /// The nine numbers from this index on, by rows, are a rotation matrix.
    Rotation(usize),
    /// The three numbers from this index on are a unit vector.
    Unit(usize),
}

/// The source of a target number in forward kinematics.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reached {
    /// The value that this equation compares.
    Value(usize),
    /// The angle of the cosine and the sine that these equations compare.
    Angle([usize; 2]),
    /// The value of this joint.
    Joint(usize),
}

/// Which solutions are marked as selected by the source.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Preference {
    /// The number that the equations read whose root the source selects.
    pub place: usize,
    /// Whether the source selects the greater root, else the smaller one.
    pub greatest: bool,
}

/// How a candidate was found.
#[derive(Clone, Copy, Debug)]
pub struct Found<N: Number = f64> {
    /// Number of the combination of cases and roots.
    pub branch: usize,
    /// End of the branch numbers of the first block's case.
    pub last: usize,
    /// Whether roots of earlier steps are so close that rounding moves them.
    pub close: N::Doubt,
    /// Joints that may take any value: bit `j` for joint `j`.
    pub free: u32,
    /// Whether it represents two candidates, of which the second differs only in signs ([`Facts::turned`]).
    pub is_pair: bool,
}

impl<N: Number> Found<N> {
    /// The branch of a case of the first block, whose branch numbers end at `last`.
    #[inline(always)]
    pub fn first(branch: usize, last: usize) -> Self {
        Found { branch, last, close: N::SURE, free: 0, is_pair: false }
    }

    /// The branch after a choice among `radix` of a later block.
    #[inline(always)]
    #[must_use]
    pub fn next(self, radix: usize, number: usize) -> Self {
        Found { branch: radix * self.branch + number, last: radix * self.last, ..self }
    }

    /// The branch of the root with this index.
    #[inline(always)]
    #[must_use]
    pub fn by_root<const D: usize>(self, roots: &Roots<N, D>, index: usize) -> Self {
        Found { close: self.close | roots.doubt(index), ..self }
    }

    /// The branch of both roots.
    #[inline(always)]
    #[must_use]
    pub fn by_pair(self, roots: &Roots<N, 2>) -> Self {
        Found { is_pair: roots.count() == 2, ..self.by_root(roots, 0) }
    }

    /// The branch of a solution for six axes. Its flags are the joints that are free, given as bits in `joints`, and whether it is only near a solution.
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

/// Receives candidates and decides which cases run.
pub trait Candidates<N: Number, M: Mechanism> {
    /// Whether a case runs that applies to ordinary targets.
    fn is_usual(&mut self, guard: Guard<N>) -> bool;
    /// Whether a case runs that applies to singular targets.
    fn is_rare(&mut self, guard: Guard<N>) -> bool;
    /// Whether the case of a stratum runs. It runs near the stratum; if the candidates after the first `before` lost no solution, only within rounding of it.
    fn is_due(&mut self, before: usize, guard: Guard<N>) -> bool;
    /// Number of candidates so far.
    fn count(&self) -> usize;
    /// Records whether the target is on a stratum, with this number, for which no derivation exists.
    fn is_open(&mut self, number: usize, guard: Guard<N>);
    /// The index of the greatest number that is not negative, the first of equals. The length of the list if all are negative.
    fn elect(&mut self, claims: &[N]) -> usize;
    /// Receives a candidate.
    fn take(&mut self, found: Found<N>, at: &Places<M, N>);

    /// Receives a candidate, or a pair.
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

/// The index of the greatest claim that is not negative, the first of equals. The number of claims if all are negative.
#[inline(always)]
pub(crate) fn elected(claims: impl ExactSizeIterator<Item = f64>) -> usize {
    let mut best = (-1.0, claims.len());
    for (place, claim) in claims.enumerate() {
        best = if claim > best.0 { (claim, place) } else { best };
    }
    best.1
}

/// Runs code of rare cases out of line.
#[cold]
#[inline(never)]
pub fn rarely<T>(what: impl FnOnce() -> T) -> T {
    what()
}
