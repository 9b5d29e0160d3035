//! The way through a program's blocks to a candidate. Main type: [`Path`].

use super::MAX_JOINTS;

/// The choices made on the way to a candidate.
#[derive(Clone, Copy, Default)]
pub(super) struct Path {
    /// The branch number as far as it is known, in mixed radix over the blocks.
    pub branch: usize,
    /// The end of the branch numbers of the first block's case.
    pub last: usize,
    /// The choice of roots in the running case, in mixed radix over its root steps.
    pub choice: usize,
    /// Whether roots on the way are so near one another that rounding moves them.
    pub close: bool,
    /// By joint: whether a case on the way leaves it free.
    pub free: [bool; MAX_JOINTS],
}
