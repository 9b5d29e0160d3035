//! The main figures of a walk. Main type: [`Summary`].

use std::fmt;

use super::biped::Biped;
use super::check;
use super::plan::Walk;
use super::request::Gait;
use super::schedule::Action;

/// A supporting sole with a smaller angle to the floor is level \[rad\].
const TILTED: f64 = 1e-3;

/// An extreme value with its time.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Extreme {
    /// The value.
    pub value: f64,
    /// The time at which it occurs first \[s\].
    pub time: f64,
}

/// The main figures of a walk.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Summary {
    /// The name of the robot.
    pub robot: String,
    /// The law of motion of the centre of mass.
    pub gait: Gait,
    /// The number of steps.
    pub steps: usize,
    /// The duration, rests included \[s\].
    pub duration: f64,
    /// The duration without rests, lowering and rising \[s\].
    pub stepping: f64,
    /// Whether the mass model is a point at the torso's centre of mass.
    pub is_point_mass: bool,
    /// The distance that the middle of the feet moves \[m\].
    pub distance: f64,
    /// The angle that the middle of the feet turns \[rad\].
    pub turn: f64,
    /// The height of the torso's origin above the floor \[m\].
    pub torso_height: f64,
    /// The mean speed from the first shift to the last \[m/s\].
    pub speed: f64,
    /// The least margin of the zero moment point \[m\], RH0 (3-5).
    pub margin: Extreme,
    /// The least margin of the projection of the centre of mass \[m\], RH0 (3-1).
    pub static_margin: Extreme,
    /// The greatest distance between the zero moment points of the multibody and of the linear inverted pendulum \[m\].
    pub pendulum_error: Extreme,
    /// The joint that comes nearest to a limit, and the distance to that limit \[rad\].
    pub nearest_limit: (String, Extreme),
    /// The joint with the greatest rate relative to its limit, and that ratio.
    pub fastest: (String, Extreme),
    /// Pairs of links that touch, by their names, with the greatest penetration \[m\] and its first time; deepest
    /// first.
    pub touching: Vec<([String; 2], Extreme)>,
    /// The greatest angle between a supporting sole and the floor \[rad\]: legs of five joints leave a rotation free.
    pub tilt: Extreme,
    /// The number of phases that are slowed down, and the greatest factor.
    pub slowed: (usize, f64),
}

impl Summary {
    /// The figures of `walk`.
    pub fn of(biped: &Biped, walk: &Walk) -> Self {
        let stands = walk.schedule.route.stands();
        let middles = [&stands[0], &stands[stands.len() - 1]].map(|feet| feet[0].middle(&feet[1]));
        let distance = (middles[1].point() - middles[0].point()).norm();
        let phases = &walk.schedule.phases;
        let walks = |phase: &&super::Phase| !matches!(phase.action, Action::Rest | Action::Lower | Action::Rise);
        let walking = phases.iter().filter(walks).map(|phase| phase.samples).sum::<usize>() as f64 * walk.schedule.tick;
        let slowed = phases.iter().filter(|phase| phase.slowed > 1.0);
        Summary {
            robot: biped.name.clone(),
            gait: walk.request.gait,
            steps: walk.schedule.route.steps.len(),
            duration: walk.time(walk.balances.len() - 1),
            stepping: walking,
            is_point_mass: biped.is_point_mass,
            distance,
            turn: middles[1].yaw - middles[0].yaw,
            torso_height: walk.request.style.torso_height,
            speed: if walking > 0.0 { distance / walking } else { 0.0 },
            margin: least_margin(walk),
            static_margin: extreme(walk, &|sample| -walk.balances[sample].static_margin, -1.0),
            pendulum_error: extreme(
                walk,
                &|sample| (walk.balances[sample].zmp - walk.balances[sample].pendulum).norm(),
                1.0,
            ),
            nearest_limit: nearest_limit(biped, walk),
            fastest: fastest(biped, walk),
            touching: touching(biped, walk),
            tilt: tilt(biped, walk),
            slowed: (slowed.clone().count(), slowed.map(|phase| phase.slowed).fold(1.0, f64::max)),
        }
    }
}

/// The greatest angle between a supporting sole and the floor.
fn tilt(biped: &Biped, walk: &Walk) -> Extreme {
    let angle = |sample: usize| check::tilt(biped, &walk.motion.postures[sample], &walk.references[sample].stands);
    extreme(walk, &angle, 1.0)
}

/// The least margin of the zero moment point, RH0 (3-5) \[m\].
pub(super) fn least_margin(walk: &Walk) -> Extreme {
    extreme(walk, &|sample| -walk.balances[sample].margin, -1.0)
}

/// The greatest value of `figure` times `sign`, with its time.
fn extreme(walk: &Walk, figure: &dyn Fn(usize) -> f64, sign: f64) -> Extreme {
    let mut best = (f64::NEG_INFINITY, 0);
    for sample in 0..walk.balances.len() {
        let value = figure(sample);
        if value > best.0 {
            best = (value, sample);
        }
    }
    Extreme { value: sign * best.0, time: walk.time(best.1) }
}

/// The joint whose figure is the greatest over the walk. Joints that do not move are ignored.
fn among_joints(biped: &Biped, walk: &Walk, figure: &dyn Fn(usize, usize) -> f64, sign: f64) -> (String, Extreme) {
    let postures = &walk.motion.postures;
    let moves = |joint: &usize| postures.iter().any(|posture| posture.q[*joint] != postures[0].q[*joint]);
    let figures = (0..biped.joints.len())
        .filter(moves)
        .map(|joint| (biped.joints[joint].name.clone(), extreme(walk, &|sample| figure(joint, sample), sign)));
    figures
        .max_by(|a, b| (sign * a.1.value).total_cmp(&(sign * b.1.value)))
        .unwrap_or_else(|| ("none".into(), Extreme { value: 0.0, time: 0.0 }))
}

fn nearest_limit(biped: &Biped, walk: &Walk) -> (String, Extreme) {
    let room = |joint: usize, sample: usize| {
        let (low, high) = biped.joints[joint].limits;
        let value = walk.motion.postures[sample].q[joint];
        (value - low).min(high - value)
    };
    among_joints(biped, walk, &|joint, sample| -room(joint, sample), -1.0)
}

fn fastest(biped: &Biped, walk: &Walk) -> (String, Extreme) {
    let postures = &walk.motion.postures;
    let share = |joint: usize, sample: usize| {
        let before = postures[sample.saturating_sub(1)].q[joint];
        (postures[sample].q[joint] - before).abs() / walk.schedule.tick / biped.joints[joint].speed
    };
    among_joints(biped, walk, &share, 1.0)
}

/// The pairs of links that touch at a sample, each with its deepest point.
fn touching(biped: &Biped, walk: &Walk) -> Vec<([String; 2], Extreme)> {
    let mut found: Vec<([usize; 2], Extreme)> = Vec::new();
    for (sample, posture) in walk.motion.postures.iter().enumerate() {
        // A posture of a walk has a finite value for each joint.
        let Ok(placed) = biped.model.place(&posture.world_from_torso, &posture.q) else { continue };
        for touch in biped.clearance.touching(&placed) {
            let deepest = Extreme { value: touch.depth, time: walk.time(sample) };
            match found.iter_mut().find(|(links, _)| *links == touch.links) {
                Some((_, known)) if known.value < touch.depth => *known = deepest,
                Some(_) => {}
                None => found.push((touch.links, deepest)),
            }
        }
    }
    found.sort_by(|(_, a), (_, b)| b.value.total_cmp(&a.value));
    found.into_iter().map(|(links, depth)| (links.map(|link| biped.links[link].clone()), depth)).collect()
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let gait = match self.gait {
            Gait::Sine => "the sine",
            Gait::Preview => "preview control",
            Gait::OneStep(_) => "one step goal",
        };
        let millimetres = |extreme: &Extreme| format!("{:.1} mm at {:.2} s", 1e3 * extreme.value, extreme.time);
        writeln!(
            f,
            "{}: {} steps by {gait}, {:.2} s, {:.2} s of them stepping",
            self.robot, self.steps, self.duration, self.stepping
        )?;
        writeln!(
            f,
            "  path            {:.3} m, turn {:.1} deg, {:.1} cm/s between the rests, torso {:.3} m high",
            self.distance,
            self.turn.to_degrees(),
            100.0 * self.speed,
            self.torso_height
        )?;
        if self.is_point_mass {
            writeln!(f, "  mass            a point at the trunk: the masses of the links are not known")?;
        }
        writeln!(f, "  least margin    {} (ZMP, RH0 (3-5))", millimetres(&self.margin))?;
        writeln!(f, "  static margin   {} (centre of mass, RH0 (3-1))", millimetres(&self.static_margin))?;
        writeln!(f, "  pendulum's ZMP  off by {} at most", millimetres(&self.pendulum_error))?;
        let (joint, room) = &self.nearest_limit;
        writeln!(f, "  joint limits    {joint} comes within {:.1} deg at {:.2} s", room.value.to_degrees(), room.time)?;
        let (joint, share) = &self.fastest;
        writeln!(
            f,
            "  joint speeds    {joint} reaches {:.0} % of its own at {:.2} s",
            100.0 * share.value,
            share.time
        )?;
        for ([one, other], depth) in &self.touching {
            writeln!(f, "  links touch     {one} and {other}, {}", millimetres(depth))?;
        }
        if self.tilt.value > TILTED {
            writeln!(
                f,
                "  soles           tilt by {:.1} deg at {:.2} s: the legs do not hold this rotation",
                self.tilt.value.to_degrees(),
                self.tilt.time
            )?;
        }
        match self.slowed {
            (0, _) => writeln!(f, "  phases          none had to be slowed down"),
            (count, factor) => writeln!(f, "  phases          {count} slowed down, up to {factor:.2} times"),
        }
    }
}
