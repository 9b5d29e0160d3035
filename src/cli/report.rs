//! The text report of a derivation.

use std::fmt::Write;
use std::path::Path;
use std::time::Duration;

use super::algebra::{divisor, readable, with_decimals};
use super::chain_report;
use super::console::Paint;
use super::files::without_ikfast;
use super::page::Page;
use super::strata;
use crate::Result;
use groebot_ik::derive::equations::EquationsView;
use groebot_ik::derive::equations::setting::{Poly, Unknowns};
use groebot_ik::derive::equations::triangular::{Stair, Triangular};
use groebot_ik::derive::planner::fitting_task;
use groebot_ik::derive::{AnyView, Derivation, JointKindUnknown, ParameterSource, Quantity, Root, Source, System};
use groebot_ik::witness;

/// The content of the report.
pub struct Report<'a> {
    /// The input.
    pub source: &'a Source,
    /// The result.
    pub derivation: &'a Derivation,
    /// The results of the numeric checks.
    pub checked: &'a witness::Report,
    /// The folder of the files.
    pub folder: &'a Path,
    /// Their names.
    pub files: &'a [&'a str],
    /// The duration of each stage.
    pub timings: &'a [(&'static str, Duration)],
}

/// The report as text.
///
/// # Errors
/// When a setting's field cannot be built, which does not happen for a derivation of this crate.
pub fn report(content: &Report<'_>, paint: Paint) -> Result<String> {
    let mut page = Page { text: String::new(), paint };
    match content.derivation.view() {
        AnyView::Equations(derivation) => block(&mut page, derivation)?,
        AnyView::Sequential(derived) => {
            page.text += &format!("{}\n", derived.problem.chain);
            chain_report::describe(&mut page, derived);
        }
        AnyView::Eigenvalue(derived) => chain_report::describe_six_axes(&mut page, derived),
        AnyView::Coupled(derived) => chain_report::describe_coupled(&mut page, derived),
    }
    meant(&mut page, content);
    ignored(&mut page, content);
    checks(&mut page, content.checked);
    written(&mut page, content);
    Ok(page.text)
}

/// The idealisation of the description, and the limitations of its joints.
fn meant(page: &mut Page, content: &Report<'_>) {
    let Some((ideal, report)) = content.source.ideal.as_ref() else { return };
    if !report.is_empty() {
        page.heading("Idealisation of the description");
        report.lines().iter().for_each(|line| page.line(line));
        let how = if report.is_same() {
            "In double precision it equals the described robot: no solution is polished.".to_owned()
        } else {
            format!(
                "The closed form is that of this ideal robot; each solution is polished on the described one, and its residual is measured there. \
                 `--exact` uses every digit, `--snap X` another tolerance than {:e}.",
                report.tolerance
            )
        };
        page.line(&how);
    }
    let usual = (report.tolerance == 0.0).then(|| ideal.ideal().1).filter(|usual| !usual.is_empty());
    if let Some(usual) = usual {
        page.heading("Every digit as described");
        usual.lines().iter().for_each(|line| page.line(&format!("not idealised: {line}")));
        page.line("Without --exact the description is idealised so, and the solver is much simpler.");
    }
    let free = ideal.independent().len();
    if free < ideal.task().freedoms() {
        page.heading("Out of reach, as a rule");
        page.line(&format!(
            "{free} joints reach no generic target of the task `{}`, which needs {} numbers: most targets have no solution.{}",
            ideal.task().name(),
            ideal.task().freedoms(),
            fitting_task(ideal).map(|task| format!(" `{task}` is a task that they can perform.")).unwrap_or_default()
        ));
    }
}

/// The ignored parts of the description.
fn ignored(page: &mut Page, content: &Report<'_>) {
    if !content.source.notes.is_empty() {
        page.heading("Notes");
        content.source.notes.iter().for_each(|note| page.line(note));
    }
}

/// A derivation of equations that are solved as one block.
fn block(page: &mut Page, derivation: EquationsView<'_>) -> Result<()> {
    let system = derivation.problem;
    introduce(page, system);
    equations(page, system);
    if let Some(solved) = derivation.method.requested.solved() {
        basis(page, system, &solved.triangular);
        triangular_steps(page, system, &solved.triangular);
    }
    run_time(page, derivation)?;
    count(page, derivation);
    strata::describe(page, derivation);
    proofs(page, derivation);
    Ok(())
}

fn introduce(page: &mut Page, system: &System) {
    page.text += &format!("{}\n", page.paint.bold(&system.name));
    for line in [&system.description, &system.source] {
        if !line.is_empty() {
            page.line(line);
        }
    }
    let unit = |quantity| match quantity {
        Quantity::Length => format!(" ({})", system.length_unit.symbol()),
        Quantity::Angle => " (rad)".to_owned(),
        Quantity::Number => String::new(),
    };
    let target: Vec<String> =
        system.inputs.iter().map(|input| format!("{}{}", input.name, unit(input.quantity))).collect();
    let joints: Vec<String> = system
        .joints
        .iter()
        .map(|joint| match &joint.kind {
            JointKindUnknown::Angle { cosine, sine } => {
                format!("{name} (cosine {cosine}, sine {sine})", name = joint.name)
            }
            JointKindUnknown::Value { unknown } => format!("{} ({unknown})", joint.name),
        })
        .collect();
    page.entries(&[("target".to_owned(), target.join(", ")), ("joints".to_owned(), joints.join(", "))]);
}

fn equations(page: &mut Page, system: &System) {
    page.heading("Equations");
    let mut entries: Vec<(String, String)> = system
        .equations
        .iter()
        .map(|equation| (equation.label.clone(), format!("{} = 0", with_decimals(&equation.expression))))
        .collect();
    for parameter in &system.parameters {
        let meaning = match parameter.source {
            ParameterSource::Input(_) => continue,
            ParameterSource::Cosine(i) => format!("the cosine of {}", system.inputs[i].name),
            ParameterSource::Sine(i) => format!("the sine of {}", system.inputs[i].name),
            ParameterSource::SquareRoot => match &parameter.square {
                Some(square) => format!("the positive square root of {square}"),
                None => continue,
            },
        };
        entries.push((format!("with {}", parameter.name), meaning));
    }
    page.entries(&entries);
}

/// The polynomials of a triangular form, in the order of solution.
fn polynomials(triangular: &Triangular) -> Vec<&Poly> {
    triangular.stairs.iter().flat_map(|stair| &stair.polynomials).collect()
}

fn basis(page: &mut Page, system: &System, triangular: &Triangular) {
    let parameters: Vec<&str> = system.parameters.iter().map(|parameter| parameter.name.as_str()).collect();
    let order = triangular.ring.variables().join(" > ");
    page.heading(&format!("Groebner basis over Q({}), lexicographic, {order}", parameters.join(", ")));
    let entry = |(index, f): (usize, &&Poly)| (number(index), format!("{} = 0", readable(&triangular.ring, f)));
    let entries: Vec<_> = polynomials(triangular).iter().enumerate().map(entry).collect();
    page.entries(&entries);
}

fn number(index: usize) -> String {
    format!("[{}]", index + 1)
}

fn triangular_steps(page: &mut Page, system: &System, triangular: &Triangular) {
    page.heading("Formulas, one unknown after the other");
    let mut first = 0;
    let mut entries = Vec::new();
    for (stair, degree) in triangular.stairs.iter().zip(triangular.degrees()) {
        let name = &triangular.ring.variables()[stair.unknown];
        entries.push((name.clone(), step(&triangular.ring, stair, degree, first)));
        first += stair.polynomials.len();
    }
    for joint in &system.joints {
        let value = match &joint.kind {
            JointKindUnknown::Angle { cosine, sine } => format!("atan2({sine}, {cosine})"),
            JointKindUnknown::Value { unknown } => unknown.clone(),
        };
        entries.push((joint.name.clone(), value));
    }
    page.entries(&entries);
}

/// The formula of one unknown from the smaller ones.
fn step(ring: &Unknowns, stair: &Stair, degree: u32, first: usize) -> String {
    let which: Vec<String> = (first..first + stair.polynomials.len()).map(number).collect();
    let which = match which.as_slice() {
        [only] => only.clone(),
        many => format!("the first of {} that does not degenerate", many.join(", ")),
    };
    let kind = match degree {
        1 => "linear".to_owned(),
        2 => "quadratic, up to 2 real roots in closed form".to_owned(),
        3 | 4 => format!("of degree {degree}, up to {degree} real roots in closed form"),
        _ => format!("of degree {degree}, up to {degree} real roots by isolation"),
    };
    let divides = match stair.polynomials.as_slice() {
        [only] => leading(ring, only, stair.unknown).map(|by| format!(", divides by {by}")).unwrap_or_default(),
        _ => String::new(),
    };
    format!("from {which}: {kind}{divides}")
}

/// The leading coefficient of `f` in `unknown`, if it is a polynomial of the parameters and not a number.
fn leading(ring: &Unknowns, f: &Poly, unknown: usize) -> Option<String> {
    let coefficient = ring.coefficients_in(f, unknown).pop()?;
    let coefficient = ring.as_constant(&coefficient)?;
    let ground = ring.field().ring();
    let is_number = ground.as_constant(coefficient.numerator()).is_some();
    (!is_number).then(|| divisor(ground, coefficient.numerator()).to_string())
}

fn run_time(page: &mut Page, derivation: EquationsView<'_>) -> Result<()> {
    let (requested, used) = (&derivation.method.requested, derivation.method.solving());
    page.heading("Order that the solver uses");
    if strata::order(requested) == strata::order(used) {
        page.line("The solver uses this order: no other tried order has denominators that vanish on fewer targets.");
        return Ok(());
    }
    page.line("Of the orders tried, the solver uses the one whose denominators vanish on the fewest strata:");
    let entry = |node| Ok((strata::order(node), strata::breakdowns(&strata::score(node)?)));
    let (requested, (order, sets)) = (entry(requested)?, entry(used)?);
    page.entries(&[requested, (order, format!("{sets}  <- used"))]);
    Ok(())
}

fn count(page: &mut Page, derivation: EquationsView<'_>) {
    let Some(dimension) = derivation.method.dimension() else { return };
    page.heading("Solutions");
    let plural = if dimension == 1 { "solution" } else { "solutions" };
    page.line(&format!(
        "{dimension} complex {plural} at a generic target, the dimension of the quotient ring: at most {dimension} real."
    ));
    if let Some(choice) = &derivation.problem.choice {
        let root = if choice.root == Root::Minus { "minus" } else { "plus" };
        page.line(&format!(
            "All are returned; the published solution has the {root} root of {}, and is marked.",
            choice.unknown
        ));
    }
}

fn proofs(page: &mut Page, derivation: EquationsView<'_>) {
    let trees = derivation.method.trees();
    let nodes = trees.iter().flat_map(|(_, node)| node.walk());
    let proofs: Vec<_> = nodes.flat_map(|node| node.proofs()).map(|(_, certified)| certified.proof).collect();
    let sum = |part: fn(&groebot_algebra::groebner::verify::Proof) -> usize| proofs.iter().map(part).sum::<usize>();
    page.heading("Proved exactly, independently of the Groebner engine");
    page.entries(&[
        (proofs.len().to_string(), "Groebner bases, one a stratum and order".to_owned()),
        (sum(|proof| proof.cofactor_rows).to_string(), "basis elements are combinations of the equations".to_owned()),
        (sum(|proof| proof.generators).to_string(), "equations reduce to zero".to_owned()),
        (sum(|proof| proof.pairs).to_string(), "S-polynomials reduce to zero".to_owned()),
    ]);
}

fn checks(page: &mut Page, checked: &witness::Report) {
    let summary = checked.summary();
    page.heading("Checked numerically by independent methods");
    let mut entries = vec![
        (
            (summary.rows - summary.failed).to_string(),
            "targets: their joint values are found, all equations hold".to_owned(),
        ),
        (summary.exact.to_string(), "of them: as many solutions as exact real roots (Sturm)".to_owned()),
    ];
    if summary.screw > 0 {
        entries
            .push((summary.screw.to_string(), "of them: the screw solver (Paden-Kahan) gives the same set".to_owned()));
    }
    entries.push((
        summary.oracle.to_string(),
        "of them: damped least squares from many starts gives the same set".to_owned(),
    ));
    if summary.open > 0 {
        entries.push((
            summary.open.to_string(),
            "of them: on a stratum that is not derived, and reported as such".to_owned(),
        ));
    }
    entries.push((format!("{:.0e}", summary.worst_residual), "the largest residual of all answers".to_owned()));
    page.entries(&entries);
    let weak: Vec<(String, String)> =
        checked.weak_spots().map(|row| (format!("row {}", row.number), row.weakness())).collect();
    if !weak.is_empty() {
        page.heading("Weak spots: singular targets, or targets close to them, with wrong or missing answers");
        page.entries(&weak);
    }
}

fn written(page: &mut Page, content: &Report<'_>) {
    let folder = if content.folder.as_os_str().is_empty() { Path::new(".") } else { content.folder };
    page.heading(&format!("Written to {}", folder.display()));
    page.line(&content.files.join(", "));
    without_ikfast(content.derivation.program()).iter().for_each(|line| page.line(line));
    page.heading("Time");
    let mut times = String::new();
    for (stage, time) in content.timings {
        let _ = write!(times, "{}{stage} {}", if times.is_empty() { "" } else { ", " }, duration(*time));
    }
    page.line(&times);
    let program = content.derivation.program();
    let is_needed =
        |place: &usize| program.redundancy.is_none() || program.given_joints.iter().all(|given| given.input != *place);
    let inputs = (0..program.inputs.len()).filter(is_needed);
    let names: Vec<&str> = inputs.map(|place| program.inputs[place].name.as_str()).collect();
    page.heading("Next");
    page.line(&format!("groebot solve {} --target {}", folder.display(), names.join(",")));
}

fn duration(time: Duration) -> String {
    let seconds = time.as_secs_f64();
    if seconds < 1.0 { format!("{:.1} ms", seconds * 1e3) } else { format!("{seconds:.1} s") }
}
