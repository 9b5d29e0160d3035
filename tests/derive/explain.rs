//! Tests of `groebot::derive::explain`.

use groebot::derive::explain::explain;
use groebot::derive::lift::Derived;
use groebot::derive::Proved;
use groebot::{Watch, robots};

#[test]
fn look() {
    for name in ["puma", "ur5", "stanford", "polar"] {
        let chain = robots::by_name(name).unwrap();
        let derived = Derived::of_chain(&chain, &Watch::none()).unwrap();
        let page = explain(&Proved::Chain(Box::new(derived))).unwrap();
        std::fs::write(format!("/tmp/wt5/explain-{name}.md"), page.to_markdown()).unwrap();
        std::fs::write(format!("/tmp/wt5/explain-{name}.tex"), page.to_latex()).unwrap();
    }
}
