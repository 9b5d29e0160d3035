//! Unchanged derivations of all kinds, and the folders that they write.

use std::fs;
use std::path::{Path, PathBuf};

use groebot_ik::Watch;
use groebot_ik::derive::{Derivation, Recount, Source};
use groebot_ik::folder::{CERTIFICATE, Stored, Written, derived, prove};
use groebot_ik::witness::{self, Report};
use serde_json::Value;
use tempfile::{TempDir, tempdir};

/// A derivation, and its folder with only the certificate.
pub struct Honest {
    pub source: Source,
    pub proved: Derivation,
    pub stored: Stored,
    pub recount: Recount,
    _folder: Option<TempDir>,
}

fn committed(name: &str) -> PathBuf {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("derivations").join(name)
}

/// The certificate of a committed derivation.
pub fn certificate(name: &str) -> Value {
    serde_json::from_str(&fs::read_to_string(committed(name).join(CERTIFICATE)).unwrap()).unwrap()
}

/// The text of a committed file.
pub fn text(name: &str, file: &str) -> String {
    fs::read_to_string(committed(name).join(file)).unwrap()
}

impl Honest {
    /// A committed derivation, proved again.
    pub fn new(name: &str) -> Self {
        let folder = committed(name);
        let (source, stored) = (Source::read(&folder).unwrap(), Stored::read(&folder).unwrap());
        let mut recount = Recount::new(&Watch::none());
        let proved = prove(&source, &stored, &mut recount).unwrap();
        Honest { source, proved, stored, recount, _folder: None }
    }

    /// Two planar arms on a common shoulder, derived.
    pub fn two_arms() -> Self {
        let folder = tempdir().unwrap();
        let arm = |name: &str, joints: usize| {
            let joint =
                |k| format!("[[joint]]\nname = \"j{k}\"\ntype = \"revolute\"\naxis = [0, 0, 1]\npoint = [{k}, 0, 0]\n");
            let joints_text: String = (0..joints).map(joint).collect();
            let task = "{ kind = \"planar_position\", plane = \"xy\" }";
            format!("name = \"{name}\"\ntask = {task}\n{joints_text}[tip]\npoint = [{joints}.25, 0, 0]\n")
        };
        let arms = "name = \"arms\"\nshared = [[\"a.j0\", \"b.j0\"]]\n[[chain]]\nname = \"a\"\nchain = \"a.toml\"\n[[chain]]\nname = \"b\"\nchain = \"b.toml\"\n";
        for (file, text) in [("0_coupled.toml", arms), ("a.toml", &arm("first", 2)), ("b.toml", &arm("second", 3))] {
            fs::write(folder.path().join(file), text).unwrap();
        }
        let source = Source::read(folder.path()).unwrap();
        let proved = Derivation::of(&source, &Watch::none()).unwrap().about(&source);
        let mut stored = Stored::read(folder.path()).unwrap();
        stored.files.extend(proved.stage_files().unwrap());
        Honest { source, proved, stored, recount: Recount::new(&Watch::none()), _folder: Some(folder) }
    }

    /// The certificate as JSON.
    pub fn certificate(&self) -> Value {
        serde_json::from_slice(self.stored.get(CERTIFICATE).unwrap()).unwrap()
    }

    /// Every file that the derivation writes, with the numeric checks.
    pub fn written(&self) -> (Vec<Written>, Report) {
        let checked = witness::check(&self.source, &self.proved, &Watch::none()).unwrap();
        (derived(&self.source, &self.proved, &checked).unwrap(), checked)
    }
}
