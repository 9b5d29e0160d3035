//! Times of the subproblems, of the screw solver for all solutions of one pose of each known robot, and of its plan.

use std::f64::consts::PI;
use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use groebot::kinematics::screw::ScrewSolver;
use groebot::kinematics::screw::circles::four_circles;
use groebot::kinematics::screw::one_joint::{
    rotate_to_distance, rotate_to_plane, rotate_to_point, translate_to_distance, translate_to_plane,
};
use groebot::kinematics::screw::three_joints::{rotate_three_parallel_to_pose, three_screws_to_point};
use groebot::kinematics::screw::two_joints::two_screws_to_point;
use groebot::kinematics::screw::values::{Reach, Values};
use groebot::kinematics::{Chain, Target};
use groebot::robots;
use groebot::spatial::{Pose, Screw};
use nalgebra::{Point3, Rotation3, Unit, Vector3};

/// Poses that `chain` reaches, evenly spread over its joint space (a Kronecker sequence).
fn targets(chain: &Chain, count: usize) -> Vec<Target> {
    let share = |seed: usize, joint: usize| {
        ((seed as f64 + 0.5) * 1.220_744_084_605_759_5_f64.powi(-(joint as i32) - 1)).fract()
    };
    let value = |seed: usize, joint: usize| match chain.screws()[joint].axis() {
        Some(_) => PI * (2.0 * share(seed, joint) - 1.0),
        None => chain.reach() * share(seed, joint),
    };
    let configuration = |seed: usize| (0..chain.joints().len()).map(|joint| value(seed, joint)).collect::<Vec<_>>();
    (0..count).map(|seed| Target::reached(chain, &configuration(seed)).expect("finite values")).collect()
}

fn solve(c: &mut Criterion) {
    let mut group = c.benchmark_group("screw_solve");
    for robot in robots::ALL {
        let chain = robot.chain();
        let solver = ScrewSolver::new(&chain).expect("a chain that it solves");
        let targets = targets(&chain, 256);
        let mut next = targets.iter().cycle();
        group.bench_function(robot.name(), |b| b.iter(|| solver.solve(black_box(next.next().expect("a cycle")))));
    }
    group.finish();
}

fn plan(c: &mut Criterion) {
    let mut group = c.benchmark_group("screw_plan");
    group.sample_size(20);
    for robot in robots::ALL {
        let chain = robot.chain();
        group.bench_function(robot.name(), |b| b.iter(|| ScrewSolver::new(black_box(&chain))));
    }
    group.finish();
}

/// Pseudorandom axes, screws, points and numbers for the 256 instances, reproducible.
struct Spread(f64);

impl Spread {
    fn next(&mut self) -> f64 {
        self.0 = (self.0 * 997.130_7 + 0.123_4).fract();
        2.0 * self.0 - 1.0
    }

    fn vector(&mut self) -> Vector3<f64> {
        Vector3::new(self.next(), self.next(), self.next())
    }

    fn point(&mut self) -> Point3<f64> {
        self.vector().into()
    }

    fn turn(&mut self, w: Vector3<f64>) -> Screw {
        Screw::revolute(w, self.point()).expect("a direction")
    }

    /// A point, and its image under the screws.
    fn path(&mut self, screws: &[Screw]) -> (Point3<f64>, Point3<f64>) {
        let p = self.point();
        let k = screws.iter().rev().fold(p, |x, screw| screw.exp(3.0 * self.next()) * x);
        (p, k)
    }
}

/// Measures `call` over instances from `make`.
fn each<T>(c: &mut Criterion, name: &str, make: impl Fn(&mut Spread) -> T, call: impl Fn(&T) -> usize) {
    let mut spread = Spread(0.371);
    let instances: Vec<T> = (0..256).map(|_| make(&mut spread)).collect();
    let mut next = instances.iter().cycle();
    c.bench_function(&format!("subproblem/{name}"), |b| {
        b.iter(|| call(black_box(next.next().expect("a cycle"))));
    });
}

type Way = (Vec<Screw>, Point3<f64>, Point3<f64>);

fn carried(spread: &mut Spread, screws: Vec<Screw>) -> Way {
    let (p, k) = spread.path(&screws);
    (screws, p, k)
}

fn subproblems(c: &mut Criterion) {
    let exact = Reach::EXACT;
    let one = |s: &mut Spread| {
        let w = s.vector();
        let screws = vec![s.turn(w)];
        carried(s, screws)
    };
    let axis = |path: &Way| *path.0[0].axis().expect("it turns");
    let count = |values: Values| values.iter().count();
    let z = Vector3::z_axis();
    let away = Point3::new(0.3, -0.2, 0.5);
    each(c, "pk1", one, |path| count(rotate_to_point(&axis(path), &path.1, &path.2, exact)));
    each(c, "pk3", one, |path| count(rotate_to_distance(&axis(path), &path.1, &away, (path.2 - away).norm(), exact)));
    each(c, "pg5", one, |path| count(rotate_to_plane(&axis(path), &path.1, &z, &path.2, exact)));
    each(c, "pardos_one", one, |path| count(translate_to_distance(&z, &path.1, &away, 2.0, exact)));
    each(c, "pg1", one, |path| count(translate_to_plane(&axis(path).direction(), &path.1, &z, &path.2, exact)));
    let two = |path: &Way| two_screws_to_point(&path.0[0], &path.0[1], &path.1, &path.2, exact).len();
    let meeting = |s: &mut Spread| {
        let (v, w) = (s.vector(), s.vector());
        let screws = [v, w].map(|w| Screw::revolute(w, away).expect("a direction")).to_vec();
        carried(s, screws)
    };
    let parallel = |s: &mut Spread| {
        let w = s.vector();
        let screws = vec![s.turn(w), s.turn(w)];
        carried(s, screws)
    };
    let skew = |s: &mut Spread| {
        let (v, w) = (s.vector(), s.vector());
        let screws = vec![s.turn(v), s.turn(w)];
        carried(s, screws)
    };
    let slides = |s: &mut Spread| {
        let screws = [s.vector(), s.vector()].map(|w| Screw::prismatic(w).expect("a direction")).to_vec();
        carried(s, screws)
    };
    each(c, "pk2", meeting, two);
    each(c, "pg4", parallel, two);
    each(c, "pg6", skew, two);
    each(c, "pg2", slides, two);
    let three = |path: &Way| three_screws_to_point([&path.0[0], &path.0[1], &path.0[2]], &path.1, &path.2, exact).len();
    let general = |s: &mut Spread| {
        let (u, v, w) = (s.vector(), s.vector(), s.vector());
        let screws = vec![s.turn(u), s.turn(v), s.turn(w)];
        carried(s, screws)
    };
    let skew_and_two = |s: &mut Spread| {
        let (v, w) = (s.vector(), s.vector());
        let screws = vec![s.turn(v), s.turn(w), s.turn(w)];
        carried(s, screws)
    };
    each(c, "three_circles", general, three);
    each(c, "pg7", skew_and_two, three);
    let poses = |s: &mut Spread| {
        let w = s.vector();
        let axes = [s.turn(w), s.turn(w), s.turn(w)];
        let pose = axes.iter().fold(Pose::identity(), |pose, screw| pose * screw.exp(3.0 * s.next()));
        (axes, pose)
    };
    each(c, "pg8", poses, |(axes, pose)| {
        let axes = axes.each_ref().map(|screw| screw.axis().expect("it turns"));
        rotate_three_parallel_to_pose(axes, pose, exact).len()
    });
    let equations = |s: &mut Spread| {
        let (h, k, p) = (
            [(); 4].map(|()| s.vector()),
            [(); 4].map(|()| Unit::new_normalize(s.vector())),
            [(); 4].map(|()| s.vector()),
        );
        let q = [3.0 * s.next(), 3.0 * s.next()];
        let term = |i: usize| h[i].dot(&(Rotation3::from_axis_angle(&k[i], q[i % 2]) * p[i]));
        (h, k, p, term(0) + term(1), term(2) + term(3))
    };
    each(c, "four_circles", equations, |(h, k, p, d1, d2)| four_circles(*h, *k, *p, [*d1, *d2], exact).len());
}

criterion_group!(benches, subproblems, solve, plan);
criterion_main!(benches);
