//! Every step of the writer fails in turn, once or permanently: each file is old or new, and a mixed folder is
//! recognised.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io;
use std::path::Path;

use groebot_robot::files::{Disk, StagedFolder, System, refuse_unfinished, write_atomically_on};
use groebot_robot::{Result, Watch};
use tempfile::{NamedTempFile, tempdir};

use super::{content, files, map};

const NOTE: &str = ".groebot-unfinished";

/// A disk on which one step fails after a number of others. If it is `dead`, all later steps fail too, as after a
/// killed process.
#[derive(Debug)]
struct Faulty {
    left: Cell<usize>,
    dead: bool,
    failed: Cell<bool>,
}

impl Faulty {
    fn new(steps: usize, dead: bool) -> Self {
        Faulty { left: Cell::new(steps), dead, failed: Cell::new(false) }
    }

    fn step(&self) -> io::Result<()> {
        match self.left.get().checked_sub(1) {
            Some(left) => self.left.set(left),
            None if self.dead || !self.failed.replace(true) => {
                self.failed.set(true);
                return Err(io::Error::other("no space"));
            }
            None => {}
        }
        Ok(())
    }
}

impl Disk for Faulty {
    fn create(&self, folder: &Path, like: &Path) -> io::Result<NamedTempFile> {
        self.step()?;
        System.create(folder, like)
    }

    /// Half of the bytes are written before the error.
    fn write(&self, file: &mut File, bytes: &[u8]) -> io::Result<()> {
        let step = self.step();
        System.write(file, if step.is_ok() { bytes } else { &bytes[..bytes.len() / 2] })?;
        step
    }

    fn sync(&self, file: &File) -> io::Result<()> {
        self.step()?;
        System.sync(file)
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        self.step()?;
        System.rename(from, to)
    }

    fn remove(&self, path: &Path) -> io::Result<()> {
        self.step()?;
        System.remove(path)
    }

    fn sync_folder(&self, folder: &Path) -> io::Result<()> {
        self.step()?;
        System.sync_folder(folder)
    }
}

const OLD: [(&str, &str); 3] = [("1.txt", "old"), ("2.txt", "old"), ("stale.c", "old")];
const NEW: [(&str, &str); 3] = [("1.txt", "new"), ("2.txt", "new"), ("3.txt", "new")];

fn write_set(disk: &dyn Disk, folder: &Path) -> Result<()> {
    StagedFolder::stage_on(disk, folder, &files(&NEW), &Watch::none())?.without("stale.c")?.commit()
}

/// The result of a write, the content of the folder afterwards, and the folder.
type Outcome = (Result<()>, BTreeMap<String, Vec<u8>>, tempfile::TempDir);

/// The outcomes for each number of steps before the fault, until there is no fault.
fn outcomes(dead: bool) -> Vec<Outcome> {
    let mut outcomes = Vec::new();
    loop {
        let folder = tempdir().unwrap();
        OLD.iter().for_each(|(name, text)| fs::write(folder.path().join(name), text).unwrap());
        let disk = Faulty::new(outcomes.len(), dead);
        let result = write_set(&disk, folder.path());
        if !disk.failed.get() {
            result.unwrap();
            assert_eq!(content(folder.path()), map(&NEW));
            return outcomes;
        }
        outcomes.push((result, content(folder.path()), folder));
    }
}

#[test]
fn one_fault_leaves_the_old_set() {
    let outcomes = outcomes(false);
    // Three files with three steps each, three copies, the marker, four changes.
    assert!(outcomes.len() >= 9 + 9 + 5 + 4, "{}", outcomes.len());
    for (step, (result, left, folder)) in outcomes.iter().enumerate() {
        assert!(result.is_err(), "step {step}");
        if step + 1 == outcomes.len() {
            // The last step removes the marker: it remains, and readers refuse the set.
            assert_eq!(left.len(), NEW.len() + 1, "{left:?}");
            assert!(NEW.iter().all(|(name, _)| refuse_unfinished(&folder.path().join(name)).is_err()));
        } else {
            assert_eq!(*left, map(&OLD), "step {step}");
        }
    }
}

#[test]
fn a_killed_writer_leaves_whole_files_and_a_mixed_set_is_refused() {
    let mut mixed = 0;
    for (step, (_, left, folder)) in outcomes(true).into_iter().enumerate() {
        let is_whole = |(name, bytes): (&String, &Vec<u8>)| name == NOTE || bytes == b"old" || bytes == b"new";
        assert!(left.iter().all(is_whole), "step {step}: {left:?}");
        let bare: BTreeMap<_, _> = left.clone().into_iter().filter(|(name, _)| name != NOTE).collect();
        if bare != map(&OLD) && bare != map(&NEW) {
            mixed += 1;
            let names = OLD.iter().chain(&NEW).map(|(name, _)| folder.path().join(name));
            assert!(names.clone().all(|path| refuse_unfinished(&path).is_err()), "step {step}: {left:?}");
            assert!(groebot_robot::document::read_text(&folder.path().join("1.txt"), 100).is_err(), "step {step}");
        }
        // The next writer completes the set.
        write_set(&System, folder.path()).unwrap();
        assert_eq!(content(folder.path()), map(&NEW), "step {step}");
    }
    assert!(mixed >= 3, "{mixed}");
}

#[test]
fn another_set_does_not_make_an_interrupted_one_whole() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join(NOTE), "a.txt\nb.txt\n").unwrap();
    let others = files(&[("b.txt", "x"), ("c.txt", "x")]);
    groebot_robot::files::write_folder_atomically(folder.path(), &others, &Watch::none()).unwrap();
    assert!(refuse_unfinished(&folder.path().join("a.txt")).is_err());
    assert!(refuse_unfinished(&folder.path().join("b.txt")).is_ok());
}

#[test]
fn one_file_is_old_or_new_at_each_fault() {
    for dead in [false, true] {
        for step in 0.. {
            let folder = tempdir().unwrap();
            let path = folder.path().join("a.txt");
            fs::write(&path, "old").unwrap();
            let disk = Faulty::new(step, dead);
            let result = write_atomically_on(&disk, &path, b"new");
            let left = content(folder.path());
            if !disk.failed.get() {
                assert!(step >= 5, "create, write, sync, rename, sync of the folder");
                assert_eq!(left, map(&[("a.txt", "new")]));
                break;
            }
            assert!(result.is_err());
            assert!(left == map(&[("a.txt", "old")]) || left == map(&[("a.txt", "new")]), "step {step}: {left:?}");
        }
    }
}

#[test]
fn two_writers_of_one_folder_do_not_mix() {
    let folder = tempdir().unwrap();
    let deep = folder.path().join("new/folder");
    let names: Vec<String> = (0..8).map(|number| format!("{number}.txt")).collect();
    let writer = |text: &'static str| {
        let set: Vec<(String, Vec<u8>)> = names.iter().map(|name| (name.clone(), text.as_bytes().to_vec())).collect();
        let deep = &deep;
        move || (0..12).for_each(|_| groebot_robot::files::write_folder_atomically(deep, &set, &Watch::none()).unwrap())
    };
    std::thread::scope(|scope| {
        scope.spawn(writer("one"));
        scope.spawn(writer("two"));
    });
    let left = content(&deep);
    assert_eq!(left.len(), names.len());
    assert!(left.values().all(|text| text == left.values().next().unwrap()), "{left:?}");
}
