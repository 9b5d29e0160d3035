//! The counts of the record: 100,000 poses for each robot, and 200 of them compared with the numeric oracle.
//!
//! `cargo test --release -- --ignored screw_record --nocapture` prints the rows of
//! `benches/record/DATE-screw-solver.csv`.

use std::f64::consts::PI;

use groebot_robot::kinematics::screw::ScrewSolver;
use groebot_robot::kinematics::{Chain, Target};
use groebot_robot::robots;

use super::solver::{distance, has_rotation, matching, oracle, reach, sigma, worst_residual};

const POSES: usize = 100_000;
const ORACLE_POSES: usize = 200;

/// Numbers in [0, 1): SplitMix64 (Steele, Lea and Flood 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn configuration(&mut self, chain: &Chain) -> Vec<f64> {
        let value = |screw: &groebot_robot::spatial::Screw| match screw.axis() {
            Some(_) => PI - 2.0 * PI * self.next(),
            None => 1.5 * reach(chain) * (2.0 * self.next() - 1.0),
        };
        chain.screws().iter().map(value).collect()
    }
}

#[derive(Default)]
struct Tally {
    lost: usize,
    residuals: Vec<f64>,
    counts: [usize; 17],
    oracle: [usize; 3],
}

fn measure(chain: &Chain) -> Tally {
    let solver = ScrewSolver::new(chain).unwrap();
    let (mut random, mut tally) = (Random(2026), Tally::default());
    for pose in 0..POSES {
        let q = random.configuration(chain);
        let target = Target::reached(chain, &q).unwrap();
        let answers = solver.solve(&target).unwrap();
        let near = answers.iter().map(|answer| distance(chain, &q, &answer.q)).fold(f64::INFINITY, f64::min);
        let sigma = sigma(chain, &q, has_rotation(&target));
        if near > matching(sigma) {
            println!("# lost: {} at {q:?}, nearest {near:e}, sigma {sigma:e}", chain.name());
            tally.lost += 1;
        }
        tally.residuals.push(worst_residual(chain, &target, &answers));
        tally.counts[answers.len()] += 1;
        if pose < ORACLE_POSES {
            let found = oracle(chain, &target).len();
            tally.oracle[usize::from(found != answers.len()) + usize::from(found > answers.len())] += 1;
        }
    }
    tally.residuals.sort_by(f64::total_cmp);
    tally
}

#[test]
#[ignore = "minutes in release mode: 100,000 poses for each robot"]
fn screw_record() {
    println!("robot,poses,lost,residual_p50,residual_p99.9,residual_max,answers,oracle_equal,oracle_fewer,oracle_more");
    for robot in robots::ALL {
        let tally = measure(&robot.chain());
        let at = |share: f64| tally.residuals[((POSES - 1) as f64 * share) as usize];
        let counts = tally.counts.iter().enumerate().filter(|(_, poses)| **poses > 0);
        let counts: Vec<String> = counts.map(|(answers, poses)| format!("{answers}:{poses}")).collect();
        let [equal, fewer, more] = tally.oracle;
        println!(
            "{},{POSES},{},{:.1e},{:.1e},{:.1e},{},{equal},{fewer},{more}",
            robot.name(),
            tally.lost,
            at(0.5),
            at(0.999),
            at(1.0),
            counts.join(" ")
        );
        assert_eq!(tally.lost, 0, "{}", robot.name());
        assert!(at(0.999) <= 1e-12, "{}", robot.name());
        assert_eq!(more, 0, "{}: the oracle has answers of its own", robot.name());
    }
}
