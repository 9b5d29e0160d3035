//! The page as a file. Main type: [`Page`].

use sha2::{Digest, Sha256};

use super::data::{Data, FORMAT, Limb};
use super::motion::motion;
use super::robot::described;
use super::run::{RunRequest, run};
use super::sole::Sole;
use super::walk::WalkRecord;
use super::{bytes, chain, data, reach};
use crate::sim::TaskRecord;
use crate::{Error, ErrorKind, Result};
use groebot_ik::reach::ReachMap;
use groebot_robot::document::shown;
use groebot_robot::kinematics::Chain;
use groebot_robot::model::{Meshes, Robot};
use groebot_robot::motion::Trajectory;

/// The frame of the page, with its style; title, data and script are inserted.
const SHELL: &str = include_str!("dist/page.html");
/// The script of the page.
const SCRIPT: &str = include_str!("dist/viewer.js");

/// The WebAssembly that solves and walks in the page, as text.
#[cfg(not(target_family = "wasm"))]
fn wasm() -> String {
    use std::io::Read;

    const XZ: &[u8] = include_bytes!("dist/groebot.wasm.xz");
    let mut module = Vec::new();
    lzma_rust2::XzReader::new(XZ, false).read_to_end(&mut module).expect("the file is a whole xz file");
    bytes::file(&module)
}

/// The WebAssembly build does not contain itself.
#[cfg(target_family = "wasm")]
fn wasm() -> String {
    bytes::file(&[])
}

/// A page that shows a robot and its motion.
#[derive(Clone, Debug)]
pub struct Page {
    data: Data,
}

impl Page {
    /// A page of `robot` at rest, with joints that the user moves. Meshes are shown where their folders are given; the
    /// page lists those that cannot be read.
    ///
    /// # Errors
    /// As [`Robot::check`]; [`ErrorKind::BadValue`] for a robot with neither a shape nor two distinct joints.
    pub fn of_robot(robot: &Robot, meshes: Option<&Meshes>) -> Result<Self> {
        Ok(Page::of(described(robot, meshes)?))
    }

    /// A page of a chain whose solutions are shown while its target is moved, from the text of its solver, a
    /// `5_program.json`, and of its certificate.
    pub fn of_chain(chain: &Chain, program: String, certificate: Option<&str>) -> Self {
        let mut page = Page::of(chain::described(chain));
        page.data.limbs.push(chain::limb(chain, &program, certificate.map(hash)));
        page.data.wasm = Some(wasm());
        page
    }

    /// Adds a limb whose solutions are shown while its target, the pose of the link `tip` in the link `base`, is moved.
    /// It needs the texts of the solver and of the certificate of its chain, whose joints are all moving ones between
    /// the two links.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] for a link or a joint that the robot does not have.
    pub fn with_limb(
        mut self,
        chain: &Chain,
        [base, tip]: [&str; 2],
        program: String,
        certificate: Option<&str>,
    ) -> Result<Self> {
        let unknown = |kind: &str, name: &str| {
            let text = format!("the robot `{}` has no {kind} `{}`", shown(&self.data.robot.name), shown(name));
            Error::new(ErrorKind::UnknownName, text)
        };
        let robot = &self.data.robot;
        let link =
            |name: &str| robot.links.iter().position(|link| link.name == name).ok_or_else(|| unknown("link", name));
        let joint =
            |name: &str| robot.joints.iter().position(|joint| joint.name == name).ok_or_else(|| unknown("joint", name));
        let joints = chain.joints().iter().map(|own| joint(&own.name)).collect::<Result<_>>()?;
        let (base, tip_place) = (link(base)?, link(tip)?);
        let limb = Limb {
            name: tip.to_owned(),
            base,
            tip: tip_place,
            joints,
            ..chain::limb(chain, &program, certificate.map(hash))
        };
        self.data.limbs.push(limb);
        self.data.wasm = Some(wasm());
        Ok(self)
    }

    /// Adds a run of the simulator, for a walking robot of this crate in a room of this text. Its goal, the furniture
    /// and the parameters of its gait can be changed while it walks.
    ///
    /// # Errors
    /// As [`crate::nav::Room::from_toml`], [`crate::sim::Start::of_robot`] and [`crate::sim::Run::new`].
    pub fn with_run(mut self, request: &RunRequest<'_>) -> Result<Self> {
        self.data.run = Some(run(request)?);
        self.data.wasm = Some(wasm());
        Ok(self)
    }

    /// Adds the room of a task, with its furniture and path at each time of the motion.
    #[must_use]
    pub fn with_task(mut self, task: TaskRecord) -> Self {
        self.data.task = Some(task);
        self
    }

    /// Adds the reachability map of the last limb, or of a chain from the robot's root.
    #[must_use]
    pub fn with_reach(mut self, map: &ReachMap) -> Self {
        let base = self.data.limbs.last().map_or(self.data.robot.base, |limb| limb.base);
        self.data.reach = Some(reach::described(map, base));
        self
    }

    fn of(robot: data::Robot) -> Self {
        let title = robot.name.clone();
        Page {
            data: Data {
                format: FORMAT,
                title,
                robot,
                motion: None,
                limbs: Vec::new(),
                run: None,
                task: None,
                reach: None,
                wasm: None,
            },
        }
    }

    /// Sets the title.
    #[must_use]
    pub fn titled(mut self, title: &str) -> Self {
        title.clone_into(&mut self.data.title);
        self
    }

    /// Adds a motion by `trajectory`, whose joints are found by their names. Support polygons are taken from `record`,
    /// else from `soles`.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] for a joint that the robot does not have; [`ErrorKind::BadValue`] for a joint of
    /// another type than in the trajectory, no sample, or a record with another number of samples; as
    /// [`Trajectory::check`].
    pub fn with_motion(mut self, trajectory: &Trajectory, record: Option<&WalkRecord>, soles: &[Sole]) -> Result<Self> {
        self.data.motion = Some(motion(&self.data.robot, trajectory, record, soles)?);
        Ok(self)
    }

    /// The data of the page, as JSON that is safe inside HTML.
    pub fn data(&self) -> String {
        let text = serde_json::to_string(&self.data).expect("the data can be represented in JSON");
        text.replace('<', "\\u003c")
    }

    /// The page: one HTML file.
    pub fn to_html(&self) -> String {
        let title = self.data.title.replace('&', "&amp;").replace('<', "&lt;");
        let parts = [("{{title}}", title.as_str()), ("{{data}}", &self.data()), ("{{script}}", SCRIPT)];
        let mut html = String::with_capacity(SHELL.len() + SCRIPT.len());
        let mut rest = SHELL;
        for (place, text) in parts {
            let (before, after) = rest.split_once(place).expect("the page's frame has a place for each, in this order");
            html.push_str(before);
            html.push_str(text);
            rest = after;
        }
        html + rest
    }
}

/// The SHA-256 of a text.
fn hash(text: &str) -> String {
    Sha256::digest(text).iter().map(|byte| format!("{byte:02x}")).collect()
}
