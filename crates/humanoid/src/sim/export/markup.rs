//! Nodes and their fields in XML and in VRML. Main type: [`Markup`].

use std::fmt::Write;

/// Decimals of a number.
const DECIMALS: f64 = 1e10;

/// The greatest depth that is indented.
const DEEPEST: usize = 40;

/// The language of the scene.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Dialect {
    /// X3D 4.0 in XML.
    X3d,
    /// VRML97.
    Vrml,
}

/// The value of a field.
pub enum Field<'f> {
    /// One number or several of one value.
    Numbers(&'f [f64]),
    /// A list of these.
    Rows(&'f [Vec<f64>]),
    /// Corners of triangles.
    Triangles(&'f [[u32; 3]]),
    /// Yes or no.
    Flag(bool),
    /// Text without special characters.
    Text(&'f str),
    /// A list of words.
    Words(&'f [&'f str]),
}

/// The text of nodes, built step by step.
pub struct Markup {
    dialect: Dialect,
    text: String,
    depth: usize,
}

impl Markup {
    /// Starts the text with the header.
    pub fn begin(dialect: Dialect) -> Self {
        let text = match dialect {
            Dialect::X3d => {
                "<?xml version='1.0' encoding='UTF-8'?>\n<X3D profile='Interchange' version='4.0' xmlns:xsd='http://www.w3.org/2001/XMLSchema-instance' xsd:noNamespaceSchemaLocation='https://www.web3d.org/specifications/x3d-4.0.xsd'>\n<Scene>\n"
            }
            Dialect::Vrml => "#VRML V2.0 utf8\n",
        };
        Markup { dialect, text: text.to_owned(), depth: 0 }
    }

    /// The whole text.
    pub fn end(mut self) -> String {
        if self.dialect == Dialect::X3d {
            self.text.push_str("</Scene>\n</X3D>\n");
        }
        self.text
    }

    /// Writes a node without inner nodes, in the field `role` of its parent node; an empty `role` is for children and
    /// roots. An empty `name` is no name.
    pub fn leaf(&mut self, role: &str, kind: &str, name: &str, fields: &[(&str, Field<'_>)]) {
        self.head(role, kind, name, fields);
        self.text.push_str(if self.dialect == Dialect::X3d { "/>\n" } else { " }\n" });
    }

    /// Writes a node; `inside` writes the nodes in its fields.
    pub fn node(&mut self, role: &str, kind: &str, fields: &[(&str, Field<'_>)], inside: impl FnOnce(&mut Self)) {
        self.head(role, kind, "", fields);
        self.text.push_str(if self.dialect == Dialect::X3d { ">\n" } else { "\n" });
        self.depth += 1;
        inside(self);
        self.depth -= 1;
        self.indent();
        match self.dialect {
            Dialect::X3d => self.put(format_args!("</{kind}>\n")),
            Dialect::Vrml => self.text.push_str("}\n"),
        }
    }

    /// Begins a `Transform`; the next nodes are its children.
    pub fn open(&mut self, name: &str, fields: &[(&str, Field<'_>)]) {
        self.head("", "Transform", name, fields);
        self.text.push_str(if self.dialect == Dialect::X3d { ">\n" } else { " children [\n" });
        self.depth += 1;
    }

    /// Ends a `Transform`.
    pub fn close(&mut self) {
        self.depth -= 1;
        self.indent();
        self.text.push_str(if self.dialect == Dialect::X3d { "</Transform>\n" } else { "] }\n" });
    }

    /// Routes an event from one node to a field of another.
    pub fn route(&mut self, from: [&str; 2], to: [&str; 2]) {
        let ([node, field], [target, taken]) = (from, to);
        match self.dialect {
            Dialect::X3d => self.put(format_args!(
                "<ROUTE fromNode='{node}' fromField='{field}' toNode='{target}' toField='{taken}'/>\n"
            )),
            Dialect::Vrml => self.put(format_args!("ROUTE {node}.{field} TO {target}.{taken}\n")),
        }
    }

    /// Writes a node up to the last of its plain fields.
    fn head(&mut self, role: &str, kind: &str, name: &str, fields: &[(&str, Field<'_>)]) {
        self.indent();
        match self.dialect {
            Dialect::X3d if name.is_empty() => self.put(format_args!("<{kind}")),
            Dialect::X3d => self.put(format_args!("<{kind} DEF='{name}'")),
            Dialect::Vrml => {
                let role = if role.is_empty() { String::new() } else { format!("{role} ") };
                let name = if name.is_empty() { String::new() } else { format!("DEF {name} ") };
                self.put(format_args!("{role}{name}{kind} {{"));
            }
        }
        for (field, value) in fields {
            match self.dialect {
                Dialect::X3d => self.put(format_args!(" {field}='{}'", value.in_xml())),
                Dialect::Vrml => self.put(format_args!(" {field} {}", value.in_vrml())),
            }
        }
    }

    fn indent(&mut self) {
        self.put(format_args!("{:1$}", "", 2 * self.depth.min(DEEPEST)));
    }

    fn put(&mut self, text: std::fmt::Arguments<'_>) {
        // Writing to a string cannot fail.
        let _ = self.text.write_fmt(text);
    }
}

impl Field<'_> {
    fn in_xml(&self) -> String {
        match self {
            Field::Numbers(numbers) => formatted(numbers),
            Field::Rows(rows) => joined(rows.iter().map(|row| formatted(row)), " "),
            Field::Triangles(triangles) => joined(triangles.iter().map(|[a, b, c]| format!("{a} {b} {c} -1")), " "),
            Field::Flag(is) => is.to_string(),
            Field::Text(text) => text.replace('&', "&amp;").replace('<', "&lt;").replace('\'', "&apos;"),
            Field::Words(words) => joined(words.iter().map(|word| format!("\"{word}\"")), " "),
        }
    }

    fn in_vrml(&self) -> String {
        match self {
            Field::Numbers(_) => self.in_xml(),
            Field::Flag(is) => is.to_string().to_uppercase(),
            Field::Text(text) => format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\"")),
            Field::Rows(_) | Field::Triangles(_) | Field::Words(_) => format!("[ {} ]", self.in_xml()),
        }
    }
}

fn formatted(numbers: &[f64]) -> String {
    joined(numbers.iter().map(|x| number(*x)), " ")
}

fn joined(parts: impl Iterator<Item = String>, between: &str) -> String {
    parts.collect::<Vec<_>>().join(between)
}

/// A number with up to ten decimals.
fn number(x: f64) -> String {
    let scaled = (x * DECIMALS).round();
    // No negative zero; a number too large for ten decimals is unchanged.
    if scaled.is_finite() { (scaled / DECIMALS + 0.0).to_string() } else { x.to_string() }
}
