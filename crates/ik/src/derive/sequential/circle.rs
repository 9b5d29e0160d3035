//! Values of unknowns as quotients, and cosines and sines scaled to the unit circle: [`on_circle`], [`divided`].

use crate::derive::equations::assemble::Assembler;
use crate::solver::Operand;

/// A value of an unknown.
#[derive(Clone, Copy)]
pub(super) struct Quotient {
    pub top: Operand,
    pub bottom: Operand,
    pub value: Operand,
}

impl Quotient {
    pub fn new(top: Operand, bottom: Operand, assembler: &mut Assembler) -> Self {
        Quotient { top, bottom, value: assembler.div(top, bottom) }
    }

    pub fn whole(value: Operand) -> Self {
        Quotient { top: value, bottom: Operand::Constant(1.0), value }
    }
}

/// A cosine and a sine divided by their length. Values with a common denominator are not divided by it first: only its sign matters.
pub(super) fn on_circle(values: [Quotient; 2], assembler: &mut Assembler) -> [Operand; 2] {
    let bottom = values[0].bottom;
    let sides = match values {
        [c, s] if c.bottom != s.bottom => [c.value, s.value],
        [c, s] if assembler.is_non_negative(bottom) => [c.top, s.top],
        [c, s] => [assembler.mul(c.top, bottom), assembler.mul(s.top, bottom)],
    };
    let squares = sides.map(|side| assembler.mul(side, side));
    let sum = assembler.add(squares[0], squares[1]);
    let length = assembler.sqrt(sum);
    let unit = assembler.div(Operand::Constant(1.0), length);
    sides.map(|side| assembler.mul(side, unit))
}

/// A cosine and a sine with a common denominator that are on the circle except for rounding. This holds for [`super::Form::Angle`], because `w^2 = A^2 + B^2 -
/// C^2` is computed from the numbers in the quotients.
pub(super) fn divided(values: [Quotient; 2], assembler: &mut Assembler) -> [Operand; 2] {
    let unit = assembler.div(Operand::Constant(1.0), values[0].bottom);
    values.map(|value| assembler.mul(value.top, unit))
}
