//! Comparison with Pinocchio 4.1.0 at 1,000 states for each robot. `scripts/dynamics/states.py witness` writes the
//! tables of tests/corpus/dynamics. The states are generated here again.

use groebot_robot::dynamics::{Base, Equations, Model, State};
use groebot_robot::model::Robot;
use nalgebra::{DMatrix, DVector};

use super::samples::{Random, floating};

/// The index in the list is the seed of a table's states.
const TABLES: [(&str, &str, Base, &str); 6] = [
    (
        "ur5",
        include_str!("../../../../tests/corpus/dynamics/ur5.urdf"),
        Base::Fixed,
        include_str!("../../../../tests/corpus/dynamics/ur5.csv"),
    ),
    (
        "panda",
        include_str!("../../../../tests/corpus/dynamics/panda.urdf"),
        Base::Fixed,
        include_str!("../../../../tests/corpus/dynamics/panda.csv"),
    ),
    (
        "stanford",
        include_str!("../../../../tests/corpus/dynamics/stanford.urdf"),
        Base::Fixed,
        include_str!("../../../../tests/corpus/dynamics/stanford.csv"),
    ),
    (
        "rrp",
        include_str!("../../../../tests/corpus/dynamics/rrp.urdf"),
        Base::Fixed,
        include_str!("../../../../tests/corpus/dynamics/rrp.csv"),
    ),
    (
        "humanoid",
        include_str!("../../../../tests/corpus/dynamics/humanoid.urdf"),
        Base::Fixed,
        include_str!("../../../../tests/corpus/dynamics/humanoid.csv"),
    ),
    (
        "humanoid_floating",
        include_str!("../../../../tests/corpus/dynamics/humanoid.urdf"),
        Base::Floating,
        include_str!("../../../../tests/corpus/dynamics/humanoid_floating.csv"),
    ),
];

/// A sum of products, and the sum of their magnitudes.
fn product(w: &[f64], matrix: &DMatrix<f64>, x: &[f64]) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for (i, j) in (0..w.len()).flat_map(|i| (0..x.len()).map(move |j| (i, j))) {
        let term = w[i] * matrix[(i, j)] * x[j];
        sums = [sums[0] + term, sums[1] + term.abs()];
    }
    sums
}

fn along(w: &[f64], vector: &DVector<f64>) -> [f64; 2] {
    product(w, &DMatrix::from_column_slice(vector.len(), 1, vector.as_slice()), &[1.0])
}

#[test]
fn a_thousand_states_of_each_robot_agree_with_pinocchio() {
    for (seed, (name, description, base, table)) in TABLES.into_iter().enumerate() {
        let robot = Robot::from_urdf(description).unwrap();
        let equations = Equations::unchecked(&robot, base).unwrap();
        let model = Model::new(&robot).unwrap();
        let (mut room, mut random) = (equations.workspace(), Random(seed as u64));
        let (joints, count) = (equations.joints().len(), equations.freedoms());
        let mut worst = 0.0_f64;
        let mut rows = 0;
        for line in table.lines().skip(1) {
            let reported: Vec<f64> = line.split(',').map(|word| word.parse().unwrap()).collect();
            let mut q = if base == Base::Fixed { Vec::new() } else { floating(&mut random, 0) };
            q.extend(random.numbers(joints, 3.0));
            let [v, a, w, x] = [2.0, 5.0, 1.0, 1.0].map(|most| random.numbers(count, most));
            let state = State::new(&q, &v);
            let torques = equations.inverse(&mut room, state, &a).unwrap().clone();
            let mut found = vec![along(&w, &torques), along(&w, equations.gravity(&mut room, &q).unwrap())];
            let alone = equations.inertia(&mut room, &q).unwrap().clone();
            let [inertia, coriolis] = equations.matrices(&mut room, state).unwrap();
            assert!((alone - inertia).amax() < 1e-12 * inertia.amax(), "{name}");
            found.extend([product(&w, inertia, &x), product(&w, coriolis, &x)]);
            let derivatives = equations.derivatives(&mut room, state, &a).unwrap();
            found.extend([product(&w, &derivatives[0], &x), product(&w, &derivatives[1], &x)]);
            let energy = equations.energy(&mut room, state).unwrap();
            let momentum = equations.momentum(&mut room, state).unwrap();
            // Pinocchio omits a fixed root.
            let root = *model.inertia_of(0);
            let still = if base == Base::Fixed { 9.81 * root.mass() * root.centre_of_mass().z } else { 0.0 };
            found.extend([energy.kinetic, energy.potential - still].map(|x| [x, x.abs().max(1.0)]));
            for part in [momentum.linear, momentum.angular] {
                found.extend(part.iter().map(|x| [*x, part.norm()]));
            }
            for (column, ([found, size], reported)) in found.into_iter().zip(reported).enumerate() {
                let miss = (found - reported).abs() / size;
                worst = worst.max(miss);
                assert!(miss < 1e-10, "{name} row {rows} column {column}: {found} beside {reported}, off by {miss:e}");
            }
            // Forward dynamics is the inverse of inverse dynamics, and agrees with the inertia matrix.
            let bias = equations.bias(&mut room, state).unwrap().clone();
            let inertia = equations.inertia(&mut room, &q).unwrap().clone();
            let solved = inertia.cholesky().unwrap().solve(&(&torques - bias));
            let back = equations.forward(&mut room, state, torques.as_slice()).unwrap();
            let size = back.amax();
            assert!(
                (back - DVector::from_vec(a)).amax() < 1e-9 * size && (back - solved).amax() < 1e-9 * size,
                "{name}"
            );
            rows += 1;
        }
        assert_eq!(rows, 1000, "{name}");
        println!("{name}: worst {worst:e}");
    }
}
