//! Reader of `system.toml`: polynomial equations in a hand-written form.
//!
//! ```
//! let arm = groebot_ik::derive::System::from_toml(r#"
//! name = "nao_arm_planar"
//! description = "NAO's arm with two joints in a plane"   # optional
//! source = "NAO (6.7.1)-(6.7.4)"                         # optional
//! length_unit = "mm"                                     # "m" (default) or "mm"
//! order = ["c4", "c2", "s4", "s2"]                       # optional; greatest first
//!
//! [constants]                                            # exact; replaced by their values
//! L1 = 105
//! L2 = "55.95 + 57.75"                                   # an expression in earlier constants
//!
//! [[parameter]]                                          # what the user gives, in this order
//! name = "py"
//! quantity = "length"                                    # "length" (default), "angle" or "number"
//! positive = false                                       # default; true: the solver may assume > 0
//!
//! [[parameter]]
//! name = "pz"
//!
//! [[joint]]                                              # an angle by its cosine and sine ...
//! name = "q2"
//! cosine = "c2"
//! sine = "s2"
//!
//! [[joint]]                                              # (... or a length or number: unknown = "d1")
//! name = "q4"
//! cosine = "c4"
//! sine = "s4"
//!
//! [[equation]]                                           # or equations = ["...", "..."] at the top
//! label = "(6.7.1)"                                      # optional
//! equation = "L1*c2 + L2*s4 - pz = 0"
//!
//! [[equation]]
//! label = "(6.7.2)"
//! equation = "L1*s2 + L2*c4 - py = 0"
//!
//! [choice]                                               # optional: the root that the source takes
//! unknown = "s2"
//! root = "minus"                                         # "minus" or "plus"
//! "#)?;
//! assert_eq!(arm.equations[0].expression.to_string(), "105*c2 + 113.7*s4 - pz");
//! assert_eq!(arm.equations[3].expression.to_string(), "c4^2 + s4^2 - 1");
//! # Ok::<(), groebot_ik::Error>(())
//! ```
//!
//! * Expressions follow [`groebot_algebra::poly::parse`]; an equation is `a = b`, or `a` for `a = 0`.
//! * The circle relation of every angle is added when the equations do not contain it.
//! * The default order is that of [`SystemParts::default_order`].
//! * A constant is a number, an expression in constants above it, or `{ square = "1/2" }`: the positive square root of
//!   such an expression. An irrational root remains a name in the equations: a [`Parameter`] with its square.
//! * A parameter with `quantity = "angle"` needs `cosine = "cphi"` and `sine = "sphi"`, the names that the equations use.
//!   They enter as two parameters, related by `sphi^2 = 1 - cphi^2`.

use std::collections::HashMap;

use crate::derive::problem::check::{Mistake, Part};
use crate::derive::problem::constants::Constants;
use crate::derive::problem::system::System;
use crate::derive::problem::system_parts::{
    Equation, Input, JointKindUnknown, JointUnknown, Parameter, ParameterSource, Quantity, SystemParts,
};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::poly::parse_equation;
use groebot_robot::document::{Document, Node, Table};
use groebot_robot::kinematics::{Choice, LengthUnit, Root};

const KEYS: [&str; 11] = [
    "name",
    "description",
    "source",
    "length_unit",
    "order",
    "constants",
    "parameter",
    "joint",
    "equation",
    "equations",
    "choice",
];

impl System {
    /// Reads the text of a `system.toml`.
    ///
    /// # Errors
    /// All have a line: those of [`Document::parse`] and [`System::new`], [`ErrorKind::UnknownKey`], [`ErrorKind::MissingKey`]. [`ErrorKind::BadValue`] for a
    /// value of the wrong type. [`ErrorKind::Syntax`] with the column for an expression that cannot be parsed.
    pub fn from_toml(text: &str) -> Result<Self> {
        let document = Document::parse(text)?;
        let root = document.root();
        root.deny_unknown(&KEYS)?;
        let mut reader = Reader::default();
        reader.head(&root)?;
        reader.constants(&root)?;
        reader.parameters(&root)?;
        reader.joints(&root)?;
        reader.order(&root)?;
        reader.equations(&root)?;
        reader.choice(&root)?;
        let lines = reader.lines;
        System::build(reader.parts).map_err(|Mistake { part, error }| error.at_line(*lines.get(&part).unwrap_or(&1)))
    }
}

/// The parts that are read so far, and the line of each.
#[derive(Default)]
struct Reader {
    parts: SystemParts,
    lines: HashMap<Part, usize>,
    constants: Constants,
}

impl Reader {
    fn head(&mut self, root: &Table<'_>) -> Result<()> {
        let name = root.required("name")?;
        self.lines.insert(Part::Name, name.line());
        self.parts.name = name.text()?.to_owned();
        self.parts.description = optional_text(root, "description")?;
        self.parts.source = optional_text(root, "source")?;
        if let Some(node) = root.optional("length_unit") {
            self.parts.length_unit = node.one_of(&[("m", LengthUnit::Metre), ("mm", LengthUnit::Millimetre)])?;
        }
        Ok(())
    }

    fn constants(&mut self, root: &Table<'_>) -> Result<()> {
        let Some(node) = root.optional("constants") else { return Ok(()) };
        for constant in node.table()?.entries() {
            self.constants.read(&constant)?;
        }
        for (root, line) in std::mem::take(&mut self.constants.roots) {
            self.push_parameter(root, line);
        }
        Ok(())
    }

    fn push_parameter(&mut self, parameter: Parameter, line: usize) {
        self.lines.insert(Part::Parameter(self.parts.parameters.len()), line);
        self.parts.parameters.push(parameter);
    }

    fn parameters(&mut self, root: &Table<'_>) -> Result<()> {
        for table in optional_tables(root, "parameter")? {
            self.parameter(&table)?;
        }
        Ok(())
    }

    fn parameter(&mut self, table: &Table<'_>) -> Result<()> {
        table.deny_unknown(&["name", "quantity", "positive", "cosine", "sine"])?;
        let name = self.new_name(&table.required("name")?)?;
        let quantities = [("length", Quantity::Length), ("angle", Quantity::Angle), ("number", Quantity::Number)];
        let quantity = table.optional("quantity").map_or(Ok(Quantity::Length), |node| node.one_of(&quantities))?;
        let positive = table.optional("positive").map_or(Ok(false), |node| node.boolean())?;
        let index = self.parts.inputs.len();
        self.lines.insert(Part::Input(index), table.line());
        if quantity == Quantity::Angle {
            for (key, source) in [("cosine", ParameterSource::Cosine(index)), ("sine", ParameterSource::Sine(index))] {
                let node = table.required(key)?;
                let name = self.new_name(&node)?;
                self.push_parameter(Parameter { name, source, square: None }, node.line());
            }
        } else {
            if let Some(node) = table.optional("cosine").or(table.optional("sine")) {
                let text = "only an angle has it; remove it or give quantity = \"angle\"";
                return Err(node.error(ErrorKind::BadValue, text));
            }
            let source = ParameterSource::Input(index);
            self.push_parameter(Parameter { name: name.clone(), source, square: None }, table.line());
        }
        self.parts.inputs.push(Input { name, quantity, positive });
        Ok(())
    }

    /// The text of `node`, if it is not the name of a constant.
    fn new_name(&self, node: &Node<'_>) -> Result<String> {
        let name = node.text()?;
        if self.constants.has(name) {
            let text = format!("`{name}` is a constant already; give one of them another name");
            return Err(node.error(ErrorKind::DuplicateName, text));
        }
        Ok(name.to_owned())
    }

    fn joints(&mut self, root: &Table<'_>) -> Result<()> {
        for (i, table) in root.required("joint")?.tables()?.iter().enumerate() {
            self.lines.insert(Part::Joint(i), table.line());
            table.deny_unknown(&["name", "cosine", "sine", "unknown"])?;
            let name = self.new_name(&table.required("name")?)?;
            let unknown = |key| table.optional(key).map(|node| self.new_name(&node)).transpose();
            let kind = match (unknown("cosine")?, unknown("sine")?, unknown("unknown")?) {
                (Some(cosine), Some(sine), None) => JointKindUnknown::Angle { cosine, sine },
                (None, None, Some(unknown)) => JointKindUnknown::Value { unknown },
                (cosine, sine, unknown) => return Err(unclear_joint(table, [cosine, sine, unknown])),
            };
            self.parts.joints.push(JointUnknown { name, kind });
        }
        Ok(())
    }

    fn order(&mut self, root: &Table<'_>) -> Result<()> {
        self.parts.order = match root.optional("order") {
            None => self.parts.default_order(),
            Some(node) => {
                self.lines.insert(Part::Order, node.line());
                node.texts()?.into_iter().map(str::to_owned).collect()
            }
        };
        Ok(())
    }

    fn equations(&mut self, root: &Table<'_>) -> Result<()> {
        let (tables, list) = (root.optional("equation"), root.optional("equations"));
        if let (Some(_), Some(list)) = (&tables, &list) {
            let text = "the file has `equation` too; use one of the two";
            return Err(list.error(ErrorKind::DuplicateName, text));
        }
        if let Some(node) = tables.or(list) {
            self.lines.insert(Part::Equations, node.line());
        }
        for table in optional_tables(root, "equation")? {
            table.deny_unknown(&["label", "equation"])?;
            self.equation(optional_text(&table, "label")?, &table.required("equation")?)?;
        }
        for node in list.map_or(Ok(Vec::new()), |node| node.array())? {
            self.equation(String::new(), &node)?;
        }
        Ok(())
    }

    fn equation(&mut self, label: String, node: &Node<'_>) -> Result<()> {
        let written = parse_equation(node.text()?).map_err(|error| node.place(error))?;
        let expression = self.constants.apply(written).map_err(|error| node.place(error))?;
        self.lines.insert(Part::Equation(self.parts.equations.len()), node.line());
        self.parts.equations.push(Equation { label, expression });
        Ok(())
    }

    fn choice(&mut self, root: &Table<'_>) -> Result<()> {
        let Some(node) = root.optional("choice") else { return Ok(()) };
        let table = node.table()?;
        table.deny_unknown(&["unknown", "root"])?;
        let unknown = table.required("unknown")?;
        self.lines.insert(Part::Choice, unknown.line());
        let root = table.required("root")?.one_of(&[("minus", Root::Minus), ("plus", Root::Plus)])?;
        self.parts.choice = Some(Choice { unknown: unknown.text()?.to_owned(), root });
        Ok(())
    }
}

/// The error for a joint whose keys define neither an angle nor a value.
fn unclear_joint(table: &Table<'_>, given: [Option<String>; 3]) -> Error {
    let excess = given[2].is_some();
    let kind = if excess { ErrorKind::BadValue } else { ErrorKind::MissingKey };
    let found = if excess { "both an angle and an unknown" } else { "no complete pair of cosine and sine" };
    table.error(kind, format!("the joint has {found}; give `cosine` and `sine`, or `unknown`"))
}

fn optional_text(table: &Table<'_>, key: &str) -> Result<String> {
    table.optional(key).map_or(Ok(String::new()), |node| Ok(node.text()?.to_owned()))
}

fn optional_tables<'d>(root: &Table<'d>, key: &str) -> Result<Vec<Table<'d>>> {
    root.optional(key).map_or(Ok(Vec::new()), |node| node.tables())
}
