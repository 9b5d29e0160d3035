//! Masses and shapes compared with another reader. A robot written as URDF is equal when it is read again.

use groebot_robot::model::{Robot, Solid};
use groebot_robot::robots;
use nalgebra::Vector3;
use num_traits::ToPrimitive;

use super::robot::NAO;

/// All features of a link, a joint and a robot.
pub const RICH: &str = r#"<robot name="rich">
  <material name="blue"><color rgba="0 0 1 0.5"/></material>
  <link name="a">
    <inertial>
      <origin xyz="0.01 -0.02 0.3" rpy="0.1 1.2345 -0.7"/>
      <mass value="1.25"/>
      <inertia ixx="0.1" ixy="0.001" ixz="-0.002" iyy="0.12" iyz="6.1e-17" izz="0.09"/>
    </inertial>
    <visual name="hull">
      <origin xyz="0 0 0.1" rpy="0 0.5 0"/>
      <geometry><mesh filename="package://rich/a.stl" scale="0.001 0.001 0.001"/></geometry>
      <material name="blue"/>
    </visual>
    <visual><geometry><box size="0.1 0.2 0.3"/></geometry><material name="own"><color rgba="1 0 0 1"/></material></visual>
    <collision><geometry><cylinder radius="0.05" length="0.4"/></geometry></collision>
    <collision><origin xyz="1 0 0"/><geometry><sphere radius="0.1"/></geometry></collision>
    <collision><geometry><capsule radius="0.02" length="0.2"/></geometry></collision>
    <collision><geometry><plane/></geometry></collision>
  </link>
  <link name="b"/>
  <link name="c"><inertial><mass value="0.5"/></inertial></link>
  <joint name="ab" type="revolute">
    <parent link="a"/><child link="b"/>
    <origin xyz="0.1 0 1e-17" rpy="0 0 0.785398"/>
    <axis xyz="0 0.70711 0.70711"/>
    <limit lower="-1.5" upper="2" effort="30" velocity="4.5"/>
    <dynamics damping="0.7" friction="0.2"/>
    <drake:rotor_inertia value="0.0001"/>
    <drake:gear_ratio value="100"/>
  </joint>
  <joint name="bc" type="prismatic">
    <parent link="b"/><child link="c"/>
    <origin quat_xyzw="0 0 0.6 0.8"/>
    <axis xyz="1 0 0"/>
    <limit lower="0" upper="0.1" effort="5" velocity="0.3"/>
    <mimic joint="ab" multiplier="0.05" offset="0.01"/>
  </joint>
  <transmission name="both">
    <type>transmission_interface/SimpleTransmission</type>
    <joint name="ab"><mechanicalReduction>50</mechanicalReduction></joint>
    <joint name="bc"/>
    <actuator name="actuator"/>
  </transmission>
  <transmission name="one"><joint name="ab"/><actuator name="actuator2"/></transmission>
</robot>"#;

/// Same robot, but without features that the other reader does not support.
fn plain() -> String {
    let known = |line: &&str| !line.contains("<plane/>") && !line.contains("drake:");
    let lines: Vec<&str> = RICH.lines().filter(known).collect();
    let inertia = "<inertia ixx=\"0\" ixy=\"0\" ixz=\"0\" iyy=\"0\" iyz=\"0\" izz=\"0\"/></inertial></link>";
    lines.join("\n").replace("<mass value=\"0.5\"/></inertial></link>", &format!("<mass value=\"0.5\"/>{inertia}"))
}

#[test]
fn another_reader_finds_the_same_masses_shapes_and_limits() {
    let (ours, theirs) = (Robot::from_urdf(RICH).unwrap(), urdf_rs::read_from_string(&plain()).unwrap());
    let near = |a: &[f64], b: &[f64]| a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15);
    for (a, b) in ours.links().iter().zip(&theirs.links) {
        if let Some(mass) = &a.mass {
            let double = |x: &groebot_algebra::number::BigRational| x.to_f64().unwrap();
            let [xx, xy, xz, yy, yz, zz] = mass.moments.each_ref().map(double);
            let i = &b.inertial.inertia;
            assert!(near(&[xx, xy, xz, yy, yz, zz], &[i.ixx, i.ixy, i.ixz, i.iyy, i.iyz, i.izz]), "{}", a.name);
            assert!(near(&[double(&mass.mass)], &[b.inertial.mass.value]));
            assert!(near(&mass.origin.angles(), &b.inertial.origin.rpy.0));
            assert!(near(&mass.origin.placement.origin.each_ref().map(double), &b.inertial.origin.xyz.0));
        }
        assert_eq!((a.visuals.len(), a.collisions.len()), (b.visual.len(), b.collision.len()));
        let own = a.visuals.iter().map(|shape| (shape, None)).chain(a.collisions.iter().map(|shape| (shape, Some(()))));
        let others = b.visual.iter().map(|shape| (&shape.origin, &shape.geometry));
        let others = others.chain(b.collision.iter().map(|shape| (&shape.origin, &shape.geometry)));
        for ((shape, _), (origin, geometry)) in own.zip(others) {
            assert!(near(&shape.xyz, &origin.xyz.0) && near(&shape.rpy, &origin.rpy.0));
            use urdf_rs::Geometry as Other;
            match (&shape.solid, geometry) {
                (Solid::Box { size }, Other::Box { size: other }) => assert!(near(size, &other.0)),
                (Solid::Cylinder { radius, length }, Other::Cylinder { radius: r, length: l })
                | (Solid::Capsule { radius, length }, Other::Capsule { radius: r, length: l }) => {
                    assert!(near(&[*radius, *length], &[*r, *l]));
                }
                (Solid::Sphere { radius }, Other::Sphere { radius: r }) => assert_eq!(radius, r),
                (Solid::Mesh { path, scale }, Other::Mesh { filename, scale: s }) => {
                    assert_eq!(path, filename);
                    assert!(near(scale, &s.unwrap().0));
                }
                (solid, other) => panic!("{solid} is not {other:?}"),
            }
        }
    }
    for (a, b) in ours.joints().iter().zip(&theirs.joints) {
        assert_eq!((a.speed, a.effort), (Some(b.limit.velocity), Some(b.limit.effort)), "{}", a.name);
        let dynamics = b.dynamics.as_ref().map_or((0.0, 0.0), |own| (own.damping, own.friction));
        assert_eq!((a.damping, a.friction), dynamics, "{}", a.name);
    }
    assert_eq!(ours.joints()[0].armature, 1.0, "0.0001 kg m^2 by a gear of 100");
    assert_eq!(ours.links()[0].visuals[0].colour, Some([0.0, 0.0, 1.0, 0.5]));
    assert_eq!(ours.links()[0].visuals[1].colour, Some([1.0, 0.0, 0.0, 1.0]));
    assert_eq!(ours.actuators().len(), 1, "that of one joint is its own");
    assert_eq!(ours.actuators()[0].joints, [("ab".to_owned(), 50.0), ("bc".to_owned(), 1.0)]);
}

/// An inertia in a rotated frame, converted to the link: the given tensor, rotated by nalgebra.
#[test]
fn an_inertia_is_turned_into_its_link() {
    let robot = Robot::from_urdf(RICH).unwrap();
    let link = &robot.links()[0];
    let turn = nalgebra::Rotation3::from_euler_angles(0.1, 1.2345, -0.7);
    let reported = nalgebra::Matrix3::new(0.1, 0.001, -0.002, 0.001, 0.12, 6.1e-17, -0.002, 6.1e-17, 0.09);
    let inertia = link.inertia();
    assert!((inertia.rotational() - turn * reported * turn.transpose()).amax() < 1e-16);
    assert!((inertia.centre_of_mass().coords - Vector3::new(0.01, -0.02, 0.3)).amax() < 1e-17);
}

/// Writing and reading again: lines and notes are those of the new text, and a rotation given by a quaternion is given
/// by angles.
#[test]
fn a_robot_is_the_same_when_it_is_written_and_read() {
    let texts = [RICH, NAO].map(|text| Robot::from_urdf(text).unwrap());
    for robot in texts.into_iter().chain([robots::nao_v5(), robots::rh0(), robots::teo()]) {
        let again = Robot::from_urdf(&robot.to_urdf()).unwrap();
        assert_eq!(again.to_urdf(), Robot::from_urdf(&again.to_urdf()).unwrap().to_urdf());
        assert_eq!((again.name(), again.actuators()), (robot.name(), robot.actuators()));
        for (a, b) in again.links().iter().zip(robot.links()) {
            assert_eq!((&a.name, &a.visuals, &a.collisions), (&b.name, &b.visuals, &b.collisions), "{}", a.name);
            assert_eq!(
                a.mass.as_ref().map(|mass| (&mass.mass, &mass.moments)),
                b.mass.as_ref().map(|mass| (&mass.mass, &mass.moments))
            );
            assert!((a.inertia().generalised() - b.inertia().generalised()).amax() < 1e-16);
        }
        for (a, b) in again.joints().iter().zip(robot.joints()) {
            let reported = |joint: &groebot_robot::model::Joint| {
                let joint = joint.clone();
                (joint.name, joint.kind, joint.parent, joint.child, joint.axis, joint.limits, joint.speed, joint.mimic)
            };
            assert_eq!(reported(a), reported(b));
            assert_eq!((a.effort, a.damping, a.friction, a.armature), (b.effort, b.damping, b.friction, b.armature));
            assert_eq!(a.origin.placement.origin, b.origin.placement.origin, "{}", a.name);
            assert!((a.origin.pose().to_homogeneous() - b.origin.pose().to_homogeneous()).amax() < 1e-15, "{}", a.name);
        }
    }
}

#[test]
fn faults_of_masses_are_refused_and_faults_of_shapes_reported() {
    let cases = [
        ("<mass value=\"1.25\"/>", "", "link `a`: <inertial> has no <mass"),
        ("<mass value=\"1.25\"/>", "<mass/>", "link `a`: <mass> has no `value`"),
        ("ixx=\"0.1\"", "ixx=\"nan\"", "link `a`: <inertia> has `ixx` = \"nan\""),
        ("<inertial>\n", "<inertal>\n", "link `a`"),
        ("velocity=\"4.5\"", "velocity=\"fast\"", "joint `ab`: <limit> has `velocity` = \"fast\""),
        ("<joint name=\"bc\"/>", "<joint name=\"cd\"/>", "actuator `actuator`: the robot has no joint `cd`"),
    ];
    for (from, to, words) in cases {
        let text = RICH.replacen(from, to, 1).replacen(
            "</inertial>",
            if to.contains("inertal") { "</inertal>" } else { "</inertial>" },
            1,
        );
        let error = Robot::from_urdf(&text).unwrap().check().unwrap_err();
        assert!(error.message().contains(words), "{error}");
        assert!(error.place().line.is_some(), "{error}");
    }
    let doubts = |from: &str, to: &str| Robot::from_urdf(&RICH.replacen(from, to, 1)).unwrap().doubts();
    let heavy = doubts("izz=\"0.09\"", "izz=\"0.9\"");
    assert!(heavy[0].starts_with("link `a`: inertia") && heavy[0].contains("physically impossible"), "{heavy:?}");
    for (from, to, words) in [
        ("size=\"0.1 0.2 0.3\"", "size=\"0.1 0.2\"", "<box> has `size`"),
        ("radius=\"0.05\" ", "", "<cylinder> has no `radius`"),
        ("<geometry><sphere radius=\"0.1\"/></geometry>", "", "<collision> has no <geometry>"),
    ] {
        let reported = doubts(from, to);
        assert!(
            reported.iter().any(|doubt| doubt.starts_with("link `a`: omitted: ") && doubt.contains(words)),
            "{reported:?}"
        );
    }
}
