//! Certificate of generated equations of motion, and its proof. Main type: [`Certificate`].

use std::collections::HashMap;
use std::fmt;

use num_traits::{One, Zero};
use serde::{Deserialize, Serialize};

use super::base_parameters::BaseParameters;
use super::lagrange::inertia_and_potential;
use super::model::{ExactModel, Masses};
use super::number::Exact;
use super::symbolic::{MOST_TERMS, Symbolic, christoffel, dependent};
use crate::document::{self, Proves};
use crate::dynamics::recursions::Scalar;
use crate::kinematics::Chain;
use crate::spatial::exact::ExactVector;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::{BigRational, parse_rational};
use groebot_algebra::poly::parse_long;

/// The claim that the generated equations of motion are those of this chain under this gravity.
#[derive(Clone, Debug, PartialEq)]
pub struct Certificate {
    /// The chain.
    name: String,
    claims: Claims,
}

/// The claims about a chain.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Claims {
    /// Gravity in the base frame, as given.
    gravity: [String; 3],
    /// For each body its ten inertial parameters; `None` when they are symbols.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    masses: Option<Vec<[String; 10]>>,
    /// Number of terms of M, C and N.
    terms: usize,
}

/// Result of a proof.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Proof {
    /// Number of joints.
    pub joints: usize,
    /// Number of terms of M, C and N.
    pub terms: usize,
    /// Number of base parameters, if the text has them.
    pub base_parameters: Option<usize>,
}

impl fmt::Display for Proof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Proof { joints, terms, base_parameters } = self;
        write!(
            f,
            "{terms} terms of {joints} joints proved again: M is the sum of J' mu J and symmetric, C is Christoffel's, M' - 2 C is skew, N = dV/dq"
        )?;
        base_parameters.map_or(Ok(()), |count| write!(f, "; {count} base parameters, no fewer"))
    }
}

impl Certificate {
    /// Builds the certificate of a chain's equations of motion.
    #[doc(hidden)]
    pub fn new(symbolic: &Symbolic, chain: &Chain, masses: Masses<'_>, gravity: &ExactVector) -> Self {
        let texts = |numbers: &[BigRational; 10]| numbers.each_ref().map(ToString::to_string);
        let claims = Claims {
            gravity: gravity.each_ref().map(ToString::to_string),
            masses: match masses {
                Masses::Symbols => None,
                Masses::Numbers(all) => Some(all.iter().map(texts).collect()),
            },
            terms: symbolic.terms(),
        };
        Certificate { name: chain.name().to_owned(), claims }
    }

    /// Whether the inertial parameters are numbers.
    #[doc(hidden)]
    pub fn has_numbers(&self) -> bool {
        self.claims.masses.is_some()
    }

    /// Whether the inertial parameters are equal to `masses`.
    #[doc(hidden)]
    pub fn has(&self, masses: &[[BigRational; 10]]) -> bool {
        let texts = |numbers: &[BigRational; 10]| numbers.each_ref().map(ToString::to_string);
        self.claims.masses.as_ref().is_some_and(|own| own.iter().eq(&masses.iter().map(texts).collect::<Vec<_>>()))
    }

    /// Converts the certificate to JSON.
    pub fn to_json(&self) -> String {
        document::Certificate::new(Proves::Dynamics, &self.name, self.claims.clone()).to_json()
    }

    /// Reads the certificate of the equations of motion of the chain `name`.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] for text that is not a certificate, [`ErrorKind::Unsupported`] for another format,
    /// [`ErrorKind::Certificate`] for the certificate of something else.
    pub fn from_json(text: &str, name: &str) -> Result<Self> {
        let claims = document::Certificate::read(text, Proves::Dynamics, name)?;
        Ok(Certificate { name: name.to_owned(), claims })
    }

    /// Proves that the equations in `text`, as printed by [`Symbolic::to_text`], are those of a chain. The inertia
    /// matrix and the potential energy are computed from Jacobians and heights, independently of the recursions that
    /// produced them. The other entries follow by differentiation. The legend and the notation of the entries are
    /// compared too.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] with the entry that is wrong, [`ErrorKind::Syntax`] for unreadable text,
    /// [`ErrorKind::Certificate`] with the line whose notation differs.
    pub fn prove(&self, chain: &Chain, text: &str) -> Result<Proof> {
        let vector = |words: &[String; 3]| -> Result<ExactVector> {
            let [x, y, z] = words.each_ref().map(|word| parse_rational(word));
            Ok([x?, y?, z?])
        };
        let numbers = |words: &[String; 10]| {
            let numbers: Vec<_> = words.iter().map(|word| parse_rational(word)).collect::<Result<_>>()?;
            Ok(<[_; 10]>::try_from(numbers).expect("as many as words"))
        };
        let masses: Option<Vec<_>> =
            self.claims.masses.as_ref().map(|all| all.iter().map(numbers).collect::<Result<_>>()).transpose()?;
        let fault = |text: String| Err(Error::new(ErrorKind::BadValue, text));
        if self.name != chain.name() {
            return fault(format!("it belongs to `{}`, the chain is `{}`", self.name, chain.name()));
        }
        if masses.as_ref().is_some_and(|all| all.len() != chain.joints().len()) {
            return fault("it does not have ten numbers for each joint".to_owned());
        }
        let masses = masses.as_deref().map_or(Masses::Symbols, Masses::Numbers);
        let gravity = vector(&self.claims.gravity)?;
        if gravity.each_ref().map(ToString::to_string) != self.claims.gravity {
            return fault("its gravity is not written in lowest terms".to_owned());
        }
        let model = ExactModel::new(chain, masses, &gravity, MOST_TERMS)?;
        let entries = ParsedEntries::read(&model, text)?;
        let proof = entries.prove(&model)?;
        if proof.terms != self.claims.terms {
            return fault(format!("it has {} terms; the text has {}", self.claims.terms, proof.terms));
        }
        entries.is_written(model, text)?;
        Ok(proof)
    }
}

/// The parsed entries of the text.
struct ParsedEntries {
    inertia: Vec<Vec<Exact>>,
    coriolis: Vec<Vec<Exact>>,
    gravity: Vec<Exact>,
    potential: Exact,
    base: Option<BaseParameters>,
}

impl ParsedEntries {
    fn read(model: &ExactModel, text: &str) -> Result<Self> {
        let mut entries = HashMap::new();
        for (number, line) in text.lines().enumerate().filter(|(_, line)| !line.starts_with('#')) {
            let syntax = |text: &str| Error::new(ErrorKind::Syntax, text.to_owned()).at_line(number + 1);
            let (name, value) = line.split_once(" = ").ok_or_else(|| syntax("give `NAME = POLYNOMIAL`"))?;
            let value = parse_long(value).and_then(|value| value.evaluate(model.setting.ring()));
            let value = value.map_err(|error| error.at_line(number + 1))?;
            if entries.insert(name.to_owned(), model.setting.number(value)).is_some() {
                return Err(syntax(&format!("`{name}` is given twice")));
            }
        }
        let count = model.joints.len();
        let mut take = |name: String| {
            let missing = || Error::new(ErrorKind::MissingKey, format!("`{name}` is missing"));
            entries.remove(&name).ok_or_else(missing)
        };
        let mut inertia = vec![vec![Exact::zero(); count]; count];
        for (i, j) in (0..count).flat_map(|i| (0..=i).map(move |j| (i, j))) {
            let entry = take(format!("M{}{}", i + 1, j + 1))?;
            inertia[j][i] = entry.clone();
            inertia[i][j] = entry;
        }
        let mut row = |i: usize| (0..count).map(|j| take(format!("C{}{}", i + 1, j + 1))).collect::<Result<Vec<_>>>();
        let coriolis = (0..count).map(&mut row).collect::<Result<_>>()?;
        let gravity = (0..count).map(|i| take(format!("N{}", i + 1))).collect::<Result<_>>()?;
        let potential = take("V".to_owned())?;
        let mut forms = Vec::new();
        while let Ok(form) = take(format!("B{}", forms.len() + 1)) {
            forms.push(form);
        }
        let base =
            (model.has_symbols && !model.setting.has_roots()).then(|| base_parameters(model, &forms)).transpose()?;
        match entries.keys().min() {
            None => Ok(ParsedEntries { inertia, coriolis, gravity, potential, base }),
            Some(name) => Err(Error::new(ErrorKind::UnknownName, format!("`{name}` is not one of M, C, N, V and B"))),
        }
    }

    /// Checks that the proved entries and the legend are written exactly as [`Symbolic::to_text`] writes them.
    fn is_written(self, model: ExactModel, text: &str) -> Result<()> {
        let ParsedEntries { inertia, coriolis, gravity, potential, base } = self;
        let expected = Symbolic { model, inertia, coriolis, gravity, potential, base }.to_text();
        if text == expected {
            return Ok(());
        }
        let same = text.lines().zip(expected.lines()).take_while(|(a, b)| a == b).count();
        let text = "this line differs from the certificate; `groebot dynamics --symbolic` writes the correct one";
        Err(Error::new(ErrorKind::Certificate, text).at_line(same + 1))
    }

    fn prove(&self, model: &ExactModel) -> Result<Proof> {
        let count = model.joints.len();
        let same = |name: String, found: &Exact, expected: &Exact| {
            let text = || format!("`{name}` differs from that of the chain");
            if found == expected { Ok(()) } else { Err(Error::new(ErrorKind::BadValue, text())) }
        };
        let (inertia, potential) = inertia_and_potential(model);
        model.setting.check()?;
        let coriolis = christoffel(model, &self.inertia)?;
        let rate = |joint: usize| model.setting.variable(&model.joints[joint].rate);
        let along = |number: &Exact| {
            let part = |joint: usize| model.setting.derivative(number, &model.changes(joint)) * rate(joint);
            (0..count).map(part).fold(Exact::zero(), |sum, part| sum + part)
        };
        for (i, j) in (0..count).flat_map(|i| (0..count).map(move |j| (i, j))) {
            same(format!("M{}{}", i + 1, j + 1), &self.inertia[i][j], &inertia[i][j])?;
            same(format!("C{}{}", i + 1, j + 1), &self.coriolis[i][j], &coriolis[i][j])?;
            let skew = self.coriolis[i][j].clone() + self.coriolis[j][i].clone();
            same(format!("C{}{}", i + 1, j + 1), &skew, &along(&self.inertia[i][j]))?;
        }
        same("V".to_owned(), &self.potential, &potential)?;
        for (joint, found) in self.gravity.iter().enumerate() {
            let slope = model.setting.derivative(&self.potential, &model.changes(joint));
            same(format!("N{}", joint + 1), found, &slope)?;
        }
        model.setting.check()?;
        if let Some(base) = &self.base {
            base.prove(model, dependent(&self.inertia, &self.gravity))?;
        }
        let lower = self.inertia.iter().enumerate().flat_map(|(i, row)| &row[..=i]);
        let terms = lower.chain(self.coriolis.iter().flatten()).chain(&self.gravity).map(Exact::terms).sum();
        let base_parameters = self.base.as_ref().map(|base| base.forms.len());
        Ok(Proof { joints: count, terms, base_parameters })
    }
}

/// Reads base parameters. Each is a linear form whose first parameter is its pivot, with factor one.
fn base_parameters(model: &ExactModel, entries: &[Exact]) -> Result<BaseParameters> {
    let mut base = BaseParameters { pivots: Vec::new(), forms: Vec::new() };
    for (at, number) in entries.iter().enumerate() {
        let form = model.coefficients(number);
        let pivot = form.as_ref().and_then(|form| form.iter().position(|x| !x.is_zero()));
        let (Some(form), Some(pivot)) = (form, pivot) else {
            let text = format!("`B{}` is not a linear form in the inertial parameters", at + 1);
            return Err(Error::new(ErrorKind::BadValue, text));
        };
        base.pivots.push(pivot);
        base.forms.push(form);
    }
    let own = |k: usize, row: usize| &base.forms[row][base.pivots[k]];
    let count = base.forms.len();
    let is_own =
        (0..count).all(|k| (0..count).all(|row| if row == k { own(k, row).is_one() } else { own(k, row).is_zero() }));
    let text = "a base parameter's first number is part of another one, or its factor is not one";
    if is_own { Ok(base) } else { Err(Error::new(ErrorKind::BadValue, text)) }
}
