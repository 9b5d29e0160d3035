//! The section on forms in a chain's report: equations with free symbols, their bases with proofs, their roots and strata.

use super::algebra::signs;
use super::document::{Document, Line};
use super::strata;
use crate::Result;
use crate::derive::sequential::{Form, FormBasis, HalfAngle, HalfAngles, SequentialView};
use groebot_algebra::number::{Ring, Style};

/// The equations of a form, in the unknowns of its joint.
pub fn equations(form: Form) -> &'static [&'static str] {
    match form {
        Form::Angle => &["A*c + B*s + C = 0"],
        Form::Rotation => &["A*c - B*s = X", "B*c + A*s = Y"],
        Form::Pair => &["A*c + B*s = X", "E*c + F*s = Y"],
        Form::Linear => &["A*d + B = 0"],
        Form::Quartic => &["A*c*s + B*s^2 + C*c + D*s + E = 0"],
        Form::Lengths => &["A*d^4 + B*d^3 + C*d^2 + D*d + E = 0"],
        Form::Quadratic => &["A*d^2 + 2*B*d + C = 0"],
    }
}

/// A short text on how a form determines its joint, and on the origin of its branches.
pub fn why(form: Form) -> &'static str {
    match form {
        Form::Angle => "one linear equation in cosine and sine, a chord of the circle with two ends",
        Form::Rotation => "two equations that rotate a known vector to a known vector, one angle",
        Form::Pair => "two independent linear equations in cosine and sine, one angle",
        Form::Quartic => {
            "an equation of degree two in cosine and sine, by the tangent of half the angle up to four angles"
        }
        Form::Lengths => "an equation of degree four at most, up to four lengths",
        Form::Linear => "a linear equation, one length",
        Form::Quadratic => "a quadratic equation, two lengths",
    }
}

/// The triangular form where no denominator vanishes. Each polynomial is text `f = 0`.
///
/// # Errors
/// [`crate::ErrorKind::Certificate`] for half angles without a quartic.
pub fn triangular(derived: SequentialView<'_>, form: Form) -> Result<Vec<String>> {
    if let (Form::Quartic, Some(halves)) = (form, &derived.method.forms.half_angles) {
        return half_angle(halves);
    }
    let form_basis = derived.method.forms.bases.iter().find(|form_basis| form_basis.form == form);
    Ok(form_basis.and_then(|form_basis| form_basis.tree.solved()).map(strata::stairs).unwrap_or_default())
}

fn half_angle(halves: &HalfAngles) -> Result<Vec<String>> {
    let Some(half) = halves.0.first() else { return Ok(Vec::new()) };
    [2, 1, 0].into_iter().map(|unknown| Ok(format!("{} = 0", sorted(half, unknown)?))).collect()
}

/// The polynomial that determines an unknown, sorted by powers of this unknown.
fn sorted(half: &HalfAngle, unknown: usize) -> Result<String> {
    let name = &half.ring.variables()[unknown];
    let parts = half.ring.coefficients_in(half.stair(unknown)?, unknown);
    let terms = parts.iter().enumerate().rev().filter(|(_, part)| !part.is_zero()).map(|(power, part)| {
        let text = strata::factor(&half.ring.format(part, Style::Text));
        match (power, text.as_str()) {
            (0, _) => text,
            (1, "1") => name.clone(),
            (1, _) => format!("{text}*{name}"),
            _ => format!("{text}*{name}^{power}"),
        }
    });
    Ok(signs(terms))
}

/// The origin of the branches of a form, as text.
pub fn roots(form: Form) -> &'static str {
    match form {
        Form::Angle => {
            "The equation is a line in the plane of cosine and sine, which cuts the unit circle in two points. With \
             $w = A*s - B*c$ they are the two roots $w = +- sqrt(A^2 + B^2 - C^2)$, and $atan2(s, c)$ is the angle: the smaller \
             root is the first branch of this step, the greater one the second. Where $A^2 + B^2 < C^2$ the line misses the \
             circle, and the target is out of reach on this branch."
        }
        Form::Rotation | Form::Pair => {
            "Both polynomials are linear, so there is one angle, $atan2(s, c)$, and no branch. Whether $c^2 + s^2 = 1$ holds is \
             checked at the end, as for all solutions."
        }
        Form::Linear => "This polynomial is linear: there is one length and no branch.",
        Form::Quartic => {
            "Here $t$ is the tangent of half the angle. The quartic has up to four real roots: in ascending order they are the \
             branches of this step. The angle opposite to the direction from which it is counted would be lost, so there are five \
             directions, each with its basis, and the one with the greatest leading coefficient is taken."
        }
        Form::Lengths => {
            "The polynomial has up to four real roots: in ascending order they are the branches of this step."
        }
        Form::Quadratic => {
            "With $w = A*d + B$ the two roots are $w = +- sqrt(B^2 - A*C)$: the smaller one is the first branch of this step, the \
             greater one the second. Where $B^2 < A*C$ the target is out of reach on this branch."
        }
    }
}

/// The behaviour where the formulas of a form are singular, as text.
pub fn singular(form: Form) -> &'static str {
    match form {
        Form::Angle => {
            "where $A^2 + B^2 = C^2$ the line touches the circle and the two branches meet. Where $A = B = 0$ the equation does not contain \
             the angle: with $C = 0$ too it is free, and a self-motion is returned; otherwise there is no solution."
        }
        Form::Rotation => {
            "where $A = B = 0$ the rotated vector is on the axis: with $X = Y = 0$ the angle is free, otherwise there is no \
             solution."
        }
        Form::Pair => {
            "where $A*F = B*E$ the two lines are parallel. Each equation is then solved alone, as in the form angle, and forward \
             kinematics selects the angles that solve both."
        }
        Form::Linear => "where $A = 0$ the equation does not contain the length.",
        Form::Quartic => {
            "where two roots of the quartic meet, two branches do. Where all five symbols vanish the angle is free, and a self-motion \
             is returned."
        }
        Form::Lengths => "where two roots meet, two branches do.",
        Form::Quadratic => "where $B^2 = A*C$ the two branches meet.",
    }
}

/// Adds the section on the forms that the steps use.
///
/// # Errors
/// If a field cannot be built. This does not occur for a derivation that this crate made.
pub fn explain(page: &mut Document, derived: SequentialView<'_>) -> Result<()> {
    page.section(Line::of("Proof of each basis"));
    page.text(
        "The steps above use only a few forms. In a form the coefficients are free symbols, so its proof holds for all \
         targets and all values of earlier joints. A polynomial that is a combination of the equations vanishes wherever they do: the \
         cofactors show this. By Buchberger's criterion no polynomial is missing: the S-polynomial of every two members, the \
         simplest combination in which their leading terms cancel, has the remainder zero.",
    );
    for form_basis in &derived.method.forms.bases {
        form(page, form_basis)?;
    }
    derived.method.forms.half_angles.iter().for_each(|halves| half_angles(page, halves));
    Ok(())
}

fn form(page: &mut Document, form_basis: &FormBasis) -> Result<()> {
    let name = form_basis.form.name();
    page.paragraph(Line::of("The form ").name(name).and(". Its equations are"));
    for (index, equation) in form_basis.system.equations.iter().enumerate() {
        page.display(format!("f{} = {} = 0", index + 1, equation.expression));
    }
    let order = form_basis.system.order.join(" > ");
    page.paragraph(
        Line::of("In the lexicographic order ")
            .formula(&order)
            .and(", denominators cleared, their reduced Groebner basis is"),
    );
    if let Some(solved) = form_basis.tree.solved() {
        strata::stairs(solved).into_iter().for_each(|stair| page.display(stair));
        strata::proof(page, &form_basis.tree.setting, &solved.certified)?;
    }
    strata::degenerate(page, &form_basis.tree, &|_| "the joint is".to_owned());
    Ok(())
}

fn half_angles(page: &mut Document, halves: &HalfAngles) {
    let Some(half) = halves.0.first() else { return };
    page.paragraph(
        Line::of("The form ").name(Form::Quartic.name()).and(". Its equations are, for the direction zero,"),
    );
    for (index, f) in half.generators.iter().enumerate() {
        page.display(format!("f{} = {} = 0", index + 1, half.ring.format(f, Style::Text)));
    }
    let count: usize = halves.0.iter().map(|half| half.basis.len()).sum();
    page.text(&format!(
        "Eliminating $c$ and $s$ leaves the quartic. The {} directions have {count} polynomials in their bases; each was multiplied \
         out from its cofactors, and all S-polynomials were reduced to zero, over the rational numbers.",
        halves.0.len()
    ));
}
