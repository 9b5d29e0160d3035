//! Tests of `groebot_algebra::watch`: progress reports and the end of work.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use groebot_algebra::groebner::{Options, basis};
use groebot_algebra::number::Rationals;
use groebot_algebra::poly::system::PolynomialSystem;
use groebot_algebra::watch::Matrix;
use groebot_algebra::{ErrorKind, Watch};

#[test]
fn progress_and_matrices_are_reported_as_text() {
    let reported = Arc::new(Mutex::new(Vec::new()));
    let kept = Arc::clone(&reported);
    let watch = Watch::none().with_listener(move |progress| kept.lock().unwrap().push(progress.to_string()));
    watch.report("basis", 3, 5);
    watch.report_matrix("basis", 4, 9, Matrix { degree: 7, rows: 30, columns: 50, rank: 12 });
    assert_eq!(
        *reported.lock().unwrap(),
        ["basis: 3 done, 5 open", "basis: 4 done, 9 open; degree 7, matrix 30 x 50, rank 12"]
    );
}

#[test]
fn nothing_ends_work_without_limits() {
    let watch = Watch::none();
    assert!(watch.check().is_ok() && watch.check_terms(usize::MAX).is_ok() && watch.check_memory(usize::MAX).is_ok());
}

#[test]
fn memory_is_what_the_engine_or_the_meter_counts() {
    let meter = Arc::new(AtomicUsize::new(0));
    let watch = Watch::none().with_memory(3 << 20).with_meter(Arc::clone(&meter));
    assert!(watch.check_memory(3 << 20).is_ok());
    let error = watch.check_memory((3 << 20) + (1 << 19)).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Budget);
    assert!(error.message().starts_with("3.5 MiB of memory are in use, the budget allows 3.0"), "{error}");
    assert!(watch.check().is_ok());
    meter.store(5 << 20, Relaxed);
    assert_eq!(watch.check().unwrap_err().kind(), ErrorKind::Budget);
}

#[test]
fn a_raised_flag_and_a_passed_deadline_end_it() {
    let flag = Arc::new(AtomicBool::new(false));
    let watch = Watch::none().with_cancel(Arc::clone(&flag)).with_time(Duration::from_secs(1000));
    assert!(watch.check().is_ok());
    flag.store(true, Relaxed);
    assert_eq!(watch.check().unwrap_err().kind(), ErrorKind::Cancelled);
    let watch = Watch::none().with_time(Duration::ZERO);
    assert_eq!(watch.check().unwrap_err().kind(), ErrorKind::Budget);
}

#[test]
fn the_engine_keeps_to_the_memory_budget() {
    let system = PolynomialSystem::read("x*y - 1\ny*z - 2*x\nz*x - 3*y + x^2", None).unwrap();
    let ring = system.heading.ring(Rationals).unwrap();
    let generators = system.expand(&ring, &Watch::none()).unwrap();
    let within = |bytes| basis(&ring, &generators, &Options::default(), &Watch::none().with_memory(bytes));
    assert!(within(1 << 20).is_ok());
    assert_eq!(within(64).unwrap_err().kind(), ErrorKind::Budget);
}
