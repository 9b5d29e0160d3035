//! Ground reactions and joint torques of a walk, compared with the zero moment point (ZMP) and with statics.

use groebot_humanoid::gait::{GRAVITY, Regular, Request, zero_moment_point};
use groebot_robot::dynamics::Momentum;
use nalgebra::Vector3;

use super::{regular, request, robot, walk};

#[test]
fn ground_reactions_equal_the_rate_of_momentum() {
    let (biped, _) = robot();
    let weight = Vector3::new(0.0, 0.0, biped.model.mass() * GRAVITY);
    let requested = request(&Regular { steps: 3, ..regular() });
    let mut apart = Vec::new();
    for tick in [0.02, 0.01] {
        let walk = walk(&Request { tick, ..requested.clone() }).unwrap();
        let forces = walk.forces(biped);
        assert_eq!(forces.len(), walk.balances.len());
        let mut most = 0.0_f64;
        for (sample, (forces, balance)) in forces.iter().zip(&walk.balances).enumerate() {
            // The centre of pressure of the wrench is the ZMP for the rate of change of momentum that it causes.
            let centre = &walk.motion.centres[sample];
            let rate = Momentum {
                linear: forces.ground.f - weight,
                angular: forces.ground.tau - centre.coords.cross(&weight),
            };
            let own = zero_moment_point(biped.model.mass(), centre, &rate).unwrap();
            assert!((own - forces.centre).norm() < 1e-9, "{sample}");
            // The ZMP from differences of momentum deviates by the square of the time between samples.
            most = most.max((forces.centre - balance.zmp).norm());
            // The reactions of both feet have the total as their sum, and that of a swing foot is zero.
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
        // At rest the floor supports the weight below the centre of mass, and the knee torque balances the bodies above it.
        let (first, centre) = (&forces[0], walk.motion.centres[0]);
        assert!((first.ground.f - weight).norm() < 1e-3 * weight.z && (first.centre - centre.xy()).norm() < 1e-4);
    }
    let quarter = apart[0] / apart[1];
    assert!((3.3..5.0).contains(&quarter) && apart[1] < 2e-5, "{apart:?}");
}

#[test]
fn forces_are_in_the_table_and_greatest_torques_are_reported() {
    let (biped, _) = robot();
    let walk = walk(&request(&Regular { steps: 2, ..regular() })).unwrap();
    let forces = walk.forces(biped);
    let trajectory = walk.trajectory_with_forces(biped, &forces);
    let table = trajectory.to_csv();
    let again = groebot_robot::motion::Trajectory::from_csv(&table).unwrap();
    let knee = again.figures.iter().find(|figure| figure.name == "tau:LKneePitch").unwrap();
    let place = biped.joints.iter().position(|joint| joint.name == "LKneePitch").unwrap();
    assert!(knee.unit == "N m" && (knee.values[40] - forces[40].torques[place]).abs() < 1e-8);
    assert!(again.points.iter().any(|point| point.name == "ground"));
    let greatest = walk.greatest_torques(biped, &forces);
    let own = forces.iter().map(|forces| forces.torques[place].abs()).fold(0.0, f64::max);
    assert!(greatest[place].torque == own && greatest[place].joint == "LKneePitch");
    // 5 kg on a bent thigh and shank of 0.1 m each: some newton metres.
    assert!((0.3..5.0).contains(&own), "{own}");
}

/// RH0 (3-40), (3-41): with the wrench through the trunk, the two chains equal the whole multibody. Without it, they differ when a foot swings.
#[test]
fn two_chains_are_the_whole_with_what_goes_through_the_trunk() {
    let (biped, _) = robot();
    let walk = walk(&request(&Regular { steps: 2, ..regular() })).unwrap();
    let forces = walk.forces(biped);
    let chains = walk.chains(biped, &forces);
    let difference = walk.difference(biped, &forces, &chains);
    assert!(difference.rounding < 1e-10, "{difference:?}");
    // Alone, a chain with a swing foot would need half of the robot's weight on it, and the hip would have a corresponding torque.
    let half = 0.5 * biped.model.mass() * GRAVITY;
    assert!((difference.swinging / half - 1.0).abs() < 0.1 && (difference.between[0] / half - 1.0).abs() < 0.1);
    assert!(difference.torque > 1.0 && difference.joint.contains("Hip") || difference.joint.contains("Ankle"));
    for ((forces, chains), reference) in forces.iter().zip(&chains).zip(&walk.references) {
        let up = chains.alone.map(|alone| alone.f.z);
        assert!((up[0] + up[1] - forces.ground.f.z).abs() < 1e-9);
        // The wrench through the trunk is the difference between the actual ground reaction and that of the supporting chain alone.
        let swings = reference.stands.iter().position(|stands| !stands);
        if let Some(side) = swings {
            let sign = if side == 0 { 1.0 } else { -1.0 };
            assert!((chains.between.f.z - sign * up[side]).abs() < 1e-9);
        }
    }
    let mut trajectory = walk.trajectory_with_forces(biped, &forces);
    walk.add_chains(biped, &chains, &mut trajectory);
    let again = groebot_robot::motion::Trajectory::from_csv(&trajectory.to_csv()).unwrap();
    assert!(
        ["chain:LKneePitch", "trunk_mz"].iter().all(|name| again.figures.iter().any(|figure| figure.name == *name))
    );
}
