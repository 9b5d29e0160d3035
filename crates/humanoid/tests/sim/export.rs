//! Scene files, checked with a reader in this module. `viewer/tests/export.test.mjs` tests how other programs read them.

mod vrml;

use groebot_humanoid::ErrorKind;
use groebot_humanoid::sim::export::{Body, Material, Node, Scene};
use groebot_robot::model::{Meshes, Robot};
use groebot_robot::motion::{JointTrack, Trajectory};
use groebot_robot::robots;
use groebot_robot::spatial::Pose;
use nalgebra::{Quaternion, Translation3, UnitQuaternion, Vector3};
use serde_json::Value;

const FINGER: &str = include_str!("../../../../tests/corpus/urdf/finger.urdf");

fn finger() -> Robot {
    Robot::from_urdf(FINGER).unwrap()
}

/// The three leading joints of the finger, and a base that moves far away and rotates.
fn tumble(away: f64) -> Trajectory {
    let samples = 12;
    let wave = |sample: usize, place: usize| (1.3 * sample as f64 + 2.1 * place as f64).sin();
    let turned = |s| UnitQuaternion::from_quaternion(Quaternion::new(wave(s, 4), wave(s, 5), wave(s, 6), wave(s, 7)));
    let base = |s| Pose::from_parts(Translation3::new(away * wave(s, 1), wave(s, 2) - away, wave(s, 3)), turned(s));
    let track = |name: &str| JointTrack { name: name.to_owned(), slides: false, limits: None, speed: None };
    Trajectory {
        robot: "finger".to_owned(),
        joints: ["turn", "spread", "knuckle"].map(track).into(),
        times: (0..samples).map(|sample| 3.0 + 0.05 * sample as f64).collect(),
        q: (0..samples).map(|sample| (8..11).map(|place| 1.4 * wave(sample, place)).collect()).collect(),
        base: (0..samples).map(base).collect(),
        ..Trajectory::default()
    }
}

/// The pose of the tip at a sample, with y up.
fn tip(trajectory: &Trajectory, sample: usize) -> Pose {
    let chain = finger().chain(None, Some("tip")).unwrap();
    let mut q = [&trajectory.q[sample][..], &[0.0, 0.0]].concat();
    chain.follow(&mut q);
    let y_from_z = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), -std::f64::consts::FRAC_PI_2);
    y_from_z * trajectory.base[sample] * chain.forward(&q).unwrap()
}

/// The parts of a glTF file.
struct Glb {
    json: Value,
    binary: Vec<u8>,
}

impl Glb {
    fn of(scene: &Scene) -> Self {
        let bytes = scene.to_glb().unwrap();
        let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
        assert!(bytes.starts_with(b"glTF\x02\0\0\0") && word(8) == bytes.len() && bytes.len().is_multiple_of(4));
        let json = &bytes[20..20 + word(12)];
        let rest = &bytes[20 + json.len()..];
        assert_eq!(&bytes[16..20], b"JSON");
        assert!(rest.is_empty() || &rest[4..8] == b"BIN\0");
        Glb { json: serde_json::from_slice(json).unwrap(), binary: rest.get(8..).unwrap_or(&[]).to_vec() }
    }

    fn list(&self, name: &str) -> &[Value] {
        self.json[name].as_array().map_or(&[], Vec::as_slice)
    }

    /// The rows of an accessor of 32-bit floats.
    fn rows(&self, accessor: &Value) -> Vec<Vec<f64>> {
        let object = &self.list("accessors")[accessor.as_u64().unwrap() as usize];
        let view = &self.list("bufferViews")[object["bufferView"].as_u64().unwrap() as usize];
        let number = |of: &Value, key: &str| of[key].as_u64().unwrap() as usize;
        let width = match object["type"].as_str().unwrap() {
            "SCALAR" => 1,
            kind => kind[3..].parse().unwrap(),
        };
        let from = number(view, "byteOffset");
        let bytes = &self.binary[from..from + number(view, "byteLength")];
        assert_eq!((object["componentType"].as_u64(), bytes.len()), (Some(5126), 4 * width * number(object, "count")));
        let single = |four: &[u8]| f64::from(f32::from_le_bytes(four.try_into().unwrap()));
        bytes.chunks(4 * width).map(|row| row.chunks(4).map(single).collect()).collect()
    }

    fn times(&self) -> Vec<f64> {
        self.rows(&self.json["animations"][0]["samplers"][0]["input"]).concat()
    }

    /// The pose of a node in the scene at a sample.
    fn pose(&self, name: &str, sample: usize) -> Pose {
        let nodes = self.list("nodes");
        let mut place = nodes.iter().position(|node| node["name"] == name).unwrap();
        let mut pose = self.own(place, sample);
        let is_parent = |node: &Value, child: usize| {
            node["children"].as_array().is_some_and(|all| all.iter().any(|each| each == child))
        };
        while let Some(parent) = nodes.iter().position(|node| is_parent(node, place)) {
            (pose, place) = (self.own(parent, sample) * pose, parent);
        }
        pose
    }

    fn own(&self, node: usize, sample: usize) -> Pose {
        let animation = &self.json["animations"][0];
        let field = |path: &str, usual: &[f64]| -> Vec<f64> {
            let channels = animation["channels"].as_array().into_iter().flatten();
            let mut own = channels.filter(|one| one["target"]["node"] == node && one["target"]["path"] == path);
            match (own.next(), &self.list("nodes")[node][path]) {
                (Some(channel), _) => {
                    let sampler = &animation["samplers"][channel["sampler"].as_u64().unwrap() as usize];
                    assert!(sampler["interpolation"] == "LINEAR" && own.next().is_none());
                    self.rows(&sampler["output"])[sample].clone()
                }
                (None, Value::Null) => usual.to_vec(),
                (None, fixed) => serde_json::from_value(fixed.clone()).unwrap(),
            }
        };
        let [at, turn] = [field("translation", &[0.0; 3]), field("rotation", &[0.0, 0.0, 0.0, 1.0])];
        let turn = UnitQuaternion::from_quaternion(Quaternion::new(turn[3], turn[0], turn[1], turn[2]));
        Pose::from_parts(Translation3::new(at[0], at[1], at[2]), turn)
    }
}

#[test]
fn links_of_glb_agree_with_kinematics_near_and_far() {
    for away in [0.0, 30.0, 400.0] {
        let trajectory = tumble(away);
        let scene = Scene::of_robot(&finger(), None, Some(&trajectory)).unwrap();
        let glb = Glb::of(&scene);
        for sample in 0..trajectory.times.len() {
            let (seen, expected) = (glb.pose("tip", sample), tip(&trajectory, sample));
            let off = (seen.translation.vector - expected.translation.vector).norm();
            assert!(off < 1e-7 && seen.rotation.angle_to(&expected.rotation) < 1e-6, "{away} m away: {off} m");
        }
        assert!(glb.times().iter().zip(0..).all(|(time, sample)| (time - 0.05 * f64::from(sample)).abs() < 1e-7));
        assert_eq!(glb.list("nodes").len(), finger().links().len() + if away > 0.0 { 2 } else { 1 });
    }
}

#[test]
fn glb_has_a_node_a_link_and_bounds_that_hold() {
    let nao = robots::robot("nao").unwrap();
    let glb = Glb::of(&Scene::of_robot(&nao, None, None).unwrap());
    let names: Vec<&str> = glb.list("nodes").iter().map(|node| node["name"].as_str().unwrap()).collect();
    assert_eq!(names.len(), nao.links().len() + 1);
    assert!(nao.links().iter().all(|link| names.contains(&link.name.as_str())) && glb.list("animations").is_empty());
    for (joint, own) in nao.joints().iter().enumerate() {
        let [parent, child] = [&own.parent, &own.child].map(|name| names.iter().position(|each| each == name).unwrap());
        let children = glb.list("nodes")[parent]["children"].as_array().unwrap();
        assert!(children.iter().any(|each| each == child), "joint {joint}");
    }
    let mut seen = 0;
    for primitive in glb.list("meshes").iter().flat_map(|mesh| mesh["primitives"].as_array().unwrap()) {
        let points = glb.rows(&primitive["attributes"]["POSITION"]);
        let object = &glb.list("accessors")[primitive["attributes"]["POSITION"].as_u64().unwrap() as usize];
        for axis in 0..3 {
            let all = || points.iter().map(|point| point[axis]);
            assert_eq!(object["min"][axis].as_f64(), all().reduce(f64::min));
            assert_eq!(object["max"][axis].as_f64(), all().reduce(f64::max));
        }
        let normals = primitive["attributes"].get("NORMAL").map(|normals| glb.rows(normals));
        for normal in normals.iter().flatten() {
            assert!((normal.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-6);
        }
        seen += 1;
    }
    assert!(seen > 20);
}

/// Triangles face outwards: the enclosed volume is positive and equals that of the body, within the error of the approximation by flat faces.
#[test]
fn solids_are_closed() {
    let text = r#"<robot name="r"><link name="a"><visual><geometry><GEOMETRY/></geometry></visual></link></robot>"#;
    let third = std::f64::consts::PI * 4.0 / 3.0 * 0.125;
    for (geometry, volume) in [
        (r#"box size="1 2 3""#, 6.0),
        (r#"sphere radius="0.5""#, third),
        (r#"cylinder radius="0.5" length="2""#, std::f64::consts::PI * 0.5),
        (r#"capsule radius="0.5" length="2""#, third + std::f64::consts::PI * 0.5),
    ] {
        let robot = Robot::from_urdf(&text.replace("GEOMETRY", geometry)).unwrap();
        let glb = Glb::of(&Scene::of_robot(&robot, None, None).unwrap());
        let primitive = &glb.json["meshes"][0]["primitives"][0];
        let points = glb.rows(&primitive["attributes"]["POSITION"]);
        let indices = &glb.list("accessors")[primitive["indices"].as_u64().unwrap() as usize];
        let view = &glb.list("bufferViews")[indices["bufferView"].as_u64().unwrap() as usize];
        let from = view["byteOffset"].as_u64().unwrap() as usize;
        let bytes = &glb.binary[from..from + view["byteLength"].as_u64().unwrap() as usize];
        let corner =
            |four: &[u8]| Vector3::from_row_slice(&points[u32::from_le_bytes(four.try_into().unwrap()) as usize]);
        let enclosed = bytes
            .chunks(12)
            .map(|three| corner(&three[..4]).dot(&corner(&three[4..8]).cross(&corner(&three[8..]))) / 6.0);
        let enclosed: f64 = enclosed.sum();
        assert!(enclosed <= volume * (1.0 + 1e-6) && enclosed > 0.94 * volume, "{geometry}: {enclosed}");
    }
}

#[test]
fn names_become_legal_and_stay_apart() {
    let mut scene = Scene { title: "it's <a> \"scene\" & more".to_owned(), ..Scene::default() };
    let names = ["l-hand", "l hand", "l_hand", "7", "ROUTE", "Clock", "", "mano_de_\u{f1}and\u{fa}", "a'<&>\"b"];
    for name in names {
        let mut node: Node = Scene::from_vrml(&format!("DEF n Transform {{ }} # {name}")).unwrap().nodes[0].clone();
        node.name = name.to_owned();
        node.slides = vec![Vector3::zeros(), Vector3::x()];
        scene.nodes.push(node);
    }
    scene.times = vec![0.0, 1.0];
    let (x3d, wrl) = (scene.to_x3d().unwrap(), scene.to_wrl().unwrap());
    let legal = ["l_hand", "l_hand_2", "l_hand_3", "x7", "ROUTE_", "Clock", "x", "mano_de__and_", "a_____b"];
    for name in legal {
        assert!(x3d.contains(&format!("<Transform DEF='{name}'")), "{name}: {x3d}");
        assert!(wrl.contains(&format!("DEF {name} Transform")), "{name}: {wrl}");
        assert!(wrl.contains(&format!(".value_changed TO {name}.set_translation")));
    }
    assert!(x3d.contains("<TimeSensor DEF='Clock_2'") && wrl.contains("ROUTE Clock_2.fraction_changed TO"));
    // XML escapes the apostrophe that delimits an attribute, VRML the quotation mark that delimits a string.
    assert!(x3d.contains("title='it&apos;s &lt;a> \"scene\" &amp; more'"), "{x3d}");
    assert!(wrl.contains(r#"title "it's <a> \"scene\" & more""#), "{wrl}");
    // glTF uses them without change.
    let glb = Glb::of(&scene);
    assert!(glb.list("nodes").iter().zip(names).all(|(node, name)| node["name"] == name));
}

#[test]
fn what_cannot_be_shown_is_refused() {
    let (robot, good) = (finger(), tumble(0.0));
    let says = |trajectory: &Trajectory, kind: ErrorKind, words: &str| {
        let error = Scene::of_robot(&robot, None, Some(trajectory)).unwrap_err();
        assert!(error.kind() == kind && error.message().contains(words), "{error}");
    };
    let with = |change: &dyn Fn(&mut Trajectory)| {
        let mut changed = good.clone();
        change(&mut changed);
        changed
    };
    says(&with(&|own| own.joints[2].name = "knukle".into()), ErrorKind::UnknownName, "did you mean `knuckle`");
    says(&with(&|own| own.joints[0].slides = true), ErrorKind::BadValue, "gives it in m, but in the robot it is");
    says(&with(&|own| own.q[4][1] = f64::NAN), ErrorKind::BadValue, "sample 5: a value is not finite");
    says(&with(&|own| own.base[2].translation.x = f64::INFINITY), ErrorKind::BadValue, "not finite");
    says(&Trajectory { robot: "finger".into(), ..Trajectory::default() }, ErrorKind::BadValue, "no sample");
    let dot = Robot::from_urdf(r#"<robot name="dot"><link name="a"/></robot>"#).unwrap();
    assert!(Scene::of_robot(&dot, None, None).unwrap_err().message().contains("nothing to draw"));

    let scene = Scene::of_robot(&robot, None, Some(&good)).unwrap();
    let refused = |change: &dyn Fn(&mut Scene), words: &str| {
        let mut changed = scene.clone();
        change(&mut changed);
        for error in [changed.to_glb().err(), changed.to_x3d().err(), changed.to_wrl().err()] {
            let error = error.unwrap();
            assert!(error.kind() == ErrorKind::BadValue && error.message().contains(words), "{error}");
        }
    };
    refused(&|own| own.nodes[2].pose.translation.x = f64::NAN, "node `swivel`: a number is not finite");
    refused(&|own| own.nodes[2].parts[0].material.diffuse[0] = f64::NAN, "not finite");
    refused(&|own| own.nodes[3].parent = Some(7), "does not follow its parent");
    refused(&|own| own.nodes[3].parent = Some(3), "does not follow its parent");
    refused(&|own| own.nodes[1].turns.truncate(11), "node `palm`: it moves at another number of samples than 12");
    refused(&|own| own.times[3] = own.times[2], "sample 4: its time is not after the previous one");
    refused(&|own| own.times[0] = -1.0, "begin at zero");
    // Only glTF has 32-bit floats.
    let mut near = scene.clone();
    near.times.iter_mut().for_each(|time| *time = 1e6 + 1e-3 * *time);
    assert!(near.to_glb().unwrap_err().message().contains("single precision") && near.to_x3d().is_ok());
    let mut large = scene;
    large.nodes[1].slides[0].x = 1e300;
    assert!(large.to_glb().unwrap_err().message().contains("too large for single precision"));
}

/// A mesh that cannot be read is reported, and the rest is shown.
#[test]
fn a_missing_mesh_is_reported() {
    let text = r#"<robot name="r"><link name="a"><visual><geometry><mesh filename="package://r/gone.stl"/></geometry></visual></link>
        <link name="b"><visual><geometry><box size="1 1 1"/></geometry><material name="m"><color rgba="1 0 0 0.5"/></material></visual></link>
        <joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint></robot>"#;
    let robot = Robot::from_urdf(text).unwrap();
    let scene = Scene::of_robot(&robot, Some(&Meshes::default()), None).unwrap();
    assert!(scene.notes.len() == 1 && scene.notes[0].contains("the mesh `package://r/gone.stl` is not found"));
    assert!(Scene::of_robot(&robot, None, None).unwrap().notes.is_empty());
    let glb = Glb::of(&scene);
    let material = &glb.json["materials"][0];
    assert!(material["pbrMetallicRoughness"]["baseColorFactor"][3] == 0.5 && material["alphaMode"] == "BLEND");
    assert!(scene.to_wrl().unwrap().contains("diffuseColor 1 0 0 transparency 0.5"));
}

#[test]
fn meshes_are_put_in() {
    let folder = tempfile::tempdir().unwrap();
    let corners = "vertex 0 0 0\nvertex 1000 0 0\nvertex 0 500 0\n";
    let stl = format!("solid s\nfacet normal 0 0 1\nouter loop\n{corners}endloop\nendfacet\nendsolid s\n");
    std::fs::write(folder.path().join("sole.stl"), stl).unwrap();
    let text = r#"<robot name="r"><link name="a"><visual><origin xyz="0 0 2"/><geometry><mesh filename="sole.stl" scale="0.001 0.001 0.001"/></geometry>
        </visual></link></robot>"#;
    let meshes = Meshes::beside(&folder.path().join("robot.urdf"));
    let scene = Scene::of_robot(&Robot::from_urdf(text).unwrap(), Some(&meshes), None).unwrap();
    let glb = Glb::of(&scene);
    let primitive = &glb.json["meshes"][0]["primitives"][0];
    let points = glb.rows(&primitive["attributes"]["POSITION"]);
    assert_eq!(points, [[0.0, 0.0, 2.0], [1.0, 0.0, 2.0], [0.0, 0.5, 2.0]]);
    // Flat triangles have no normals.
    assert!(primitive["attributes"].get("NORMAL").is_none());
    let wrl = scene.to_wrl().unwrap();
    assert!(wrl.contains("translation 0 0 2") && wrl.contains("coordIndex [ 0 1 2 -1 ]"), "{wrl}");
    assert!(wrl.contains("coord Coordinate { point [ 0 0 0 1 0 0 0 0.5 0 ] }"), "{wrl}");
}

/// With one sample, or with identical samples, the robot does not move.
#[test]
fn what_does_not_move_has_no_clock() {
    let mut still = tumble(0.0);
    still.times.truncate(1);
    still.q.truncate(1);
    still.base.truncate(1);
    let scene = Scene::of_robot(&finger(), None, Some(&still)).unwrap();
    let glb = Glb::of(&scene);
    assert!((glb.pose("tip", 0).translation.vector - tip(&still, 0).translation.vector).norm() < 1e-9);
    assert!(glb.list("animations").is_empty() && !scene.to_x3d().unwrap().contains("TimeSensor"));
}
