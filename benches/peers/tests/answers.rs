//! Tests of the conventions: solutions of the peers are checked by groebot's forward kinematics, and those of groebot
//! by the peers' definitions.

use groebot::kinematics::Chain;
use groebot::kinematics::screw::one_joint::{rotate_to_distance, rotate_to_plane, rotate_to_point};
use groebot::kinematics::screw::two_joints::rotate_about_meeting_axes;
use groebot::kinematics::screw::values::Reach;
use groebot::robots;
use groebot::spatial::{Pose, angle};
use groebot_peers::Joints;
use groebot_peers::by_c;
use groebot_peers::by_ik_geo::{IkGeo, vector};
use groebot_peers::by_library::Read;
use groebot_peers::by_opw::Opw;
use groebot_peers::by_print;
use groebot_peers::inputs::{COUNT, Random, poses};
use ik_geo::subproblems::{subproblem1, subproblem2, subproblem3, subproblem4};
use nalgebra::Unit;

/// The difference of `q` from `pose`: metres plus the distance of the rotation matrices.
fn error(chain: &Chain, q: &Joints, pose: &Pose) -> f64 {
    (chain.forward(q).unwrap().to_homogeneous() - pose.to_homogeneous()).norm()
}

/// Whether all angles are equal modulo whole turns, to 1e-6 rad.
fn same(q: &[f64], other: &Joints) -> bool {
    q.iter().zip(other).all(|(a, b)| angle::difference(*a, *b).abs() < 1e-6)
}

/// Checks that every solution is correct. Returns the number of poses whose original joint values are not among the solutions.
fn missed(chain: &Chain, solve: impl Fn(&Pose) -> Vec<Joints>) -> usize {
    let mut missed = 0;
    for (q, pose) in poses(chain) {
        let answers = solve(&pose);
        for answer in &answers {
            let error = error(chain, answer, &pose);
            assert!(error < 1e-6, "{}: {answer:?} is off by {error:e}", chain.name());
        }
        missed += usize::from(!answers.iter().any(|answer| same(&q, answer)));
    }
    missed
}

#[test]
fn ik_geo_solves_our_chains() {
    for robot in robots::ALL {
        let chain = robot.chain();
        let Some(peer) = IkGeo::new(&chain) else { continue };
        assert_eq!(missed(&chain, |pose| peer.solutions(&peer.target(pose))), 0, "{}", robot.name());
    }
}

#[test]
fn opw_solves_our_arms() {
    for chain in [robots::irb120(), robots::puma()] {
        let peer = Opw::new(&chain).unwrap();
        assert_eq!(missed(&chain, |pose| peer.solutions(&peer.target(pose))), 0, "{}", chain.name());
    }
}

#[test]
fn subproblems_mean_the_same() {
    let mut random = Random(1);
    for _ in 0..COUNT {
        let (axis, p, k, turn) = (random.axis(), random.point(), random.point(), random.angle());
        let (w, reached) = (vector(&axis.direction()), axis.rotate(turn, &p));
        let ours = rotate_to_point(&axis, &p, &reached, Reach::EXACT).iter().next().unwrap();
        let (other, _) = subproblem1(&vector(&p.coords), &vector(&reached.coords), &w);
        assert!(angle::difference(ours, other).abs() < 1e-7 && angle::difference(ours, turn).abs() < 1e-7);

        let delta = (reached - k).norm();
        let (other, _) = subproblem3(&vector(&p.coords), &vector(&k.coords), &w, delta);
        for ours in rotate_to_distance(&axis, &p, &k, delta, Reach::EXACT).iter() {
            assert!(other.get_all().iter().any(|other| angle::difference(ours, *other).abs() < 1e-6));
        }
    }
}

#[test]
fn subproblems_of_two_axes_and_of_a_plane_mean_the_same() {
    let mut random = Random(2);
    for _ in 0..COUNT {
        let (first, second, p) = (random.axis(), random.axis(), random.point());
        let k = first.rotate(random.angle(), &second.rotate(random.angle(), &p));
        let ours = rotate_about_meeting_axes(&first, &second, &p, &k, Reach::EXACT);
        let [w1, w2] = [first, second].map(|axis| vector(&axis.direction()));
        let (theirs, _) = subproblem2(&vector(&p.coords), &vector(&k.coords), &w2, &-w1);
        for answer in &ours {
            let [yaw, pitch] = answer.map(Option::unwrap);
            let near = |(a, b): &(f64, f64)| angle::difference(*b, yaw).hypot(angle::difference(*a, pitch)) < 1e-5;
            assert!(theirs.get_all().iter().any(near), "{answer:?} is not among {theirs:?}");
        }

        let (normal, turned) = (random.vector(), second.rotate(random.angle(), &p));
        let ours = rotate_to_plane(&second, &p, &Unit::new_normalize(normal), &turned, Reach::EXACT);
        let height = normal.dot(&turned.coords);
        let (theirs, _) = subproblem4(&vector(&normal), &vector(&p.coords), &w2, height);
        for ours in ours.iter() {
            assert!(theirs.get_all().iter().any(|theirs| angle::difference(ours, *theirs).abs() < 1e-5));
        }
    }
}

/// C code of each compiler and the library return bitwise the same solutions as the generated Rust code.
#[test]
fn ours_are_the_same_however_compiled() {
    for robot in robots::ALL {
        let Some(printed) = by_print::solver(robot.name()) else { continue };
        let read = Read::new(robot.name());
        for (_, pose) in poses(&robot.chain()) {
            let target = by_print::target(&pose);
            let answers = (printed.solutions)(&target);
            assert!(!answers.is_empty(), "{}", robot.name());
            assert_eq!(read.solutions(&target), answers, "{}", robot.name());
            for compiled in by_c::solvers(robot.name()) {
                assert_eq!(compiled.solutions(&target), answers, "{} {:?}", robot.name(), compiled.names());
            }
        }
    }
}
