//! Text of a cover: for each stratum its region, its number of solutions and its basis.

use std::fmt;

use super::{Cover, Element, Kind, RealPoints, Region, Stratum};
use crate::number::{Field, Rationals, Ring, Style};
use crate::poly::Polynomial;

impl<F: Field> fmt::Display for Cover<F> {
    /// Writes a line with the numbers of strata, then each stratum with its number and its indented basis.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parameters = self.ring.field().ring().variables().join(", ");
        let strata = count(self.strata.len(), "stratum", "strata");
        writeln!(f, "parameters {parameters}: {strata}; solutions are complex and counted with multiplicity")?;
        for (index, stratum) in self.strata.iter().enumerate() {
            write!(f, "{}. {}", index + 1, self.describe(stratum))?;
        }
        Ok(())
    }
}

impl<F: Field> Cover<F> {
    /// Describes a stratum of this cover: one line with its region and its solutions, then its basis.
    pub(crate) fn describe(&self, stratum: &Stratum<F>) -> String {
        let place = self.place(&stratum.parts, &stratum.region);
        let mut text = format!("{place}: {}{}\n", self.kind(stratum), self.real(&stratum.real));
        if stratum.kind != Kind::Inconsistent {
            for element in &stratum.basis {
                text.push_str(&format!("     {}\n", self.element(element)));
            }
        }
        text
    }

    /// Text of a region such as `where pz = 0 and px != 0`. A closed set of several parts is described part by part.
    fn place(&self, parts: &[Vec<Polynomial<F::Element>>], region: &Region<F::Element>) -> String {
        let all: Vec<String> = parts.iter().map(|part| self.zeros(part)).filter(|text| !text.is_empty()).collect();
        let zeros = match all.as_slice() {
            [] => None,
            [single] => Some(single.clone()),
            _ => Some(format!("({})", all.join(" or "))),
        };
        let exclusions = region.exclusions.iter().map(|exclusion| self.exclusion(exclusion));
        let conditions: Vec<String> = zeros.into_iter().chain(exclusions).collect();
        if conditions.is_empty() { "everywhere".to_owned() } else { format!("where {}", conditions.join(" and ")) }
    }

    /// Describes a region: `where pz = 0 and px != 0`.
    pub(crate) fn describe_region(&self, region: &Region<F::Element>) -> String {
        self.place(std::slice::from_ref(&region.equations), region)
    }

    fn zeros(&self, equations: &[Polynomial<F::Element>]) -> String {
        let zeros: Vec<_> = equations.iter().map(|f| format!("{} = 0", self.parameter_text(f))).collect();
        zeros.join(" and ")
    }

    fn exclusion(&self, exclusion: &[Polynomial<F::Element>]) -> String {
        match exclusion {
            [single] => format!("{} != 0", self.parameter_text(single)),
            _ => format!("not ({})", self.zeros(exclusion)),
        }
    }

    fn kind(&self, stratum: &Stratum<F>) -> String {
        match stratum.kind {
            Kind::Inconsistent => "no solution".to_owned(),
            Kind::Finite(number) => count(number, "solution", "solutions"),
            Kind::Family(dimension) => {
                format!("infinitely many solutions, a family of dimension {dimension}")
            }
        }
    }

    fn element(&self, element: &Element<F>) -> String {
        let texts: Vec<_> = element.representatives.iter().map(|f| self.ring.format(f, Style::Decimal)).collect();
        texts.join("   or, where its leading coefficient is zero,   ")
    }

    fn real(&self, verdict: &RealPoints) -> String {
        match verdict {
            RealPoints::None(reason) => format!("; no real point: {reason}"),
            RealPoints::At(point) => {
                let names = self.ring.field().ring().variables();
                let values =
                    names.iter().zip(point).map(|(name, q)| format!("{name} = {}", Rationals.format(q, Style::Text)));
                format!("; for instance at {}", values.collect::<Vec<_>>().join(", "))
            }
            RealPoints::Some(reason) => format!("; real points: {reason}"),
            RealPoints::Unknown => String::new(),
        }
    }

    fn parameter_text(&self, f: &Polynomial<F::Element>) -> String {
        self.ring.field().ring().format(f, Style::Decimal)
    }
}

/// `two solutions`.
fn count(number: usize, one: &str, many: &str) -> String {
    const WORDS: [&str; 13] =
        ["no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve"];
    let amount = WORDS.get(number).map_or_else(|| number.to_string(), |&word| word.to_owned());
    format!("{amount} {}", if number == 1 { one } else { many })
}
