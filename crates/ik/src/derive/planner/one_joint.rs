//! Steps that find one joint from relations whose other joints are all known.

use super::types::{PlanStep, StepMethod};
use crate::Result;
use crate::derive::closure::{Factor, Letter, Measure, Object, Relation};
use crate::derive::samples::echelon::Echelon;
use crate::derive::samples::sampled_relations::{
    SAMPLES, SampledRelations, SampledValue, coefficient, is_number, is_sound,
};
use groebot_algebra::number::Ring;

/// The maximum number of relations of each form that are examined, the shortest first.
const CANDIDATES: usize = 16;

/// A linear equation A c + B s' + C = 0 of one revolute joint.
#[derive(Clone, Debug)]
struct Linear {
    relation: usize,
    cosine: SampledValue,
    sine: SampledValue,
    constant: SampledValue,
}

/// A step and its effort. The effort grows with the numerical risks of the step and with its length.
pub type Candidate = (PlanStep, usize);

/// The best step to `joint` alone when those of the set `known` are known. A step with one solution is preferred to one with two.
///
/// # Errors
/// As [`SampledRelations::of`].
pub fn best_step(sampled: &mut SampledRelations<'_>, joint: usize, known: u32) -> Result<Option<Candidate>> {
    if !sampled.mechanism.joints()[joint].is_revolute() {
        return slide(sampled, joint, known);
    }
    let equations = linear_equations(sampled, joint, known)?;
    if let Some((effort, pair)) = best_pair(sampled, joint, &equations) {
        let method = StepMethod::Pair(pair.map(|index| sampled.relations[index].clone()));
        return Ok(Some((PlanStep { joint, method, degree: 1 }, effort)));
    }
    let single = equations.iter().min_by_key(|equation| equation.effort());
    Ok(single.map(|equation| {
        let method = StepMethod::Single(sampled.relations[equation.relation].clone());
        (PlanStep { joint, method, degree: 2 }, equation.effort())
    }))
}

/// The step for a prismatic joint: an equation of degree one in d', otherwise of degree two. A constant leading coefficient is preferred.
fn slide(sampled: &mut SampledRelations<'_>, joint: usize, known: u32) -> Result<Option<Candidate>> {
    let mut best: Option<(usize, bool, usize)> = None;
    for index in candidates(sampled, joint, known) {
        let terms = sampled.of(index, 1 << joint)?;
        let square = coefficient(&terms, &[Factor::LengthSquared(joint)]);
        let linear = coefficient(&terms, &[Factor::Length(joint)]);
        let (degree, lead) = if square == [0; SAMPLES] { (1, linear) } else { (2, square) };
        let found = (degree, !is_number(&lead), index);
        if is_sound(&lead) && best.is_none_or(|best| found < best) {
            best = Some(found);
        }
    }
    Ok(best.map(|(degree, function, index)| {
        let method = StepMethod::Single(sampled.relations[index].clone());
        (PlanStep { joint, method, degree }, degree - 1 + usize::from(function))
    }))
}

/// Relations in which only `joint` is unknown. First those with the joint alone on one side, then those in which it acts last, then others. At most
/// [`CANDIDATES`] of each form.
fn candidates(sampled: &SampledRelations<'_>, joint: usize, known: u32) -> Vec<usize> {
    let form = |relation: &Relation| match relation.left.0.as_slice() {
        [Letter::Joint(only)] if *only == joint => 0,
        [Letter::Joint(first), ..] if *first == joint => 1,
        _ => 2,
    };
    let mut counts = [0; 3];
    let mut found: Vec<(usize, usize)> = Vec::new();
    for index in sampled.among(1 << joint, known) {
        let form = form(&sampled.relations[index]);
        counts[form] += 1;
        if counts[form] <= CANDIDATES {
            found.push((form, index));
        }
    }
    found.sort_unstable();
    found.into_iter().map(|(_, index)| index).collect()
}

fn linear_equations(sampled: &mut SampledRelations<'_>, joint: usize, known: u32) -> Result<Vec<Linear>> {
    let mut equations = Vec::new();
    for relation in candidates(sampled, joint, known) {
        let terms = sampled.of(relation, 1 << joint)?;
        let at = |factors: &[Factor]| coefficient(&terms, factors);
        let [cosine, sine] = [Factor::Cosine(joint), Factor::Sine(joint)].map(|factor| at(&[factor]));
        let depends = (0..cosine.len()).all(|k| cosine[k] != 0 || sine[k] != 0);
        if depends {
            equations.push(Linear { relation, cosine, sine, constant: at(&[]) });
        }
    }
    Ok(equations)
}

impl Linear {
    /// Whether the coefficients of c and s' are rational numbers.
    fn has_numbers(&self) -> bool {
        is_number(&self.cosine) && is_number(&self.sine)
    }

    /// The effort of solving this equation alone. A c + B s' = 0 needs no square root. If A and B are constants, the equation is never singular.
    fn effort(&self) -> usize {
        match (self.constant == [0; SAMPLES], self.has_numbers()) {
            (true, _) => 1,
            (false, true) => 2,
            (false, false) => 5,
        }
    }
}

/// The best two independent equations, with their effort. The two rows of one rotation are preferred, then constant coefficients, then simple relations.
fn best_pair(sampled: &SampledRelations<'_>, joint: usize, equations: &[Linear]) -> Option<(usize, [usize; 2])> {
    let mut best: Option<(usize, usize, [usize; 2])> = None;
    for (at, first) in equations.iter().enumerate() {
        for second in &equations[at + 1..] {
            if !is_sound(&determinant(sampled, first, second)) {
                continue;
            }
            let effort = match (is_rotation(sampled, joint, first, second), first.has_numbers() && second.has_numbers())
            {
                (true, true) => 0,
                (false, true) => 1,
                (true, false) => 2,
                (false, false) if mixes_rotation(sampled, joint, first, second) => 3,
                (false, false) => 5,
            };
            let pair = [first.relation, second.relation];
            let intricacy = pair.iter().map(|&index| intricacy(&sampled.relations[index])).sum();
            if best.is_none_or(|(least, plain, _)| (effort, intricacy) < (least, plain)) {
                best = Some((effort, intricacy, pair));
            }
        }
    }
    best.map(|(effort, _, pair)| (effort, pair))
}

/// The complexity of a relation for readers: 0 for angles and coordinates, up to 3 for moments.
fn intricacy(relation: &Relation) -> usize {
    match (relation.measure, &relation.moved) {
        (Measure::Moment, _) => 3,
        (_, Object::Line { .. }) => 2,
        (Measure::Distance, _) => 1,
        _ => 0,
    }
}

fn determinant(sampled: &SampledRelations<'_>, first: &Linear, second: &Linear) -> SampledValue {
    let field = sampled.field();
    std::array::from_fn(|k| {
        let main = field.mul(&first.cosine[k], &second.sine[k]);
        field.sub(&main, &field.mul(&first.sine[k], &second.cosine[k]))
    })
}

/// Whether the coefficients are (A, -n B) and k (B, A) with a constant k. The determinant then is k (A^2 + n B^2).
fn is_rotation(sampled: &SampledRelations<'_>, joint: usize, first: &Linear, second: &Linear) -> bool {
    let (field, n) = (sampled.field(), sampled.squares[joint]);
    let turned: SampledValue = std::array::from_fn(|k| field.neg(&field.mul(&n, &second.cosine[k])));
    let pairs = [(&second.sine, &first.cosine), (&turned, &first.sine)];
    let mut ratios = Vec::new();
    for (a, b) in pairs.into_iter().filter(|(a, b)| **a != [0; SAMPLES] || **b != [0; SAMPLES]) {
        match sampled.ratio(a, b) {
            Some(ratio) if ratio != 0 => ratios.push(ratio),
            _ => return false,
        }
    }
    ratios.windows(2).all(|pair| pair[0] == pair[1])
}

/// Whether the rows (A, B) are constant combinations of the two rows of one rotation. The map (A, B) -> (B, -n A), a rotation by 90 degrees, then keeps their
/// span.
fn mixes_rotation(sampled: &SampledRelations<'_>, joint: usize, first: &Linear, second: &Linear) -> bool {
    let (field, n) = (sampled.field(), sampled.squares[joint]);
    let row = |a: SampledValue, b: SampledValue| a.into_iter().chain(b).enumerate();
    let mut rows = Echelon::new(field);
    for equation in [first, second] {
        rows.insert(row(equation.cosine, equation.sine));
    }
    let turned = |equation: &Linear| row(equation.sine, equation.cosine.map(|a| field.neg(&field.mul(&n, &a))));
    [first, second].into_iter().all(|equation| !rows.insert(turned(equation)))
}
