//! Checks that every system must pass. Each mistake names the part of the description that contains it.

use std::collections::{HashMap, HashSet};

use crate::derive::problem::radicals::check_root;
use crate::derive::problem::system_parts::{
    Input, JointKindUnknown, JointUnknown, MAX_BITS, MAX_DEGREE, MAX_PARAMETERS, MAX_TERMS, MAX_UNKNOWNS, Parameter,
    ParameterSource, Quantity, SystemParts, are_partners, complement, is_circle,
};
use crate::{Error, ErrorKind};
use groebot_algebra::limits::is_name;
use groebot_algebra::poly::{Expression, is_identifier};

/// The part of a description that contains a mistake. An index counts the parts of that kind from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(in crate::derive) enum Part {
    Name,
    Input(usize),
    Parameter(usize),
    Joint(usize),
    Order,
    Equation(usize),
    Equations,
    Choice,
}

/// A mistake and the part that contains it.
pub(in crate::derive) struct Mistake {
    pub(in crate::derive) part: Part,
    pub(in crate::derive) error: Error,
}

type Checked = Result<(), Mistake>;

fn mistake(part: Part, kind: ErrorKind, message: impl Into<String>) -> Mistake {
    Mistake { part, error: Error::new(kind, message) }
}

/// Returns the first mistake of `parts` as an error.
pub(in crate::derive) fn check(parts: &SystemParts) -> Checked {
    let mut names = Names::default();
    check_length(parts)?;
    check_identifier(&parts.name, Part::Name, "the system")?;
    for (i, input) in parts.inputs.iter().enumerate() {
        names.declare(&input.name, Part::Input(i), "an input")?;
    }
    for (i, parameter) in parts.parameters.iter().enumerate() {
        check_parameter(parts, i, parameter, &mut names)?;
    }
    for (i, joint) in parts.joints.iter().enumerate() {
        check_joint(i, joint, &mut names)?;
    }
    for (i, joint) in parts.joints.iter().enumerate() {
        let own = matches!(&joint.kind, JointKindUnknown::Value { unknown } if *unknown == joint.name);
        if !own {
            names.declare(&joint.name, Part::Joint(i), "a joint")?;
        }
    }
    let unknowns: Vec<&str> = parts.joints.iter().flat_map(|joint| joint.kind.unknowns()).collect();
    check_count(unknowns.len())?;
    check_order(&parts.order, &unknowns)?;
    check_equations(parts, &unknowns)?;
    check_choice(parts, &unknowns)
}

/// The meaning of each name that is declared so far.
#[derive(Default)]
struct Names<'a> {
    meanings: HashMap<&'a str, &'static str>,
}

impl<'a> Names<'a> {
    fn declare(&mut self, name: &'a str, part: Part, meaning: &'static str) -> Checked {
        check_identifier(name, part, meaning)?;
        match self.meanings.insert(name, meaning) {
            None => Ok(()),
            Some(other) => {
                let text =
                    format!("`{name}` is declared as {other} and again as {meaning}; give one of them another name");
                Err(mistake(part, ErrorKind::DuplicateName, text))
            }
        }
    }
}

fn check_identifier(name: &str, part: Part, meaning: &str) -> Checked {
    if is_identifier(name) && is_name(name) {
        return Ok(());
    }
    let shown: String = name.chars().take(40).collect();
    let text = format!("`{shown}` cannot name {meaning}; give up to 200 letters, digits and `_`, no digit first");
    Err(mistake(part, ErrorKind::BadValue, text))
}

fn check_parameter<'a>(parts: &'a SystemParts, i: usize, parameter: &'a Parameter, names: &mut Names<'a>) -> Checked {
    let part = Part::Parameter(i);
    check_source(parts, i, parameter)?;
    let same_input = match parameter.source {
        ParameterSource::Input(input) => parts.inputs[input].name == parameter.name,
        _ => false,
    };
    let is_new = parts.parameters[..i].iter().all(|earlier| earlier.name != parameter.name);
    if !(same_input && is_new) {
        names.declare(&parameter.name, part, "a parameter")?;
    }
    let Some(square) = &parameter.square else { return Ok(()) };
    let earlier: HashSet<&str> = parts.parameters[..i].iter().map(|earlier| earlier.name.as_str()).collect();
    let context = format!("the square of `{}`", parameter.name);
    check_names(square, part, &context, |name| earlier.contains(name), "an earlier parameter")?;
    check_size(square, part, &context)?;
    check_root(&parts.parameters[..=i]).map_err(|error| Mistake { part, error })
}

fn check_source(parts: &SystemParts, i: usize, parameter: &Parameter) -> Checked {
    let bad = |text: String| Err(mistake(Part::Parameter(i), ErrorKind::BadValue, text));
    let name = &parameter.name;
    let earlier = &parts.parameters[..i];
    if parameter.source != ParameterSource::SquareRoot && earlier.iter().any(|other| other.source == parameter.source) {
        return bad(format!("parameter `{name}` has the source of an earlier parameter; use one name for both"));
    }
    let (index, is_angle) = match parameter.source {
        ParameterSource::SquareRoot if parameter.square.is_some() => return Ok(()),
        ParameterSource::SquareRoot => return bad(format!("the root `{name}` needs its `square`")),
        ParameterSource::Input(index) => (index, false),
        ParameterSource::Cosine(index) | ParameterSource::Sine(index) => (index, true),
    };
    let Some(input) = parts.inputs.get(index) else {
        return bad(format!("parameter `{name}` refers to input {index}, there are {}", parts.inputs.len()));
    };
    check_angle(input, is_angle, parameter, i)?;
    let partner = earlier.iter().find(|other| are_partners(other.source, parameter.source));
    match (partner, &parameter.square) {
        (Some(partner), Some(square)) if *square != complement(&partner.name) => {
            bad(format!("the square of `{name}` is {}, not {square}", complement(&partner.name)))
        }
        _ => Ok(()),
    }
}

fn check_angle(input: &Input, is_angle: bool, parameter: &Parameter, i: usize) -> Checked {
    if (input.quantity == Quantity::Angle) == is_angle {
        return Ok(());
    }
    let text = if is_angle {
        format!("parameter `{}` is a cosine or sine of `{}`, which is not an angle", parameter.name, input.name)
    } else {
        format!("the angle `{}` cannot be used in equations; use its cosine and sine", input.name)
    };
    Err(mistake(Part::Parameter(i), ErrorKind::BadValue, text))
}

fn check_joint<'a>(i: usize, joint: &'a JointUnknown, names: &mut Names<'a>) -> Checked {
    check_identifier(&joint.name, Part::Joint(i), "a joint")?;
    for unknown in joint.kind.unknowns() {
        names.declare(unknown, Part::Joint(i), "an unknown")?;
    }
    Ok(())
}

fn check_length(parts: &SystemParts) -> Checked {
    if parts.inputs.len().max(parts.parameters.len()) <= MAX_PARAMETERS {
        return Ok(());
    }
    let text = format!("more than {MAX_PARAMETERS} inputs or parameters; replace some by constants");
    Err(mistake(Part::Parameter(MAX_PARAMETERS), ErrorKind::Unsupported, text))
}

fn check_count(count: usize) -> Checked {
    match count {
        0 => Err(mistake(Part::Equations, ErrorKind::MissingKey, "there are no joints; give at least one")),
        1..=MAX_UNKNOWNS => Ok(()),
        _ => {
            let text = format!("{count} unknowns, at most {MAX_UNKNOWNS} are allowed; split the system");
            Err(mistake(Part::Joint(MAX_UNKNOWNS / 2), ErrorKind::Unsupported, text))
        }
    }
}

fn check_order(order: &[String], unknowns: &[&str]) -> Checked {
    let mut seen = HashSet::new();
    let bad = |kind, text: String| {
        let allowed = format!("give each of {} once, greatest first", unknowns.join(", "));
        Err(mistake(Part::Order, kind, format!("order: {text}; {allowed}")))
    };
    for name in order {
        if !unknowns.contains(&name.as_str()) {
            return bad(ErrorKind::UnknownName, format!("`{name}` is not an unknown"));
        }
        if !seen.insert(name.as_str()) {
            return bad(ErrorKind::DuplicateName, format!("`{name}` is given twice"));
        }
    }
    match unknowns.iter().find(|unknown| !seen.contains(*unknown)) {
        Some(missing) => bad(ErrorKind::BadValue, format!("`{missing}` is missing")),
        None => Ok(()),
    }
}

fn check_equations(parts: &SystemParts, unknowns: &[&str]) -> Checked {
    let parameters: HashSet<&str> = parts.parameters.iter().map(|parameter| parameter.name.as_str()).collect();
    for (i, equation) in parts.equations.iter().enumerate() {
        let (part, expression) = (Part::Equation(i), &equation.expression);
        let context = format!("equation {} {}", i + 1, equation.label);
        let context = context.trim_end();
        let known = |name: &str| unknowns.contains(&name) || parameters.contains(name);
        check_names(expression, part, context, known, "an unknown or a parameter")?;
        check_size(expression, part, context)?;
        check_divisors(expression, part, context, unknowns)?;
    }
    let says_more = |expression: &Expression| {
        !parts.joints.iter().any(|joint| match &joint.kind {
            JointKindUnknown::Angle { cosine, sine } => is_circle(expression, cosine, sine),
            JointKindUnknown::Value { .. } => false,
        })
    };
    if parts.equations.iter().any(|equation| says_more(&equation.expression)) {
        return Ok(());
    }
    let text = "there are no equations besides circle relations; give at least one";
    Err(mistake(Part::Equations, ErrorKind::MissingKey, text))
}

fn check_names(
    expression: &Expression,
    part: Part,
    context: &str,
    known: impl Fn(&str) -> bool,
    allowed: &str,
) -> Checked {
    match expression.names().into_iter().find(|name| !known(name)) {
        None => Ok(()),
        Some(name) => {
            let text = format!("{context}: `{name}` is not declared as {allowed}; declare it or correct its spelling");
            Err(mistake(part, ErrorKind::UnknownName, text))
        }
    }
}

fn check_size(expression: &Expression, part: Part, context: &str) -> Checked {
    let degree = expression.degree_bound();
    if degree > MAX_DEGREE {
        let text = format!("{context}: its degree may be {degree}; at most {MAX_DEGREE} is allowed: lower its powers");
        return Err(mistake(part, ErrorKind::Overflow, text));
    }
    let bound = expression.expansion_bound();
    if bound.terms <= MAX_TERMS && bound.bits <= MAX_BITS {
        return Ok(());
    }
    let text = format!(
        "{context}: its expansion may take more than {MAX_TERMS:.0} terms or {MAX_BITS:.0} bits in a coefficient; \
         lower its powers"
    );
    Err(mistake(part, ErrorKind::Overflow, text))
}

fn check_divisors(expression: &Expression, part: Part, context: &str, unknowns: &[&str]) -> Checked {
    let mut found = None;
    expression.visit(&mut |node| {
        if let Expression::Inverse(divisor) = node {
            found = found.or_else(|| divisor.names().into_iter().find(|name| unknowns.contains(name)));
        }
    });
    match found {
        None => Ok(()),
        Some(name) => {
            let text = format!("{context}: it divides by the unknown `{name}`; multiply it out");
            Err(mistake(part, ErrorKind::BadValue, text))
        }
    }
}

fn check_choice(parts: &SystemParts, unknowns: &[&str]) -> Checked {
    match &parts.choice {
        Some(choice) if !unknowns.contains(&choice.unknown.as_str()) => {
            let text = format!("choice: `{}` is not an unknown; give one of {}", choice.unknown, unknowns.join(", "));
            Err(mistake(Part::Choice, ErrorKind::UnknownName, text))
        }
        _ => Ok(()),
    }
}
