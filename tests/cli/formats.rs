//! Robots in xacro, Denavit-Hartenberg tables in CSV, and calibrations of Universal Robots, as given to commands.

use std::fs;

use tempfile::tempdir;

use super::{refused, succeed, text};

const XACRO: &str = r#"<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="length" default="0.5"/>
  <xacro:include filename="$(find parts)/hinge.xacro"/>
  <link name="base"/>
  <xacro:hinge name="shoulder" parent="base" child="upper" x="0"/>
  <xacro:hinge name="elbow" parent="upper" child="lower" x="$(arg length)"/>
</robot>
"#;
const HINGE: &str = r#"<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="hinge" params="name parent child x">
    <link name="${child}"/>
    <joint name="${name}" type="continuous">
      <parent link="${parent}"/> <child link="${child}"/> <origin xyz="${x} 0 0"/> <axis xyz="0 0 1"/>
    </joint>
  </xacro:macro>
</robot>
"#;

#[test]
fn a_description_in_xacro_takes_packages_and_arguments() {
    let folder = tempdir().unwrap();
    let (file, parts) = (folder.path().join("arm.urdf.xacro"), folder.path().join("elsewhere"));
    fs::create_dir(&parts).unwrap();
    fs::write(&file, XACRO).unwrap();
    fs::write(parts.join("hinge.xacro"), HINGE).unwrap();
    let package = format!("parts={}", text(&parts));
    let q = ["--q", "0,0"];
    let found = |more: &[&str]| {
        let options = [&["fk", text(&file), q[0], q[1], "--package", &package], more].concat();
        succeed(&options).lines().find(|line| line.contains("position")).unwrap().to_owned()
    };
    assert!(found(&[]).contains("0.500000000"));
    assert!(found(&["--arg", "length:=0.25"]).contains("0.250000000"));
    let error = refused(&["fk", text(&file), q[0], q[1]]);
    assert!(error.contains("parts") && error.contains("--package") && error.contains("line 3"), "{error}");
}

#[test]
fn a_table_in_csv_is_derived() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("arm.csv");
    let table = "# convention: standard\n# task: position\nname,theta [deg],d,a,alpha [deg]\nyaw,q1,0.2,0,90\nshoulder,q2,0,0.3,0\nelbow,q3,0,0.25,0\n";
    fs::write(&file, table).unwrap();
    succeed(&["derive", text(&file), "--quiet"]);
    let solver = folder.path().join("arm");
    // The arm is straight along x at zero: 0.3 + 0.25 from the axis, 0.2 high.
    let answer = succeed(&["solve", text(&solver), "--target", "0.4,0.1,0.35"]);
    assert!(answer.contains("4 solutions"), "{answer}");
    fs::write(&file, table.replace("0.25,0\n", "0.25\n")).unwrap();
    assert!(refused(&["info", text(&file)]).contains("arm.csv: line 6"));
}

#[test]
fn a_calibration_is_a_robot() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("calibration.yaml");
    let joint = |name: &str, x: &str| {
        format!("  {name}:\n    x: {x}\n    y: 0\n    z: 0.1\n    roll: 0\n    pitch: 0\n    yaw: 0\n")
    };
    let joints =
        ["shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3"].map(|name| joint(name, "0.0123"));
    fs::write(&file, format!("kinematics:\n{}", joints.concat())).unwrap();
    let pose = succeed(&["fk", text(&file), "--tip", "tool0", "--q", "0,0,0,0,0,0"]);
    // Six times the same step, in a frame that is turned by half a turn about z.
    assert!(pose.contains("-0.073800000") && pose.contains("0.600000000"), "{pose}");
}
