//! The numbered text files of a chain's derivation, written for students.

use std::fmt::Write;

use num_traits::One;

use super::form_basis::{Form, FormBasis};
use super::symbolic::{Symbolic, TargetPoly};
use super::{Elimination, ProvedStep, SequentialView, certificate};
use crate::Result;
use crate::derive::closure::{Factor, Mechanism, Multilinear};
use crate::derive::describe;
use crate::derive::equations::tree::{Node, Outcome};
use crate::derive::equations::triangular::presented;
use crate::derive::report::stages::{MARK, PAGE, STAGES};
use groebot_algebra::escape::markdown;
use groebot_algebra::number::{Ring, Style};
use groebot_robot::document::word;

/// The maximum number of printed terms of an equation.
const MOST_TERMS: usize = 120;

impl SequentialView<'_> {
    /// The stage files with their names. Every run gives the same bytes.
    ///
    /// # Errors
    /// If a field cannot be built. This does not occur for a derivation that this crate made.
    pub fn stage_files(&self) -> Result<Vec<(String, Vec<u8>)>> {
        let mechanism = Mechanism::new(&self.problem.chain)?;
        let [equations, plan, basis, triangular] = self.stage_texts(&mechanism)?;
        let texts = [equations, plan, basis, triangular, self.program.to_json(), certificate::write(*self)?];
        let mut files: Vec<(String, Vec<u8>)> =
            STAGES.iter().zip(texts).map(|(name, text)| ((*name).to_owned(), text.into_bytes())).collect();
        files.push((PAGE.to_owned(), self.readme(&mechanism).into_bytes()));
        Ok(files)
    }

    /// The texts of the equations, the plan, the bases and the triangular forms.
    pub(in crate::derive) fn stage_texts(&self, mechanism: &Mechanism) -> Result<[String; 4]> {
        let equations = self.equations_text(mechanism)?;
        Ok([equations, self.plan_text(mechanism), self.basis_text(), self.triangular_text(mechanism)])
    }

    fn equations_text(&self, mechanism: &Mechanism) -> Result<String> {
        let mut text = format!("{}: {} equations of the loop\n\n", self.problem.chain.name(), self.equations());
        text += &notation(mechanism);
        let mut symbolic = Symbolic::new(mechanism)?;
        for (index, step) in self.method.steps.iter().enumerate() {
            let _ =
                writeln!(text, "\n{} for {}", heading(index, mechanism, step), joint_unknowns(mechanism, step.joint));
            for (number, relation) in step.relations.iter().enumerate() {
                let _ = writeln!(text, "({}.{})  {relation}", index + 1, number + 1);
                let _ = writeln!(text, "       {}", relation.meaning(mechanism));
                if let Some(law) = relation.law(mechanism) {
                    let _ = writeln!(text, "       {law}");
                    continue;
                }
                let polynomial = symbolic.polynomial(mechanism, relation)?;
                let _ = writeln!(text, "       {}", written(mechanism, &symbolic, &polynomial));
            }
        }
        Ok(text)
    }

    fn equations(&self) -> usize {
        self.method.steps.iter().map(|step| step.relations.len()).sum()
    }

    fn plan_text(&self, mechanism: &Mechanism) -> String {
        let mut text = format!("{}: plan\n\n", self.problem.chain.name());
        for evidence in &self.method.plan.evidence {
            let degrees: Vec<String> = evidence.degrees.iter().map(usize::to_string).collect();
            let _ = writeln!(
                text,
                "A random pose modulo {} (seed {}) has {} complex solutions; values of the joints: {}.",
                evidence.prime,
                evidence.seed,
                evidence.dimension,
                degrees.join(", ")
            );
        }
        let _ = writeln!(text, "\nThe steps give {} solutions together.\n", self.method.plan.product());
        for &joint in &self.method.plan.given {
            let _ = writeln!(text, "given: {}", mechanism.joints()[joint].name);
        }
        for (index, step) in self.method.steps.iter().enumerate() {
            let count = step.shape.form.degree();
            let _ = writeln!(
                text,
                "{}: {} solution{}; {}",
                heading(index, mechanism, step),
                count,
                if count == 1 { "" } else { "s" },
                why(step.shape.form)
            );
            for (number, relation) in step.relations.iter().enumerate() {
                let _ = writeln!(text, "    ({}.{})  {relation}", index + 1, number + 1);
            }
        }
        text
    }

    fn basis_text(&self) -> String {
        let mut text = format!(
            "{}: reduced Groebner bases of the forms, their coefficients free symbols\n\
             Each polynomial is zero. Denominators are cleared. A stratum is where a denominator vanishes.\n",
            self.problem.chain.name()
        );
        for form_basis in &self.method.form_bases {
            let _ = writeln!(text, "\n{}: {}", form_basis.form.name(), equations(form_basis));
            for node in form_basis.tree.walk() {
                let _ = writeln!(text, "\n  [{}] {}", node.label, describe(node));
                for line in polynomials(node) {
                    let _ = writeln!(text, "    {line} = 0");
                }
                for excluded in &node.excluded {
                    let _ = writeln!(text, "    never zero: {} ({})", excluded.factor, excluded.reason);
                }
            }
        }
        text
    }

    fn triangular_text(&self, mechanism: &Mechanism) -> String {
        let mut text = format!("{}: one joint at a time\n", self.problem.chain.name());
        for (index, step) in self.method.steps.iter().enumerate() {
            let form = step.shape.form;
            let _ = writeln!(text, "\n{}: form `{}`", heading(index, mechanism, step), form.name());
            for line in symbols(index, mechanism, step) {
                let _ = writeln!(text, "    {line}");
            }
            let Some(form_basis) = self.method.form_bases.iter().find(|form_basis| form_basis.form == form) else {
                continue;
            };
            for node in form_basis.tree.walk() {
                match &node.outcome {
                    Outcome::Solved(solved) if !solved.inherited => {
                        let _ = writeln!(text, "  [{}]", node.label);
                        solved.triangular.to_string().lines().for_each(|line| {
                            let _ = writeln!(text, "    {line}");
                        });
                    }
                    Outcome::SelfMotion(_) => {
                        let name = &mechanism.joints()[step.joint].name;
                        let _ = writeln!(text, "  [{}]\n    {name} is free", node.label);
                    }
                    _ => {}
                }
            }
        }
        text
    }

    fn readme(&self, mechanism: &Mechanism) -> String {
        let parts = self.problem.chain.parts();
        let mut text = format!("# {}\n\n", markdown(self.problem.chain.name()));
        for line in [&parts.description, &parts.source].into_iter().flatten() {
            let _ = writeln!(text, "{}\n", markdown(line));
        }
        let inputs: Vec<String> = self.program.inputs.iter().map(|input| markdown(&input.name)).collect();
        let joints: Vec<String> = self.program.joints.iter().map(|joint| markdown(&joint.name)).collect();
        let _ = writeln!(
            text,
            "Lengths in {}, angles in rad. Target: {}. Joints: {}.\n",
            self.problem.chain.length_unit().symbol(),
            inputs.join(", "),
            joints.join(", ")
        );
        if let Some((_, report)) = &self.problem.truth {
            let _ = writeln!(text, "{}", report.paragraph());
        }
        if mechanism.standing().is_some() {
            text += "The yaw is left open, and the first joint turns about a vertical as the yaw does. So the loop is cut there: E1 is the second joint; \
                     behind the tip follow roll and pitch (given), the turn that is left, the way from the first axis and the height (given), and last the \
                     first joint, counted from where the tip is to be, seen from above. The target of this loop never changes.\n\n";
        }
        text += &self.steps_text(mechanism);
        text += "\nEach equation is a rigid-motion invariant of the loop E1 ... En = G, where G moves the tip from its place at zero to \
                 the target: `1_equations.txt`. No solution is lost, for each equation follows from the loop; none is added, for each \
                 answer is measured by forward kinematics.\n\n";
        text += MARK;
        text += "; `groebot check` proves it again from `certificate.json`. Solve with\n\n";
        let example = vec!["..."; inputs.len()].join(",");
        let _ = writeln!(text, "    groebot solve derivations/{} --target {example}", word(self.problem.chain.name()));
        text
    }

    /// The steps, as a numbered list.
    pub(in crate::derive) fn steps_text(&self, mechanism: &Mechanism) -> String {
        let mut text = String::new();
        let _ = writeln!(text, "Up to {} solutions. The joints are found one at a time:\n", self.method.plan.dimension);
        for (index, step) in self.method.steps.iter().enumerate() {
            let form = step.shape.form;
            let _ =
                writeln!(text, "{}. **{}**: {}.", index + 1, markdown(&mechanism.joints()[step.joint].name), why(form));
            for relation in &step.relations {
                let _ = writeln!(text, "   `{relation}`: {}.", relation.meaning(mechanism));
            }
            let _ = writeln!(text, "   Singular: {}", singular(form));
        }
        text
    }
}

fn heading(index: usize, mechanism: &Mechanism, step: &ProvedStep) -> String {
    format!("step {}, joint {} `{}`", index + 1, step.joint + 1, mechanism.joints()[step.joint].name)
}

/// Text on how a form determines its joint, and on the origin of its branches.
fn why(form: Form) -> &'static str {
    match form {
        Form::Angle => "one linear equation in cosine and sine, a chord of the circle with two ends",
        Form::Turn => "two equations that turn a known vector to a known place, one angle",
        Form::Pair => "two independent linear equations in cosine and sine, one angle",
        Form::Quartic => {
            "an equation of degree two in cosine and sine, by the tangent of half the angle up to four angles"
        }
        Form::Lengths => "an equation of degree four at most, up to four lengths",
        Form::Linear => "a linear equation, one length",
        Form::Quadratic => "a quadratic equation, two lengths",
    }
}

/// Text on the behaviour where the generic formulas are singular.
fn singular(form: Form) -> &'static str {
    match form {
        Form::Angle => {
            "where A = B = 0 no angle solves it, or with C = 0 each does: the joint is free. Where A^2 + B^2 = C^2 both ends meet."
        }
        Form::Turn => "where A = B = 0 no angle solves it, or with X = Y = 0 each does: the joint is free.",
        Form::Pair => "where A F = B E each equation is solved alone, and what solves both is kept.",
        Form::Quartic => {
            "where all coefficients vanish the joint is free. Where the quartic has a double root two answers meet."
        }
        Form::Lengths => "where the polynomial has a double root two answers meet.",
        Form::Linear => "never, where A is a number.",
        Form::Quadratic => "where B^2 = A C both roots meet.",
    }
}

fn equations(form_basis: &FormBasis) -> String {
    let list: Vec<String> = form_basis.system.equations.iter().map(|e| format!("{} = 0", e.expression)).collect();
    list.join(", ")
}

fn polynomials(node: &Node) -> Vec<String> {
    let Some(solved) = node.solved().filter(|solved| !solved.inherited) else { return Vec::new() };
    let stairs = solved.triangular.stairs.iter().flat_map(|stair| &stair.polynomials);
    stairs.map(|f| presented(&solved.triangular.ring, f)).collect()
}

/// Definitions of the unknowns and of E and G, as text.
fn notation(mechanism: &Mechanism) -> String {
    let mut text = String::from(
        "Ei is the motion of joint i, G the motion of the tip from its place at zero to the target; E1 ... En = G.\n\
         x . y is the scalar product. Points and directions stand in the base frame at zero.\n",
    );
    for (index, joint) in mechanism.joints().iter().enumerate() {
        let unknowns = joint_unknowns(mechanism, index);
        let motion = if joint.is_revolute() { "turns about" } else { "slides along" };
        let axis = crate::derive::closure::show(&joint.axis);
        let point = crate::derive::closure::show(&joint.point);
        let _ = writeln!(text, "    joint {} `{}` ({unknowns}) {motion} {axis} through {point}", index + 1, joint.name);
    }
    text
}

/// The unknowns of a joint as text, such as `c1, s1`. `s1'` is the sine divided by the length of the axis vector, if that is not one.
pub(in crate::derive) fn joint_unknowns(mechanism: &Mechanism, joint: usize) -> String {
    let factors: &[Factor] = if mechanism.joints()[joint].is_revolute() {
        &[Factor::Cosine(joint), Factor::Sine(joint)]
    } else {
        &[Factor::Length(joint)]
    };
    let screw = &mechanism.joints()[joint];
    let mut text = factors.iter().map(|factor| name(mechanism, *factor)).collect::<Vec<_>>().join(", ");
    if !screw.square.is_one() {
        let letter = if screw.is_revolute() { 's' } else { 'd' };
        let _ = write!(text, ", {letter}{0}' = {letter}{0} / sqrt({1})", screw.symbol, screw.square);
    }
    text
}

/// The name of an unknown, such as `c1`, `s1'` or `d3'^2`.
pub(in crate::derive) fn name(mechanism: &Mechanism, factor: Factor) -> String {
    let joint = &mechanism.joints()[factor.joint()];
    let prime = if joint.square.is_one() { "" } else { "'" };
    match factor {
        Factor::Cosine(_) => format!("c{}", joint.symbol),
        Factor::Sine(_) => format!("s{}{prime}", joint.symbol),
        Factor::Length(_) => format!("d{}{prime}", joint.symbol),
        Factor::LengthSquared(_) => format!("d{}{prime}^2", joint.symbol),
    }
}

/// An equation as text, such as `c1*(px - 1) + s1*py + 0.5 = 0`.
fn written(mechanism: &Mechanism, symbolic: &Symbolic, polynomial: &Multilinear<TargetPoly>) -> String {
    let count: usize = polynomial.terms().map(|(_, value)| value.terms().len()).sum();
    if count > MOST_TERMS {
        return format!("a polynomial of {count} terms in the unknowns and the target");
    }
    let term = |(product, value): (&crate::derive::closure::Factors, &TargetPoly)| {
        let mut factors: Vec<String> = product.list().iter().map(|factor| name(mechanism, *factor)).collect();
        let text = symbolic.ring.format(value, Style::Decimal);
        match (factors.is_empty(), text.as_str()) {
            (true, _) => text,
            (false, "1") => factors.join("*"),
            (false, _) => {
                factors.insert(0, if value.terms().len() > 1 { format!("({text})") } else { text });
                factors.join("*")
            }
        }
    };
    let sum = polynomial.terms().map(term).collect::<Vec<_>>().join(" + ").replace("+ -", "- ");
    format!("{sum} = 0")
}

/// The definitions of the symbols of a step's form, as text.
fn symbols(index: usize, mechanism: &Mechanism, step: &ProvedStep) -> Vec<String> {
    let screw = &mechanism.joints()[step.joint];
    let root = if screw.square.is_one() { String::new() } else { format!(" / sqrt({})", screw.square) };
    let letters = |factor: Factor| name(mechanism, factor);
    let (c, s) = (letters(Factor::Cosine(step.joint)), letters(Factor::Sine(step.joint)));
    let (d, dd) = (letters(Factor::Length(step.joint)), letters(Factor::LengthSquared(step.joint)));
    let of = |number: usize, what: &str| format!("{what} in ({}.{number})", index + 1);
    if let Some(elimination) = &step.elimination {
        return left(index, mechanism, step, elimination);
    }
    match step.shape.form {
        Form::Angle => vec![
            format!("A = the coefficient of {}", of(1, &c)),
            format!("B = the coefficient of {}{root}", of(1, &s)),
            format!("C = the rest of ({}.1)", index + 1),
        ],
        Form::Turn => vec![
            format!("A = the coefficient of {}", of(1, &c)),
            format!("B = minus the coefficient of {}{root}", of(1, &s)),
            format!("X = minus the rest of ({}.1)", index + 1),
            format!("Y = minus the rest of ({}.2), which is scaled to fit", index + 1),
        ],
        Form::Pair => vec![
            format!("A, E = the coefficients of {c} in ({0}.1) and ({0}.2)", index + 1),
            format!("B, F = the coefficients of {s} in ({0}.1) and ({0}.2){root}", index + 1),
            format!("X, Y = minus the rests of ({0}.1) and ({0}.2)", index + 1),
        ],
        Form::Lengths => vec!["A d^4 + B d^3 + C d^2 + D d + E = 0 with the true length".to_owned()],
        Form::Quartic => vec![format!("A {c} {s} + B {s}^2 + C {c} + D {s} + E = 0 with the true sine")],
        Form::Linear => {
            vec![format!("A = the coefficient of {}{root}", of(1, &d)), format!("B = the rest of ({}.1)", index + 1)]
        }
        Form::Quadratic => vec![
            format!("A = the coefficient of {}, of the true length", of(1, &dd)),
            format!("B = half the coefficient of {}{root}", of(1, &d)),
            format!("C = the rest of ({}.1)", index + 1),
        ],
    }
}

/// The result of an elimination with its own names, as text.
fn left(index: usize, mechanism: &Mechanism, step: &ProvedStep, elimination: &Elimination) -> Vec<String> {
    let product = |factors: &[Factor]| match factors {
        [] => "1".to_owned(),
        list => list.iter().map(|factor| name(mechanism, *factor)).collect::<Vec<_>>().join(" "),
    };
    let mut lines =
        vec![format!("the other joints are eliminated from ({0}.1) to ({0}.{1}):", index + 1, step.relations.len())];
    for (number, place) in elimination.symbols.iter().enumerate() {
        let (what, relation) = (product(&place.factors), place.relation + 1);
        lines.push(format!("S{number} = the coefficient of {what} in ({}.{relation})", index + 1));
    }
    let own =
        elimination.ring.variables()[elimination.sizes[0]..elimination.sizes[0] + elimination.sizes[1]].join(", ");
    let text = elimination.ring.format(&elimination.member, Style::Decimal);
    lines.push(format!("with {own} for {}:", joint_unknowns(mechanism, step.joint)));
    lines.push(format!("{text} = 0"));
    lines
}
