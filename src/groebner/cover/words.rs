//! A cover told to a person: where each stratum is, how many solutions it has, its basis.

use std::fmt;

use super::{Cover, Element, Kind, RealPoints, Region, Stratum};
use crate::number::{Field, Ring, Style};
use crate::poly::Polynomial;

impl<F: Field> fmt::Display for Cover<F> {
    /// A line that says what is counted, then each stratum with its number, its basis indented below.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parameters = self.ring.field().ring().variables().join(", ");
        let strata = count(self.strata.len(), "stratum", "strata");
        writeln!(f, "parameters {parameters}: {strata}; solutions are complex and counted with multiplicity")?;
        for (index, stratum) in self.strata.iter().enumerate() {
            write!(f, "{}. {}", index + 1, self.tell(stratum))?;
        }
        Ok(())
    }
}

impl<F: Field> Cover<F> {
    /// `stratum`, one of this cover's, in words: a line that says where it is and what happens there, its basis below.
    pub fn tell(&self, stratum: &Stratum<F>) -> String {
        let place = self.place(&stratum.region);
        let mut text = format!("{place}: {}{}\n", self.kind(stratum), real(&stratum.real));
        if stratum.kind != Kind::Inconsistent {
            for element in &stratum.basis {
                text.push_str(&format!("     {}\n", self.element(element)));
            }
        }
        text
    }

    /// A region in words: `where pz = 0 and px != 0`.
    pub fn place(&self, region: &Region<F::Element>) -> String {
        let zeros = region.equations.iter().map(|f| format!("{} = 0", self.parameter_text(f)));
        let exclusions = region.exclusions.iter().map(|exclusion| self.exclusion(region, exclusion));
        let conditions: Vec<String> = zeros.chain(exclusions).collect();
        if conditions.is_empty() { "everywhere".to_owned() } else { format!("where {}", conditions.join(" and ")) }
    }

    /// What an exclusion adds to the equations of its region.
    fn exclusion(&self, region: &Region<F::Element>, exclusion: &[Polynomial<F::Element>]) -> String {
        let new = exclusion.iter().filter(|f| !region.equations.contains(f));
        let texts: Vec<String> = new.map(|f| self.parameter_text(f)).collect();
        match texts.as_slice() {
            [single] => format!("{single} != 0"),
            _ => format!("({} are not all 0)", texts.join(", ")),
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

    fn parameter_text(&self, f: &Polynomial<F::Element>) -> String {
        self.ring.field().ring().format(f, Style::Decimal)
    }
}

fn real(verdict: &RealPoints) -> String {
    match verdict {
        RealPoints::None(reason) => format!("; no real point: {reason}"),
        _ => String::new(),
    }
}

/// `two solutions`.
fn count(number: usize, one: &str, many: &str) -> String {
    const WORDS: [&str; 13] =
        ["no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve"];
    let amount = WORDS.get(number).map_or_else(|| number.to_string(), |&word| word.to_owned());
    format!("{amount} {}", if number == 1 { one } else { many })
}
