//! Names of the parts of a derivation of coupled chains, for reports.

use super::method::{ChainStage, CoupledView};

impl CoupledView<'_> {
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
}
