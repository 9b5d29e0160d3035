//! A ray as a pose: two unit vectors perpendicular to the ray fix an arbitrary rotation about it.

use nalgebra::Vector3;
use num_traits::ToPrimitive;

use super::emit::{Emitted, Emitter};
use crate::derive::closure::{Arithmetic, Mechanism};
use crate::derive::equations::assemble::Assembler;
use crate::solver::{Block, Case, Operand, Pivot, Step};

/// The parameters of a ray's direction.
const DIRECTION: [Operand; 3] = [Operand::Parameter(3), Operand::Parameter(4), Operand::Parameter(5)];

/// The block that finds two unit vectors perpendicular to a ray and to each other. The first is also perpendicular to a coordinate axis: the one with the
/// greatest angle to the ray.
pub(super) fn across([first, second]: [[usize; 3]; 2]) -> Block {
    let case = |axis: usize| {
        let (mut assembler, d) = (Assembler::default(), DIRECTION);
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        let squares = [assembler.mul(d[a], d[a]), assembler.mul(d[b], d[b])];
        let square = assembler.add(squares[0], squares[1]);
        let guard_code = assembler.take();
        let length = assembler.sqrt(square);
        let mut u = [Operand::Constant(0.0); 3];
        u[a] = assembler.div(d[b], length);
        let quotient = assembler.div(d[a], length);
        u[b] = assembler.mul(Operand::Constant(-1.0), quotient);
        let v: [Operand; 3] = std::array::from_fn(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let (left, right) = (assembler.mul(d[i], u[j]), assembler.mul(d[j], u[i]));
            assembler.sub(left, right)
        });
        let sets = first.into_iter().zip(u).chain(second.into_iter().zip(v));
        let sets = sets.map(|(unknown, value)| Step::Set { unknown, value });
        Case {
            label: format!("across {}", ["x", "y", "z"][axis]),
            guard_code,
            pivot: Some(Pivot { group: 0, value: square }),
            steps: [Step::Compute(assembler.take())].into_iter().chain(sets).collect(),
            ..Case::default()
        }
    };
    Block::numbered("directions across the ray", Vec::new(), (0..3).map(case).collect())
}

/// The pose that replaces a ray: its point, and a rotation from the zero configuration. The rotation takes the tip's direction and two unit vectors
/// perpendicular to it to the ray's direction and the unknowns `across`.
pub(super) fn turned(mechanism: &Mechanism, across: [[usize; 3]; 2], emitter: &mut Emitter<'_>) -> Vec<Emitted> {
    let aim = mechanism.aim().each_ref().map(|entry| entry.to_f64().unwrap_or(0.0));
    let aim = Vector3::from(aim).normalize();
    let side = aim.cross(&Vector3::ith(aim.iamin(), 1.0)).normalize();
    let from = [aim, side, aim.cross(&side)];
    let to = [DIRECTION, across[0].map(Operand::Unknown), across[1].map(Operand::Unknown)];
    let mut values: Vec<Emitted> = (0..3).map(|index| Emitted::code(Operand::Parameter(index))).collect();
    for entry in 0..9 {
        let terms = from.iter().zip(&to).map(|(from, to)| (from[entry % 3], to[entry / 3]));
        let sum = terms.fold(Emitted::integer(0), |sum, (factor, value)| {
            let term = Emitted::code(value).times(factor);
            emitter.add(&sum, &term)
        });
        values.push(sum);
    }
    values
}
