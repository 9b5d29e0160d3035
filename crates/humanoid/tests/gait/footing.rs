//! Robots from descriptions: soles that are found, legs of five joints, a waist, root links with other axes.

use std::fmt::Write;
use std::sync::{Arc, LazyLock};

use groebot_humanoid::gait::{Footing, GRAVITY, GaitDefaults, LegSolver, Measures, Route, Side, Walk, Walker, plan_at};
use groebot_humanoid::{ErrorKind, Result, Watch};
use groebot_ik::derive::Options;
use groebot_robot::dynamics::Model;
use groebot_robot::kinematics::{Chain, InverseKinematics, Solution, Target};
use groebot_robot::model::{Meshes, Robot};
use groebot_robot::spatial::Pose;
use nalgebra::{Point2, Point3, Vector3};

const NO_LINKS: [Option<&str>; 2] = [None, None];

/// A description with legs of 0.3 m + 0.3 m, 0.05 m ahead of the torso's origin.
#[derive(Clone, Copy)]
struct Description {
    /// Whether the root link has x backward and y to the right.
    backward: bool,
    /// Whether a joint about the vertical is between the root and the legs.
    waist: bool,
    /// The distance of the legs from the torso's origin to the sides \[m\].
    aside: f64,
    /// Whether the ankles roll.
    rolls: bool,
    /// Whether the feet have boxes.
    boxes: bool,
    /// The names of the links of one side begin with these, the left one first.
    names: [&'static str; 2],
}

const PLAIN: Description =
    Description { backward: false, waist: false, aside: 0.1, rolls: true, boxes: true, names: ["l_", "r_"] };

impl Description {
    fn urdf(&self) -> String {
        let mut text = "<robot name=\"small\">\n".to_owned();
        link(&mut text, "base", 8.0, "");
        let turn = if self.backward { "3.14159265358979" } else { "0" };
        joint(&mut text, "mount", ("base", "hips"), ("0 0 0", turn), if self.waist { "0 0 1" } else { "" });
        link(&mut text, "hips", 1.0, "");
        for (side, name) in [1.0, -1.0].into_iter().zip(self.names) {
            let at = |link: &str| format!("{name}{link}");
            let sole = "<collision><origin xyz=\"0.03 0 -0.04\"/><geometry><box size=\"0.2 0.1 0.02\"/></geometry></collision>";
            let sole = if self.boxes { sole } else { "" };
            let mut parts = vec![
                ("yaw", format!("0.05 {} -0.1", self.aside * side), "0 0 1"),
                ("roll", "0 0 0".to_owned(), "1 0 0"),
                ("pitch", "0 0 0".to_owned(), "0 1 0"),
                ("knee", "0 0 -0.3".to_owned(), "0 1 0"),
                ("ankle", "0 0 -0.3".to_owned(), "0 1 0"),
            ];
            if self.rolls {
                parts.push(("foot", "0 0 0".to_owned(), "1 0 0"));
            }
            let mut parent = "hips".to_owned();
            let last = parts.len() - 1;
            for (place, (part, xyz, axis)) in parts.into_iter().enumerate() {
                joint(&mut text, &format!("{}_joint", at(part)), (&parent, &at(part)), (&xyz, "0"), axis);
                link(&mut text, &at(part), 0.6, if place == last { sole } else { "" });
                parent = at(part);
            }
            joint(&mut text, &at("arm_joint"), ("hips", &at("arm")), (&format!("0 {} 0.3", 0.2 * side), "0"), "0 1 0");
            link(&mut text, &at("arm"), 0.3, "");
        }
        text + "</robot>\n"
    }

    fn robot(&self) -> Robot {
        Robot::from_urdf(&self.urdf()).unwrap()
    }
}

fn link(text: &mut String, name: &str, mass: f64, shapes: &str) {
    let moment = 0.01 * mass;
    writeln!(
        text,
        "<link name=\"{name}\"><inertial><mass value=\"{mass}\"/><inertia ixx=\"{moment}\" iyy=\"{moment}\" izz=\"{moment}\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/>\
         </inertial>{shapes}</link>"
    )
    .unwrap();
}

/// A joint about `axis`, fixed without one.
fn joint(text: &mut String, name: &str, (parent, child): (&str, &str), (xyz, yaw): (&str, &str), axis: &str) {
    let kind = if axis.is_empty() { "fixed" } else { "revolute" };
    let moves = format!("<axis xyz=\"{axis}\"/><limit lower=\"-2.4\" upper=\"2.4\" velocity=\"9\" effort=\"99\"/>");
    let moves = if axis.is_empty() { "" } else { &moves };
    writeln!(
        text,
        "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{child}\"/><origin xyz=\"{xyz}\" rpy=\"0 0 {yaw}\"/>{moves}</joint>"
    )
    .unwrap();
}

fn derived(chain: &Chain) -> Result<LegSolver> {
    Ok(Arc::new(Options::new().derive(chain)?.solver()))
}

fn footing(robot: &Robot, links: [Option<&str>; 2]) -> Result<Footing> {
    Footing::find(robot, &Meshes::default(), links, None)
}

fn walk(walker: &Walker, goal: (f64, f64, Option<f64>)) -> Result<Walk> {
    walk_by(walker, &walker.gaits[0].1, goal)
}

fn walk_by(walker: &Walker, defaults: &GaitDefaults, (x, y, heading): (f64, f64, Option<f64>)) -> Result<Walk> {
    let biped = &walker.biped;
    let request = |height, ease| {
        let gait = defaults.clone().eased(ease);
        let measures = Measures { length: gait.length, half_width: gait.half_width(biped), most_turn: gait.most_turn };
        let route = Route::towards(&Point2::new(x, y), heading, Side::Left, &measures)?;
        Ok(gait.from_upright(biped).request(biped, route, height))
    };
    plan_at((biped, &walker.legs), None, &defaults.hip_heights, request, &Watch::none())
}

/// The pose of a link of the description in each row of the walk's trajectory, by its forward kinematics.
fn poses(robot: &Robot, walker: &Walker, walk: &Walk, link: &str) -> Vec<Pose> {
    let (model, trajectory) = (Model::new(robot).unwrap(), walk.trajectory(&walker.biped));
    let (body, base_from_link) = model.link(robot.link(link).unwrap());
    let value = |row: usize, name: &str| {
        let column = trajectory.joints.iter().position(|joint| joint.name == name);
        column.map_or(0.0, |column| trajectory.q[row][column])
    };
    let row = |row: usize| {
        let q: Vec<f64> = model.joints().iter().map(|joint| value(row, &joint.name)).collect();
        model.place(&trajectory.base[row], &q).unwrap().motion(body) * base_from_link
    };
    (0..trajectory.times.len()).map(row).collect()
}

/// Checks that the description itself, moved by the trajectory, has the bottoms of its soles where the walk says.
fn feet_are_where_the_walk_says(description: &Description, walker: &Walker, walk: &Walk) {
    let robot = description.robot();
    let last = if description.rolls { "foot" } else { "ankle" };
    for (side, name) in description.names.into_iter().enumerate() {
        let poses = poses(&robot, walker, walk, &format!("{name}{last}"));
        for (pose, reference) in poses.iter().zip(&walk.references) {
            let wanted = reference.world_from_soles[side];
            // The bottom of the box is 5 cm below the ankle.
            let off = pose.translation.vector - wanted.translation.vector - Vector3::z() * 0.05;
            assert!(off.norm() < 1e-6, "{name}: {off:?}");
            let ahead = (pose.rotation * Vector3::x()).angle(&(wanted.rotation * Vector3::x()));
            assert!(ahead < 1e-6, "{name}: {ahead}");
        }
    }
}

fn plain() -> &'static Walker {
    static WALKER: LazyLock<Walker> =
        LazyLock::new(|| footing(&PLAIN.robot(), NO_LINKS).unwrap().walker(derived).unwrap());
    &WALKER
}

#[test]
fn soles_are_the_ends_of_the_lowest_mirrored_limbs() {
    for names in [["l_", "r_"], ["left_", "right_"], ["a_", "b_"], ["b_", "a_"]] {
        let robot = Description { names, ..PLAIN }.robot();
        let found = footing(&robot, NO_LINKS).unwrap();
        // Where the names say nothing, the boxes do, which reach further forward.
        assert_eq!(found.soles(), names.map(|name| format!("{name}foot")), "{names:?}");
    }
}

/// iCub's feet have frames of a skin that are a little lower than those of the soles, and not mirrored.
#[test]
fn of_low_frames_the_one_below_the_ankle_is_the_sole() {
    let mut text = PLAIN.urdf().replace("</robot>\n", "");
    for (name, aside) in [("l_", 0.02), ("r_", 0.03)] {
        let frames = [("skin", format!("0.08 {aside} -0.05")), ("sole", "0 0 -0.045".to_owned())];
        for (frame, at) in frames {
            let child = format!("{name}{frame}");
            writeln!(text, "<link name=\"{child}\"/>").unwrap();
            joint(&mut text, &format!("{child}_fixed"), (&format!("{name}foot"), &child), (&at, "0"), "");
        }
    }
    let robot = Robot::from_urdf(&(text + "</robot>\n")).unwrap();
    assert_eq!(footing(&robot, NO_LINKS).unwrap().soles(), ["l_sole", "r_sole"]);
}

#[test]
fn exchanged_labels_are_put_right_by_the_shapes() {
    let robot = PLAIN.robot();
    let found = footing(&robot, [Some("r_foot"), Some("l_foot")]).unwrap();
    assert_eq!(found.soles(), ["l_foot", "r_foot"]);
    assert!(found.notes()[0].contains("`l_foot` is the left sole"), "{:?}", found.notes());
    let found = footing(&robot, [None, Some("r_foot")]).unwrap();
    assert_eq!(found.soles(), ["l_foot", "r_foot"]);
    assert!(found.notes().is_empty());
}

#[test]
fn links_that_are_no_soles_are_refused_with_the_options() {
    let robot = PLAIN.robot();
    for (links, reason) in [
        ([Some("l_foot"), Some("l_ankle")], "moves both feet"),
        ([Some("base"), Some("r_foot")], "there are 0 joints"),
        ([Some("l_shoe"), Some("r_foot")], "no link `l_shoe`"),
    ] {
        let error = footing(&robot, links).unwrap_err();
        assert!(error.to_string().contains(reason), "{error}");
    }
    let one_leg = Robot::from_urdf(&PLAIN.urdf().replace("0.05 -0.1 -0.1", "0.4 -0.3 0.2")).unwrap();
    let error = footing(&one_leg, NO_LINKS).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::MissingKey);
    assert!(error.to_string().contains("--left and --right"), "{error}");
}

#[test]
fn hips_ahead_of_the_root_walk_and_turn() {
    let walk = walk(plain(), (0.4, 0.0, Some(0.3))).unwrap();
    feet_are_where_the_walk_says(&PLAIN, plain(), &walk);
    let feet = walk.schedule.route.end();
    assert!((feet[0].middle(&feet[1]).x - 0.4).abs() < 1e-9);
}

#[test]
fn a_goal_at_the_start_is_a_plan_of_standing() {
    let walk = walk(plain(), (0.0, 0.0, None)).unwrap();
    assert!(
        walk.schedule.route.steps.is_empty() && walk.references.iter().all(|reference| reference.stands == [true; 2])
    );
    feet_are_where_the_walk_says(&PLAIN, plain(), &walk);
}

#[test]
fn a_root_with_x_backward_and_a_waist_walks_the_same() {
    let description = Description { backward: true, waist: true, ..PLAIN };
    let found = footing(&description.robot(), NO_LINKS).unwrap();
    assert!(found.notes().iter().any(|note| note.contains("`mount` is between the root and both legs")));
    let walker = found.walker(derived).unwrap();
    let walk = walk(&walker, (0.3, 0.0, None)).unwrap();
    feet_are_where_the_walk_says(&description, &walker, &walk);
}

#[test]
fn a_leg_of_five_joints_holds_position_heading_and_pitch() {
    let description = Description { rolls: false, aside: 0.058, ..PLAIN };
    let walker = footing(&description.robot(), NO_LINKS).unwrap().walker(derived).unwrap();
    // The centre of mass moves by 11 mm to the sides, and the torso more than that, because the lifted leg does not.
    let little = GaitDefaults { amplitude: 0.011, margin: 0.002, ..walker.gaits[0].1.clone() };
    let walk = walk_by(&walker, &little, (0.3, 0.0, Some(0.2))).unwrap();
    feet_are_where_the_walk_says(&description, &walker, &walk);
}

#[test]
fn soles_that_would_tilt_are_refused() {
    let wide = Description { rolls: false, ..PLAIN };
    let walker = footing(&wide.robot(), NO_LINKS).unwrap().walker(derived).unwrap();
    let defaults = walker.gaits[0].1.clone();
    let low = GaitDefaults { hip_heights: vec![defaults.hip_heights[6]].into(), ..defaults };
    let error = walk_by(&walker, &low, (0.3, 0.0, None)).unwrap_err();
    assert!(error.kind() == ErrorKind::BadValue && error.message().contains("sole would tilt by"), "{error}");
}

#[test]
fn a_foot_without_a_shape_gets_one_in_walk_and_export() {
    let robot = Description { boxes: false, ..PLAIN }.robot();
    let found = footing(&robot, NO_LINKS).unwrap();
    assert!(found.notes()[0].contains("--outline"), "{:?}", found.notes());
    let shod = found.shod(&robot).unwrap();
    let walker = found.walker(derived).unwrap();
    for (side, name) in ["l_foot", "r_foot"].into_iter().enumerate() {
        let shapes = &shod.links()[shod.link(name).unwrap()].collisions;
        let points: Vec<_> = shapes[0].solid.points().iter().map(|point| shapes[0].pose() * point).collect();
        let lowest = points.iter().map(|point| point.z).fold(f64::INFINITY, f64::min);
        assert!((lowest + walker.biped.feet[side].ankle_height).abs() < 1e-12);
        let front = points.iter().map(|point| point.x).fold(f64::NEG_INFINITY, f64::max);
        let corners = walker.biped.feet[side].corners.iter().map(|corner| corner.x);
        assert!((front - corners.fold(f64::NEG_INFINITY, f64::max)).abs() < 1e-12);
    }
}

/// The feet of the Berkeley Humanoid point up by 10 degrees at zero.
#[test]
fn soles_that_are_pitched_at_zero_stand_flat() {
    let origin = "<origin xyz=\"0.03 0 -0.04\"/>";
    let pitched = "<origin xyz=\"0.03 0 -0.04\" rpy=\"0 -0.17 0\"/>";
    let robot = Robot::from_urdf(&PLAIN.urdf().replace(origin, pitched)).unwrap();
    let found = footing(&robot, NO_LINKS).unwrap();
    assert!(found.notes()[0].contains("pitched by -9.7 deg"), "{:?}", found.notes());
    let walker = found.walker(derived).unwrap();
    let walk = walk(&walker, (0.3, 0.0, Some(0.2))).unwrap();
    for (side, name) in ["l_foot", "r_foot"].into_iter().enumerate() {
        let shape = &robot.links()[robot.link(name).unwrap()].collisions[0];
        for (pose, reference) in poses(&robot, &walker, &walk, name).iter().zip(&walk.references) {
            let on_floor = |point: &Point3<f64>| (pose * shape.pose() * point).z.abs() < 1e-6;
            let touching = shape.solid.points().iter().filter(|point| on_floor(point)).count();
            assert!(!reference.stands[side] || touching == 4, "{name}: {touching} corners touch the floor");
        }
    }
}

/// The same leg for a walker that does not know how it is solved.
#[derive(Debug)]
struct Plain(LegSolver);

impl InverseKinematics for Plain {
    fn solve(&self, target: &Target, given: &[f64], out: &mut Vec<Solution>) -> Result<()> {
        self.0.solve(target, given, out)
    }
}

/// Legs in general position are solved by eigenvalues. Newton's method then finds the same walk, up to the tolerance of the centre of mass.
#[test]
fn legs_that_are_solved_by_eigenvalues_follow_the_nearest_solution() {
    // No axes meet, and none are parallel.
    let tilted = |line: &str| match line {
        knee if knee.contains("knee_joint") => knee.replace("0 1 0", "0.01 1 -0.02"),
        ankle if ankle.contains("ankle_joint") => ankle.replace("0 1 0", "0.02 1 0.03"),
        other => other.replace("axis xyz=\"1 0 0\"", "axis xyz=\"1 0.03 0.02\""),
    };
    let text: String = PLAIN.urdf().lines().map(tilted).collect();
    let text = text.replace("xyz=\"0 0 0\"", "xyz=\"0.02 0.005 -0.01\"");
    let robot = Robot::from_urdf(&text).unwrap();
    let found = footing(&robot, NO_LINKS).unwrap();
    let walker = found.walker(|chain| derived(chain).inspect(|leg| assert!(leg.uses_eigenvalues()))).unwrap();
    let all = found.walker(|chain| Ok(Arc::new(Plain(derived(chain)?)))).unwrap();
    let preview = walker.gait("preview").unwrap();
    let [walk, other] = [&walker, &all].map(|walker| walk_by(walker, preview, (0.3, 0.1, Some(0.3))).unwrap());
    assert_eq!(walk.schedule, other.schedule);
    for (sample, (posture, same)) in walk.motion.postures.iter().zip(&other.motion.postures).enumerate() {
        let off = posture.q.iter().zip(&same.q).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 5e-6, "sample {sample}: {off}");
        // Some samples are compared with all solutions.
        for (side, foot) in [Side::Left, Side::Right].into_iter().zip(&walker.biped.feet).filter(|_| sample % 25 == 0) {
            let torso_from_sole =
                posture.world_from_torso.inv_mul(&walk.references[sample].world_from_soles[side as usize]);
            let solutions = walker.legs.solutions(side, &torso_from_sole);
            let away = |q: &Vec<f64>| {
                q.iter().zip(&foot.joints).map(|(q, joint)| (q - posture.q[*joint]).abs()).fold(0.0, f64::max)
            };
            let nearest = solutions.iter().map(away).fold(f64::INFINITY, f64::min);
            assert!(
                solutions.len() >= 2 && nearest < 1e-11,
                "sample {sample}: {} solutions, {nearest}",
                solutions.len()
            );
        }
    }
}

#[test]
fn weak_hips_walk_with_shorter_steps_that_turn_less() {
    let preview = |walker: &Walker| walker.gaits.iter().find(|(name, _)| *name == "preview").unwrap().1.clone();
    let strong = preview(plain());
    // Three quarters of what holds 16.8 kg on a foot 0.1 m from the middle: half of what full steps need.
    let effort = format!("effort=\"{}\"", 0.75 * 16.8 * GRAVITY * 0.1);
    let robot = Robot::from_urdf(&PLAIN.urdf().replace("effort=\"99\"", &effort)).unwrap();
    let weak = preview(&footing(&robot, NO_LINKS).unwrap().walker(derived).unwrap());
    assert!((weak.length / strong.length - 0.5).abs() < 1e-9, "{} m of {} m", weak.length, strong.length);
    assert!((weak.most_turn / strong.most_turn - 0.5).abs() < 1e-9);
    assert_eq!(weak.period, strong.period);
}

#[test]
fn wide_hips_walk_with_feet_nearer_to_each_other() {
    let wide = Description { aside: 0.2, ..PLAIN };
    let walker = footing(&wide.robot(), NO_LINKS).unwrap().walker(derived).unwrap();
    let preview = &walker.gaits.iter().find(|(name, _)| *name == "preview").unwrap().1;
    // 0.26 of the legs' length of 0.6 m.
    assert!((preview.half_width(&walker.biped) - 0.156).abs() < 1e-9);
    assert_eq!(preview.amplitude, preview.half_width(&walker.biped));
    let walk = walk_by(&walker, preview, (0.2, 0.0, None)).unwrap();
    feet_are_where_the_walk_says(&wide, &walker, &walk);
}
