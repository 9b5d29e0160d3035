//! Computations for a page of groebot: one call with a request and a response, both as JSON.
//!
//! The page allocates memory for a request by [`allocate`], writes it there, and calls [`call`], which returns the address of the response. [`length`] returns
//! its length. Both are valid until the next call.

mod arm;
mod session;

use std::cell::RefCell;

use session::Session;

thread_local! {
    static SESSION: RefCell<Session> = RefCell::default();
    static REQUEST: RefCell<Vec<u8>> = RefCell::default();
    static ANSWER: RefCell<String> = RefCell::default();
}

/// Allocates memory for a request of this number of bytes.
#[unsafe(no_mangle)]
pub extern "C" fn allocate(bytes: usize) -> *mut u8 {
    REQUEST.with_borrow_mut(|request| {
        request.clear();
        request.resize(bytes, 0);
        request.as_mut_ptr()
    })
}

/// Processes the written request. Returns the address of the response.
#[unsafe(no_mangle)]
pub extern "C" fn call() -> *const u8 {
    let answer = REQUEST.with_borrow(|request| SESSION.with_borrow_mut(|session| session.answer(request)));
    ANSWER.with_borrow_mut(|own| {
        *own = answer;
        own.as_ptr()
    })
}

/// Length of the last response in bytes.
#[unsafe(no_mangle)]
pub extern "C" fn length() -> usize {
    ANSWER.with_borrow(String::len)
}
