//! Bases over rational functions: three ways to one answer.

use std::time::Instant;

use groebot::Watch;
use groebot::groebner::parametric::{Options, Way, basis};

use super::blocks::{self, Mechanism};

#[test]
#[ignore = "a measurement"]
fn time_of_blocks() {
    let time = |name: &str, block: fn() -> Mechanism, ways: &[Way]| {
        let Mechanism { ring, generators, solutions } = block();
        for &way in ways {
            let mut best = f64::INFINITY;
            let total = Instant::now();
            let mut size = (0, 0);
            while total.elapsed().as_secs_f64() < 0.5 {
                let start = Instant::now();
                let found = basis(&ring, &generators, &Options { way: Some(way) }, &Watch::none().with_time(std::time::Duration::from_secs(100)));
                best = best.min(start.elapsed().as_secs_f64());
                match found {
                    Err(error) => { println!("{name} {way:?}: {error}"); break }
                    Ok(found) => {
                        assert_eq!(found.basis.quotient_dimension(), Some(solutions), "{name}");
                        let coefficients = || found.basis.polynomials.iter().flat_map(|f| f.terms());
                        let largest = coefficients().map(|t| t.coefficient.numerator().terms().len().max(t.coefficient.denominator().terms().len())).max().unwrap();
                        size = (coefficients().count(), largest);
                    }
                }
            }
            println!("{name:25} {way:?}: {:.3} ms {size:?}", best * 1e3);
        }
    };
    use Way::*;
    time("nao_leg", blocks::nao_leg, &[Direct, Variables, Interpolation]);
    time("nao_arm", blocks::nao_arm, &[Direct, Variables, Interpolation]);
    time("planar_3r", blocks::planar_3r, &[Direct, Variables]);
    time("puma_position", blocks::puma_position, &[Direct, Interpolation]);
    time("puma_symbolic", blocks::puma_symbolic, &[Interpolation]);
    time("generic_3r_position", blocks::generic_3r_position, &[Interpolation]);
    if std::env::var("BIG").is_ok() { time("generic_3r_symbolic", blocks::generic_3r_symbolic, &[Interpolation]); }
}
