//! The reader of VRML scenes, on a figure of the thesis and on faulty files.

use super::*;

const FIGURE: &str = include_str!("../../../../../tests/corpus/vrml/rh0_figure_5_4.wrl");

#[test]
fn the_figure_of_the_thesis_is_read() {
    let scene = Scene::from_vrml(FIGURE).unwrap();
    let [arm, outer] = &scene.nodes[..] else { panic!("{:?}", scene.nodes) };
    assert_eq!((&arm.name[..], &outer.name[..]), ("l_upperarm_ver", "l_upperarm_extern"));
    assert_eq!(arm.pose.translation.vector, Vector3::new(0.0, -0.12, 0.0));
    let Body::Solid(groebot_robot::model::Solid::Box { size }) = arm.parts[0].body else { panic!("{arm:?}") };
    let yellow = Material {
        ambient: 0.0,
        diffuse: [0.8, 0.8, 0.0],
        emissive: [0.15, 0.15, 0.0],
        specular: [0.5; 3],
        opacity: 1.0,
    };
    assert_eq!((size, arm.parts[0].material), ([0.02, 0.25, 0.02], yellow));
    let angle = 15708.0 / 10000.0;
    let turn = UnitQuaternion::from_axis_angle(&-Vector3::x_axis(), angle);
    assert!((outer.pose.rotation.angle_to(&turn)) < 1e-12 && outer.scale == [0.001; 3] && outer.parts.is_empty());
    assert!(scene.to_wrl().unwrap().contains("geometry Box { size 0.02 0.25 0.02 }"));
    // A complete file, with its children in brackets, a comment and commas, has equal meaning.
    let whole = FIGURE.replace("children DEF Shape Shape {", "children [ DEF Shape Shape { # the box");
    let whole = whole.replacen("    }\n}\n", "    }]\n}\n", 1).replace("0.8 0.8 0", "0.8, 0.8, 0");
    assert_eq!(Scene::from_vrml(&format!("#VRML V2.0 utf8\n{whole}")).unwrap(), scene);
}

#[test]
fn children_hang_on_their_parents() {
    let text = "Transform { translation 1 0 0 children [ DEF a Transform { children Shape { geometry Box { } } } Transform { } ] } Shape { }";
    let scene = Scene::from_vrml(text).unwrap();
    let nodes: Vec<_> = scene.nodes.iter().map(|node| (&node.name[..], node.parent, node.parts.len())).collect();
    assert_eq!(nodes, [("Transform", None, 0), ("a", Some(0), 1), ("Transform", Some(0), 0), ("Shape", None, 0)]);
    assert!(scene.check().is_ok());
}

#[test]
fn all_else_is_refused_with_its_line() {
    use ErrorKind::*;
    let deep = format!("{}{}", "Transform { children ".repeat(70), "}".repeat(70));
    let long = format!("Transform {{ }}{}", " ".repeat(1_000_000));
    for (text, kind, line, words) in [
        ("#VRML V1.0 ascii\nSeparator { }", Unsupported, 1, "only `#VRML V2.0 utf8` is read"),
        ("#VRML V2.0 utf8\n\nDEF t TimeSensor { }", Unsupported, 3, "`TimeSensor` is not supported here"),
        ("Transform {\n children USE arm }", Unsupported, 2, "`USE` is not supported here"),
        ("Shape { geometry\nSphere { radius 1 } }", Unsupported, 2, "`Sphere` is not supported here"),
        ("ROUTE a.b TO c.d", Unsupported, 1, "allowed: `Transform`, `Shape`"),
        (&deep, Unsupported, 1, "deeper than 64"),
        ("Transform {\ncenter 0 0 0 }", UnknownKey, 2, "Transform has no field `center` here"),
        ("Transform { scale 1 1 1\n scale 1 1 1 }", DuplicateName, 2, "`scale` is given twice"),
        ("Transform {\ntranslation 1 2 }", Syntax, 2, "`}` is not a number; give 3 here"),
        ("Transform { translation 1 nan 0 }", BadValue, 1, "give a finite number"),
        ("Transform { scale 1 0 1 }", BadValue, 1, "give a positive number"),
        ("Transform { rotation 0 0 0 1 }", BadValue, 1, "no direction"),
        ("Shape { geometry Box { size 1 -1 1 } }", BadValue, 1, "give a positive number"),
        ("Shape { appearance Appearance { material Material {\ndiffuseColor 0 0 1.5 } } }", BadValue, 2, "from 0 to 1"),
        ("Transform\n[ ]", Syntax, 2, "give `{`"),
        ("Transform {\n children [\n Shape { }", Syntax, 3, "the text ends here; a node is missing"),
        ("DEF", Syntax, 1, "a name is missing"),
        ("DEF { }", Syntax, 1, "give a name"),
        ("}", Unsupported, 1, "`}` is not supported here"),
    ] {
        let error = Scene::from_vrml(text).unwrap_err();
        assert!(error.kind() == kind && error.message().contains(words), "{text}: {error}");
        assert!(error.to_string().contains(&format!("line {line}:")), "{text}: {error}");
    }
    assert_eq!(Scene::from_vrml(" # nothing").unwrap_err().kind(), Syntax);
    assert_eq!(Scene::from_vrml(&long).unwrap_err().kind(), BadValue);
}

#[test]
fn many_nodes_of_one_name_are_written_at_once() {
    let scene = Scene::from_vrml(&"Transform{}".repeat(90_000)).unwrap();
    assert!(scene.to_wrl().unwrap().contains("DEF Transform_90000 Transform"));
    assert_eq!(Glb::of(&scene).list("nodes").len(), 90_000);
}

/// Any text removed from the figure, or inserted into it, is read or rejected.
#[test]
fn damaged_figures_do_no_harm() {
    for at in (0..FIGURE.len()).filter(|at| FIGURE.is_char_boundary(*at)) {
        for text in [&FIGURE[..at], &FIGURE[at..]] {
            let _ = Scene::from_vrml(text);
        }
        for piece in ["{", "}", "[", "]", "#", " 1e999 ", " DEF ", "\u{e9}"] {
            if let Ok(scene) = Scene::from_vrml(&format!("{}{piece}{}", &FIGURE[..at], &FIGURE[at..])) {
                assert!(scene.to_wrl().is_ok());
            }
        }
    }
}
