//! `groebot export`, and walking with a robot that is described in a file.

use std::fs;

use tempfile::tempdir;

use super::{refused, run, succeed, text};

#[test]
fn a_robot_is_exported_and_walks_from_its_file() {
    let folder = tempdir().unwrap();
    let [urdf, mjcf, csv] = ["robot.urdf", "robot.xml", "walk.csv"].map(|name| folder.path().join(name));
    assert_eq!(succeed(&["export", "teo", "--format", "urdf", "-o", text(&urdf)]), "");
    succeed(&["export", text(&urdf), "--format", "mjcf", "-o", text(&mjcf)]);
    assert!(fs::read_to_string(&mjcf).unwrap().contains("<freejoint name=\"root\"/>"));
    assert!(succeed(&["export", "nao_v5", "--format", "mjcf"]).starts_with("<mujoco model=\"nao_v5\">"));

    // The legs are derived on the spot; the soles are boxes.
    let soles = ["--left", "l_sole", "--right", "r_sole"];
    let walk =
        |extra: &[&str]| succeed(&[&["walk", text(&urdf)][..], &soles, &["--goal", "0.2,0.05,20"], extra].concat());
    let told = walk(&["-o", text(&csv)]);
    assert!(told.contains("by one step goal") && told.contains("way             0.206 m, turn 20.0 deg"), "{told}");
    let walk_of = groebot::motion::Trajectory::read_csv(&csv).unwrap();
    assert!(walk_of.joints.iter().any(|joint| joint.name == "LKneePitch") && walk_of.times.len() > 100);
    assert!(walk(&["--gait", "preview"]).contains("by preview control"));
    assert!(walk(&["--outline", "-0.1,0.12,-0.05,0.06"]).contains("one step goal"));

    // The same soles in a file of triangles.
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
    assert_eq!(walk(&[]), told);

    // A folder holds the description as `0_robot.urdf`, its meshes beside it.
    let inside = folder.path().join("described");
    fs::create_dir(&inside).unwrap();
    fs::copy(&urdf, inside.join("0_robot.urdf")).unwrap();
    fs::copy(folder.path().join("sole.stl"), inside.join("sole.stl")).unwrap();
    let from_folder = succeed(&[&["walk", text(&inside)][..], &soles, &["--goal", "0.2,0.05,20"]].concat());
    assert_eq!(from_folder, told);
}

#[test]
fn what_cannot_be_walked_or_exported_is_refused() {
    let folder = tempdir().unwrap();
    let urdf = folder.path().join("robot.urdf");
    succeed(&["export", "teo", "--format", "urdf", "-o", text(&urdf)]);
    let described = fs::read_to_string(&urdf).unwrap();
    let walk =
        |left: &str, right: &str| refused(&["walk", text(&urdf), "--left", left, "--right", right, "--steps", "2"]);
    assert!(refused(&["walk", text(&urdf), "--steps", "2"]).contains("give --left and --right"));
    assert!(walk("l_sole", "r_shoe").contains("no link `r_shoe` (did you mean `r_sole`?)"));
    assert!(walk("l_sole", "l_sole").contains("moves both feet"));
    assert!(walk("RootWaist", "r_sole").contains("0 joints lead to `RootWaist`"));
    fs::write(&urdf, described.replace("<box size=\"0.24 0.14 0.01\"/>", "<mesh filename=\"nowhere.stl\"/>")).unwrap();
    let told = walk("l_sole", "r_sole");
    assert!(told.contains("nowhere.stl") && told.contains("--outline"), "{told}");
    let outline = |numbers: &str| {
        ["walk", text(&urdf), "--left", "l_sole", "--right", "r_sole", "--steps", "2", "--outline", numbers]
            .map(str::to_owned)
    };
    // The sole's plane at its link, and 2 cm above it: the robot then stands 2 cm lower.
    let height = |numbers: &str| {
        let told = succeed(&outline(numbers).each_ref().map(String::as_str));
        let at = told.split("torso ").nth(1).unwrap().split(' ').next().unwrap();
        at.parse::<f64>().unwrap()
    };
    let lower = height("-0.12,0.12,-0.07,0.07") - height("-0.12,0.12,-0.07,0.07,0.02");
    assert!((lower - 0.02).abs() < 2e-3, "{lower}");
    let three = refused(&outline("-0.1,0.1,-0.05").each_ref().map(String::as_str));
    assert!(three.contains("four or five numbers"), "{three}");
    fs::write(&urdf, described.replace("<mass value=", "<mass value=\"0\" told=")).unwrap();
    assert!(walk("l_sole", "r_sole").contains("it has no mass"));
    assert!(refused(&["export", "derivations/ur5/0_chain.toml", "--format", "urdf"]).contains("no robot with links"));
    assert!(refused(&["export", "c3po", "--format", "urdf"]).contains("c3po"));
    assert_eq!(run(&["export", "teo"]).code, 2, "which format?");
}
