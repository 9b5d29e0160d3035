//! A file or a set of files is replaced completely or not at all, and no temporary file remains.

mod faults;
mod own;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use groebot_robot::files::{StagedFolder, write_atomically, write_folder_atomically};
use groebot_robot::{ErrorKind, Watch};
use proptest::prelude::*;
use tempfile::tempdir;

/// Every entry of `folder`, including hidden ones. A folder counts as empty content.
fn content(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entry = |entry: std::io::Result<fs::DirEntry>| {
        let entry = entry.unwrap();
        (entry.file_name().into_string().unwrap(), fs::read(entry.path()).unwrap_or_default())
    };
    fs::read_dir(folder).unwrap().map(entry).collect()
}

fn files(pairs: &[(&str, &str)]) -> Vec<(String, Vec<u8>)> {
    pairs.iter().map(|(name, text)| (name.to_string(), text.as_bytes().to_vec())).collect()
}

fn map(pairs: &[(&str, &str)]) -> BTreeMap<String, Vec<u8>> {
    files(pairs).into_iter().collect()
}

proptest! {
    #![proptest_config(crate::cases(32))]

    #[test]
    fn what_was_written_is_read_back(first in any::<Vec<u8>>(), second in any::<Vec<u8>>()) {
        let folder = tempdir().unwrap();
        let path = folder.path().join("a.txt");
        for bytes in [&first, &second] {
            write_atomically(&path, bytes).unwrap();
            prop_assert_eq!(&fs::read(&path).unwrap(), bytes);
            prop_assert_eq!(content(folder.path()).len(), 1);
        }
    }
}

#[test]
fn a_file_that_cannot_be_written_is_named() {
    let folder = tempdir().unwrap();
    let absent = folder.path().join("absent/a.txt");
    let error = write_atomically(&absent, b"x").unwrap_err();
    assert_eq!((error.kind(), error.place().file.as_deref()), (ErrorKind::Io, Some(absent.as_path())));
    assert_eq!(write_atomically(Path::new("/"), b"x").unwrap_err().kind(), ErrorKind::BadValue);
    assert_eq!(write_atomically(Path::new(""), b"x").unwrap_err().kind(), ErrorKind::BadValue);
}

#[test]
fn a_folder_in_the_place_of_the_file_stays_and_no_temporary_file_does() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("taken");
    fs::create_dir(&path).unwrap();
    assert_eq!(write_atomically(&path, b"x").unwrap_err().kind(), ErrorKind::Io);
    assert!(path.is_dir());
    assert_eq!(content(folder.path()).len(), 1);
}

#[test]
fn a_set_of_files_is_written_into_new_folders() {
    let folder = tempdir().unwrap();
    let deep = folder.path().join("a/b");
    let set = [("1.txt", "one"), ("2.txt", "")];
    write_folder_atomically(&deep, &files(&set), &Watch::none()).unwrap();
    assert_eq!(content(&deep), map(&set));
}

#[test]
fn files_outside_the_set_are_left_alone() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("mine"), "kept").unwrap();
    fs::write(folder.path().join("1.txt"), "old").unwrap();
    write_folder_atomically(folder.path(), &files(&[("1.txt", "new")]), &Watch::none()).unwrap();
    assert_eq!(content(folder.path()), map(&[("mine", "kept"), ("1.txt", "new")]));
}

#[test]
fn a_dropped_set_leaves_no_trace() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("1.txt"), "old").unwrap();
    let set = files(&[("1.txt", "new"), ("2.txt", "new")]);
    let here = StagedFolder::stage(folder.path(), &set, &Watch::none()).unwrap();
    let deep = StagedFolder::stage(&folder.path().join("a/b"), &set, &Watch::none()).unwrap();
    assert_eq!(fs::read(folder.path().join("1.txt")).unwrap(), b"old");
    drop((here, deep));
    assert_eq!(content(folder.path()), map(&[("1.txt", "old")]));
}

#[test]
fn a_cancelled_set_leaves_no_trace() {
    let folder = tempdir().unwrap();
    let watch = Watch::none().with_cancel(Arc::new(AtomicBool::new(true)));
    let error = write_folder_atomically(&folder.path().join("new"), &files(&[("1.txt", "x")]), &watch).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Cancelled);
    assert_eq!(content(folder.path()), map(&[]));
}

#[test]
fn a_failed_rename_takes_the_earlier_ones_back() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("1.txt"), "old").unwrap();
    let set = files(&[("1.txt", "new"), ("2.txt", "new"), ("3.txt", "new"), ("4.txt", "new")]);
    let staged = StagedFolder::stage(folder.path(), &set, &Watch::none()).unwrap();
    fs::create_dir(folder.path().join("3.txt")).unwrap();
    let error = staged.commit().unwrap_err();
    assert_eq!((error.kind(), error.place().file.clone()), (ErrorKind::Io, Some(folder.path().join("3.txt"))));
    assert_eq!(content(folder.path()), map(&[("1.txt", "old"), ("3.txt", "")]));
}

#[test]
fn names_that_leave_the_folder_or_repeat_are_refused() {
    let folder = tempdir().unwrap();
    for name in ["", ".", "..", "a/b", "/a", "a/", "./a", "../a"] {
        let error = write_folder_atomically(folder.path(), &files(&[(name, "x")]), &Watch::none()).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::BadValue, "{name}");
    }
    let twice = files(&[("a", "x"), ("a", "y")]);
    let error = write_folder_atomically(folder.path(), &twice, &Watch::none()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::DuplicateName);
    assert_eq!(content(folder.path()), map(&[]));
}

#[cfg(unix)]
#[test]
fn permissions_are_those_of_an_ordinary_file() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempdir().unwrap();
    let (plain, ours) = (folder.path().join("plain"), folder.path().join("ours"));
    let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode();
    fs::write(&plain, "x").unwrap();
    write_atomically(&ours, b"x").unwrap();
    assert_eq!(mode(&ours), mode(&plain));
    fs::set_permissions(&ours, fs::Permissions::from_mode(0o640)).unwrap();
    write_atomically(&ours, b"y").unwrap();
    assert_eq!(mode(&ours) & 0o777, 0o640);
}

/// An unlocked temporary file was left by a killed process.
#[test]
fn what_a_killed_process_left_goes_with_the_next_set() {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    for name in [".groebot-dead.tmp", ".groebot-alive.tmp", ".groebot-mine", "a.tmp"] {
        fs::write(at(name), "half").unwrap();
    }
    fs::create_dir(at(".groebot-folder.tmp")).unwrap();
    let alive = fs::File::open(at(".groebot-alive.tmp")).unwrap();
    alive.lock().unwrap();
    write_folder_atomically(folder.path(), &files(&[("1.txt", "new")]), &Watch::none()).unwrap();
    let left = content(folder.path());
    let names: Vec<&str> = left.keys().map(String::as_str).collect();
    assert_eq!(names, [".groebot-alive.tmp", ".groebot-folder.tmp", ".groebot-mine", "1.txt", "a.tmp"]);
    drop(alive);
    write_folder_atomically(folder.path(), &files(&[("1.txt", "new")]), &Watch::none()).unwrap();
    assert!(!at(".groebot-alive.tmp").exists());
}

/// The temporary file of an active writer is not removed as a left-over file.
#[test]
fn single_files_and_sets_are_written_into_one_folder_at_once() {
    let folder = tempdir().unwrap();
    let single = |name: &'static str| {
        let path = folder.path().join(name);
        move || (0..200).for_each(|_| write_atomically(&path, b"single").unwrap())
    };
    let sets = || {
        for _ in 0..100 {
            write_folder_atomically(folder.path(), &files(&[("1.txt", "set")]), &Watch::none()).unwrap();
        }
    };
    std::thread::scope(|scope| {
        scope.spawn(single("a.txt"));
        scope.spawn(single("b.txt"));
        scope.spawn(sets);
    });
    assert_eq!(content(folder.path()), map(&[("1.txt", "set"), ("a.txt", "single"), ("b.txt", "single")]));
}
