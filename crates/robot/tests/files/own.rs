//! Which files are replaced, and which are written to instead.

use std::fs;

use groebot_robot::files::{MARK, Target, refuse_foreign, write_atomically};
use tempfile::tempdir;

#[test]
fn files_of_others_are_known() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("a");
    let marked = format!("/* @{MARK} 1.0 */\nint x;\n");
    let late = format!("{}{MARK}", " ".repeat(3000));
    let own: [(&str, &str); 7] = [
        ("", "new"),
        ("same", "same"),
        (&marked, "new"),
        ("# groebot trajectory 1\n", "new"),
        ("{\"generator\":\"groebot\",\"format\":1}", "new"),
        ("x,y\n1,2\n", "x,y\n3,4\n"),
        ("x,y\r\n1,2\r\n", "x,y\n3,4\n"),
    ];
    let foreign: [(&str, &str); 7] = [
        ("mine", "new"),
        ("mine\n", "mine\nbut longer\n"),
        ("x,z\n1,2\n", "x,y\n1,2\n"),
        ("{\"format\":1}", "{\"format\":1}\n"),
        ("{\"format\":1,\n2", "{\"format\":1,\n\"generator\":\"groebot\"}"),
        (&late, "new"),
        ("# variables: x, y\n", "variables: x, y\n"),
    ];
    for (list, is_own) in [(own, true), (foreign, false)] {
        for (old, new) in list {
            fs::write(&path, old).unwrap();
            assert_eq!(refuse_foreign(&path, new.as_bytes()).is_ok(), is_own, "{old:?} by {new:?}");
        }
    }
    fs::remove_file(&path).unwrap();
    assert!(refuse_foreign(&path, b"new").is_ok());
}

#[cfg(unix)]
#[test]
fn devices_pipes_and_links_to_them_stay() {
    use std::os::unix::fs::{FileTypeExt, symlink};
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    symlink("/dev/null", at("null")).unwrap();
    symlink("file", at("link")).unwrap();
    symlink("nowhere", at("dangling")).unwrap();
    fs::write(at("file"), "kept").unwrap();
    let kinds = [("null", Target::Stream), ("link", Target::Link), ("dangling", Target::Link), ("file", Target::File)];
    for (name, kind) in kinds {
        assert_eq!(Target::of(&at(name)).unwrap(), kind, "{name}");
    }
    assert_eq!(Target::of("/dev/stdout".as_ref()).unwrap(), Target::Stream);
    write_atomically(&at("null"), b"x").unwrap();
    assert!(fs::symlink_metadata(at("null")).unwrap().is_symlink());
    assert!(write_atomically("/dev/full".as_ref(), b"x").is_err());
    assert!(refuse_foreign(&at("link"), b"kept").is_err());
    assert_eq!(fs::read(at("file")).unwrap(), b"kept");

    let pipe = at("pipe");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let reader = std::thread::spawn({
        let pipe = pipe.clone();
        move || fs::read(pipe).unwrap()
    });
    write_atomically(&pipe, b"through").unwrap();
    assert_eq!(reader.join().unwrap(), b"through");
    assert!(fs::metadata(&pipe).unwrap().file_type().is_fifo());
}
