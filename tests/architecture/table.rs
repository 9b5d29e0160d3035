//! The permitted dependencies between modules.

/// Modules at the root of a crate that every module may use. They use only each other.
const ROOT: [&str; 7] = ["error", "escape", "limits", "random", "watch", "files", "tolerances"];

/// The reader of input files: every module below it may use it.
const DOCUMENT: &str = "document";

/// Each other module with the modules that it may use, which are above it in the table.
const TABLE: [(&str, Uses); 29] = [
    ("drawing", Uses::Only(&[])),
    ("number", Uses::Only(&[])),
    (DOCUMENT, Uses::Only(&["number"])),
    ("poly", Uses::Only(&["number"])),
    ("groebner", Uses::Only(&["number", "poly"])),
    ("roots", Uses::Only(&["number", "poly"])),
    ("real", Uses::Only(&["number", "poly", "groebner", "roots"])),
    ("spatial", Uses::Only(&["number"])),
    ("model", Uses::Only(&["number", "spatial"])),
    ("kinematics", Uses::Only(&["number", "roots", "spatial", "model"])),
    ("robots", Uses::Only(&["model", "kinematics"])),
    ("dynamics", Uses::Only(&["number", "poly", "spatial", "model", "kinematics"])),
    ("control", Uses::Only(&["drawing", "spatial", "model", "dynamics"])),
    ("solver", Uses::Only(&["number", "poly", "roots", "spatial", "kinematics"])),
    ("reach", Uses::Only(&["drawing", "spatial", "kinematics", "solver"])),
    (
        "derive",
        Uses::Only(&["number", "poly", "groebner", "roots", "spatial", "model", "kinematics", "robots", "solver"]),
    ),
    (
        "witness",
        Uses::Only(&["number", "poly", "groebner", "roots", "real", "spatial", "kinematics", "solver", "derive"]),
    ),
    ("codegen", Uses::Only(&["number", "kinematics", "dynamics", "solver"])),
    ("motion", Uses::Only(&["spatial", "model", "kinematics"])),
    ("gait", Uses::Only(&["number", "drawing", "spatial", "model", "kinematics", "dynamics", "motion"])),
    ("walkers", Uses::Only(&["spatial", "model", "kinematics", "robots", "gait"])),
    ("nav", Uses::Only(&["spatial"])),
    ("task", Uses::Only(&["drawing", "spatial", "model", "dynamics", "motion", "gait", "nav"])),
    ("sim", Uses::AllAbove),
    ("stabilizer", Uses::Only(&["spatial", "motion", "gait", "sim"])),
    (
        "view",
        Uses::Only(&[
            "spatial",
            "model",
            "kinematics",
            "solver",
            "reach",
            "motion",
            "gait",
            "robots",
            "walkers",
            "nav",
            "task",
            "sim",
        ]),
    ),
    ("serve", Uses::Only(&["sim"])),
    (
        "folder",
        Uses::Only(&[
            "number",
            "spatial",
            "model",
            "kinematics",
            "robots",
            "dynamics",
            "solver",
            "derive",
            "witness",
            "codegen",
        ]),
    ),
    ("cli", Uses::AllAbove),
];

/// Pairs that are forbidden regardless of the table, for example because the screw solver and the derived solver verify
/// each other.
const NEVER: [(&str, &str); 9] = [
    ("kinematics::screw", "poly"),
    ("kinematics::screw", "groebner"),
    ("kinematics::screw", "derive"),
    ("kinematics::screw", "solver"),
    ("groebner", "kinematics::screw"),
    ("derive", "kinematics::screw"),
    ("solver", "kinematics::screw"),
    ("sim", "witness"),
    ("serve", "witness"),
];

enum Uses {
    Only(&'static [&'static str]),
    AllAbove,
}

/// Whether `name` is a module of the crate root in this table.
pub fn knows(name: &str) -> bool {
    ROOT.contains(&name) || row(name).is_some()
}

/// The reason why code in the module `from` may not use `to`, both as paths from the crate root; `None` if it may. An
/// empty `from` is `lib.rs`, which may use every module. `main` is `main.rs`.
pub fn objection(from: &[String], to: &[String]) -> Option<String> {
    let (Some(source), Some(target)) = (from.first(), to.first()) else {
        return to.is_empty().then(|| "names the whole crate; name a module of it".to_owned());
    };
    if let Some((_, never)) = NEVER.iter().find(|(a, b)| is_inside(from, a) && is_inside(to, b)) {
        return Some(format!("the two solvers are separate witnesses: never uses `{never}`"));
    }
    if source == target || ROOT.contains(&target.as_str()) {
        return None;
    }
    let allowed = allowed(source);
    (!allowed.contains(&target.as_str())).then(|| {
        let list = if allowed.is_empty() { "nothing else".to_owned() } else { allowed.join(", ") };
        format!("`{source}` may not use `{target}`; it may use {} and {list}", ROOT.join(", "))
    })
}

fn allowed(source: &str) -> Vec<&'static str> {
    let Some(i) = row(source) else { return if source == "main" { vec!["cli"] } else { Vec::new() } };
    let above = TABLE[..i].iter().map(|(name, _)| *name);
    match TABLE[i].1 {
        Uses::AllAbove => above.collect(),
        Uses::Only(modules) => above.filter(|name| *name == DOCUMENT || modules.contains(name)).collect(),
    }
}

fn row(name: &str) -> Option<usize> {
    TABLE.iter().position(|(module, _)| *module == name)
}

fn is_inside(path: &[String], module: &str) -> bool {
    let segments: Vec<&str> = module.split("::").collect();
    path.len() >= segments.len() && path.iter().zip(segments).all(|(a, b)| a == b)
}

#[test]
fn the_table_has_no_cycle() {
    for (i, (name, uses)) in TABLE.iter().enumerate() {
        let Uses::Only(modules) = uses else { continue };
        for used in *modules {
            assert!(row(used).is_some_and(|j| j < i), "`{name}` uses `{used}`, which does not stand above it");
        }
    }
}
