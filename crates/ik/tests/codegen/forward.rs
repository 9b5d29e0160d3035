//! Forward kinematics by the equations of a program, compared with that of the chain.

use std::fs;

use groebot_ik::solver::Reached;

use super::random;
use super::samples::{arm, leg, polar, wrist};
use super::stored::{all, joint_values, reached};

#[test]
fn every_stored_chain_reaches_its_forward_kinematics() {
    let mut chains = 0;
    for stored in all() {
        let Some(chain) = stored.chain else { continue };
        if stored.program.forward().is_none() {
            // The equations of the first are those of a system. In the second, pitch and roll are not parameters of its equations.
            assert!(["nao_leg_sagittal", "upright_arm"].contains(&stored.name.as_str()), "{}", stored.name);
            continue;
        }
        chains += 1;
        for q in joint_values(&stored.program, 40, random()) {
            let target = stored.program.reached(&q).unwrap();
            let expected = reached(&chain, &q);
            assert_eq!(target.len(), expected.len(), "{}", stored.name);
            for ((value, expected), input) in target.iter().zip(&expected).zip(&stored.program.inputs) {
                let off = (value - expected).abs();
                let off = if input.name == "phi" { off.min((off - std::f64::consts::TAU).abs()) } else { off };
                assert!(
                    off <= 1e-14 * (1.0 + stored.program.scale),
                    "{} at {q:?}: {} {value} {expected}",
                    stored.name,
                    input.name
                );
            }
        }
    }
    assert!(chains >= 24, "{chains}");
}

#[test]
fn a_given_joint_is_distinguished_from_the_target() {
    for stored in all() {
        let Some(chain) = &stored.chain else { continue };
        let Some(forward) = stored.program.forward() else { continue };
        let given: Vec<usize> = forward
            .inputs
            .iter()
            .filter_map(|input| if let Reached::Joint(joint) = input { Some(*joint) } else { None })
            .collect();
        assert_eq!(given, chain.given(), "{}", stored.name);
    }
}

#[test]
fn equations_that_mix_target_and_joints_have_none() {
    assert!(
        leg::program().forward().is_none()
            && arm::program().forward().is_none()
            && polar::program().forward().is_none()
    );
    assert!(wrist::program(false).reached(&[0.0; 2]).is_none(), "three joints");
}

/// The stored programs can be read with and without the field about their source.
#[test]
fn what_is_known_of_the_source_is_optional_and_checked() {
    let text =
        fs::read_to_string(concat!(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."), "/derivations/puma/5_program.json"))
            .unwrap();
    let mut program = groebot_ik::solver::Program::from_json(&text).unwrap();
    let about = |limits| Some(groebot_ik::solver::About { hash: "0".into(), limits, ..Default::default() });
    program.about = about(vec![Some((-1.0, 1.0)); 6]);
    assert_eq!(groebot_ik::solver::Program::from_json(&program.to_json()).unwrap(), program);
    for limits in [vec![None; 5], vec![Some((1.0, -1.0)); 6], vec![Some((f64::NAN, 1.0)); 6]] {
        program.about = about(limits);
        assert!(program.validate().unwrap_err().message().contains("limits"));
    }
}
