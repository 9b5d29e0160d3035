//! `groebot export`, and walking with a robot from a file.

use std::fs;

use tempfile::tempdir;

use super::{refused, root, run, succeed, text};

#[test]
fn a_robot_is_exported_and_walks_from_its_file() {
    let folder = tempdir().unwrap();
    let [urdf, mjcf, csv] = ["robot.urdf", "robot.xml", "walk.csv"].map(|name| folder.path().join(name));
    assert_eq!(succeed(&["export", "teo", "--format", "urdf", "-o", text(&urdf)]), "");
    succeed(&["export", text(&urdf), "--format", "mjcf", "-o", text(&mjcf)]);
    assert!(fs::read_to_string(&mjcf).unwrap().contains("<freejoint name=\"root\"/>"));
    assert!(succeed(&["export", "nao_v5", "--format", "mjcf"]).starts_with("<mujoco model=\"nao_v5\">"));

    // The legs are derived by the command; the soles are boxes.
    let soles = ["--left", "l_sole", "--right", "r_sole"];
    let walk =
        |extra: &[&str]| succeed(&[&["walk", text(&urdf)][..], &soles, &["--goal", "0.2,0.05,20"], extra].concat());
    let reported = walk(&["-o", text(&csv)]);
    assert!(
        reported.contains("by preview control") && reported.contains("path            0.206 m, turn 20.0 deg"),
        "{reported}"
    );
    let walk_of = groebot::motion::Trajectory::read_csv(&csv).unwrap();
    assert!(walk_of.joints.iter().any(|joint| joint.name == "LKneePitch") && walk_of.times.len() > 100);
    assert!(walk(&["--gait", "osg"]).contains("by one step goal"));
    let outline = ["--outline", "-0.1,0.12,-0.05,0.06,-0.02"];
    assert!(walk(&outline).contains("by preview control"));
    // The same soles are found without --left and --right, and the outline is the shape of the soles in MJCF.
    assert_eq!(succeed(&["walk", text(&urdf), "--goal", "0.2,0.05,20"]), walk(&[]));
    let exported = succeed(&[&["export", text(&urdf), "--to", "mjcf"][..], &outline].concat());
    assert_eq!(exported.matches("type=\"box\" size=\"0.11 0.055 0.005\"").count(), 2, "{exported}");
    assert!(refused(&["export", "teo", "--to", "x3d", "--left", "l_sole"]).contains("for urdf, mjcf and sdf"));

    // The same soles as triangles of an STL file.
    let box_of = "<box size=\"0.24 0.14 0.01\"/>";
    let described = fs::read_to_string(&urdf).unwrap();
    assert_eq!(described.matches(box_of).count(), 2);
    let corner = |i: usize| {
        [[-0.12, 0.12], [-0.07, 0.07], [-0.005, 0.005]]
            .iter()
            .enumerate()
            .map(|(axis, ends)| ends[i >> axis & 1])
            .map(|x| x.to_string())
            .collect::<Vec<_>>()
            .join(" ")
    };
    let facet = |[a, b, c]: [usize; 3]| {
        let [a, b, c] = [a, b, c].map(corner);
        format!("facet normal 0 0 0\nouter loop\nvertex {a}\nvertex {b}\nvertex {c}\nendloop\nendfacet\n")
    };
    let facets: String = [[0, 1, 2], [1, 2, 3], [4, 5, 6], [5, 6, 7], [0, 4, 1], [2, 6, 3]].map(facet).concat();
    fs::write(folder.path().join("sole.stl"), format!("solid s\n{facets}endsolid s\n")).unwrap();
    fs::write(&urdf, described.replace(box_of, "<mesh filename=\"sole.stl\"/>")).unwrap();
    assert_eq!(walk(&[]), reported);

    // A folder with the description as `0_robot.urdf` and its meshes.
    let inside = folder.path().join("described");
    fs::create_dir(&inside).unwrap();
    fs::copy(&urdf, inside.join("0_robot.urdf")).unwrap();
    fs::copy(folder.path().join("sole.stl"), inside.join("sole.stl")).unwrap();
    let from_folder = succeed(&[&["walk", text(&inside)][..], &soles, &["--goal", "0.2,0.05,20"]].concat());
    assert_eq!(from_folder, reported);
}

#[test]
fn what_cannot_be_walked_or_exported_is_refused() {
    let folder = tempdir().unwrap();
    let urdf = folder.path().join("robot.urdf");
    succeed(&["export", "teo", "--format", "urdf", "-o", text(&urdf)]);
    let described = fs::read_to_string(&urdf).unwrap();
    let walk =
        |left: &str, right: &str| refused(&["walk", text(&urdf), "--left", left, "--right", right, "--steps", "2"]);
    assert!(walk("l_sole", "r_shoe").contains("no link `r_shoe` (did you mean `r_sole`?)"));
    assert!(walk("l_sole", "l_sole").contains("moves both feet"));
    assert!(walk("RootWaist", "r_sole").contains("there are 0 joints between the root and `RootWaist`"));
    fs::write(&urdf, described.replace("<box size=\"0.24 0.14 0.01\"/>", "<mesh filename=\"nowhere.stl\"/>")).unwrap();
    let ran = run(&["walk", text(&urdf), "--steps", "2"]);
    assert!(ran.code == 0 && ran.err.contains("nowhere.stl") && ran.err.contains("--outline"), "{}", ran.err);
    let outline = |numbers: &str| {
        ["walk", text(&urdf), "--left", "l_sole", "--right", "r_sole", "--steps", "2", "--outline", numbers]
            .map(str::to_owned)
    };
    // The sole's plane is at its link, and 2 cm above it: the robot's base is then 2 cm lower.
    let height = |numbers: &str| {
        let reported = succeed(&outline(numbers).each_ref().map(String::as_str));
        let at = reported.split("torso ").nth(1).unwrap().split(' ').next().unwrap();
        at.parse::<f64>().unwrap()
    };
    let lower = height("-0.12,0.12,-0.07,0.07") - height("-0.12,0.12,-0.07,0.07,0.02");
    assert!((lower - 0.02).abs() < 2e-3, "{lower}");
    let three = refused(&outline("-0.1,0.1,-0.05").each_ref().map(String::as_str));
    assert!(three.contains("four or five numbers"), "{three}");
    fs::write(&urdf, described.replace("<mass value=", "<mass value=\"0\" told=")).unwrap();
    assert!(walk("l_sole", "r_sole").contains("it has no mass"));
    assert!(
        refused(&["export", "derivations/ur5/0_chain.toml", "--format", "urdf"])
            .contains("not describe a robot with links")
    );
    assert!(refused(&["export", "c3po", "--format", "urdf"]).contains("c3po"));
    assert_eq!(run(&["export", "teo"]).code, 2, "which format?");
}

const TELESCOPE: &str = "tests/corpus/urdf/telescope.urdf";
const FIGURE: &str = "tests/corpus/vrml/rh0_figure_5_4.wrl";

#[test]
fn motions_robots_and_vrml_become_scenes() {
    let folder = tempdir().unwrap();
    let [csv, json, out] = ["walk.csv", "walk.json", "scene"].map(|name| folder.path().join(name));
    for out in [&csv, &json] {
        succeed(&["walk", "nao", "--steps", "2", "-o", text(out), "--quiet"]);
    }
    let written = |arguments: &[&str]| {
        assert_eq!(succeed(&[&["export"], arguments, &["-o", text(&out)]].concat()), "");
        fs::read(&out).unwrap()
    };
    for motion in [&csv, &json] {
        let glb = written(&[text(motion), "--to", "glb"]);
        assert!(glb.starts_with(b"glTF") && String::from_utf8_lossy(&glb).contains("\"animations\""));
    }
    let still = written(&["nao", "--format", "glb"]);
    assert!(still.starts_with(b"glTF") && !String::from_utf8_lossy(&still).contains("\"animations\""));
    let x3d = succeed(&["export", text(&csv), "--to", "x3d"]);
    assert!(x3d.contains("<X3D profile='Interchange' version='4.0'") && x3d.contains("<TimeSensor DEF='Clock'"));
    let wrl = succeed(&[
        "export",
        text(&csv),
        "--robot",
        text(&root("crates/robot/src/robots/data/nao_v5.toml")),
        "--to",
        "wrl",
    ]);
    assert!(wrl.starts_with("#VRML V2.0 utf8\n") && wrl.contains("TO LTibia.set_rotation"));
    assert!(succeed(&["export", text(&root(FIGURE)), "--to", "x3d"]).contains("<Box size='0.02 0.25 0.02'/>"));
}

#[test]
fn what_is_no_scene_is_refused() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("out");
    let at = |name: &str, content: &str| {
        let file = folder.path().join(name);
        fs::write(&file, content).unwrap();
        file.to_str().unwrap().to_owned()
    };
    let check_message = |arguments: &[&str], words: &str| {
        let error = refused(&[&["export"], arguments, &["-o", text(&out)]].concat());
        assert!(error.contains(words) && !out.exists(), "{error}");
    };
    let head = "# groebot trajectory 1\n# robot: somebody\n";
    let motion = at("motion.csv", &format!("{head}time [s],q:lift [m]\n0,0.1\n1,0.2\n"));
    let telescope = root(TELESCOPE);
    let telescope = text(&telescope);
    check_message(&[&motion, "--to", "glb"], "motion.csv: its robot `somebody` is not a robot of groebot");
    check_message(&[&motion, "--robot", "nao", "--to", "x3d"], "no joint `lift`");
    check_message(&[&motion, "--robot", "c3po", "--to", "x3d"], "there is no such file, and no robot is called `c3po`");
    check_message(
        &[&motion, "--to", "mjcf"],
        "motion.csv: urdf, mjcf and sdf describe a robot, not a motion or a scene",
    );
    check_message(&[text(&root(FIGURE)), "--to", "urdf"], "urdf, mjcf and sdf describe a robot");
    check_message(
        &[telescope, "--robot", "nao", "--to", "glb"],
        "--robot names the robot that moves, but this is not a motion",
    );
    check_message(&[telescope, "--meshes", "--to", "urdf"], "leave them out for urdf, mjcf and sdf");
    check_message(
        &[&at("a.wrl", "#VRML V2.0 utf8\nSphere { }\n"), "--to", "glb"],
        "a.wrl: line 2: `Sphere` is not supported here",
    );
    let not = format!("{head}time [s],q:lift [m]\n0,0.1\n1,NaN\n");
    check_message(
        &[&at("b.csv", &not), "--robot", telescope, "--to", "wrl"],
        "b.csv: line 5: `NaN` is not a finite number",
    );
    let error = refused(&["export", &motion, "--robot", telescope, "--to", "glb"]);
    assert!(error.contains("give its file by -o"), "{error}");
    // Parts of meshes that are not read are reported, and the rest is written.
    let meshed = fs::read_to_string(telescope).unwrap();
    let gone = "<link name=\"mast\"><visual><geometry><mesh filename=\"gone.stl\"/></geometry></visual></link>";
    let meshed = at("meshed.urdf", &meshed.replace("<link name=\"mast\"/>", gone));
    let ran = run(&["export", &motion, "--robot", &meshed, "--meshes", "--to", "glb", "-o", text(&out)]);
    assert!(ran.code == 0 && ran.err.starts_with("warning: the mesh `gone.stl` is not found"), "{}", ran.err);
    assert!(out.exists());
}

/// An MJCF and its export as SDF are robots for the other commands, and a solver's folder keeps an MJCF as URDF.
#[test]
fn mjcf_and_sdf_are_robots() {
    let folder = tempdir().unwrap();
    let [mjcf, sdf, out] = ["arm.xml", "arm.sdf", "arm"].map(|name| folder.path().join(name));
    let arm = "<mujoco model='arm'><compiler angle='radian'/><worldbody><body name='upper' pos='0 0 0.1'>\
        <joint name='a' axis='0 1 0' range='-1 1'/><geom size='0.1'/><body name='fore' pos='0 0 0.3'>\
        <joint name='b' axis='0 1 0' range='-2 2'/><geom size='0.1'/><site name='tool' pos='0 0 0.2'/></body></body></worldbody></mujoco>";
    fs::write(&mjcf, arm).unwrap();
    succeed(&["export", text(&mjcf), "--to", "sdf", "-o", text(&sdf)]);
    let pose = |file| succeed(&["fk", text(file), "--tip", "tool", "--q", "0.3,-0.3"]);
    assert!(pose(&mjcf).contains("0.586600947"), "0.1 + 0.3 cos 0.3 + 0.2 above the floor: {}", pose(&mjcf));
    assert_eq!(pose(&mjcf).lines().last(), pose(&sdf).lines().last());
    assert!(succeed(&["info", text(&sdf)]).contains("world"));
    let task = ["--task", "planar_position", "--plane", "xz"];
    succeed(&[&["derive", text(&mjcf), "--tip", "tool", "--out", text(&out)][..], &task].concat());
    assert!(fs::read_to_string(out.join("0_robot.urdf")).unwrap().contains("<robot name=\"arm\">"));
    succeed(&["check", text(&out)]);
}

/// A damaged mesh is reported with its fault whenever it is omitted, also if nothing else is drawn.
#[test]
fn a_damaged_mesh_is_named() {
    let folder = tempdir().unwrap();
    let [urdf, out] = ["robot.urdf", "out"].map(|name| folder.path().join(name));
    fs::write(folder.path().join("part.stl"), "solid part\nfacet normal 0 0 1\nouter lop\n").unwrap();
    let robot = |shape: &str| {
        let mesh = "<visual><geometry><mesh filename='part.stl'/></geometry></visual>";
        fs::write(&urdf, format!("<robot name='r'><link name='a'>{mesh}{shape}</link></robot>")).unwrap();
    };
    let check_message =
        |reported: &str| assert!(reported.contains("part.stl: line 3: this is not an STL file"), "{reported}");
    robot("");
    check_message(&refused(&["export", text(&urdf), "--meshes", "--to", "glb", "-o", text(&out)]));
    check_message(&refused(&["view", text(&urdf), "--meshes", "-o", text(&out)]));
    robot("<collision><geometry><box size='1 1 1'/></geometry></collision>");
    for options in [&["--meshes", "--to", "glb"][..], &["--to", "mjcf"]] {
        let ran = run(&[&["export", text(&urdf), "-o", text(&out), "--force"], options].concat());
        assert_eq!(ran.code, 0, "{}", ran.err);
        check_message(&ran.err);
    }
    assert!(!fs::read_to_string(&out).unwrap().contains("part.stl"), "MuJoCo would refuse the whole model");
}

/// 1e400 is a decimal number, but not a double.
#[test]
fn numbers_beyond_doubles_are_not_exported() {
    let folder = tempdir().unwrap();
    let (file, out) = (folder.path().join("robot.urdf"), folder.path().join("out"));
    let robot = |mass: &str, size: &str, place: &str, limit: &str| {
        format!(
            "<robot name='r'><link name='a'/><link name='b'><inertial><mass value='{mass}'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' \
             izz='1'/></inertial><visual><geometry><box size='1 1 {size}'/></geometry></visual></link><joint name='j' type='revolute'><parent \
             link='a'/><child link='b'/><origin xyz='0 0 {place}'/><axis xyz='0 0 1'/><limit lower='-1' upper='{limit}' effort='1' \
             velocity='1'/></joint></robot>"
        )
    };
    fs::write(&file, robot("1", "1", "1", "1")).unwrap();
    for format in ["urdf", "mjcf", "glb"] {
        succeed(&["export", text(&file), "--to", format, "-o", text(&out), "--force"]);
    }
    fs::remove_file(&out).unwrap();
    // A shape is omitted, with a note.
    fs::write(&file, robot("1", "1e400", "1", "1")).unwrap();
    let ran = run(&["export", text(&file), "--to", "mjcf"]);
    assert!(
        ran.code == 0 && !ran.out.contains("inf") && ran.err.contains("outside the range of doubles"),
        "{}",
        ran.err
    );
    for place in [0, 2, 3] {
        let at = |own: usize| if own == place { "1e400" } else { "1" };
        fs::write(&file, robot(at(0), at(1), at(2), at(3))).unwrap();
        for format in ["urdf", "mjcf", "glb"] {
            let error = refused(&["export", text(&file), "--to", format, "-o", text(&out)]);
            assert!(error.contains("robot.urdf") && !out.exists(), "{error}");
            assert!(error.contains("finite") || error.contains("double"), "{error}");
        }
    }
}

/// An arm is fixed; the world of an MJCF is its world again.
#[test]
fn the_root_of_an_arm_is_fixed_in_mjcf() {
    let folder = tempdir().unwrap();
    let (file, out) = (folder.path().join("arm.xml"), folder.path().join("out.xml"));
    let written = |arguments: &[&str]| {
        succeed(&[&["export", "--to", "mjcf", "-o", text(&out), "--force"], arguments].concat());
        fs::read_to_string(&out).unwrap()
    };
    assert!(!written(&["ur10e"]).contains("freejoint"));
    assert!(written(&["ur10e", "--root", "free"]).contains("freejoint"));
    assert!(written(&["nao_v5"]).contains("freejoint"));
    assert!(!written(&["nao_v5", "--root", "fixed"]).contains("freejoint"));
    let geom = "<geom size='0.1' pos='0 0 3'/>";
    fs::write(
        &file,
        format!(
            "<mujoco><worldbody>{geom}<body name='a' pos='1 2 3'><joint name='j'/>{geom}</body></worldbody></mujoco>"
        ),
    )
    .unwrap();
    let again = written(&[text(&file)]);
    assert!(!again.contains("freejoint") && !again.contains("world_"), "{again}");
    let tree = |file: &str| succeed(&["info", file]).lines().take(6).map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(tree(text(&out)), tree(text(&file)));
    assert!(refused(&["export", "ur10e", "--to", "sdf", "--root", "fixed"]).contains("--root is for mjcf"));
}

/// A joint at such a place is refused in an MJCF and an SDF, too. It does not become a joint at the origin.
#[test]
fn places_beyond_doubles_are_refused_in_mjcf_and_sdf() {
    let folder = tempdir().unwrap();
    let mjcf = |place: &str| {
        format!(
            "<mujoco><worldbody><body name='a' pos='1 2 {place}'><joint name='j'/><geom size='1'/></body></worldbody></mujoco>"
        )
    };
    let sdf = |place: &str| {
        format!(
            "<sdf version='1.9'><model name='r'><link name='w'/><link name='a'><pose>1 2 {place} 0 0 0</pose></link><joint name='j' \
             type='revolute'><parent>w</parent><child>a</child><axis><xyz>0 0 1</xyz></axis></joint></model></sdf>"
        )
    };
    for (name, good, bad) in [("r.xml", mjcf("3"), mjcf("1e400")), ("r.sdf", sdf("3"), sdf("1e400"))] {
        let file = folder.path().join(name);
        fs::write(&file, good).unwrap();
        assert!(succeed(&["fk", text(&file), "--q", "1"]).contains("3.000000000 m"));
        fs::write(&file, bad).unwrap();
        for command in [&["fk", "--q", "1"][..], &["export", "--to", "urdf"], &["export", "--to", "sdf"]] {
            let error = refused(&[&[command[0], text(&file)], &command[1..]].concat());
            assert!(error.contains(name) && error.contains("joint `j`") && error.contains("double"), "{error}");
        }
    }
}
