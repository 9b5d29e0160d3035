//! The cache of derived solvers.

use std::fs;
use std::path::Path;
use std::time::SystemTime;

use groebot_ik::ErrorKind;
use groebot_ik::folder::{self, PROGRAM, SolverCache};
use groebot_robot::robots;
use tempfile::tempdir;

/// The time of the last change of a folder's program.
fn changed(folder: &Path) -> SystemTime {
    fs::metadata(folder.join(PROGRAM)).unwrap().modified().unwrap()
}

#[test]
fn a_solver_is_derived_once() {
    let place = tempdir().unwrap();
    let cache = SolverCache::new(place.path().join("a/b"));
    let polar = robots::find("polar").unwrap();
    let first = cache.derivation(polar, None).unwrap();
    let time = changed(&first);
    assert_eq!(folder::program(&first).unwrap().name, "polar");
    assert_eq!(cache.derivation(polar, None).unwrap(), first);
    assert_eq!(changed(&first), time);
    // Only the derivation is left.
    assert_eq!(fs::read_dir(place.path().join("a/b")).unwrap().count(), 1);
}

#[test]
fn a_damaged_folder_is_derived_again() {
    let place = tempdir().unwrap();
    let cache = SolverCache::new(place.path());
    let polar = robots::find("polar").unwrap();
    let folder = cache.derivation(polar, None).unwrap();
    let files = ["5_program.json", "certificate.json", "0_chain.toml", "cache.sha256"];
    let sound = files.map(|name| fs::read(folder.join(name)).unwrap());
    for name in files {
        let mut bytes = fs::read(folder.join(name)).unwrap();
        bytes[20] ^= 1;
        fs::write(folder.join(name), bytes).unwrap();
        assert_eq!(cache.derivation(polar, None).unwrap(), folder);
        assert_eq!(files.map(|name| fs::read(folder.join(name)).unwrap()), sound, "{name}");
        fs::remove_file(folder.join(name)).unwrap();
        cache.derivation(polar, None).unwrap();
        assert_eq!(files.map(|name| fs::read(folder.join(name)).unwrap()), sound, "{name}");
    }
    assert_eq!(fs::read_dir(place.path()).unwrap().count(), 1);
}

#[test]
fn several_processes_share_a_cache() {
    let place = tempdir().unwrap();
    let polar = robots::find("polar").unwrap();
    let derive = || {
        let folder = SolverCache::new(place.path()).derivation(polar, None).unwrap();
        folder::program(&folder).unwrap()
    };
    let programs = std::thread::scope(|scope| {
        let threads = [(); 4].map(|()| scope.spawn(derive));
        threads.map(|thread| thread.join().unwrap())
    });
    assert!(programs.windows(2).all(|pair| pair[0] == pair[1]));
    assert_eq!(fs::read_dir(place.path()).unwrap().count(), 1);
}

#[test]
fn a_robot_with_several_chains_has_no_solver() {
    let place = tempdir().unwrap();
    let error = SolverCache::new(place.path()).derivation(robots::find("nao").unwrap(), None).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unsupported);
    assert!(error.message().contains("nao_left_leg"), "{error}");
}

#[test]
fn a_folder_that_cannot_be_written_is_an_error() {
    let place = tempdir().unwrap();
    let file = place.path().join("file");
    fs::write(&file, "").unwrap();
    let error = SolverCache::new(&file).derivation(robots::find("polar").unwrap(), None).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Io);
}
