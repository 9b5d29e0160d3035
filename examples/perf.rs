//! perf
use groebot::Watch;
use groebot::derive::*;
use groebot::kinematics::Chain;
use std::path::Path;
use std::time::{Duration, Instant};
fn show(n: &tree::Node, d: usize) {
    println!(
        "{}[{}] {} order {:?}",
        "  ".repeat(d),
        n.label,
        describe(n),
        n.solved().map(|s| s.certified.order.join(" "))
    );
    for c in &n.children {
        show(c, d + 1);
    }
}
fn main() {
    let j = |n: &str, k: &str, a: &str, p: &str| {
        format!("[[joint]]\nname = \"{n}\"\ntype = \"{k}\"\naxis = {a}\npoint = {p}\n")
    };
    let planar3 = format!(
        "name=\"planar3\"\n[task]\nkind=\"planar_pose\"\nplane=\"xz\"\n{}{}{}[tip]\npoint=[0,0,0.8]\n",
        j("a", "revolute", "[0,1,0]", "[0,0,0]"),
        j("b", "revolute", "[0,1,0]", "[0,0,0.4]"),
        j("c", "revolute", "[0,1,0]", "[0,0,0.7]")
    );
    let sph = format!(
        "name=\"sph\"\n[task]\nkind=\"position\"\n{}{}{}[tip]\npoint=[0,0,1.2]\n",
        j("a", "revolute", "[0,0,1]", "[0,0,0]"),
        j("b", "revolute", "[0,1,0]", "[0,0,0.3]"),
        j("c", "revolute", "[0,1,0]", "[0,0,0.7]")
    );
    let slant = format!(
        "name=\"slant\"\n[task]\nkind=\"position\"\n{}{}{}[tip]\npoint=[0,0,0.5]\n",
        j("a", "revolute", "[0,1,1]", "[0,0,0]"),
        j("b", "revolute", "[1,0,0]", "[0,0,0]"),
        j("c", "prismatic", "[0,0,2]", "[0,0,0]")
    );
    let mut list: Vec<System> = ["derivations/nao_leg_sagittal", "derivations/nao_arm_planar"]
        .iter()
        .map(|d| Source::read(Path::new(d)).unwrap().system)
        .collect();
    let a: Vec<String> = std::env::args().collect();
    if a.iter().any(|x| x == "3") {
        list.push(formulate(&Chain::from_toml(&planar3).unwrap()).unwrap());
    }
    if a.iter().any(|x| x == "s") {
        list.push(formulate(&Chain::from_toml(&sph).unwrap()).unwrap());
    }
    if a.iter().any(|x| x == "l") {
        list.push(formulate(&Chain::from_toml(&slant).unwrap()).unwrap());
    }
    for s in list {
        println!("{s}");
        for o in [Orders::Requested, Orders::Searched] {
            let t = Instant::now();
            match derive_tree(
                &s,
                o,
                &Watch::none().with_time(Duration::from_secs(60)).with_listener(|p| {
                    if p.done % 200 == 199 {
                        eprintln!("{p:?}")
                    }
                }),
            ) {
                Ok(n) => {
                    println!("{o:?} {:?}", t.elapsed());
                    show(&n, 0);
                }
                Err(e) => println!("{e} {:?}", t.elapsed()),
            }
        }
    }
}
