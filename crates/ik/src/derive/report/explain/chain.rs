//! The report of a chain that is solved joint by joint.

use super::algebra::joint_unknowns;
use super::document::{Document, Line, Stage};
use super::{forms, geometry, step};
use crate::Result;
use crate::derive::closure::{Mechanism, show};
use crate::derive::sequential::SequentialView;
use crate::solver::{Block, Program};
use groebot_robot::kinematics::Task;

/// The report of `derived`, or of one of its stages.
///
/// # Errors
/// If a field cannot be built. This does not occur for a derivation that this crate made.
pub fn document(derived: SequentialView<'_>, stage: Option<Stage>) -> Result<Document> {
    let mechanism = Mechanism::new(&derived.problem.chain)?;
    let mut page = Document::of(derived.problem.chain.name(), stage);
    if stage.is_none() {
        introduce(&mut page, derived);
    }
    if Stage::Equations.is_in(stage) {
        chain(&mut page, derived, &mechanism);
        closure(&mut page);
    }
    if Stage::Plan.is_in(stage) {
        plan(&mut page, derived, &mechanism);
    }
    for index in 0..derived.method.steps.len() {
        step::explain(&mut page, derived, &mechanism, (index, stage))?;
    }
    if stage.is_none() {
        branches(&mut page, derived);
        singularities(&mut page);
    }
    if Stage::Basis.is_in(stage) {
        forms::explain(&mut page, derived)?;
    }
    if stage.is_none() {
        proof(&mut page, derived);
    }
    Ok(page)
}

/// Text on the cut of the loop for a task that leaves the yaw open.
pub(super) const YAW_OPEN: &str = "The yaw is left open, and the first joint turns about a vertical as the yaw does. So the loop is cut \
     there. After the tip it continues with the given roll and pitch, the remaining rotation about the vertical, the distance from the \
     first axis to the tip, the given height of the tip, and the first joint, measured from the direction of the wanted tip seen from above. \
     The loop closes where its tip is at the base again, so its target is constant.";

fn introduce(page: &mut Document, derived: SequentialView<'_>) {
    let parts = derived.problem.chain.parts();
    for text in [&parts.description, &parts.source].into_iter().flatten() {
        page.paragraph(Line::plain(text));
    }
    let inputs: Vec<&str> = derived.program.inputs.iter().map(|input| input.name.as_str()).collect();
    page.paragraph(
        Line::of(&format!("Given is {}: ", task(derived.problem.chain.task()))).formula(&inputs.join(", ")).and(&format!(
            ", lengths in {}. Wanted are all values of the joints that reach it. They are found one joint at a time: a step is an \
             equation or two in a single unknown joint, for the others cancel in it, are known from the steps before, or are eliminated.",
            derived.problem.chain.length_unit().symbol(),
        )),
    );
}

fn task(task: Task) -> &'static str {
    match task {
        Task::Pose => "the pose of the tip, its position and by rows its rotation",
        Task::Position => "the position of the tip",
        Task::PlanarPosition { .. } => "the position of the tip in a plane",
        Task::PlanarPose { .. } => {
            "the position of the tip in a plane and its angle, counted from the zero configuration"
        }
        Task::Ray => "the position and the direction of the tip",
        Task::Direction => "the direction of the tip",
        Task::Rotation => "the rotation of the tip, by rows",
        Task::PositionYaw { .. } => {
            "the position of the tip and the angle of one of its directions about an axis of the base; the relations contain the rotation from the zero configuration"
        }
        Task::PositionPitchRoll => "the position of the tip, its pitch and its roll, with any yaw",
    }
}

fn chain(page: &mut Document, derived: SequentialView<'_>, mechanism: &Mechanism) {
    page.section(Line::of("The chain"));
    let head = ["joint", "name", "motion", "unknowns", "axis", "through"];
    let mut rows = vec![head.map(Line::of).to_vec()];
    for (index, joint) in mechanism.joints().iter().enumerate() {
        rows.push(vec![
            Line::of(&(index + 1).to_string()),
            Line::default().name(&joint.name),
            Line::of(if joint.is_revolute() { "revolute" } else { "prismatic" }),
            Line::default().formula(&joint_unknowns(mechanism, index)),
            Line::default().formula(&show(&joint.axis)),
            Line::default().formula(&show(&joint.point)),
        ]);
    }
    page.table(rows);
    page.text(
        "Axes and points are given in the base frame at zero. The unknowns of a revolute joint are the cosine and the sine of its \
         angle, $c^2 + s^2 = 1$, so that its motion is polynomial. Where no unit vector along an axis has rational \
         coordinates, the sine is divided by the length of the vector, which keeps all numbers rational.",
    );
    let common = geometry::common(mechanism);
    match common.is_empty() {
        true => page.text("No two neighbouring axes meet or are parallel."),
        false => page.items(common),
    }
    if mechanism.upright_loop().is_some() {
        page.text(YAW_OPEN);
    } else if let Some(hidden) = mechanism.hidden() {
        page.text(&format!(
            "A ray does not specify the rotation of the tip about it. Two arbitrary directions normal to the ray make the target a pose. Joint {} \
             is not a joint of the chain: it rotates the tip about the ray to that pose. Its angle is found with the others and is not \
             part of a solution.",
            hidden + 1
        ));
    }
    if !derived.method.plan.given.is_empty() && mechanism.upright_loop().is_none() {
        let given = geometry::numbers(derived.method.plan.given.iter().copied());
        page.text(&format!("The user gives the value of {given}."));
    }
}

fn closure(page: &mut Document) {
    page.section(Line::of("The loop equation and its invariants"));
    page.text(
        "Let $Ei$ be the motion of joint $i$ and $G$ the motion that takes the tip from its pose at zero to the target ($G = T*M^-1$ with the \
         target $T$ and the tip's pose $M$ at zero). The chain reaches the target when",
    );
    page.equation("0.1", "E1 ... En = G");
    page.text(
        "Cut this loop twice. The joints of one piece leave an object in place (a point on their axes, a direction along them), and \
         the joints of another piece leave another object in place. Then both pieces cancel in each rigid-motion invariant of the two \
         objects: the scalar product $a . x$ of two directions, the coordinate of a point along a \
         direction, the distance $|a - x|$ of two points, the mutual moment of two lines. Each is one polynomial equation in the \
         remaining joints.",
    );
    page.text(
        "Every such equation follows from the loop. This has been computed, not assumed: with $G$ replaced by $E1 ... En$ \
         and each $c^2$ by $1 - s^2$ it becomes identically zero. The equations of the loop and the circles have coprime \
         leading terms, so they are a Groebner basis, and a zero remainder means membership in their ideal.",
    );
}

fn plan(page: &mut Document, derived: SequentialView<'_>, mechanism: &Mechanism) {
    page.section(Line::of("The order of the joints"));
    page.text(&format!(
        "A generic target has {} complex solutions, and at most as many real ones. They were counted modulo primes at random reachable \
         targets, as the dimension of the quotient by all equations, from a Groebner basis of them:",
        derived.method.plan.dimension
    ));
    page.items(derived.method.plan.evidence.iter().map(|evidence| Line::of(&evidence.to_string())).collect());
    let mut rows = vec![["step", "joint", "name", "form", "solutions"].map(Line::of).to_vec()];
    for (index, (step, planned)) in derived.method.steps.iter().zip(&derived.method.plan.steps).enumerate() {
        rows.push(vec![
            Line::of(&(index + 1).to_string()),
            Line::of(&(step.joint + 1).to_string()),
            Line::default().name(&mechanism.joints()[step.joint].name),
            Line::of(step.shape.form.name()),
            Line::of(&planned.degree.to_string()),
        ]);
    }
    page.table(rows);
    let degrees: Vec<String> = derived.method.plan.steps.iter().map(|step| step.degree.to_string()).collect();
    page.text(&format!("Together: $({}) = {}$ solutions.", degrees.join(")("), derived.method.plan.product()));
}

/// Adds how the branch number of a solution follows from the choices of the steps.
fn branches(page: &mut Document, derived: SequentialView<'_>) {
    page.section(Line::of("Branch numbers"));
    page.text(
        "Each step that has several roots makes a choice, such as the left or the right shoulder, the elbow up or down, the wrist \
         flipped or not: here they are the first and the second root. These choices are the digits of a solution's branch number, \
         the first step first; each step has its own base:",
    );
    let mut rows = vec![["choice", "joint", "base", "values"].map(Line::of).to_vec()];
    for block in derived.program.blocks.iter().filter(|block| block.branches() > 1) {
        let choice = format!("b{}", rows.len());
        rows.push(vec![
            Line::default().formula(&choice),
            Line::default().name(&block.label),
            Line::of(&block.branches().to_string()),
            Line::of(&digits(block)),
        ]);
    }
    if rows.len() > 1 {
        page.table(rows);
        let bases: Vec<&Block> = derived.program.blocks.iter().filter(|block| block.branches() > 1).collect();
        let sum = bases.iter().enumerate().skip(1).fold("b1".to_owned(), |sum, (index, block)| {
            let sum = if index > 1 { format!("({sum})") } else { sum };
            format!("{sum}*{} + b{}", block.branches(), index + 1)
        });
        page.display(format!("branch = {sum}"));
    } else {
        page.text("No step of this chain has more than one root: there is one branch.");
    }
}

/// The digits of a block as text, such as `0 to 1 generic, 2 where A = 0, B = 0`.
fn digits(block: &Block) -> String {
    let mut cases: Vec<(usize, usize, String)> = Vec::new();
    for case in &block.cases {
        let last = (case.first_branch + Program::branches(case)).saturating_sub(1);
        let label = if case.label.contains('=') { format!("where ${}$", case.label) } else { case.label.clone() };
        let entry = (case.first_branch, last, label);
        if !cases.contains(&entry) {
            cases.push(entry);
        }
    }
    let text = |(first, last, label): (usize, usize, String)| match last > first {
        true => format!("{first} to {last} {label}"),
        false => format!("{first} {label}"),
    };
    cases.into_iter().map(text).collect::<Vec<_>>().join("; ")
}

fn singularities(page: &mut Document) {
    page.section(Line::of("At singularities"));
    page.text(
        "The formulas of a step have denominators. Where one vanishes the step has other formulas: a stratum (below, with \
         its proof). The program never tests whether a rounded number is zero. It runs every stratum that may apply, near a \
         boundary those on both sides of it. It polishes each candidate on forward kinematics by Newton's method, computes its \
         residual, and merges equal ones.",
    );
    page.text(
        "Where a joint is free there is a self-motion. The program samples an angle at 8 or 16 values, a length at 5 or more. \
         It continues with the later steps and returns the best member that it finds. The solution names the joints that are free, \
         and all members share one branch number.",
    );
}

fn proof(page: &mut Document, derived: SequentialView<'_>) {
    page.section(Line::of("Why no solution is lost and none is added"));
    let relations: usize = derived.method.steps.iter().map(|step| step.relations.len()).sum();
    page.text(&format!(
        "None is lost: all {relations} equations of the steps are members of the ideal of the loop, by exact computation, and \
         every form is proved on all its strata."
    ));
    let tight = derived.method.plan.product() == derived.method.plan.dimension;
    page.text(&format!(
        "None is added: a random target modulo a prime has {} complex solutions, and the degrees of the steps multiply to {}, {}. Besides, \
         the program checks each solution by forward kinematics before it returns it.",
        derived.method.plan.dimension,
        derived.method.plan.product(),
        match tight {
            true => "the same number, so that each branch of the steps is a solution",
            false => "more than that: the task requires more than the joints can do, and the program checks the remaining equations when it runs",
        }
    ));
    page.paragraph(
        Line::of("The count modulo a prime at random targets is evidence, not proof; the rest is proved, and ")
            .name("groebot check")
            .and(" proves it again from ")
            .name("certificate.json")
            .and(" without search and without the Groebner engine."),
    );
}
