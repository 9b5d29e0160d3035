//! Memory that a thread keeps between calls: [`with_spare`].

use std::any::Any;
use std::cell::RefCell;

thread_local! {
    /// The values that no call uses at the moment, one per type unless calls were nested.
    static SPARE: RefCell<Vec<Box<dyn Any>>> = const { RefCell::new(Vec::new()) };
}

/// Lends a value of this type, with the content from its last use.
#[inline]
pub(super) fn with_spare<T: Default + 'static, R>(run: impl FnOnce(&mut T) -> R) -> R {
    let kept = SPARE.with_borrow_mut(|spare| {
        let place = spare.iter().position(|kept| kept.is::<T>())?;
        spare.swap_remove(place).downcast::<T>().ok()
    });
    let mut lent = kept.unwrap_or_default();
    let result = run(&mut lent);
    SPARE.with_borrow_mut(|spare| spare.push(lent));
    result
}
