//! Printing of systems and bases in the formats of the readers, so that Singular and msolve can read them too.

use super::{Format, Heading, PolynomialSystem};
use crate::number::{Field, Rationals, Ring, Style, Zp};
use crate::poly::{Block, Fractions, Order, Polynomial, PolynomialRing};
use crate::{Error, ErrorKind, Result, Watch};

impl PolynomialSystem {
    /// Prints the system with expanded polynomials.
    ///
    /// # Errors
    /// Those of [`PolynomialSystem::expand`] and [`Heading::print`].
    pub fn print(&self, format: Format) -> Result<String> {
        let parameters = &self.heading.parameters;
        match (self.heading.characteristic, parameters.is_empty()) {
            (0, true) => self.print_over(Rationals, format),
            (0, false) => self.print_over(Fractions::new(Rationals, parameters)?, format),
            (p, true) => self.print_over(Zp::new(p)?, format),
            (p, false) => self.print_over(Fractions::new(Zp::new(p)?, parameters)?, format),
        }
    }

    fn print_over<F: Field>(&self, field: F, format: Format) -> Result<String> {
        let ring = self.heading.ring(field)?;
        self.heading.print(format, &ring, &self.expand(&ring, &Watch::none())?)
    }
}

impl Heading {
    /// Prints `polynomials` of `ring` after this heading, which describes `ring`. An empty list is printed as the zero
    /// polynomial. msolve's format cannot express the order.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for parameters in msolve's format, and for a name that begins with `_` in Singular's.
    pub fn print<F: Field>(
        &self,
        format: Format,
        ring: &PolynomialRing<F>,
        polynomials: &[Polynomial<F::Element>],
    ) -> Result<String> {
        let mut lines: Vec<String> = polynomials.iter().map(|f| ring.format(f, Style::Text)).collect();
        if lines.is_empty() {
            lines.push("0".to_owned());
        }
        match format {
            Format::Plain => Ok(self.plain(&lines)),
            Format::Singular => self.singular(&lines),
            Format::Msolve => self.msolve(&lines),
        }
    }

    fn plain(&self, lines: &[String]) -> String {
        let mut text = format!("variables: {}\n", self.variables.join(", "));
        if !self.parameters.is_empty() {
            text += &format!("parameters: {}\n", self.parameters.join(", "));
        }
        if self.characteristic > 0 {
            text += &format!("characteristic: {}\n", self.characteristic);
        }
        text += &format!("order: {}\n\n", self.order);
        text + &lines.join("\n") + "\n"
    }

    fn singular(&self, lines: &[String]) -> Result<String> {
        if let Some(name) = self.variables.iter().chain(&self.parameters).find(|name| name.starts_with('_')) {
            let text =
                format!("Singular does not allow names that start with `_`; rename `{name}`, or use another format");
            return Err(Error::new(ErrorKind::Unsupported, text));
        }
        let field = match self.parameters.as_slice() {
            [] => self.characteristic.to_string(),
            parameters => format!("({},{})", self.characteristic, parameters.join(",")),
        };
        let (ring, ideal) = (self.fresh("R"), self.fresh("I"));
        let variables = self.variables.join(",");
        let order = singular_order(&self.order);
        Ok(format!("ring {ring} = {field},({variables}),{order};\nideal {ideal} =\n{};\n", lines.join(",\n")))
    }

    /// A name that is neither a variable nor a parameter.
    fn fresh(&self, start: &str) -> String {
        let mut name = start.to_owned();
        while self.variables.contains(&name) || self.parameters.contains(&name) {
            name.push('_');
        }
        name
    }

    fn msolve(&self, lines: &[String]) -> Result<String> {
        if !self.parameters.is_empty() {
            let text = "msolve's format has no parameters; choose plain or singular";
            return Err(Error::new(ErrorKind::Unsupported, text));
        }
        Ok(format!("{}\n{}\n{}\n", self.variables.join(", "), self.characteristic, lines.join(",\n")))
    }
}

fn singular_order(order: &Order) -> String {
    match order {
        Order::Lex => "lp".to_owned(),
        Order::GrevLex => "dp".to_owned(),
        Order::Block(blocks) => {
            let name = |block: &Block| format!("{}({})", if block.graded { "dp" } else { "lp" }, block.size);
            format!("({})", blocks.iter().map(name).collect::<Vec<_>>().join(","))
        }
    }
}
