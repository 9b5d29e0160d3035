//! NAO's leg in the sagittal plane, the mechanism of its chapter: from its description to the polynomials and all solutions of a target.
//!
//!     cargo run --release --example 02_planar_leg

use groebot::derive::Derivation;
use groebot::derive::formulate;
use groebot::kinematics::Chain;
use groebot::{Result, Watch};

fn main() -> Result<()> {
    let chain = Chain::read("derivations/nao_leg_sagittal/0_chain.toml".as_ref())?;
    let derivation = Derivation::of_problem(formulate(&chain)?, &Watch::none())?;
    if let Some(solved) = derivation.equations().and_then(|equations| equations.method.requested.solved()) {
        println!("{}", solved.triangular);
    }

    let target = [60.0, 150.0];
    for solution in derivation.program().solve_numbers(&target)? {
        let tip = chain.forward(&solution.q)?.translation.vector;
        let error = (tip.x - target[0]).hypot(tip.z - target[1]);
        println!("q = {:.6?} rad puts the ankle at ({:.6}, {:.6}) mm, off by {error:.1e} mm", solution.q, tip.x, tip.z);
        assert!(error < 1e-10, "forward kinematics disagrees");
    }
    Ok(())
}
