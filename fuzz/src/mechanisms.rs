//! Descriptions of robots, chains and equations, tasks, and meshes.

use std::fs;
use std::path::Path;

use groebot::derive::coupled::CoupledChains;
use groebot::derive::{Ends, InputFile, Source, System};
use groebot::document::decode_xml;
use groebot::kinematics::Chain;
use groebot::limits::XML_BYTES;
use groebot::model::xacro::expand;
use groebot::model::{Meshes, ReadOptions, Robot, Solid};
use tempfile::tempdir;

use super::{Target, read, text};

pub(super) const TARGETS: [Target; 13] = [
    Target { name: "chain_toml", about: "chains, `kinematics::Chain::from_toml`", run: chain_toml, damaged: 200 },
    Target { name: "dh_toml", about: "Denavit-Hartenberg tables", run: dh_toml, damaged: 100 },
    Target { name: "system_toml", about: "equations of a mechanism, `derive::System`", run: system_toml, damaged: 200 },
    Target { name: "coupled_toml", about: "coupled chains", run: coupled_toml, damaged: 200 },
    Target { name: "task_toml", about: "tasks of a mechanism, `derive::Ends`", run: task_toml, damaged: 200 },
    Target { name: "robot_toml", about: "robots in TOML, written as URDF and MJCF", run: robot_toml, damaged: 200 },
    Target {
        name: "urdf",
        about: "robots in URDF, in any encoding, written as URDF and MJCF",
        run: urdf,
        damaged: 100,
    },
    Target { name: "xacro", about: "descriptions in xacro, `model::xacro::expand`", run: xacro, damaged: 200 },
    Target { name: "mjcf", about: "robots in MJCF, written in all formats", run: mjcf, damaged: 100 },
    Target { name: "sdf", about: "robots in SDF, written in all formats", run: sdf, damaged: 100 },
    Target { name: "input", about: "any input file of `derive`, `derive::Source`", run: input, damaged: 100 },
    Target { name: "mesh", about: "STL, `model::Meshes::triangles`", run: mesh, damaged: 200 },
    Target { name: "mesh_path", about: "names of meshes, `model::Meshes::find`", run: mesh_path, damaged: 200 },
];

fn chain_toml(bytes: &[u8]) {
    let _ = read(Chain::from_toml(&text(bytes)));
}

fn dh_toml(bytes: &[u8]) {
    let _ = read(Chain::from_dh_toml(&text(bytes)));
}

fn system_toml(bytes: &[u8]) {
    let _ = read(System::from_toml(&text(bytes)));
}

/// Chains in separate files are searched where there are none.
fn coupled_toml(bytes: &[u8]) {
    let _ = read(CoupledChains::from_toml(&text(bytes), Path::new("/nonexistent")));
}

/// The text of a task is read as the same task.
fn task_toml(bytes: &[u8]) {
    if let Some(ends) = read(Ends::from_toml(&text(bytes))) {
        assert_eq!(Ends::from_toml(&ends.to_toml()), Ok(ends));
    }
}

fn robot_toml(bytes: &[u8]) {
    if let Some(robot) = read(Robot::from_toml(&text(bytes))) {
        write(&robot);
    }
}

fn urdf(bytes: &[u8]) {
    let Some(decoded) = read(decode_xml(bytes)) else { return };
    let Some(robot) = read(Robot::from_urdf(&decoded.text)) else { return };
    for tip in robot.leaves() {
        let _ = read(robot.chain(None, Some(tip)));
        if let Some(path) = read(robot.path(None, Some(tip))) {
            let _ = robot.notes(&path);
        }
    }
    write(&robot);
}

/// The texts before and after a line `---`: a description, and the file `part.xacro`, which is also `part.yaml`. An expansion is XML without xacro.
fn xacro(bytes: &[u8]) {
    let folder = tempdir().expect("a folder for files");
    let input = text(bytes);
    let (robot, part) = input.split_once("\n---\n").unwrap_or((&input, "<robot/>"));
    for (name, text) in [("robot.xacro", robot), ("part.xacro", part), ("part.yaml", part)] {
        fs::write(folder.path().join(name), text).expect("a file to read");
    }
    let options = ReadOptions::new().argument("given", "1").package("here", folder.path());
    let Some(expanded) = read(expand(&folder.path().join("robot.xacro"), &options)) else { return };
    assert!(expanded.text.len() as u64 <= XML_BYTES);
    let _ = read(expanded.robot());
}

fn mjcf(bytes: &[u8]) {
    if let Some(robot) = read(Robot::from_mjcf(&text(bytes), None)) {
        write(&robot);
        write_sdf(&robot);
    }
}

fn sdf(bytes: &[u8]) {
    if let Some(robot) = read(Robot::from_sdf(&text(bytes), None)) {
        write(&robot);
        write_sdf(&robot);
    }
}

/// A robot without faults, and without joints that SDF lacks, is written as SDF and read without faults.
fn write_sdf(robot: &Robot) {
    if read(robot.check()).is_none() {
        return;
    }
    let Some(written) = read(robot.to_sdf(&mut Vec::new())) else { return };
    let again = Robot::from_sdf(&written, None).and_then(|again| again.check());
    again.unwrap_or_else(|error| panic!("{error}\n{written}"));
}

/// A robot without faults is written as URDF and MJCF. The URDF is read without faults and written unchanged.
fn write(robot: &Robot) {
    if read(robot.check()).is_none() {
        return;
    }
    // The remark with the source is not read.
    let text =
        |robot: &Robot| robot.to_urdf().lines().filter(|line| !line.starts_with("<!--")).collect::<Vec<_>>().join("\n");
    let written = text(robot);
    let again = Robot::from_urdf(&written).and_then(|again| again.check().map(|()| again));
    let again = again.unwrap_or_else(|error| panic!("{error}\n{written}"));
    assert_eq!(text(&again), written);
    let _ = robot.to_mjcf(&Meshes::default(), &mut Vec::new());
}

/// A file of any kind, and its equations.
fn input(bytes: &[u8]) {
    let folder = tempdir().expect("a folder for a file");
    let file = folder.path().join("input");
    fs::write(&file, bytes).expect("a file to read");
    if let Some(input) = read(InputFile::read(&file)) {
        let _ = read(Source::of(input, &Ends::default()));
    }
}

/// Triangles have finite vertices with valid indices.
fn mesh(bytes: &[u8]) {
    let folder = tempdir().expect("a folder for a file");
    fs::write(folder.path().join("mesh.stl"), bytes).expect("a file to read");
    let solid = Solid::Mesh { path: "mesh.stl".to_owned(), scale: [0.001, 1.0, -1e30] };
    if let Some(surface) = read(Meshes::beside(&folder.path().join("robot.urdf")).triangles(&solid)) {
        assert!(surface.points.iter().all(|point| point.iter().all(|x| x.is_finite())));
        assert!(surface.triangles.iter().flatten().all(|corner| (*corner as usize) < surface.points.len()));
    }
}

/// The result is a file. A name that is not an STL file is refused.
fn mesh_path(bytes: &[u8]) {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("robot.urdf");
    let (meshes, path) = (Meshes::beside(&beside), text(bytes).into_owned());
    let found = meshes.find(&path);
    assert!(found.as_ref().is_none_or(|file| file.is_file()), "{found:?}");
    if !found.is_some_and(|file| file.extension().is_some_and(|end| end.eq_ignore_ascii_case("stl"))) {
        let error = meshes.triangles(&Solid::Mesh { path, scale: [1.0; 3] });
        super::check_refusal(&error.expect_err("there is no mesh"));
    }
}
