//! The report of equations that are solved as one system.

use super::document::{Document, Line, Stage};
use super::strata;
use crate::Result;
use crate::derive::equations::EquationsView;
use crate::derive::equations::plan::score;
use crate::derive::equations::setting::Setting;
use crate::derive::equations::tree::{Node, Outcome, Solved};
use crate::derive::{JointKindUnknown, ParameterSource, Quantity, Root, System};
use crate::solver::Program;
use groebot_algebra::groebner::Basis;
use groebot_algebra::number::{Ring, Style};
use groebot_algebra::poly::Order;

/// The report of `derivation`, or of one of its stages.
///
/// # Errors
/// If a field cannot be built. This does not occur for a derivation that this crate made.
pub fn document(derivation: EquationsView<'_>, stage: Option<Stage>) -> Result<Document> {
    let mut page = Document::of(&derivation.problem.name, stage);
    if Stage::Equations.is_in(stage) {
        introduce(&mut page, derivation.problem);
        equations(&mut page, derivation.problem);
    }
    if Stage::Plan.is_in(stage) {
        plan(&mut page, derivation)?;
    }
    let trees = derivation.method.trees();
    for (index, (title, node)) in trees.into_iter().enumerate().filter(|_| stage != Some(Stage::Equations)) {
        tree(&mut page, derivation, (index, title, stage), node)?;
    }
    if stage.is_none() {
        branches(&mut page, derivation);
        closing(&mut page);
    }
    Ok(page)
}

/// The report of the equations alone.
pub fn equations_page(system: &System) -> Document {
    let mut page = Document::of(&system.name, Some(Stage::Equations));
    introduce(&mut page, system);
    equations(&mut page, system);
    page
}

fn introduce(page: &mut Document, system: &System) {
    for text in [&system.description, &system.source].into_iter().filter(|text| !text.is_empty()) {
        page.paragraph(Line::plain(text));
    }
    let inputs: Vec<&str> = system.inputs.iter().map(|input| input.name.as_str()).collect();
    page.paragraph(Line::of("Given: ").formula(&inputs.join(", ")).and(&format!(
        ", lengths in {}. The result is all values of the joints that solve the equations below. They are solved together: a Groebner \
         basis in a lexicographic order is triangular, one unknown after the other.",
        system.length_unit.symbol()
    )));
}

fn equations(page: &mut Document, system: &System) {
    page.section(Line::of("The equations"));
    let mut items = Vec::new();
    for input in &system.inputs {
        let quantity = match input.quantity {
            Quantity::Length => "a length",
            Quantity::Angle => "an angle",
            Quantity::Number => "a number",
        };
        let assumed = if input.positive { ", assumed greater than zero." } else { "." };
        items.push(Line::of("Input ").formula(&input.name).and(": ").and(quantity).and(assumed));
    }
    for parameter in &system.parameters {
        let input = |index: usize| system.inputs[index].name.as_str();
        let value = match parameter.source {
            ParameterSource::Input(index) if input(index) == parameter.name => continue,
            ParameterSource::Input(index) => format!("{} = {}", parameter.name, input(index)),
            ParameterSource::Cosine(index) => format!("{} = cos({})", parameter.name, input(index)),
            ParameterSource::Sine(index) => format!("{} = sin({})", parameter.name, input(index)),
            ParameterSource::SquareRoot => format!("{} > 0", parameter.name),
        };
        let square = parameter.square.as_ref().map(|square| format!(", {}^2 = {square}", parameter.name));
        items.push(Line::of("Known: ").formula(&(value + &square.unwrap_or_default())).and("."));
    }
    for joint in &system.joints {
        let text = match &joint.kind {
            JointKindUnknown::Angle { cosine, sine } => {
                Line::of(&format!("the cosine ${cosine}$ and the sine ${sine}$ of an angle."))
            }
            JointKindUnknown::Value { unknown } => Line::of("the value ").formula(unknown).and("."),
        };
        let mut line = Line::of("Joint ").name(&joint.name).and(": ");
        line.0.extend(text.0);
        items.push(line);
    }
    page.items(items);
    page.paragraph(Line::of("The unknowns, greatest first: ").formula(&system.order.join(" > ")).and("."));
    let as_written = || system.equations.iter().map(|equation| equation.expression.to_string()).collect();
    let formulas: Vec<String> = multiplied_out(system).unwrap_or_else(|_| as_written());
    for (index, (equation, formula)) in system.equations.iter().zip(formulas).enumerate() {
        let label = equation.label.trim_matches(['(', ')']);
        let is_number = !label.is_empty() && label.chars().all(|c| c.is_ascii_digit() || c == '.');
        let number = if is_number { label.to_owned() } else { format!("0.{}", index + 1) };
        page.equation(&number, format!("f{} = {formula} = 0", index + 1));
    }
    if let Some(choice) = &system.choice {
        let root = if choice.root == Root::Minus { "minus" } else { "plus" };
        page.text(&format!("The published solution has the {root} root of ${}$.", choice.unknown));
    }
}

/// The equations as polynomials of the unknowns.
///
/// # Errors
/// As [`Setting::generators`].
fn multiplied_out(system: &System) -> Result<Vec<String>> {
    let setting = Setting::new(system);
    let ring = setting.ring(&system.order, Order::Lex)?;
    Ok(setting.generators(&ring)?.iter().map(|f| ring.format(f, Style::Decimal)).collect())
}

/// The orders of the unknowns, by the denominators of their formulas that may vanish.
fn plan(page: &mut Document, derivation: EquationsView<'_>) -> Result<()> {
    page.section(Line::of("The order of the unknowns"));
    page.text("All unknowns are solved together, the smallest first. Each denominator that may vanish requires a stratum; its codimension is that of the denominator's zero set.");
    let head = [
        "order",
        "greatest first",
        "strata of codimension one",
        "smaller",
        "without description",
        "candidates",
        "terms",
    ];
    let mut rows = vec![head.map(Line::of).to_vec()];
    for (title, node) in derivation.method.trees() {
        let Some(solved) = node.solved() else { continue };
        let (ring, polynomials) = (solved.triangular.ring.clone(), solved.certified.basis.clone());
        let score = score(&node.setting, &Basis { ring, polynomials, cofactors: Vec::new() })?;
        let mut row = vec![Line::of(title), Line::default().formula(&solved.certified.order.join(" > "))];
        let numbers = [score.surfaces, score.thin, score.open, score.candidates, score.terms];
        row.extend(numbers.iter().map(|number| Line::of(&number.to_string())));
        rows.push(row);
    }
    page.table(rows);
    for joint in &derivation.problem.joints {
        let value = match &joint.kind {
            JointKindUnknown::Angle { cosine, sine } => format!("atan2({sine}, {cosine})"),
            JointKindUnknown::Value { unknown } => unknown.clone(),
        };
        page.display(format!("{} = {value}", joint.name));
    }
    Ok(())
}

/// Adds a tree of strata: its bases with their proofs, or the formulas of one unknown after the other.
fn tree(
    page: &mut Document,
    derivation: EquationsView<'_>,
    (index, title, stage): (usize, &str, Option<Stage>),
    node: &Node,
) -> Result<()> {
    if stage == Some(Stage::Plan) {
        return Ok(());
    }
    page.section(Line::of(if index == 0 { "The basis" } else { "The basis that the program uses" }));
    if index > 0 {
        page.text(
            "Each order of the unknowns gives a basis of the same ideal, but with different denominators. The program uses \
             the order whose denominators vanish most rarely.",
        );
    }
    if let Some(solved) = node.solved() {
        basis(page, (index, title), solved);
        if Stage::Triangular.is_in(stage) {
            page.items(values(solved));
        }
        if Stage::Basis.is_in(stage) {
            strata::proof(page, &node.setting, &solved.certified)?;
        }
    }
    let names = |node: &Node| match &node.outcome {
        Outcome::SelfMotion(self_motion) => {
            let names: Vec<&str> =
                self_motion.free.iter().map(|&joint| derivation.problem.joints[joint].name.as_str()).collect();
            format!("{} {}", names.join(", "), if names.len() == 1 { "is" } else { "are" })
        }
        _ => String::new(),
    };
    strata::degenerate(page, node, &names);
    Ok(())
}

fn basis(page: &mut Document, (index, title): (usize, &str), solved: &Solved) {
    let order = solved.certified.order.join(" > ");
    page.paragraph(
        Line::of("In the lexicographic order ").formula(&order).and(&format!(" ({title}), denominators cleared:")),
    );
    for (number, stair) in strata::stairs(solved).into_iter().enumerate() {
        page.equation(&format!("{}.{}", index + 1, number + 1), stair);
    }
}

/// The number of values of each unknown of a triangular form, as text.
fn values(solved: &Solved) -> Vec<Line> {
    let degrees = solved.triangular.stairs.iter().zip(solved.triangular.degrees());
    let degrees = degrees.map(|(stair, degree)| {
        let unknown = &solved.triangular.ring.variables()[stair.unknown];
        let count = if degree == 1 {
            "one value: its polynomial is linear".to_owned()
        } else {
            format!("up to {degree} real values, the roots of a polynomial of degree {degree}")
        };
        Line::default().formula(unknown).and(": ").and(&count).and(".")
    });
    degrees.collect()
}

fn branches(page: &mut Document, derivation: EquationsView<'_>) {
    page.section(Line::of("Branch numbers"));
    page.text(
        "A polynomial with several roots makes several branches. The branch number of a solution counts the roots in ascending order, \
         smallest unknown first. The numbers of a stratum follow those of the stratum before.",
    );
    let mut rows = vec![["branches", "stratum"].map(Line::of).to_vec()];
    for case in derivation.program.cases().filter(|case| !case.open) {
        let end = case.first_branch + Program::branches(case);
        let stratum =
            if case.label.contains('=') { Line::default().formula(&case.label) } else { Line::of(&case.label) };
        rows.push(vec![Line::of(&format!("{} to {}", case.first_branch, end.saturating_sub(1))), stratum]);
    }
    page.table(rows);
}

fn closing(page: &mut Document) {
    page.section(Line::of("At singularities"));
    page.text(
        "The program never tests whether a rounded number is zero. It runs every stratum that may apply, near a boundary those on both \
         sides of it. It polishes each candidate on the equations by Newton's method, computes its residual, and merges equal \
         ones. Where a joint is free the solution names it, and its value is zero.",
    );
    page.paragraph(
        Line::of("All bases are proved; ")
            .name("groebot check")
            .and(" proves them again from ")
            .name("certificate.json")
            .and(" without the Groebner engine."),
    );
}
