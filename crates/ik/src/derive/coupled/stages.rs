//! The numbered text files of a derivation of coupled chains: the texts of each chain's own derivation, chain by chain.

use std::fmt::Write;

use super::method::{ChainStage, CoupledView};
use crate::Result;
use crate::derive::closure::Mechanism;
use crate::derive::report::stages::{MARK, PAGE, STAGES};
use crate::derive::sequential::{joint_unknowns, name as name_of};
use groebot_algebra::escape::markdown;
use groebot_algebra::number::{Ring, Style};
use groebot_robot::document::word;

impl CoupledView<'_> {
    /// The stage files with their names. Every run gives the same bytes.
    ///
    /// # Errors
    /// If a field cannot be built. This does not occur for a derivation that this crate made.
    pub fn stage_files(&self) -> Result<Vec<(String, Vec<u8>)>> {
        let mut texts = self.shared_texts()?;
        for stage in &self.method.stages {
            let parts = stage.view().stage_texts(&Mechanism::new(&stage.problem.chain)?)?;
            for (text, part) in texts.iter_mut().zip(parts) {
                let _ = write!(text, "{}{}\n\n{part}", if text.is_empty() { "" } else { "\n\n" }, self.title(stage));
            }
        }
        let [equations, plan, basis, triangular] = texts;
        let texts = [equations, plan, basis, triangular, self.program.to_json(), self.certificate()?];
        let mut files: Vec<(String, Vec<u8>)> =
            STAGES.iter().zip(texts).map(|(name, text)| ((*name).to_owned(), text.into_bytes())).collect();
        files.push((PAGE.to_owned(), self.readme()?.into_bytes()));
        Ok(files)
    }

    /// The texts of the stages on shared joints that are found from both chains together; empty if there are none.
    fn shared_texts(&self) -> Result<[String; 4]> {
        let Some(simultaneous) = &self.method.simultaneous else { return Ok([const { String::new() }; 4]) };
        let chains = self.problem.chains();
        let mechanisms = [Mechanism::new(&chains[0].chain)?, Mechanism::new(&chains[1].chain)?];
        let head = format!("shared joints: {}, from both chains at once\n", self.simultaneous_names().join(", "));
        let mut equations = head.clone();
        for (index, relation) in simultaneous.relations()?.into_iter().enumerate() {
            let name = &chains[index].name;
            let _ = write!(equations, "\n(0.{})  chain {name}: {relation}\n", index + 1);
            let _ = writeln!(equations, "       {}", relation.meaning(&mechanisms[index]));
        }
        let (mut plan, mut triangular) = (head.clone(), head);
        for step in &simultaneous.steps {
            let (name, form) = (&self.program.joints[step.joint].name, step.shape.form.name());
            let _ = writeln!(plan, "    {name}: form `{form}` from (0.1) and (0.2)");
            let _ = writeln!(triangular, "\n{name}: form `{form}`");
            if let Some(elimination) = &step.elimination {
                for (number, place) in elimination.symbols.iter().enumerate() {
                    let factors: Vec<String> =
                        place.factors.iter().map(|factor| name_of(&mechanisms[0], *factor)).collect();
                    let product = if factors.is_empty() { "1".to_owned() } else { factors.join(" ") };
                    let relation = place.relation + 1;
                    let _ = writeln!(triangular, "    S{number} = the coefficient of {product} in (0.{relation})");
                }
                let text = elimination.ring.format(&elimination.member, Style::Decimal);
                let own = joint_unknowns(&mechanisms[0], step.joint);
                let _ = writeln!(triangular, "    with x2, x3 for {own}:\n    {text} = 0");
            }
        }
        Ok([equations, plan, String::new(), triangular])
    }

    /// The names of the unknown joints that are found from both chains together, in order.
    pub fn simultaneous_names(&self) -> Vec<&str> {
        let steps = self.method.simultaneous.iter().flat_map(|simultaneous| &simultaneous.steps);
        steps.map(|step| self.program.joints[step.joint].name.as_str()).collect()
    }

    /// The title of a chain, such as `chain 2: right, with HipYawPitch where the chains before it have put it`.
    pub fn title(&self, stage: &ChainStage) -> String {
        let number =
            self.method.stages.iter().position(|other| other.member == stage.member).map_or(0, |index| index + 1);
        let found: Vec<&str> = self.shared(stage).collect();
        let shared = match (found.is_empty(), &self.method.simultaneous) {
            (true, _) => String::new(),
            (false, None) => format!(", with {} where the chains before it have put it", found.join(", ")),
            (false, Some(_)) => format!(", with {} known", found.join(", ")),
        };
        format!("chain {number}: {}{shared}", self.problem.chains()[stage.member].name)
    }

    /// The names of the actuators that earlier chains have found for a chain.
    fn shared<'a>(&'a self, stage: &'a ChainStage) -> impl Iterator<Item = &'a str> {
        stage.found().map(|joint| self.program.joints[joint].name.as_str())
    }

    /// The text of the README on shared joints that are found from both chains together.
    fn shared_page(&self) -> Result<String> {
        let Some(simultaneous) = &self.method.simultaneous else { return Ok(String::new()) };
        let mut text = format!("## Shared joints: {}\n\n", self.simultaneous_names().join(", "));
        text += "They are found first, from one equation of each chain that holds no other unknown joint:\n\n";
        for (member, relation) in self.problem.chains().iter().zip(simultaneous.relations()?) {
            let meaning = relation.meaning(&Mechanism::new(&member.chain)?);
            let _ = writeln!(text, "* **{}**: `{relation}`: {meaning}.", member.name);
        }
        text += match simultaneous.steps.as_slice() {
            [_] => "\nBoth are linear in its cosine and sine. Where one says nothing the other is solved alone.\n\n",
            _ => {
                "\nBoth are linear in the cosine and sine of the second joint; their determinant is an equation in the first one, of degree\n\
                 two in its cosine and sine, by the tangent of half the angle up to four angles. Each has two values of the second joint.\n\n"
            }
        };
        Ok(text)
    }

    fn readme(&self) -> Result<String> {
        let parts = self.problem.parts();
        let mut text = format!("# {}\n\n", markdown(&parts.name));
        for line in [&parts.description, &parts.source].into_iter().flatten() {
            let _ = writeln!(text, "{}\n", markdown(line));
        }
        let unit = self.problem.chains()[0].chain.length_unit().symbol();
        let inputs: Vec<String> = self.program.inputs.iter().map(|input| markdown(&input.name)).collect();
        let joints: Vec<String> = self.program.joints.iter().map(|joint| markdown(&joint.name)).collect();
        let (inputs_list, joints_list) = (inputs.join(", "), joints.join(", "));
        let _ = writeln!(text, "Lengths in {unit}, angles in rad. Target: {inputs_list}. Joints: {joints_list}.\n");
        let _ = writeln!(
            text,
            "Up to {} solutions. The chains are solved one after the other; a joint that is found already is given for those behind it.\n\
             Every way of one chain is continued by all ways of the next, so none is lost; the answers are polished on the equations of\n\
             all chains together and measured by them.\n",
            self.method.dimension()
        );
        text += &self.shared_page()?;
        for stage in &self.method.stages {
            let chain = &stage.problem.chain;
            let _ = writeln!(text, "## {}\n", markdown(&capitalised(&self.title(stage))));
            for line in [&chain.parts().description, &chain.parts().source].into_iter().flatten() {
                let _ = writeln!(text, "{}\n", markdown(line));
            }
            let _ = writeln!(text, "Task: {}.\n", markdown(&chain.asked()));
            let _ = writeln!(text, "{}", stage.view().steps_text(&Mechanism::new(chain)?));
        }
        text += MARK;
        text += "; `groebot check` proves it again from `certificate.json`. Solve with\n\n";
        let example = vec!["..."; inputs.len()].join(",");
        let _ = writeln!(text, "    groebot solve derivations/{} --target {example}", word(&parts.name));
        Ok(text)
    }
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
