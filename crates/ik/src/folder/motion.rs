//! Equations of motion in a mechanism's folder: the files and their proof ([`files`]), and the check of both ([`check`]).

use super::finding::Finding;
use super::names::{DYNAMICS, DYNAMICS_TEXT, MOTION};
use super::stored::Stored;
use crate::derive::{Description, Ends, InputFile, Source};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::BigRational;
use groebot_robot::dynamics::exact::{Certificate, Masses, Symbolic, masses};
use groebot_robot::kinematics::Chain;
use groebot_robot::model::Robot;
use groebot_robot::spatial::exact::ExactVector;

/// A chain with the masses of its bodies.
#[derive(Clone, Debug)]
pub struct Moving {
    /// The chain.
    pub chain: Chain,
    /// The robot that contains it, if there is one: only robots have masses.
    pub robot: Option<Robot>,
    /// The first and the last link of the chain in the robot.
    pub ends: Ends,
}

impl Moving {
    /// The chain of a source that `input` gives.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a source without a chain.
    pub fn of(input: &InputFile, source: &Source) -> Result<Self> {
        let robot = if let Description::Robot(robot) = &input.description { Some(robot.clone()) } else { None };
        let ideal = source.ideal.as_ref().map(|(chain, _)| chain).or(source.chain.as_ref());
        let text = "this file describes no chain of joints; give a chain or a robot";
        let chain = ideal.ok_or_else(|| Error::new(ErrorKind::BadValue, text).in_file(&input.path))?;
        Ok(Moving { chain: chain.clone(), robot, ends: source.ends.clone() })
    }

    /// The mass parameters of the bodies, ten numbers each.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a chain without masses. Otherwise those of [`masses`].
    pub fn numbers(&self) -> Result<Vec<[BigRational; 10]>> {
        let text = "this chain's description has no masses; omit --numbers";
        let robot = self.robot.as_ref().ok_or_else(|| Error::new(ErrorKind::BadValue, text))?;
        let path = robot.path(self.ends.base.as_deref(), self.ends.tip.as_deref())?;
        masses(robot, &path, &self.chain)
    }
}

/// The files of the equations of motion with this gravity, proved.
///
/// # Errors
/// Same as [`Certificate::prove`].
pub fn files(
    chain: &Chain,
    symbolic: &Symbolic,
    masses: Masses<'_>,
    gravity: &ExactVector,
) -> Result<[(String, Vec<u8>); 2]> {
    let certificate = Certificate::new(symbolic, chain, masses, gravity);
    let text = symbolic.to_text();
    certificate.prove(chain, &text)?;
    Ok([(DYNAMICS_TEXT, text), (DYNAMICS, certificate.to_json())]
        .map(|(name, text)| (name.to_owned(), text.into_bytes())))
}

/// Checks the equations of motion of a folder. No findings if it has none.
pub fn check(source: &Source, stored: &Stored) -> Vec<Finding> {
    let folder = &stored.folder;
    let missing = |name: &str, other: &str| {
        vec![Finding::refused(
            folder,
            name,
            format!("this file is unproved: `{other}`, which belongs to it, is missing"),
        )]
    };
    match MOTION.map(|name| stored.get(name)) {
        [None, None] => Vec::new(),
        [Some(_), None] => missing(DYNAMICS_TEXT, DYNAMICS),
        [None, Some(_)] => missing(DYNAMICS, DYNAMICS_TEXT),
        [Some(text), Some(json)] => {
            let [text, json] = [text, json].map(String::from_utf8_lossy);
            checked(source, stored, &text, &json)
        }
    }
}

fn checked(source: &Source, stored: &Stored, text: &str, json: &str) -> Vec<Finding> {
    let fails = |name: &str, error: Error| Finding::fails(&stored.folder, name, error);
    match read(source, json) {
        Err(error) => {
            let unproved =
                Error::new(ErrorKind::Certificate, format!("this file is unproved: `{DYNAMICS}` does not hold"));
            vec![fails(DYNAMICS, error), fails(DYNAMICS_TEXT, unproved)]
        }
        Ok((certificate, moving)) => match certificate.prove(&moving.chain, text) {
            Err(error) => vec![Finding::holds(DYNAMICS, "about this chain"), fails(DYNAMICS_TEXT, error)],
            Ok(proof) => vec![
                Finding::holds(DYNAMICS, proof.to_string()),
                Finding::holds(DYNAMICS_TEXT, "follows from the proof"),
            ],
        },
    }
}

/// The certificate of a folder's equations of motion, and the chain of that certificate.
fn read(source: &Source, json: &str) -> Result<(Certificate, Moving)> {
    let moving = Moving::of(&InputFile::read(&source.path)?, source)?;
    let certificate = Certificate::from_json(json, moving.chain.name())?;
    let refused = |text: &str| Err(Error::new(ErrorKind::Certificate, text));
    if certificate.has_numbers() && !certificate.has(&moving.numbers()?) {
        return refused("its mass parameters differ from those of the description");
    }
    if certificate.to_json() != json {
        return refused("it differs from the output of `groebot dynamics --symbolic`, which writes the correct one");
    }
    Ok((certificate, moving))
}
