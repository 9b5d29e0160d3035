//! The way from a plan to a program.

use groebot::Watch;
use groebot::derive::describe;
use groebot::derive::lift::{Form, Template};

#[test]
fn zz_show() {
    for form in [Form::Angle, Form::Turn, Form::Pair, Form::Linear, Form::Quadratic] {
        let start = std::time::Instant::now();
        let template = Template::derive(form, &Watch::none()).unwrap();
        println!("{form:?} {:?}", start.elapsed());
        for node in template.tree.walk() {
            println!("  [{}] {}", node.label, describe(node));
            if let Some(solved) = node.solved() {
                println!("{}", solved.triangular);
            }
            for e in &node.excluded {
                println!("    never zero {} {}", e.factor, e.reason);
            }
        }
    }
}
