//! Storage of a mechanism's numbers: arrays whose lengths are known at compile time ([`Fixed`]), or lists for a program that is interpreted.

use core::array::from_fn;

/// A row of values.
pub trait Array<T>: Clone + AsRef<[T]> + AsMut<[T]> {
    /// The row of this length, with the values of a function.
    fn by(length: usize, value: impl FnMut(usize) -> T) -> Self;
}

impl<T: Clone, const L: usize> Array<T> for [T; L] {
    #[inline(always)]
    fn by(length: usize, value: impl FnMut(usize) -> T) -> Self {
        debug_assert_eq!(length, L, "a row has the length of its type");
        from_fn(value)
    }
}

/// The types of rows that solving uses.
pub trait Storage {
    /// One value for each target number.
    type Inputs<T: Clone>: Array<T>;
    /// One for each parameter.
    type Parameters<T: Clone>: Array<T>;
    /// One for each joint.
    type Joints<T: Clone>: Array<T>;
    /// One for each number that the equations read of joints.
    type Places<T: Clone>: Array<T>;
    /// One for each equation.
    type Equations<T: Clone>: Array<T>;
    /// One for each size that equations have.
    type Sizes<T: Clone>: Array<T>;
    /// One for each equation of the normal-equation steps.
    type Shorts<T: Clone>: Array<T>;
    /// One for each candidate of an ordinary target.
    type Candidates<T: Clone>: Array<T>;
    /// One for each possible solution of a target.
    type Answers<T: Clone>: Array<T>;
    /// `JOINTS + 1` columns with one number for each equation and each joint.
    type Triangle: Array<f64>;
}

/// Arrays of these lengths; `TRIANGLE` is `(JOINTS + 1) * (EQUATIONS + JOINTS)`.
#[derive(Clone, Copy, Debug)]
pub struct Fixed<
    const INPUTS: usize,
    const PARAMETERS: usize,
    const JOINTS: usize,
    const PLACES: usize,
    const EQUATIONS: usize,
    const SIZES: usize,
    const SHORTS: usize,
    const CANDIDATES: usize,
    const ANSWERS: usize,
    const TRIANGLE: usize,
>;

impl<
    const INPUTS: usize,
    const PARAMETERS: usize,
    const JOINTS: usize,
    const PLACES: usize,
    const EQUATIONS: usize,
    const SIZES: usize,
    const SHORTS: usize,
    const CANDIDATES: usize,
    const ANSWERS: usize,
    const TRIANGLE: usize,
> Storage for Fixed<INPUTS, PARAMETERS, JOINTS, PLACES, EQUATIONS, SIZES, SHORTS, CANDIDATES, ANSWERS, TRIANGLE>
{
    type Inputs<T: Clone> = [T; INPUTS];
    type Parameters<T: Clone> = [T; PARAMETERS];
    type Joints<T: Clone> = [T; JOINTS];
    type Places<T: Clone> = [T; PLACES];
    type Equations<T: Clone> = [T; EQUATIONS];
    type Sizes<T: Clone> = [T; SIZES];
    type Shorts<T: Clone> = [T; SHORTS];
    type Candidates<T: Clone> = [T; CANDIDATES];
    type Answers<T: Clone> = [T; ANSWERS];
    type Triangle = [f64; TRIANGLE];
}
