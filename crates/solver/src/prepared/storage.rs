//! Rows of a prepared program: of the length that the program needs, without allocation where they are short. Main
//! type: [`Dynamic`].

use groebot_runtime::storage::{Array, Storage};
use smallvec::SmallVec;

/// A row of values, up to `L` of them without allocation.
#[derive(Clone, Debug, PartialEq)]
pub struct Row<T, const L: usize>(SmallVec<[T; L]>);

impl<T, const L: usize> AsRef<[T]> for Row<T, L> {
    #[inline(always)]
    fn as_ref(&self) -> &[T] {
        &self.0
    }
}

impl<T, const L: usize> AsMut<[T]> for Row<T, L> {
    #[inline(always)]
    fn as_mut(&mut self) -> &mut [T] {
        &mut self.0
    }
}

impl<T: Clone, const L: usize> Array<T> for Row<T, L> {
    #[inline(always)]
    fn by(length: usize, value: impl FnMut(usize) -> T) -> Self {
        // An array is filled faster than a list.
        if length == L {
            return Row(SmallVec::from_buf(std::array::from_fn(value)));
        }
        Row((0..length).map(value).collect())
    }
}

/// Arrays for a pose of six joints, which usually has eight solutions, and rows for the other data of a program.
#[derive(Clone, Copy, Debug)]
pub struct SixJoints;

impl Storage for SixJoints {
    type Inputs<T: Clone> = [T; 12];
    type Parameters<T: Clone> = [T; 13];
    type Joints<T: Clone> = [T; 6];
    type Places<T: Clone> = [T; 12];
    type Equations<T: Clone> = [T; 12];
    type Sizes<T: Clone> = [T; 2];
    type Shorts<T: Clone> = [T; 6];
    type Candidates<T: Clone> = [T; 8];
    type Answers<T: Clone> = Row<T, 8>;
    type Triangle = [f64; 126];
}

/// Rows whose lengths depend on the program.
#[derive(Clone, Copy, Debug)]
pub struct Dynamic;

impl Storage for Dynamic {
    type Inputs<T: Clone> = Row<T, 12>;
    type Parameters<T: Clone> = Row<T, 16>;
    type Joints<T: Clone> = Row<T, 8>;
    type Places<T: Clone> = Row<T, 12>;
    type Equations<T: Clone> = Row<T, 12>;
    type Sizes<T: Clone> = Row<T, 2>;
    type Shorts<T: Clone> = Row<T, 8>;
    type Candidates<T: Clone> = Row<T, 8>;
    type Answers<T: Clone> = Row<T, 8>;
    type Triangle = Row<f64, 128>;
}
