use crate::corpus::groebner::{self as corpus, Case, read_basis};
use crate::corpus::{Check, over};
use groebot::Watch;
use groebot::groebner::{Options, Strategy, basis};
use groebot::number::Field;
use std::time::{Duration, Instant};

struct Timing<'a>(&'a Case, Strategy);
impl Check for Timing<'_> {
    fn run<F: Field>(&self, field: F) {
        let case = self.0;
        let ring = case.ring(&field);
        let generators = case.generators(&ring);
        let known = read_basis(&ring, &case.basis);
        let start = Instant::now();
        let watch = Watch::none().with_time(Duration::from_secs(15));
        let result = basis(&ring, &generators, &Options { strategy: self.1, cofactors: false }, &watch);
        let time = start.elapsed().as_secs_f64();
        match result {
            Ok(found) => eprintln!(
                "{:8.3} {:?} {} {}",
                time,
                self.1,
                case.file,
                if found.polynomials == known { "ok" } else { "WRONG" }
            ),
            Err(error) => eprintln!("{time:8.3} {:?} {} {error}", self.1, case.file),
        }
    }
}

#[test]
fn timing() {
    for case in corpus::all() {
        for strategy in [Strategy::Normal, Strategy::Sugar] {
            over(&case.field, &case.parameters, &Timing(&case, strategy));
        }
    }
}
