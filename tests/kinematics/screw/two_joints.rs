//! Two joints of any kind.

use groebot::kinematics::screw::two_joints::two_screws_to_point;
use groebot::spatial::Screw;

use super::EXACT;
use super::instance::{Random, forward, judge};

#[test]
fn smoke() {
    for kinds in 0..4 {
        let (mut lost, mut worst, mut counts, mut repeated) = (0, 0.0_f64, [0; 9], 0);
        for seed in 0..5000 {
            let mut random = Random(seed);
            let screws: [Screw; 2] = std::array::from_fn(|i| random.screw(kinds >> i & 1 == 0));
            let p = random.point();
            let q: [f64; 2] =
                std::array::from_fn(|i| if kinds >> i & 1 == 0 { random.angle() } else { random.uniform(-1.0, 1.0) });
            let k = forward(&screws, q, &p);
            let answers = two_screws_to_point(&screws[0], &screws[1], &p, &k, EXACT);
            let verdict = judge(&screws, &p, q, &answers);
            if verdict.lost {
                lost += 1;
                println!("{seed} {verdict:?}");
            }
            repeated += usize::from(verdict.repeated);
            worst = worst.max(verdict.residual);
            counts[verdict.count] += 1;
        }
        println!("{kinds:02b}: lost {lost} repeated {repeated} worst {worst:e} counts {counts:?}");
    }
}
