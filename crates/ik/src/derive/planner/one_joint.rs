//! Steps that find one joint from relations whose other joints are all known.

use super::types::{PlanStep, Way};
use crate::Result;
use crate::derive::closure::{Factor, Letter, Measure, Object, Relation};
use crate::derive::samples::echelon::Echelon;
use crate::derive::samples::sights::{SPECIMENS, Sample, Sights, coefficient, is_number, is_sound};
use groebot_algebra::number::Ring;

/// The maximum number of relations of each form that are examined, the shortest first.
const CANDIDATES: usize = 16;

/// A linear equation A c + B s' + C = 0 of one revolute joint.
#[derive(Clone, Debug)]
struct Linear {
    relation: usize,
    cosine: Sample,
    sine: Sample,
    constant: Sample,
}

/// A step and its effort. The effort grows with the numerical risks of the step and with its length.
pub type Candidate = (PlanStep, usize);

/// The best step to `joint` alone when those of the set `known` are known. A step with one solution is preferred to one with two.
///
/// # Errors
/// As [`Sights::of`].
pub fn best_step(sights: &mut Sights<'_>, joint: usize, known: u32) -> Result<Option<Candidate>> {
    if !sights.mechanism.joints()[joint].is_revolute() {
        return slide(sights, joint, known);
    }
    let equations = linear_equations(sights, joint, known)?;
    if let Some((effort, pair)) = best_pair(sights, joint, &equations) {
        let way = Way::Pair(pair.map(|index| sights.relations[index].clone()));
        return Ok(Some((PlanStep { joint, way, degree: 1 }, effort)));
    }
    let single = equations.iter().min_by_key(|equation| equation.effort());
    Ok(single.map(|equation| {
        let way = Way::Single(sights.relations[equation.relation].clone());
        (PlanStep { joint, way, degree: 2 }, equation.effort())
    }))
}

/// The step for a prismatic joint: an equation of degree one in d', otherwise of degree two. A constant leading coefficient is preferred.
fn slide(sights: &mut Sights<'_>, joint: usize, known: u32) -> Result<Option<Candidate>> {
    let mut best: Option<(usize, bool, usize)> = None;
    for index in candidates(sights, joint, known) {
        let sight = sights.of(index, 1 << joint)?;
        let square = coefficient(&sight, &[Factor::LengthSquared(joint)]);
        let linear = coefficient(&sight, &[Factor::Length(joint)]);
        let (degree, lead) = if square == [0; SPECIMENS] { (1, linear) } else { (2, square) };
        let found = (degree, !is_number(&lead), index);
        if is_sound(&lead) && best.is_none_or(|best| found < best) {
            best = Some(found);
        }
    }
    Ok(best.map(|(degree, function, index)| {
        let way = Way::Single(sights.relations[index].clone());
        (PlanStep { joint, way, degree }, degree - 1 + usize::from(function))
    }))
}

/// Relations in which only `joint` is unknown. First those with the joint alone on one side, then those in which it acts last, then others. At most
/// [`CANDIDATES`] of each form.
fn candidates(sights: &Sights<'_>, joint: usize, known: u32) -> Vec<usize> {
    let form = |relation: &Relation| match relation.left.0.as_slice() {
        [Letter::Joint(only)] if *only == joint => 0,
        [Letter::Joint(first), ..] if *first == joint => 1,
        _ => 2,
    };
    let mut counts = [0; 3];
    let mut found: Vec<(usize, usize)> = Vec::new();
    for index in sights.among(1 << joint, known) {
        let form = form(&sights.relations[index]);
        counts[form] += 1;
        if counts[form] <= CANDIDATES {
            found.push((form, index));
        }
    }
    found.sort_unstable();
    found.into_iter().map(|(_, index)| index).collect()
}

fn linear_equations(sights: &mut Sights<'_>, joint: usize, known: u32) -> Result<Vec<Linear>> {
    let mut equations = Vec::new();
    for relation in candidates(sights, joint, known) {
        let sight = sights.of(relation, 1 << joint)?;
        let at = |factors: &[Factor]| coefficient(&sight, factors);
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
        match (self.constant == [0; SPECIMENS], self.has_numbers()) {
            (true, _) => 1,
            (false, true) => 2,
            (false, false) => 5,
        }
    }
}

/// The best two independent equations, with their effort. The two rows of one rotation are preferred, then constant coefficients, then simple relations.
fn best_pair(sights: &Sights<'_>, joint: usize, equations: &[Linear]) -> Option<(usize, [usize; 2])> {
    let mut best: Option<(usize, usize, [usize; 2])> = None;
    for (at, first) in equations.iter().enumerate() {
        for second in &equations[at + 1..] {
            if !is_sound(&determinant(sights, first, second)) {
                continue;
            }
            let effort = match (is_rotation(sights, joint, first, second), first.has_numbers() && second.has_numbers())
            {
                (true, true) => 0,
                (false, true) => 1,
                (true, false) => 2,
                (false, false) if mixes_rotation(sights, joint, first, second) => 3,
                (false, false) => 5,
            };
            let pair = [first.relation, second.relation];
            let intricacy = pair.iter().map(|&index| intricacy(&sights.relations[index])).sum();
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

fn determinant(sights: &Sights<'_>, first: &Linear, second: &Linear) -> Sample {
    let field = sights.field();
    std::array::from_fn(|k| {
        let main = field.mul(&first.cosine[k], &second.sine[k]);
        field.sub(&main, &field.mul(&first.sine[k], &second.cosine[k]))
    })
}

/// Whether the coefficients are (A, -n B) and k (B, A) with a constant k. The determinant then is k (A^2 + n B^2).
fn is_rotation(sights: &Sights<'_>, joint: usize, first: &Linear, second: &Linear) -> bool {
    let (field, n) = (sights.field(), sights.squares[joint]);
    let turned: Sample = std::array::from_fn(|k| field.neg(&field.mul(&n, &second.cosine[k])));
    let pairs = [(&second.sine, &first.cosine), (&turned, &first.sine)];
    let mut ratios = Vec::new();
    for (a, b) in pairs.into_iter().filter(|(a, b)| **a != [0; SPECIMENS] || **b != [0; SPECIMENS]) {
        match sights.ratio(a, b) {
            Some(ratio) if ratio != 0 => ratios.push(ratio),
            _ => return false,
        }
    }
    ratios.windows(2).all(|pair| pair[0] == pair[1])
}

/// Whether the rows (A, B) are constant combinations of the two rows of one rotation. The map (A, B) -> (B, -n A), a rotation by 90 degrees, then keeps their
/// span.
fn mixes_rotation(sights: &Sights<'_>, joint: usize, first: &Linear, second: &Linear) -> bool {
    let (field, n) = (sights.field(), sights.squares[joint]);
    let row = |a: Sample, b: Sample| a.into_iter().chain(b).enumerate();
    let mut rows = Echelon::new(field);
    for equation in [first, second] {
        rows.insert(row(equation.cosine, equation.sine));
    }
    let turned = |equation: &Linear| row(equation.sine, equation.cosine.map(|a| field.neg(&field.mul(&n, &a))));
    [first, second].into_iter().all(|equation| !rows.insert(turned(equation)))
}
