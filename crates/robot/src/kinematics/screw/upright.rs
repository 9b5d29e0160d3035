//! The task `position_pitch_roll` by its equivalent loop: [`on_chain`].

use nalgebra::DVector;

use super::ACCEPT;
use crate::kinematics::upright::Upright;
use crate::kinematics::{Chain, Solution, Target};
use crate::spatial::{Screw, angle, pitch_and_roll, vertical};

/// Newton steps for a solution of the ideal robot's loop on the described chain.
const STEPS: usize = 8;

/// All solutions of `chain`, from those of the loop `upright` of its ideal robot, each polished and measured on the
/// chain.
pub(super) fn on_chain(chain: &Chain, upright: &Upright, target: &Target, answers: Vec<Solution>) -> Vec<Solution> {
    let mut found: Vec<Solution> = Vec::new();
    for answer in answers {
        let q = polished(chain, target, upright.answer(target, &answer.q));
        let Some((_, position, rotation)) = miss(chain, target, &q) else { continue };
        let same = |other: &Solution| chain.are_one(&q, &other.q);
        if (position / chain.scale()).max(rotation) <= ACCEPT && !found.iter().any(same) {
            let mut free: Vec<usize> = answer.free.iter().filter_map(|&joint| upright.place(joint)).collect();
            free.sort_unstable();
            found.push(Solution { q, free, residual: position.max(rotation), ..answer });
        }
    }
    found
}

/// The residual of the tip at `q` in the rows of [`Chain::task_jacobian`], the distance, and the angle \[rad\].
fn miss(chain: &Chain, target: &Target, q: &[f64]) -> Option<(DVector<f64>, f64, f64)> {
    let Target::PositionPitchRoll { point, pitch, roll } = *target else { return None };
    let pose = chain.forward(q).ok()?;
    let shift = pose.translation.vector - point.coords;
    let (reached, rolled) = pitch_and_roll(&pose.rotation);
    let off = vertical(reached, rolled) - vertical(pitch, roll);
    // An excess rotation w of the tip moves the vertical, seen from the tip, by R^T (z x w).
    let turned = pose.rotation * off;
    let v = shift / chain.scale();
    Some((DVector::from_vec(vec![v.x, v.y, v.z, turned.y, -turned.x]), shift.norm(), off.norm()))
}

/// `q` after Newton steps, as long as they reduce the residual.
fn polished(chain: &Chain, target: &Target, mut q: Vec<f64>) -> Vec<f64> {
    let size = |q: &[f64]| miss(chain, target, q).map_or(f64::INFINITY, |(miss, ..)| miss.norm());
    let held = chain.given();
    for _ in 0..STEPS {
        let Some((missed, ..)) = miss(chain, target, &q) else { break };
        let svd = chain.task_jacobian(&q, &held).svd(true, true);
        let Ok(step) = svd.solve(&missed, 1e-9 * svd.singular_values.amax()) else { break };
        let next: Vec<f64> =
            q.iter().zip(step.iter()).enumerate().map(|(i, (q, step))| moved(chain, i, *q, *step)).collect();
        if size(&next) >= size(&q) {
            break;
        }
        q = next;
    }
    q
}

/// A joint's value minus a step \[rad, or units of the reach\].
fn moved(chain: &Chain, joint: usize, q: f64, step: f64) -> f64 {
    match chain.screws()[joint] {
        Screw::Revolute(_) => angle::wrap(q - step),
        Screw::Prismatic(_) => q - step * chain.scale(),
    }
}
