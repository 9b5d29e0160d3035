//! `--verify` and `--repair`: a plan is simulated before anything is written.

use super::feedback::Feedback;
use super::physics::{Case, ScriptOutput, Stage};
use super::walker::Named;
use super::{Halt, console};
use crate::{ErrorKind, Result, Watch};
use groebot_humanoid::gait::{REPAIRS, Steadier, Walk, Walker};

/// The simulation of a plan.
#[derive(clap::Args)]
pub struct Verification {
    /// Simulate the walk with MuJoCo, with feedback on a level floor; a walk that falls is refused (exit status 5)
    #[arg(long)]
    verify: bool,
    /// Same as --verify, but a walk that falls is planned again until it stands: slower, nearer to the supporting foot,
    /// wider, lower
    #[arg(long)]
    repair: bool,
}

/// A plan that was not refused by a simulation.
pub struct Verified<P> {
    /// The plan.
    pub plan: P,
    /// What was simulated and changed, one line each.
    pub notes: Vec<String>,
}

impl Verification {
    /// The plan of `plan`, which is given the walker. With `--verify`, its walk is simulated; with `--repair`, it is
    /// planned for steadier gaits until it stands. `walk` is the walk of a plan, if it has one.
    ///
    /// # Errors
    /// [`Halt::Fell`], which is reported, when the robot falls; those of `plan`, [`Stage::play`] and [`Feedback::new`].
    pub fn planned<P>(
        &self,
        named: &Named,
        watch: &Watch,
        plan: impl Fn(&Walker) -> Result<P>,
        walk: impl Fn(&P) -> Option<&Walk>,
    ) -> std::result::Result<Verified<P>, Halt> {
        let first = plan(&named.walker)?;
        if !(self.verify || self.repair) {
            return Ok(Verified { plan: first, notes: Vec::new() });
        }
        let Some(first_walk) = walk(&first) else { return Ok(Verified { plan: first, notes: Vec::new() }) };
        let simulated = simulate(named, first_walk, watch)?;
        let unused = simulated.unused_gains().map(|text| format!("simulated: the gains {text}"));
        let noted = |note: String| [note].into_iter().chain(unused.clone()).collect();
        let Some(time) = simulated.fell else {
            return Ok(Verified { plan: first, notes: noted("simulated: the robot stands".to_owned()) });
        };
        if self.repair {
            for repair in &REPAIRS {
                let repaired = match plan(&steadier(&named.walker, repair)) {
                    Err(error) if error.kind() == ErrorKind::BadValue => continue,
                    repaired => repaired?,
                };
                let Some(repaired_walk) = walk(&repaired) else { continue };
                if simulate(named, repaired_walk, watch)?.fell.is_none() {
                    let note = format!("simulated: the robot would fall at {time:.2} s; it stands with {repair}");
                    return Ok(Verified { plan: repaired, notes: noted(note) });
                }
            }
        }
        let advice = match self.repair {
            true => "so do slower, wider and lower walks; nothing was written",
            false => "nothing was written; --repair plans again until it stands",
        };
        unused.iter().for_each(|note| console::line("note", note));
        console::line("error", &format!("simulated: the robot falls at {time:.2} s; {advice}"));
        Err(Halt::Fell)
    }
}

/// Simulates a walk with feedback on a level floor.
fn simulate(named: &Named, walk: &Walk, watch: &Watch) -> Result<ScriptOutput> {
    let trajectory = walk.trajectory(&named.walker.biped);
    let model = named.shod.robot.to_mjcf(&named.meshes, &mut Vec::new())?;
    let soles = named.shod.soles.each_ref().map(String::as_str);
    let stage = Stage::new(&model, &trajectory, soles, None)?;
    let mut feedback = Feedback::new(&named.walker, &trajectory)?;
    Ok(stage.play(&Case::default(), Some(&mut feedback), watch)?.1)
}

/// The walker with steadier gaits.
fn steadier(walker: &Walker, repair: &Steadier) -> Walker {
    let mut walker = walker.clone();
    for (_, gait) in &mut walker.gaits {
        *gait = gait.steadier(&walker.biped, repair);
    }
    walker
}
