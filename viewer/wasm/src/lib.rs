//! What a page of groebot computes: one call that takes a request and gives its answer, both as JSON.
//!
//! The page allocates room for a request by [`allocate`], writes it there, and calls [`call`]; the answer's place is what that returns, its length is
//! told by [`length`]. Both stay valid until the next call.

mod desk;

use std::cell::RefCell;

use desk::Desk;

thread_local! {
    static DESK: RefCell<Desk> = RefCell::default();
    static REQUEST: RefCell<Vec<u8>> = RefCell::default();
    static ANSWER: RefCell<String> = RefCell::default();
}

/// Room for a request of so many bytes.
#[unsafe(no_mangle)]
pub extern "C" fn allocate(bytes: usize) -> *mut u8 {
    REQUEST.with_borrow_mut(|request| {
        request.clear();
        request.resize(bytes, 0);
        request.as_mut_ptr()
    })
}

/// Answers the request that was written; where the answer is.
#[unsafe(no_mangle)]
pub extern "C" fn call() -> *const u8 {
    let answer = REQUEST.with_borrow(|request| DESK.with_borrow_mut(|desk| desk.answer(request)));
    ANSWER.with_borrow_mut(|own| {
        *own = answer;
        own.as_ptr()
    })
}

/// How many bytes the last answer has.
#[unsafe(no_mangle)]
pub extern "C" fn length() -> usize {
    ANSWER.with_borrow(String::len)
}
