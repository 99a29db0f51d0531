//! Tests of what is written, what is refused, and which files are left over.

use msdd_files::{FileError, Lock, Part, read, read_text, write};
use std::fs;
use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};
use std::path::{Path, PathBuf};

fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn a_file_is_replaced_whole_and_its_folder_is_made() {
    let folder = folder("whole");
    let file = folder.join("new/a.txt");
    for text in ["first", "second and longer", ""] {
        write(&file, text.as_bytes()).unwrap();
        assert_eq!(fs::read_to_string(&file).unwrap(), text);
    }
    // A file with the permissions that any program's file has.
    fs::write(folder.join("plain"), "").unwrap();
    let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode();
    assert_eq!(mode(&file), mode(&folder.join("plain")));
    assert_eq!(names(&folder.join("new")), ["a.txt"]);
    let long = folder.join("ä".repeat(120));
    write(&long, b"long").unwrap();
    assert_eq!(fs::read(&long).unwrap(), b"long");
}

#[test]
fn an_error_leaves_the_old_file_and_no_part() {
    let folder = folder("error");
    let file = folder.join("a");
    write(&file, b"old").unwrap();
    let part = Part::beside(&file).unwrap();
    fs::write(part.path(), b"half").unwrap();
    assert_eq!(names(&folder).len(), 2);
    drop(part);
    assert_eq!(names(&folder), ["a"]);
    assert_eq!(fs::read(&file).unwrap(), b"old");
    let error = write(&file.join("below"), b"x").unwrap_err().to_string();
    assert!(error.contains("error/a"), "{error}");
}

#[test]
fn links_are_neither_followed_nor_replaced() {
    let folder = folder("links");
    let victim = folder.join("victim");
    fs::write(&victim, "precious").unwrap();
    for (link, target) in [("to_file", "victim"), ("to_nothing", "absent"), ("to_folder", ".")] {
        let link = folder.join(link);
        symlink(target, &link).unwrap();
        let error = write(&link, b"x").unwrap_err();
        assert!(matches!(&error, FileError::Link { .. }), "{error}");
        let text = error.to_string();
        assert!(text.contains(&link.display().to_string()) && text.contains(target), "{text}");
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        // A lock file that is a link is not followed either.
        symlink("victim", folder.join("a.lock")).unwrap();
        assert!(matches!(Lock::take(&folder.join("a")), Err(FileError::Link { .. })));
        fs::remove_file(folder.join("a.lock")).unwrap();
    }
    assert_eq!(fs::read_to_string(&victim).unwrap(), "precious");
    assert!(!folder.join("absent").exists());
}

#[test]
fn devices_folders_and_pipes_stay_what_they_are() {
    let folder = folder("kinds");
    let refused = |path: &Path, kind: &str| {
        let error = write(path, b"x").unwrap_err().to_string();
        assert!(error.contains(kind) && error.contains("allowed: a regular file"), "{error}");
    };
    refused(&folder, "a folder");
    refused(Path::new("/dev/null"), "a device");
    refused(Path::new("/"), "no name of a file");
    refused(Path::new(""), "no name of a file");
    refused(&folder.join("a/"), "no name of a file");
    let pipe = folder.join("pipe");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    refused(&pipe, "a pipe");
    let kind = fs::symlink_metadata(&pipe).unwrap().file_type();
    assert!(kind.is_fifo() && fs::metadata("/dev/null").unwrap().file_type().is_char_device());
    assert_eq!(names(&folder), ["pipe"]);
}

#[test]
fn two_writers_at_once_leave_one_of_the_two_files() {
    let folder = folder("two");
    let file = folder.join("a");
    let texts = ["a", "b"].map(|letter| letter.repeat(100_000));
    std::thread::scope(|scope| {
        for text in &texts {
            let file = &file;
            scope.spawn(move || (0..50).for_each(|_| write(file, text.as_bytes()).unwrap()));
        }
    });
    assert!(texts.contains(&fs::read_to_string(&file).unwrap()));
    assert_eq!(names(&folder), ["a"]);
}

#[test]
fn what_killed_programs_left_is_in_nobodys_way() {
    let folder = folder("left");
    for name in ["a.part", "a.XXXXXX.part", "a.lock"] {
        fs::write(folder.join(name), "left").unwrap();
    }
    let file = folder.join("a");
    let lock = Lock::take(&file).unwrap();
    write(&file, b"new").unwrap();
    drop(lock);
    assert_eq!(names(&folder), ["a", "a.XXXXXX.part", "a.part"]);
}

#[test]
fn the_second_is_told_who_holds_the_lock() {
    let file = folder("lock").join("a");
    let lock = Lock::take(&file).unwrap();
    let error = Lock::take(&file).err().unwrap().to_string();
    assert!(error.contains(&format!("process {}", std::process::id())), "{error}");
    drop(lock);
    // Many threads take and release the lock; there must never be two inside at the same time.
    let inside = std::sync::atomic::AtomicUsize::new(0);
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                for _ in 0..500 {
                    let Ok(_lock) = Lock::take(&file) else { continue };
                    assert_eq!(inside.fetch_add(1, std::sync::atomic::Ordering::SeqCst), 0);
                    inside.fetch_sub(1, std::sync::atomic::Ordering::SeqCst);
                }
            });
        }
    });
    assert!(!file.with_extension("lock").exists());
}

#[test]
fn reading_ends_at_the_limit() {
    let file = folder("limit").join("a");
    fs::write(&file, "12345").unwrap();
    assert_eq!(read(&file, 5).unwrap(), b"12345");
    assert!(read(&file, 4).unwrap_err().to_string().contains("more than 4 bytes"));
    assert!(matches!(read(Path::new("/dev/zero"), 1000), Err(FileError::Large { .. })));
    fs::write(&file, b"ab\xffc").unwrap();
    let error = read_text(&file).unwrap_err().to_string();
    assert!(error.contains("limit/a: byte 2 is not UTF-8"), "{error}");
}
