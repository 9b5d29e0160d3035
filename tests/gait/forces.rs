//! What floor and motors give in a walk, beside the zero moment point of the gait and beside statics.

use groebot::dynamics::Momentum;
use groebot::gait::{GRAVITY, Regular, Request, zero_moment_point};
use nalgebra::Vector3;

use super::{regular, request, robot, walk};

#[test]
fn the_floor_gives_what_momentum_asks_for() {
    let (biped, _) = robot();
    let weight = Vector3::new(0.0, 0.0, biped.model.mass() * GRAVITY);
    let asked = request(&Regular { steps: 3, ..regular() });
    let mut apart = Vec::new();
    for tick in [0.02, 0.01] {
        let walk = walk(&Request { tick, ..asked.clone() }).unwrap();
        let forces = walk.forces(biped);
        assert_eq!(forces.len(), walk.balances.len());
        let mut most = 0.0_f64;
        for (sample, (forces, balance)) in forces.iter().zip(&walk.balances).enumerate() {
            // The centre of the wrench is the zero moment point of the momentum's rate that it makes.
            let centre = &walk.motion.centres[sample];
            let rate = Momentum {
                linear: forces.ground.f - weight,
                angular: forces.ground.tau - centre.coords.cross(&weight),
            };
            let own = zero_moment_point(biped.model.mass(), centre, &rate).unwrap();
            assert!((own - forces.centre).norm() < 1e-9, "{sample}");
            // That of differences of momentum is another one, by the square of the time between samples.
            most = most.max((forces.centre - balance.zmp).norm());
            // Both feet together give all, and one that swings gives nothing.
            let soles = walk.references[sample].world_from_soles;
            let sum: Vector3<f64> = forces.feet.iter().map(|foot| foot.f).sum();
            let moment: Vector3<f64> = forces
                .feet
                .iter()
                .zip(&soles)
                .map(|(foot, sole)| foot.tau + sole.translation.vector.cross(&foot.f))
                .sum();
            assert!((sum - forces.ground.f).norm() < 1e-9 && (moment - forces.ground.tau).norm() < 1e-9);
            for (foot, stands) in forces.feet.iter().zip(walk.references[sample].stands) {
                assert!(if stands { foot.f.z >= 0.0 } else { foot.f.norm() == 0.0 });
            }
        }
        apart.push(most);
        // At rest the floor bears the weight below the centre of mass, and a knee the moment of what is above it.
        let (first, centre) = (&forces[0], walk.motion.centres[0]);
        assert!((first.ground.f - weight).norm() < 1e-3 * weight.z && (first.centre - centre.xy()).norm() < 1e-4);
    }
    let quarter = apart[0] / apart[1];
    assert!((3.3..5.0).contains(&quarter) && apart[1] < 2e-5, "{apart:?}");
}

#[test]
fn forces_stand_in_the_table_and_greatest_torques_are_told() {
    let (biped, _) = robot();
    let walk = walk(&request(&Regular { steps: 2, ..regular() })).unwrap();
    let forces = walk.forces(biped);
    let trajectory = walk.trajectory_with_forces(biped, &forces);
    let table = trajectory.to_csv();
    let again = groebot::motion::Trajectory::from_csv(&table).unwrap();
    let knee = again.figures.iter().find(|figure| figure.name == "tau:LKneePitch").unwrap();
    let place = biped.joints.iter().position(|joint| joint.name == "LKneePitch").unwrap();
    assert!(knee.unit == "N m" && (knee.values[40] - forces[40].torques[place]).abs() < 1e-8);
    assert!(again.points.iter().any(|point| point.name == "ground"));
    let greatest = walk.greatest_torques(biped, &forces);
    let own = forces.iter().map(|forces| forces.torques[place].abs()).fold(0.0, f64::max);
    assert!(greatest[place].torque == own && greatest[place].joint == "LKneePitch");
    // Of 5 kg on a thigh and a shank of 0.1 m each, bent: some newton metres.
    assert!((0.3..5.0).contains(&own), "{own}");
}
