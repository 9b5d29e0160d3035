//! The data of a page compared with their sources. Tests in Chromium (`viewer/tests`) check how the page shows them.

use groebot_humanoid::ErrorKind;
use groebot_humanoid::view::{Page, RunRequest, Sole, WalkRecord};
use groebot_robot::kinematics::Chain;
use groebot_robot::model::{Meshes, Robot};
use groebot_robot::motion::{Contact, Figure, JointTrack, Track, Trajectory};
use groebot_robot::spatial::Pose;
use miniz_oxide::inflate::decompress_to_vec_zlib;
use nalgebra::{Point2, Point3, Translation3, UnitQuaternion, Vector3};
use serde_json::{Value, json};

const ARM: &str = r#"<robot name="arm &lt;/script&gt;"><link name="foot"/><link name="upper"/><link name="rod"/><link name="finger"/>
    <joint name="turn" type="continuous"><parent link="foot"/><child link="upper"/><origin xyz="0.1 0.2 0.3" rpy="0 0 0.5"/><axis xyz="0 3 4"/></joint>
    <joint name="slide" type="prismatic"><parent link="upper"/><child link="rod"/><axis xyz="0 0 1"/><limit lower="0" upper="0.5"/></joint>
    <joint name="grip" type="revolute"><parent link="rod"/><child link="finger"/><axis xyz="1 0 0"/><limit lower="-1" upper="1"/>
        <mimic joint="turn" multiplier="2" offset="0.25"/></joint></robot>"#;

fn arm() -> Robot {
    Robot::from_urdf(ARM).unwrap()
}

fn track(name: &str, slides: bool) -> JointTrack {
    JointTrack { name: name.to_owned(), slides, limits: None, speed: None }
}

/// Three samples in which the feet support one after the other.
fn motion() -> Trajectory {
    let sole = |name: &str, y: f64, stands: [bool; 3]| {
        let pose =
            Pose::from_parts(Translation3::new(1.0, y, 0.0), UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.3));
        Contact { name: name.to_owned(), poses: vec![pose; 3], stands: stands.into() }
    };
    Trajectory {
        robot: "arm".to_owned(),
        joints: vec![track("slide", true), track("turn", false)],
        times: vec![0.0, 0.1, 0.3],
        q: vec![vec![0.2, 1.0 / 3.0], vec![0.2, -1e-300], vec![0.2, 2.0]],
        base: Vec::new(),
        contacts: vec![sole("left", 0.1, [true, true, false]), sole("right", -0.1, [true, true, true])],
        points: vec![Track { name: "zmp".to_owned(), at: vec![Point3::new(0.1, -0.0, 0.0); 3] }],
        figures: vec![Figure { name: "margin".to_owned(), unit: "m".to_owned(), values: vec![0.1, 0.2, 0.3] }],
    }
}

fn soles() -> Vec<Sole> {
    let corners = [(0.1, 0.05), (-0.1, 0.05), (-0.1, -0.05), (0.1, -0.05)].map(|(x, y)| Point2::new(x, y));
    ["left", "right"].map(|side| Sole { contact: side.to_owned(), corners: corners.to_vec() }).into()
}

fn data(page: &Page) -> Value {
    serde_json::from_str(&page.data()).unwrap()
}

/// The doubles of a packed text: zlib in base64, first all first bytes, then all second ones and so on.
fn doubles(text: &Value) -> Vec<f64> {
    let digit = |letter: u8| match letter {
        b'A'..=b'Z' => letter - b'A',
        b'a'..=b'z' => letter - b'a' + 26,
        b'0'..=b'9' => letter - b'0' + 52,
        b'+' => 62,
        _ => 63,
    };
    let text = text.as_str().unwrap().trim_end_matches('=');
    let bits: Vec<bool> =
        text.bytes().flat_map(|letter| (0..6).rev().map(move |bit| digit(letter) >> bit & 1 == 1)).collect();
    let bytes: Vec<u8> =
        bits.chunks_exact(8).map(|byte| byte.iter().fold(0, |byte, bit| byte << 1 | u8::from(*bit))).collect();
    let planes = decompress_to_vec_zlib(&bytes).unwrap();
    let count = planes.len() / 8;
    let double = |sample| f64::from_le_bytes(std::array::from_fn(|place| planes[place * count + sample]));
    (0..count).map(double).collect()
}

#[test]
fn joints_stand_with_frames_axes_limits_and_leaders() {
    let page_data = data(&Page::of_robot(&arm(), None).unwrap());
    let joints = page_data["robot"]["joints"].as_array().unwrap();
    let (sine, cosine) = 0.5f64.sin_cos();
    let origin: Vec<f64> = serde_json::from_value(joints[0]["origin"].clone()).unwrap();
    let expected = [cosine, -sine, 0.0, 0.1, sine, cosine, 0.0, 0.2, 0.0, 0.0, 1.0, 0.3];
    assert!(origin.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15), "{origin:?}");
    let axis: Vec<f64> = serde_json::from_value(joints[0]["axis"].clone()).unwrap();
    assert!(axis.iter().zip([0.0, 0.6, 0.8]).all(|(a, b)| (a - b).abs() < 1e-15), "{axis:?}");
    assert_eq!((&joints[0]["kind"], &joints[1]["limits"]), (&json!("continuous"), &json!([0.0, 0.5])));
    assert_eq!(joints[2]["follows"], json!({ "joint": 0, "factor": 2.0, "offset": 0.25 }));
    assert_eq!((&joints[2]["parent"], &joints[2]["child"]), (&json!(2), &json!(3)));
    assert!(joints[0].get("follows").is_none() && page_data.get("motion").is_none());
}

#[test]
fn numbers_are_exact_and_what_does_not_change_stands_once() {
    let page = Page::of_robot(&arm(), None).unwrap().with_motion(&motion(), None, &soles()).unwrap();
    let page_data = &data(&page)["motion"];
    assert_eq!(doubles(&page_data["times"]), [0.0, 0.1, 0.3]);
    assert_eq!((&page_data["joints"], &page_data["q"][0]), (&json!([1, 0]), &json!(0.2)));
    assert_eq!(doubles(&page_data["q"][1]), [1.0 / 3.0, -1e-300, 2.0]);
    assert_eq!(doubles(&page_data["figures"][0]["values"]), [0.1, 0.2, 0.3]);
    // A negative zero is preserved.
    assert!(page_data["points"][0]["at"][1].as_f64().unwrap().is_sign_negative());
    assert_eq!((&page_data["contacts"][0]["stands"], page_data.get("base")), (&json!("110"), None));
    assert_eq!(page_data["contacts"][1]["outline"].as_array().unwrap().len(), 4);
}

#[test]
fn support_is_the_hull_of_the_soles_that_stand() {
    let page = Page::of_robot(&arm(), None).unwrap().with_motion(&motion(), None, &soles()).unwrap();
    let page_data = &data(&page)["motion"]["support"];
    assert_eq!((doubles(&page_data["starts"]), doubles(&page_data["counts"])), (vec![0.0, 2.0], vec![6.0, 4.0]));
    let corners = doubles(&page_data["corners"]);
    // The right sole alone: its corners rotated by 0.3 rad about (1, -0.1).
    let (sine, cosine) = 0.3f64.sin_cos();
    for (x, y) in [(0.1, 0.05), (-0.1, 0.05), (-0.1, -0.05), (0.1, -0.05)] {
        let (x, y) = (1.0 + cosine * x - sine * y, -0.1 + sine * x + cosine * y);
        let is_there = corners[12..].chunks(2).any(|corner| (corner[0] - x).hypot(corner[1] - y) < 1e-15);
        assert!(is_there, "({x}, {y}) is not in {corners:?}");
    }
    // If outlines are not known, there is no polygon.
    let page = Page::of_robot(&arm(), None).unwrap().with_motion(&motion(), None, &soles()[..1]).unwrap();
    assert!(data(&page)["motion"].get("support").is_none());
}

#[test]
fn a_walks_record_has_polygons_soles_steps_and_phases() {
    let right = json!([[1.1, -0.2], [1.1, 0.0], [0.9, 0.0], [0.9, -0.2]]);
    let both = json!([[1.1, -0.2], [1.1, 0.2], [0.9, 0.2], [0.9, -0.2]]);
    let record = json!({ "walk": {
        "tick": 0.1,
        "start": { "left": { "x": 0.0, "y": 0.1, "yaw": 0.0 }, "right": { "x": 0.0, "y": -0.1, "yaw": 0.0 } },
        "steps": [{ "foot": "left", "x": 1.0, "y": 0.1, "yaw": 0.3 }],
        "phases": [{ "action": "swing", "step": 1, "from": 0.0, "to": 0.3, "slowed": 1.0 }],
        "support": [both, both, right],
    }});
    let record = WalkRecord::from_json(&record.to_string()).unwrap().unwrap();
    let page = Page::of_robot(&arm(), None).unwrap().with_motion(&motion(), Some(&record), &[]).unwrap();
    let page_data = &data(&page)["motion"];
    assert_eq!(doubles(&page_data["support"]["starts"]), [0.0, 2.0]);
    assert_eq!(doubles(&page_data["support"]["corners"])[8..], [1.1, -0.2, 1.1, 0.0, 0.9, 0.0, 0.9, -0.2]);
    assert_eq!(page_data["steps"].as_array().unwrap().len(), 3);
    assert_eq!(page_data["steps"][2], json!({ "foot": "left", "x": 1.0, "y": 0.1, "yaw": 0.3 }));
    assert_eq!(page_data["phases"], json!([{ "action": "swing", "step": 1, "from": 0.0, "to": 0.3 }]));
    // The right foot supports alone at the last sample: in its frame the polygon is its sole.
    let corner = &page_data["contacts"][1]["outline"][0];
    let (x, y) = (corner[0].as_f64().unwrap(), corner[1].as_f64().unwrap());
    let (sine, cosine) = 0.3f64.sin_cos();
    assert!((x - (0.1 * cosine - 0.1 * sine)).abs() < 1e-15 && (y - (-0.1 * sine - 0.1 * cosine)).abs() < 1e-15);
    assert!(page_data["contacts"][0].get("outline").is_none());

    assert!(WalkRecord::from_json("{}").unwrap().is_none());
    assert_eq!(WalkRecord::from_json(r#"{"walk": {"support": 3}}"#).unwrap_err().kind(), ErrorKind::Syntax);
    let short = WalkRecord::from_json(r#"{"walk": {"support": []}}"#).unwrap();
    let refused = Page::of_robot(&arm(), None).unwrap().with_motion(&motion(), short.as_ref(), &[]).unwrap_err();
    assert_eq!(
        (refused.kind(), refused.message()),
        (ErrorKind::BadValue, "`walk` has 0 support polygons for 3 samples; give one each")
    );
}

#[test]
fn what_cannot_be_shown_is_refused() {
    let with = |change: fn(&mut Trajectory)| {
        let mut trajectory = motion();
        change(&mut trajectory);
        Page::of_robot(&arm(), None).unwrap().with_motion(&trajectory, None, &[]).unwrap_err()
    };
    let unknown = with(|own| own.joints[1].name = "turm".to_owned());
    assert_eq!(unknown.kind(), ErrorKind::UnknownName);
    assert!(unknown.message().contains("joint `turm`") && unknown.message().contains("`turn`"), "{unknown}");
    let kind = with(|own| own.joints[1].slides = true);
    assert!(
        kind.kind() == ErrorKind::BadValue && kind.message().contains("in m, but in the robot it is continuous"),
        "{kind}"
    );
    let empty = with(|own| *own = Trajectory::default());
    assert!(empty.message().contains("no sample"), "{empty}");
    let short = with(|own| own.figures[0].values.truncate(2));
    assert!(short.message().contains("`margin` has 2 values for 3 samples"), "{short}");

    let nothing = Robot::from_urdf(r#"<robot name="dot"><link name="a"/></robot>"#).unwrap();
    let nothing = Page::of_robot(&nothing, None).unwrap_err();
    assert!(nothing.kind() == ErrorKind::BadValue && nothing.message().contains("nothing to draw"), "{nothing}");
}

#[test]
fn shapes_are_what_is_seen_else_what_collides() {
    let shape = |tag: &str, solid: &str| format!("<{tag}><origin xyz=\"0 0 1\"/><geometry>{solid}</geometry></{tag}>");
    let [ball, bar, mesh] = ["<sphere radius=\"0.1\"/>", "<box size=\"1 2 3\"/>", "<mesh filename=\"lost.stl\"/>"];
    let text = format!(
        "<robot name=\"r\"><link name=\"a\">{}{}</link><link name=\"b\">{}{}</link>\
         <joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child link=\"b\"/></joint></robot>",
        shape("visual", ball),
        shape("collision", bar),
        shape("visual", mesh),
        shape("collision", bar)
    );
    let robot = Robot::from_urdf(&text).unwrap();
    let page_data = data(&Page::of_robot(&robot, None).unwrap());
    let kinds = ["a", "b"].map(|name| {
        let links = page_data["robot"]["links"].as_array().unwrap();
        links.iter().find(|link| link["name"] == name).unwrap()["shapes"][0].clone()
    });
    assert_eq!((&kinds[0]["kind"], &kinds[0]["radius"]), (&json!("sphere"), &json!(0.1)));
    assert_eq!((&kinds[1]["kind"], &kinds[1]["size"]), (&json!("box"), &json!([1.0, 2.0, 3.0])));
    assert_eq!(kinds[1]["pose"][11], json!(1.0));
    // The mesh is requested, but missing.
    let page_data = data(&Page::of_robot(&robot, Some(&Meshes::default())).unwrap());
    assert!(page_data["robot"]["notes"][0].as_str().unwrap().contains("`lost.stl` is not found"), "{page_data}");
}

#[test]
fn the_page_is_one_file_that_its_data_cannot_end() {
    let page = Page::of_robot(&arm(), None).unwrap();
    assert!(!page.data().contains('<'));
    assert_eq!(data(&page)["robot"]["name"], json!("arm </script>"));
    let html = page.titled("{{data}} & {{script}} <b>").to_html();
    assert!(html.contains("<title>{{data}} &amp; {{script}} &lt;b></title>"));
    assert_eq!(html.matches("</script>").count(), 2);
    assert!(html.contains("default-src 'none'") && html.trim_end().ends_with("</html>"));
    // Bundled code is in the page with its licence.
    assert!(html.contains("three.js authors") && html.contains("Permission is hereby granted, free of charge"));
    assert!(html.len() < 800_000, "{}", html.len());
}

/// The frames and axes of a chain's page, composed with Rodrigues' formula, agree with the chain's own product of exponentials.
#[test]
fn a_chain_stands_with_its_axes_in_turn() {
    for name in ["ur5", "puma", "rrp", "nao_left_leg"] {
        let folder = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("derivations").join(name);
        let chain = Chain::read(&folder.join("0_chain.toml")).unwrap();
        let page_data = data(&Page::of_chain(&chain, "{}".to_owned(), Some("abc")));
        let metres = chain.length_unit().metres();
        let limb = &page_data["limbs"][0];
        // The SHA-256 of "abc": FIPS 180-4, appendix B.1.
        assert_eq!(limb["certificate"], "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
        assert_eq!(limb["metres"], metres);
        for k in 0..5 {
            let q: Vec<f64> =
                (0..chain.joints().len()).map(|joint| (1.7 * f64::from(k) + joint as f64).sin()).collect();
            let mut pose = nalgebra::Matrix4::<f64>::identity();
            for (place, joint) in page_data["robot"]["joints"].as_array().unwrap().iter().enumerate() {
                let numbers: Vec<f64> = serde_json::from_value(joint["origin"].clone()).unwrap();
                let axis: [f64; 3] = serde_json::from_value(joint["axis"].clone()).unwrap();
                let mut origin = nalgebra::Matrix4::identity();
                origin.fixed_view_mut::<3, 4>(0, 0).copy_from(&nalgebra::Matrix3x4::from_row_slice(&numbers));
                let mut moved = nalgebra::Matrix4::identity();
                let axis = Vector3::from(axis);
                match joint["kind"].as_str().unwrap() {
                    "fixed" => {}
                    "prismatic" => moved.fixed_view_mut::<3, 1>(0, 3).copy_from(&(axis * q[place] * metres)),
                    _ => {
                        let cross = axis.cross_matrix();
                        let turn = nalgebra::Matrix3::identity()
                            + cross * q[place].sin()
                            + cross * cross * (1.0 - q[place].cos());
                        moved.fixed_view_mut::<3, 3>(0, 0).copy_from(&turn);
                    }
                }
                pose = pose * origin * moved;
            }
            let mut expected = chain.forward(&q).unwrap();
            expected.translation.vector *= metres;
            assert!((pose - expected.to_homogeneous()).norm() < 1e-12, "{name}");
        }
    }
}

#[test]
fn a_run_holds_its_room_with_furniture_from_above() {
    let robot = groebot_robot::robots::robot("rh0").unwrap();
    let room = "size = [3, 2]\nwall = 0.1\n[[furniture]]\nname = \"ball\"\ncircle = 0.3\nat = [2, 1, 90]\nheight = 0.6\n[[furniture]]\nname = \"box\"\nbox = [0.4, 0.2]\nat = [0.5, 0.5]\n";
    let page = |robot_name: &str, room: &str| {
        let request = RunRequest { robot: robot_name, room, start: [1.0, 1.0, 0.0], goal: &[2.0, 0.4], apart: 0.02 };
        Page::of_robot(&robot, None).unwrap().with_run(&request)
    };
    let page_data = data(&page("rh0", room).unwrap());
    let scene = &page_data["run"]["scene"];
    assert_eq!((&scene["size"], &scene["wall"]), (&json!([3.0, 2.0]), &json!(0.1)));
    let ball = &scene["pieces"][0];
    assert_eq!((&ball["at"], &ball["height"]), (&json!([2.0, 1.0, std::f64::consts::FRAC_PI_2]), &json!(0.6)));
    for corner in ball["outline"].as_array().unwrap() {
        // The corners of a polygon with 48 sides around the circle.
        let away = corner[0].as_f64().unwrap().hypot(corner[1].as_f64().unwrap());
        assert!((away * (std::f64::consts::PI / 48.0).cos() - 0.3).abs() < 1e-12);
    }
    assert_eq!(scene["pieces"][1]["outline"].as_array().unwrap().len(), 4);
    assert!(page_data["wasm"].as_str().unwrap().len() > 100_000);
    assert_eq!(page("ur5", room).unwrap_err().kind(), ErrorKind::UnknownName);
    assert_eq!(
        page("rh0", "size = [3, 2]\n[[furniture]]\nname = \"a\"\ncircle = 1\nheight = 0\n").unwrap_err().kind(),
        ErrorKind::BadValue
    );
}
