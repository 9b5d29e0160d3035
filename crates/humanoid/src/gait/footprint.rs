//! Footprints on a flat floor: [`Footprint`], and a walk's list of footsteps, [`Route`].

use nalgebra::{Point2, Rotation2, UnitQuaternion, Vector2, Vector3};

use crate::{Error, ErrorKind, Result};
use groebot_algebra::limits;
use groebot_robot::document::unix_lines;
use groebot_robot::spatial::{Pose, angle};

/// The greatest number of steps of a route.
pub const MAX_STEPS: usize = limits::FOOTSTEPS;
/// The greatest coordinate of a footprint \[m\].
const MAX_COORDINATE: f64 = limits::FOOTPRINT_METRES;

/// The side of a foot; as a number, its index in pairs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// The left foot.
    Left = 0,
    /// The right foot.
    Right = 1,
}

impl Side {
    /// The opposite side.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Side::Left => Side::Right,
            Side::Right => Side::Left,
        }
    }

    /// `left` or `right`.
    pub fn name(self) -> &'static str {
        match self {
            Side::Left => "left",
            Side::Right => "right",
        }
    }

    /// 1 for the left side, in the direction of y, and -1 for the right one.
    pub fn sign(self) -> f64 {
        match self {
            Side::Left => 1.0,
            Side::Right => -1.0,
        }
    }
}

/// A pose on the floor of the world: x and y \[m\], and the heading \[rad\], anticlockwise from x.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Footprint {
    /// The coordinate forward.
    pub x: f64,
    /// The coordinate to the left.
    pub y: f64,
    /// The rotation about the vertical.
    pub yaw: f64,
}

impl Footprint {
    /// Composes two poses: `other` is given in the frame of `self`.
    #[must_use]
    pub fn then(&self, other: &Footprint) -> Footprint {
        let at = self.carry(&Point2::new(other.x, other.y));
        Footprint { x: at.x, y: at.y, yaw: self.yaw + other.yaw }
    }

    /// Projects a pose whose x axis is not vertical onto the floor: its origin, and the heading of its x axis.
    pub fn below(pose: &Pose) -> Footprint {
        let ahead = pose.rotation * Vector3::x();
        Footprint { x: pose.translation.x, y: pose.translation.y, yaw: ahead.y.atan2(ahead.x) }
    }

    /// Transforms a point from this frame to the world.
    pub(crate) fn carry(&self, point: &Point2<f64>) -> Point2<f64> {
        self.point() + Rotation2::new(self.yaw) * point.coords
    }

    /// Transforms points from this frame to the world.
    pub(crate) fn carry_all(&self, points: &[Point2<f64>]) -> Vec<Point2<f64>> {
        let turn = Rotation2::new(self.yaw);
        points.iter().map(|point| self.point() + turn * point.coords).collect()
    }

    /// Transforms a point of the world to this frame.
    pub(crate) fn seen(&self, point: &Point2<f64>) -> Point2<f64> {
        Point2::from(Rotation2::new(-self.yaw) * (point - self.point()))
    }

    /// The position \[m\].
    pub fn point(&self) -> Point2<f64> {
        Point2::new(self.x, self.y)
    }

    /// The unit vector forward.
    pub fn ahead(&self) -> Vector2<f64> {
        Rotation2::new(self.yaw) * Vector2::x()
    }

    /// Interpolates to `other`: the pose at the fraction `share` of the straight line, with the shorter rotation.
    #[must_use]
    pub fn towards(&self, other: &Footprint, share: f64) -> Footprint {
        let at = self.point() + (other.point() - self.point()) * share;
        Footprint { x: at.x, y: at.y, yaw: self.yaw + angle::difference(other.yaw, self.yaw) * share }
    }

    /// The pose halfway between two.
    #[must_use]
    pub fn middle(&self, other: &Footprint) -> Footprint {
        self.towards(other, 0.5)
    }

    /// The footprints of two parallel feet, left and right, each at the lateral distance `half_width` \[m\] from this
    /// pose.
    pub fn feet(&self, half_width: f64) -> [Footprint; 2] {
        [Side::Left, Side::Right]
            .map(|side| self.then(&Footprint { y: side.sign() * half_width, ..Default::default() }))
    }

    /// The pose in SE(3) at height `z` \[m\] with a vertical z axis.
    pub fn at_height(&self, z: f64) -> Pose {
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), self.yaw);
        Pose::from_parts(Vector3::new(self.x, self.y, z).into(), turn)
    }
}

/// A footstep: the swing foot and its landing pose.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Footstep {
    /// The swing foot.
    pub side: Side,
    /// Its landing pose.
    pub print: Footprint,
}

/// The initial footprints and the footsteps.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Route {
    /// The initial footprints, left and right.
    pub start: [Footprint; 2],
    /// The footsteps in order; the sides alternate.
    pub steps: Vec<Footstep>,
    /// The resting poses in double support, seen from above, before the first step and after each: halfway between the
    /// feet, or the centre of a turn on the spot.
    pub rests: Vec<Footprint>,
}

/// A regular route: steps of equal length and turn, the last of which closes the feet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Regular {
    /// The number of steps.
    pub steps: usize,
    /// The distance forward from one foot's print to the next one's \[m\].
    pub length: f64,
    /// The lateral distance of each step of the foot on that side, to the left \[m\]; the other foot follows.
    pub aside: f64,
    /// The rotation of the whole walk \[rad\], anticlockwise.
    pub turn: f64,
    /// Half of the lateral distance between the feet \[m\].
    pub half_width: f64,
    /// The first swing foot.
    pub first: Side,
}

impl Route {
    /// Makes the route of `regular`: the prints are beside the corners of a polygon with `steps - 1` equal sides and
    /// angles.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for no steps or more than [`MAX_STEPS`], a number that is not finite, or one beyond the
    /// greatest coordinate.
    pub fn regular(regular: &Regular) -> Result<Self> {
        let Regular { steps, length, aside, turn, half_width, first } = *regular;
        if steps == 0 || steps > MAX_STEPS {
            return Err(bad(format!("{steps} steps are requested; give 1 to {MAX_STEPS}")));
        }
        if !(length.is_finite() && aside.is_finite() && turn.is_finite() && half_width.is_finite() && half_width > 0.0)
        {
            return Err(bad(
                "the length, the turn and the width of the steps must be finite, the width positive".into()
            ));
        }
        let advances = (steps - 1).max(1);
        let share = turn / advances as f64;
        let stride = |side: Side| {
            let y = if aside * side.sign() > 0.0 { aside } else { 0.0 };
            Footprint { x: 0.0, y: 0.0, yaw: share / 2.0 }.then(&Footprint { x: length, y, yaw: share / 2.0 })
        };
        let mut middle = Footprint::default();
        let start = middle.feet(half_width);
        let mut side = first;
        let mut list = Vec::with_capacity(steps);
        for step in 0..steps {
            if step < advances {
                middle = middle.then(&stride(side));
            }
            list.push(Footstep { side, print: middle.feet(half_width)[side as usize] });
            side = side.other();
        }
        Route::new(start, list)
    }

    /// Reads footsteps from CSV: a header `foot,x,y,yaw`, then a line for each step, with `left` or `right`, metres and
    /// radians. Empty lines and lines that start with `#` are ignored. The robot starts at the origin with its feet at
    /// `half_width` \[m\] to each side.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] for another header, a wrong number of fields, or a field that is not a number.
    /// [`ErrorKind::BadValue`] for two consecutive steps of one foot, no steps or more than [`MAX_STEPS`], and numbers
    /// that are not finite. The message has the line.
    pub fn from_csv(text: &str, half_width: f64) -> Result<Self> {
        let text = unix_lines(text.trim_start_matches('\u{feff}'));
        let mut lines = text.lines().enumerate().filter(|(_, line)| {
            let line = line.trim();
            !line.is_empty() && !line.starts_with('#')
        });
        let syntax = |line: usize, text: String| Err(Error::new(ErrorKind::Syntax, text).at_line(line + 1));
        match lines.next() {
            Some((_, header)) if fields(header) == ["foot", "x", "y", "yaw"] => {}
            Some((line, _)) => return syntax(line, "the first line must be `foot,x,y,yaw`".into()),
            None => return syntax(0, "there are no footsteps; start with the line `foot,x,y,yaw`".into()),
        }
        let mut steps: Vec<Footstep> = Vec::new();
        for (line, row) in lines {
            let step = footstep(row).map_err(|error| error.at_line(line + 1))?;
            if steps.last().is_some_and(|last| last.side == step.side) {
                let text = format!("the {} foot has two consecutive steps; the feet must alternate", step.side.name());
                return Err(bad(text).at_line(line + 1));
            }
            steps.push(step);
        }
        let start = Footprint::default().feet(half_width);
        Route::new(start, steps)
    }

    /// Makes the route of `steps` from feet at `start`; between steps the robot rests halfway between its feet.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for no steps or more than [`MAX_STEPS`], or numbers that are not finite.
    pub fn new(start: [Footprint; 2], steps: Vec<Footstep>) -> Result<Self> {
        let mut route = Route { start, steps, rests: Vec::new() }.checked()?;
        route.rests = route.stands().iter().map(|feet| feet[0].middle(&feet[1])).collect();
        Ok(route)
    }

    /// A route without steps.
    pub fn at_rest(feet: [Footprint; 2]) -> Self {
        Route { start: feet, steps: Vec::new(), rests: vec![feet[0].middle(&feet[1])] }
    }

    /// The footprints after the last step.
    pub fn end(&self) -> [Footprint; 2] {
        let last = |side: Side| self.steps.iter().rev().find(|step| step.side == side).map(|step| step.print);
        [Side::Left, Side::Right].map(|side| last(side).unwrap_or(self.start[side as usize]))
    }

    fn checked(self) -> Result<Self> {
        if self.steps.is_empty() || self.steps.len() > MAX_STEPS {
            return Err(bad(format!("{} steps are requested; give 1 to {MAX_STEPS}", self.steps.len())));
        }
        let is_near =
            |print: &Footprint| [print.x, print.y, print.yaw].iter().all(|value| value.abs() <= MAX_COORDINATE);
        if !self.steps.iter().all(|step| is_near(&step.print)) {
            return Err(bad(format!("a footstep is beyond {MAX_COORDINATE} m or rad, or not finite")));
        }
        Ok(self)
    }

    /// The footprints after each step, the initial ones first.
    pub fn stands(&self) -> Vec<[Footprint; 2]> {
        let mut stands = vec![self.start];
        for step in &self.steps {
            let mut feet = stands[stands.len() - 1];
            feet[step.side as usize] = step.print;
            stands.push(feet);
        }
        stands
    }
}

fn fields(row: &str) -> Vec<&str> {
    row.split(',').map(str::trim).collect()
}

fn footstep(row: &str) -> Result<Footstep> {
    let [foot, x, y, yaw] = fields(row)[..] else {
        return Err(Error::new(ErrorKind::Syntax, "give four fields: foot,x,y,yaw"));
    };
    let side = match foot {
        "left" => Side::Left,
        "right" => Side::Right,
        _ => return Err(Error::new(ErrorKind::Syntax, "the foot must be `left` or `right`")),
    };
    let number = |name: &str, text: &str| {
        let value = text.parse::<f64>().ok().filter(|value| value.is_finite());
        value.ok_or_else(|| {
            Error::new(ErrorKind::Syntax, format!("`{name}` must be a finite number, in metres or radians"))
        })
    };
    Ok(Footstep { side, print: Footprint { x: number("x", x)?, y: number("y", y)?, yaw: number("yaw", yaw)? } })
}

fn bad(text: String) -> Error {
    Error::new(ErrorKind::BadValue, text)
}

/// The heading of a frame's x axis about the vertical \[rad\].
pub(super) fn heading_of(world_from_frame: &Pose) -> f64 {
    let ahead = world_from_frame.rotation * Vector3::x();
    ahead.y.atan2(ahead.x)
}
