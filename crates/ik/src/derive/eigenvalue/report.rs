//! The report of the derivation of six axes, written for students.

use super::EigenvalueView;
use super::rank::Determinant;
use crate::derive::report::explain::{Document, Line, Stage};
use crate::solver::eigenvalue::Formulation;
use groebot_robot::kinematics::JointKind;

/// The origin of the equations, line by line.
const EQUATIONS: [&str; 7] = [
    "The loop E1 E2 E3 E4 E5 E6 = G, seen from a joint h: E_h (E_h+1 E_h+2 L) = G' E_h+5^-1 E_h+4^-1 L, where L is the line of the axis \
     of joint h+3, which E_h+3 leaves alone; joints count on behind joint 6 at joint 1, and axes behind the target are moved by it.",
    "Fourteen functions of a line with direction l through p: p, l, p x l, (p.p) l - 2 (p.l) p, p.p and p.l. Rigid motions map their span \
     into itself, and a turn acts on it by a matrix that is affine in the cosine and sine of its angle (Raghavan and Roth 1993). Both sides \
     are sums of the nine products of 1, c, s of two joints.",
    "With the origin on axis h and w its direction: w.v for the four vectors v, p.p and p.l are the same on both sides: six equations \
     without the angle of joint h.",
    "For the parts across w, b turned from a by the angle q: b - a = x w x (a + b) with x = tan(q/2) (Rodrigues): eight equations, \
     linear in x.",
    "Each of the fourteen is multiplied by cos(r/2) and sin(r/2), r the angle of one joint next to h: 28 equations in 12 products of \
     cos(r/2)^3, ..., sin(r/2)^3 with 1, c, s of the other joint, and 16 of the far joints. No angle is lost at half a turn.",
    "The twelve equations without x are solved for twelve products. The remaining problem is (A - x B) v = 0 with sixteen rows and columns: one \
     eigenvalue for each complex solution.",
    "The real eigenvalues are the angles of joint h, their eigenvectors give four more, forward kinematics the last. Newton's method \
     polishes each solution, and the equations of the loop give its residual.",
];

/// The differences for prismatic joints.
const SLIDING: [&str; 3] = [
    "For a prismatic joint with displacement d the functions are polynomials of degree two in d: 1, d^2, d replace 1, c, s, and with \
     d = sin(r/2) / cos(r/2) the equations are multiplied by cos(r/2)^2.",
    "A hidden prismatic joint with displacement 2 x w moves the fourteen functions by exp(2 x N) with N^3 = 0: b - a = x N (a + b), of which six \
     equations are free of x.",
    "A prismatic joint h+3 does not change directions, nor lines along its own direction l: with a normal to it, a, l, p x l, l x a, p.a and p.(l x a) are \
     the fourteen functions.",
];

impl EigenvalueView<'_> {
    /// The origin of the equations, and the differences for prismatic joints if there are any.
    fn equations(&self) -> impl Iterator<Item = &'static str> {
        let slides = self.method.six.joints().iter().any(|joint| joint.kind == JointKind::Prismatic);
        EQUATIONS.into_iter().chain(SLIDING.into_iter().filter(move |_| slides))
    }

    /// Text on the treatment of given joints.
    pub fn given(&self) -> Option<String> {
        let given = self.problem.chain.given();
        let names: Vec<&str> = given.iter().map(|&joint| self.problem.chain.joints()[joint].name.as_str()).collect();
        let (text, motion, are) = match names.as_slice() {
            [] => return None,
            [one] => (format!("{one} is given"), "its motion", "is"),
            [many @ .., last] => (format!("{} and {last} are given", many.join(", ")), "their motions", "are"),
        };
        let six = |place: usize| self.method.six.joints()[place].name.as_str();
        let place = |name: &str| self.problem.chain.joints().iter().position(|joint| joint.name == name);
        let ends = (place(six(0))?, place(six(5))?);
        let count = given.iter().filter(|joint| (ends.0..ends.1).contains(joint)).count();
        let removed =
            format!("{motion} {are} removed from the target, and the remaining motion is the target of the six others");
        let applied = "the axes of the joints after it, and the tip, are moved at run time";
        Some(match count {
            0 => format!("{text}: {removed}."),
            _ if count == given.len() => format!("{text} between the six others: by each motion {applied}."),
            _ => {
                format!("{text}. At the ends of the chain {removed}. By each motion between the six others {applied}.")
            }
        })
    }

    /// The counts of random targets modulo primes, as text.
    pub fn counts(&self) -> Vec<String> {
        self.method.evidence.iter().map(ToString::to_string).collect()
    }

    /// The formulations with their proofs, as text.
    pub fn choices(&self) -> Vec<String> {
        let value = |determinant: &Determinant| format!("{} modulo {}", determinant.value, determinant.prime);
        let line = |(index, regular): (usize, &super::Regular)| {
            let values: Vec<String> = regular.determinants.iter().map(value).collect();
            format!(
                "{}. {}; the determinant at a random pose is {}: not zero, so the equations are independent.",
                index + 1,
                self.described(regular.formulation),
                values.join(", ")
            )
        };
        self.method.formulations.iter().enumerate().map(line).collect()
    }

    /// The hidden and the doubled joint of a formulation, as text.
    fn described(&self, formulation: Formulation) -> String {
        let name = |joint: usize| self.method.six.joints()[joint].name.as_str();
        let (hidden, doubled) = (formulation.hidden, formulation.doubled());
        let slides = |joint: usize| self.method.six.joints()[joint].kind == JointKind::Prismatic;
        let what = if slides(hidden) { "displacement" } else { "angle" };
        let second = match (slides(doubled), slides(hidden)) {
            (true, _) => format!("the equations are multiplied by the displacement of {}", name(doubled)),
            (false, false) => format!("that of {} is halved", name(doubled)),
            (false, true) => format!("the angle of {} is halved", name(doubled)),
        };
        format!("The {what} of {} is the eigenvalue, {second}", name(hidden))
    }

    /// The report for students, or one of its stages. The stages of bases and formulas are empty.
    pub(in crate::derive) fn document(&self, stage: Option<Stage>) -> Document {
        let mut page = Document::of(self.problem.chain.name(), stage);
        if Stage::Equations.is_in(stage) {
            page.items(self.equations().map(Line::of).collect());
        }
        if Stage::Plan.is_in(stage) {
            let lines = self.given().into_iter().chain(self.counts()).chain(self.choices());
            lines.for_each(|line| page.paragraph(Line::plain(&line)));
        }
        page
    }
}
