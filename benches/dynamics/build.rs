//! Generates the equations of motion of robots as Rust and C and compiles the C code. If `PINOCCHIO` is the folder of its pip package, also compiles the calls
//! of Pinocchio.

use std::path::{Path, PathBuf};
use std::{env, fs};

use groebot::codegen::dynamics::{Form, Function, Printed};
use groebot::dynamics::{Base, Equations};
use groebot::model::{JointType, Robot};

/// Robots, joints that are held at zero, and whether the base is floating.
const ROBOTS: [(&str, &[&str], Base); 3] = [
    ("ur5", &[], Base::Fixed),
    ("panda", &["panda_finger_joint1", "panda_finger_joint2"], Base::Fixed),
    ("humanoid", &[], Base::Floating),
];

fn main() {
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap());
    let corpus = Path::new("../../tests/corpus/dynamics");
    println!("cargo:rerun-if-changed={}", corpus.display());
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-env-changed=PINOCCHIO");
    println!("cargo:rustc-check-cfg=cfg(pinocchio)");
    for (name, held, base) in ROBOTS {
        let text = fs::read_to_string(corpus.join(format!("{name}.urdf"))).unwrap();
        let mut parts = Robot::from_urdf(&text).unwrap().as_meant().unwrap().parts().clone();
        for joint in parts.joints.iter_mut().filter(|joint| held.contains(&joint.name.as_str())) {
            (joint.kind, joint.limits) = (JointType::Fixed, None);
        }
        let equations = Equations::unchecked(&Robot::new(parts).unwrap(), base).unwrap();
        let (remarks, functions) = (Vec::new(), Function::ALL.to_vec());
        let printed = Printed { name, equations: &equations, remarks, functions, form: Form::Shorter };
        let rust: String = printed
            .rust()
            .unwrap()
            .lines()
            .filter(|line| !line.starts_with("//!") && !line.starts_with("#!["))
            .map(|line| format!("{line}\n"))
            .collect();
        fs::write(out.join(format!("{name}.rs")), rust).unwrap();
        let [header, source] = printed.c99(name).unwrap();
        fs::write(out.join(format!("{name}.h")), header).unwrap();
        fs::write(out.join(format!("{name}.c")), source).unwrap();
    }
    cc::Build::new()
        .files(ROBOTS.map(|(name, ..)| out.join(format!("{name}.c"))))
        .include(&out)
        .include("../../runtime/c")
        .flag("-std=c99")
        .opt_level(2)
        .compile("printed");
    let Some(prefix) = env::var_os("PINOCCHIO").map(PathBuf::from) else {
        println!("cargo:warning=PINOCCHIO is not set: groebot is measured alone (README.md says how to get it)");
        return;
    };
    println!("cargo:rustc-cfg=pinocchio");
    println!("cargo:rerun-if-changed=pinocchio.cpp");
    let include = prefix.join("include");
    let library = prefix.join("lib");
    cc::Build::new()
        .cpp(true)
        .file("pinocchio.cpp")
        .includes([include.clone(), include.join("eigen3"), include.join("urdfdom")])
        .flag("-std=c++17")
        .flag("-w")
        .opt_level(3)
        .define("PINOCCHIO_ENABLE_TEMPLATE_INSTANTIATION", None)
        .define("PINOCCHIO_WITH_URDFDOM", None)
        .define("NDEBUG", None)
        .define("BOOST_MPL_LIMIT_LIST_SIZE", "40")
        .define("BOOST_MPL_LIMIT_VECTOR_SIZE", "40")
        .define("BOOST_MPL_CFG_NO_PREPROCESSED_HEADERS", None)
        .compile("calls");
    println!("cargo:rustc-link-search=native={}", library.display());
    println!("cargo:rustc-link-arg=-Wl,-rpath,{}", library.display());
    for name in ["pinocchio_default", "pinocchio_parsers", "urdfdom_model"] {
        println!("cargo:rustc-link-lib=dylib={name}");
    }
}
