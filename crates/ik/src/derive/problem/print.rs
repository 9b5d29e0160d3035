//! A system as numbered text: the stage file `1_equations.txt`.

use std::fmt::{self, Display, Formatter};

use groebot_robot::kinematics::Root;

use crate::derive::problem::system::System;
use crate::derive::problem::system_parts::{
    Input, JointKindUnknown, JointUnknown, Parameter, ParameterSource, Quantity,
};

impl Display for Input {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let quantity = match self.quantity {
            Quantity::Length => "length",
            Quantity::Angle => "angle",
            Quantity::Number => "number",
        };
        write!(f, "{}: {quantity}{}", self.name, if self.positive { " > 0" } else { "" })
    }
}

impl Display for JointUnknown {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.kind {
            JointKindUnknown::Angle { cosine, sine } => {
                write!(f, "{name}: {cosine} = cos({name}), {sine} = sin({name})", name = self.name)
            }
            JointKindUnknown::Value { unknown } => write!(f, "{}: {unknown}", self.name),
        }
    }
}

fn write_parameter(f: &mut Formatter<'_>, parameter: &Parameter, inputs: &[Input]) -> fmt::Result {
    let input = |i: usize| inputs[i].name.as_str();
    match parameter.source {
        ParameterSource::Input(i) => write!(f, "{} = input {}", parameter.name, input(i))?,
        ParameterSource::Cosine(i) => write!(f, "{} = cos({})", parameter.name, input(i))?,
        ParameterSource::Sine(i) => write!(f, "{} = sin({})", parameter.name, input(i))?,
        ParameterSource::SquareRoot => write!(f, "{} > 0", parameter.name)?,
    }
    match &parameter.square {
        Some(square) => write!(f, ", {}^2 = {square}", parameter.name),
        None => Ok(()),
    }
}

/// Writes a heading and numbered lines under it.
fn write_list<T>(
    f: &mut Formatter<'_>,
    heading: &str,
    items: &[T],
    line: impl Fn(&mut Formatter<'_>, &T) -> fmt::Result,
) -> fmt::Result {
    writeln!(f, "\n{heading}")?;
    for (i, item) in items.iter().enumerate() {
        write!(f, "{:>4}. ", i + 1)?;
        line(f, item)?;
        writeln!(f)?;
    }
    if items.is_empty() { writeln!(f, "      none") } else { Ok(()) }
}

impl Display for System {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.name)?;
        for text in [&self.description, &self.source] {
            if !text.is_empty() {
                writeln!(f, "{text}")?;
            }
        }
        writeln!(f, "lengths in {}, angles in rad", self.length_unit.symbol())?;
        write_list(f, "inputs", &self.inputs, |f, input| write!(f, "{input}"))?;
        write_list(f, "parameters", &self.parameters, |f, parameter| write_parameter(f, parameter, &self.inputs))?;
        write_list(f, "joints", &self.joints, |f, joint| write!(f, "{joint}"))?;
        writeln!(f, "\nunknowns, greatest first\n      {}", self.order.join(" > "))?;
        write_list(f, "equations", &self.equations, |f, equation| {
            let space = if equation.label.is_empty() { "" } else { "  " };
            write!(f, "{}{space}{} = 0", equation.label, equation.expression)
        })?;
        match &self.choice {
            Some(choice) => writeln!(
                f,
                "\nchoice of root\n      {}: {}",
                choice.unknown,
                if choice.root == Root::Minus { "minus" } else { "plus" }
            ),
            None => Ok(()),
        }
    }
}
