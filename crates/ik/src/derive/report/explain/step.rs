//! The section on one step in a chain's report: its relations, what cancels in them, the equation in its joint, and its roots.

use num_traits::One;

use super::algebra::{Sorted, name, product, renamed, signs, unknowns};
use super::document::{Document, Line, Stage};
use super::{forms, geometry, strata};
use crate::Result;
use crate::derive::closure::{Factor, Mechanism, ScrewJoint};
use crate::derive::planner::StepMethod;
use crate::derive::sequential::{Elimination, Form, ProvedStep, SequentialView};
use groebot_algebra::number::{BigRational, Ring, Style};

/// The maximum length of a printed combination, in characters.
const LONGEST: usize = 1500;

/// Adds the section of step `index`. Its relations belong to the stage of equations, its formulas to the triangular stage.
pub fn explain(
    page: &mut Document,
    derived: SequentialView<'_>,
    mechanism: &Mechanism,
    (index, stage): (usize, Option<Stage>),
) -> Result<()> {
    if matches!(stage, Some(Stage::Plan | Stage::Basis)) {
        return Ok(());
    }
    let step = &derived.method.steps[index];
    let laws: Vec<String> = step.relations.iter().filter_map(|relation| relation.law(mechanism)).collect();
    let relations = if laws.len() == step.relations.len() { &[] } else { step.relations.as_slice() };
    let sorted = relations.iter().map(|relation| Sorted::new(mechanism, relation, step.joint));
    let sorted = sorted.collect::<Result<Vec<_>>>()?;
    Writer { page, derived, mechanism, step, index, sorted, numbers: step.relations.len() }.section(stage)
}

struct Writer<'a> {
    page: &'a mut Document,
    derived: SequentialView<'a>,
    mechanism: &'a Mechanism,
    step: &'a ProvedStep,
    index: usize,
    /// The relations, sorted by the joint's unknowns.
    sorted: Vec<Sorted>,
    /// The number of the last equation.
    numbers: usize,
}

impl Writer<'_> {
    fn section(mut self, stage: Option<Stage>) -> Result<()> {
        let heading = format!("Step {}: joint {}, ", self.index + 1, self.step.joint + 1);
        self.page.section(Line::of(&heading).name(&self.joint().name));
        if Stage::Equations.is_in(stage) {
            self.known();
            (0..self.sorted.len()).for_each(|number| self.relation(number));
        }
        if self.sorted.is_empty() {
            self.follows();
            return Ok(());
        }
        if !Stage::Triangular.is_in(stage) {
            return Ok(());
        }
        match &self.step.elimination {
            Some(elimination) => self.elimination(elimination),
            None => self.symbols(),
        }
        self.triangular()?;
        self.singular();
        Ok(())
    }

    /// Adds the law of a joint that follows another one.
    fn follows(&mut self) {
        for relation in &self.step.relations {
            self.page.text(&format!("Here {}:", relation.meaning(self.mechanism)));
            self.page.display(relation.law(self.mechanism).unwrap_or_default());
        }
        self.page.text("This step solves no equation, and no solution is added or lost.");
    }

    fn joint(&self) -> &ScrewJoint {
        &self.mechanism.joints()[self.step.joint]
    }

    fn known(&mut self) {
        let before = self.derived.method.steps[..self.index].iter().map(|step| step.joint);
        let mut known: Vec<usize> = self.derived.method.plan.given.iter().copied().chain(before).collect();
        known.sort_unstable();
        let used: Vec<usize> = known
            .into_iter()
            .filter(|joint| self.step.relations.iter().any(|relation| relation.joints().contains(joint)))
            .collect();
        match used.as_slice() {
            [] => self.page.text("This step needs the target only."),
            list => {
                let text =
                    format!("It uses the values of {} from earlier steps.", geometry::numbers(list.iter().copied()));
                self.page.text(&text);
            }
        }
    }

    fn relation(&mut self, number: usize) {
        let relation = &self.step.relations[number];
        self.page.items(geometry::cancelled(self.mechanism, relation));
        self.page.text(&format!(
            "These objects are not moved by the cancelled joints, and {}:",
            geometry::conserved(relation.measure)
        ));
        self.page.equation(&format!("{}.{}", self.index + 1, number + 1), relation.to_string());
        self.page.text("Multiplied out, by the unknowns of this joint:");
        let text = self.sorted[number].equation(self.mechanism);
        self.page.display(text);
    }

    /// Adds an equation with the step's next number, and returns the number.
    fn equation(&mut self, formula: String) -> String {
        self.numbers += 1;
        let number = format!("{}.{}", self.index + 1, self.numbers);
        self.page.equation(&number, formula);
        number
    }

    /// Adds the equation in the joint, and the definitions of its symbols.
    fn symbols(&mut self) {
        let form = self.step.shape.form;
        self.page.text(match form {
            Form::Angle => "The equation is linear in the cosine and the sine of one angle:",
            Form::Rotation => "The two equations rotate a known vector to a known vector:",
            Form::Pair => "The two equations are linear in the cosine and the sine of one angle:",
            Form::Linear => "The equation is linear in the length:",
            Form::Quadratic => "The equation is quadratic in the length:",
            Form::Quartic | Form::Lengths => "This is one equation in the joint alone:",
        });
        let own = self.own_names();
        let equations: Vec<String> = forms::equations(form).iter().map(|text| renamed(text, &own)).collect();
        for equation in equations {
            self.equation(equation);
        }
        let values = self.values();
        if !values.is_empty() {
            self.page.text("with");
        }
        values.into_iter().for_each(|value| self.page.display(value));
    }

    /// The symbols of the form, such as `A = ...`, in terms of the physical sine and length.
    fn values(&self) -> Vec<String> {
        let joint = self.step.joint;
        let one = BigRational::one();
        let (c, s) = ([Factor::Cosine(joint)], [Factor::Sine(joint)]);
        let (d, dd) = ([Factor::Length(joint)], [Factor::LengthSquared(joint)]);
        let half = BigRational::new(1.into(), 2.into());
        let ratio = self.step.shape.ratio.as_ref().map_or_else(BigRational::one, BigRational::recip);
        let over = self.over(1);
        let take = |symbol: &str, equation: usize, own: &[Factor], factor: &BigRational, root: &str| {
            scaled(symbol, &self.sorted[equation].coefficient(self.mechanism, own, factor), root)
        };
        match self.step.shape.form {
            Form::Angle => {
                vec![take("A", 0, &c, &one, ""), take("B", 0, &s, &one, &over), take("C", 0, &[], &one, "")]
            }
            Form::Rotation => vec![
                take("A", 0, &c, &one, ""),
                take("B", 0, &s, &-&one, &over),
                take("X", 0, &[], &-&one, ""),
                take("Y", 1, &[], &-ratio, &over.replace('/', "*")),
            ],
            Form::Pair => vec![
                take("A", 0, &c, &one, ""),
                take("B", 0, &s, &one, &over),
                take("E", 1, &c, &one, ""),
                take("F", 1, &s, &one, &over),
                take("X", 0, &[], &-&one, ""),
                take("Y", 1, &[], &-&one, ""),
            ],
            Form::Linear => vec![take("A", 0, &d, &one, &over), take("B", 0, &[], &one, "")],
            Form::Quadratic => vec![
                take("A", 0, &dd, &self.joint().square.recip(), ""),
                take("B", 0, &d, &half, &over),
                take("C", 0, &[], &one, ""),
            ],
            Form::Quartic | Form::Lengths => Vec::new(),
        }
    }

    /// `/sqrt(n)^power`; empty if the axis has length one.
    fn over(&self, power: usize) -> String {
        if self.joint().square.is_one() {
            String::new()
        } else {
            format!("/sqrt({})", self.joint().square).repeat(power)
        }
    }

    /// The unknowns of a form, each with its name for this joint.
    fn own_names(&self) -> Vec<(String, String)> {
        let symbol = &self.joint().symbol;
        ["c", "s", "d", "w", "t"].iter().map(|name| ((*name).to_owned(), format!("{name}{symbol}"))).collect()
    }

    /// Adds the elimination of other joints and its result.
    fn elimination(&mut self, elimination: &Elimination) {
        let names = self.elimination_names(elimination);
        let away = match &self.derived.method.plan.steps[self.index].method {
            StepMethod::Eliminated { away, .. } => geometry::numbers(away.iter().copied()),
            _ => String::new(),
        };
        self.page.text(&format!(
            "These equations also contain the unknown {away}. It is eliminated by a Groebner basis with its unknowns first or, where \
             the equations rotate a vector by it, by the sum of their squares. Symbols denote the known quantities:"
        ));
        self.page.items(symbol_lines(self.mechanism, elimination, (self.index + 1, 1)));
        self.page.text("The generators: the relations, then the circles:");
        let text = |f| renamed(&elimination.ring.format(f, Style::Decimal), &names);
        for (number, f) in elimination.generators.iter().enumerate() {
            self.page.display(format!("f{} = {} = 0", number + 1, text(f)));
        }
        self.page.text("The element of their ideal that contains only this joint:");
        let number = self.equation(format!("{} = 0", text(&elimination.member)));
        self.page.text(
            "It is this combination of them, multiplied out exactly, so every solution of the loop satisfies it:",
        );
        let terms = elimination.cofactors.iter().enumerate().filter(|(_, f)| !f.is_zero());
        let sum = signs(terms.map(|(number, f)| format!("{}*f{}", strata::factor(&text(f)), number + 1)));
        match sum.len() {
            0..=LONGEST => self.page.display(sum),
            _ => self.page.text("The cofactors are long; they are in certificate.json."),
        }
        let form = self.step.shape.form;
        let own = self.own_names();
        self.page.text(&format!("Sorted by the unknowns of this joint, ({number}) is"));
        for equation in forms::equations(form) {
            self.equation(renamed(equation, &own));
        }
    }

    fn elimination_names(&self, elimination: &Elimination) -> Vec<(String, String)> {
        let away: &[usize] = match &self.derived.method.plan.steps[self.index].method {
            StepMethod::Eliminated { away, .. } => away,
            _ => &[],
        };
        let factors = away.iter().chain([&self.step.joint]).flat_map(|&joint| unknowns(self.mechanism, joint));
        let names = elimination.ring.variables().iter().zip(factors);
        names.map(|(old, factor)| (old.clone(), name(self.mechanism, factor))).collect()
    }

    /// Adds the triangular form and its roots.
    fn triangular(&mut self) -> Result<()> {
        let (form, own) = (self.step.shape.form, self.own_names());
        let stairs = forms::triangular(self.derived, form)?;
        self.page.paragraph(
            Line::of("The Groebner basis of the form ")
                .name(form.name())
                .and(", proved for all values of the symbols, is triangular: one unknown after the other."),
        );
        for stair in stairs {
            self.equation(renamed(&stair, &own));
        }
        match self.first_use() {
            Some(before) => self.page.text(&format!(
                "Its roots, and the cases where two of them meet or symbols vanish, are those given in step {}.",
                before + 1
            )),
            None => {
                self.page.text(&renamed_prose(forms::roots(form), &own));
                self.page.text(&format!("Singular: {}", renamed_prose(forms::singular(form), &own)));
            }
        }
        Ok(())
    }

    /// The earlier step whose section describes this form.
    fn first_use(&self) -> Option<usize> {
        self.derived.method.steps[..self.index].iter().position(|step| step.shape.form == self.step.shape.form)
    }

    /// Adds the geometric meaning of vanishing symbols.
    fn singular(&mut self) {
        let form = self.step.shape.form;
        if self.step.elimination.is_some() || !matches!(form, Form::Angle | Form::Rotation) {
            return;
        }
        let is_number = |value: &String| value[4..].parse().is_ok_and(|number: f64| number != 0.0);
        match self.values().iter().take(2).find(|value| is_number(value)) {
            Some(value) => {
                let text = format!(
                    "Here ${value}$ is a number, so this step is never singular for this reason: the joint is never free."
                );
                self.page.text(&text);
            }
            None => {
                let meaning = geometry::degenerate(self.step.relations[0].measure);
                self.page.text(&format!("In the mechanism $A = B = 0$ means that {meaning}."));
            }
        }
    }
}

/// The definitions of the symbols of an elimination, as text. Its first relation has the number `(step.first)`.
pub fn symbol_lines(mechanism: &Mechanism, elimination: &Elimination, (step, first): (usize, usize)) -> Vec<Line> {
    let lines = elimination.symbols.iter().enumerate().map(|(number, place)| {
        let (what, relation) = (product(mechanism, &place.factors), place.relation + first);
        let what = if what.is_empty() { "1" } else { &what };
        Line::of(&format!("$S{number}$ is the coefficient of "))
            .formula(what)
            .and(&format!(" in ({step}.{relation}) when it is sorted by the unknown joints."))
    });
    lines.collect()
}

/// A definition as text, such as `A = text/sqrt(3)`.
fn scaled(symbol: &str, text: &str, root: &str) -> String {
    match root {
        "" => format!("{symbol} = {text}"),
        _ if text == "0" => format!("{symbol} = 0"),
        _ => format!("{symbol} = ({text}){root}"),
    }
}

/// Report text with names replaced in its formulas, which are between dollar signs.
fn renamed_prose(prose: &str, names: &[(String, String)]) -> String {
    let pieces = prose.split('$').enumerate();
    let pieces = pieces.map(|(index, piece)| if index % 2 == 0 { piece.to_owned() } else { renamed(piece, names) });
    pieces.collect::<Vec<_>>().join("$")
}
