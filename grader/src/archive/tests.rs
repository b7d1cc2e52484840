use std::fs;
use std::io::{Cursor, Write};

use flate2::Compression;
use flate2::write::GzEncoder;
use grader::submission::{Source, Submission, Unreadable};
use zip::write::SimpleFileOptions;

use super::read_submission;

const BODY: &str = "pub fn psi_neo_hookean() {}";

fn read(name: &str, bytes: &[u8]) -> Result<Submission, Unreadable> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, bytes).unwrap();
    read_submission(&path)
}

fn tar_of(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut tar = tar::Builder::new(Vec::new());
    for (path, bytes) in files {
        let mut header = tar::Header::new_gnu();
        // Written by hand, because the builder refuses hostile paths.
        header.as_gnu_mut().unwrap().name[..path.len()].copy_from_slice(path.as_bytes());
        header.set_size(bytes.len() as u64);
        header.set_mode(0o644);
        header.set_cksum();
        tar.append(&header, *bytes).unwrap();
    }
    tar.into_inner().unwrap()
}

fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut gzip = GzEncoder::new(Vec::new(), Compression::fast());
    gzip.write_all(bytes).unwrap();
    gzip.finish().unwrap()
}

fn zip_of(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for (path, bytes) in files {
        zip.start_file(*path, SimpleFileOptions::default()).unwrap();
        zip.write_all(bytes).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

#[test]
fn every_kind_of_archive_gives_the_same_submission() {
    let files = [("ada/src/psi_neo_hookean.rs", BODY.as_bytes()), ("ada/data/mesh.obj", b"v 0 0 0")];
    let tar = tar_of(&files);
    let dotted = tar_of(&[("./src/psi_neo_hookean.rs", BODY.as_bytes())]);
    let submissions = [
        read("ada.zip", &zip_of(&files)),
        read("ada.tar", &tar),
        read("ada.tar.gz", &gzip(&tar)),
        read("ada.TGZ", &gzip(&tar)),
        read("ada.tgz", &gzip(&dotted)),
    ];
    for submission in submissions {
        let submission = submission.unwrap();
        assert_eq!(submission.name, "ada");
        assert_eq!(submission.functions["psi_neo_hookean"], Source::Written(BODY.to_owned()));
    }
}

#[test]
fn a_folder_with_an_archive_in_it_is_the_archive() {
    let folder = tempfile::tempdir().unwrap();
    let ada = folder.path().join("Ada Doe_17_assignsubmission_file_");
    fs::create_dir(&ada).unwrap();
    fs::write(ada.join("hw.zip"), zip_of(&[("hw/psi_neo_hookean.rs", b"old")])).unwrap();
    fs::write(ada.join("hw (1).zip"), zip_of(&[("hw/psi_neo_hookean.rs", BODY.as_bytes())])).unwrap();
    let submission = read_submission(&ada).unwrap();
    assert_eq!(submission.name, "Ada Doe_17_assignsubmission_file_");
    assert_eq!(submission.functions["psi_neo_hookean"], Source::Written(BODY.to_owned()), "the second attempt counts");
    fs::write(ada.join("other.zip"), zip_of(&[("src/psi_neo_hookean.rs", b"other")])).unwrap();
    assert!(
        read_submission(&ada)
            .is_err_and(|error| error.to_string().contains("several archives (hw (1).zip, hw.zip, other.zip)"))
    );
    fs::write(ada.join("psi_neo_hookean.rs"), BODY).unwrap();
    let submission = read_submission(&ada).unwrap();
    assert_eq!(submission.functions["psi_neo_hookean"], Source::Written(BODY.to_owned()), "files come before archives");
}

#[test]
fn what_is_no_archive_or_damaged_is_told_and_no_fault() {
    let zip = zip_of(&[("src/psi_neo_hookean.rs", BODY.as_bytes())]);
    let tar = gzip(&tar_of(&[("src/psi_neo_hookean.rs", &[b' '; 5000])]));
    for (name, bytes) in [
        ("a.zip", &b"not a zip"[..]),
        ("a.zip", b""),
        ("a.zip", &zip[..zip.len() / 2]),
        ("a.tar.gz", b"not a tar"),
        ("a.tar.gz", &tar[..tar.len() - 20]),
        ("a.tgz", b""),
        ("a.tar", b""),
        ("a.tar", &[b'x'; 2048]),
        ("a.rar", b"Rar!"),
    ] {
        assert!(read(name, bytes).is_err(), "{name} of {} bytes", bytes.len());
    }
}

#[test]
fn a_path_that_leads_out_is_refused() {
    for path in ["../src/psi_neo_hookean.rs", "/src/psi_neo_hookean.rs", "a/../../x", "C:\\src\\psi_neo_hookean.rs"] {
        let tar = read("a.tar", &tar_of(&[(path, b"")]));
        assert!(tar.is_err_and(|error| error.to_string().contains("leads out")), "{path}");
    }
}

#[test]
fn two_files_of_one_path_are_refused() {
    let (first, second) = ("src/psi_neo_hookean.rs", "src/psi_neo_hookeaN.rs");
    // The writer refuses such a path, so another path is overwritten with it.
    let mut zip = zip_of(&[(first, BODY.as_bytes()), (second, BODY.as_bytes())]);
    let wrong = second.as_bytes();
    while let Some(at) = zip.windows(wrong.len()).position(|bytes| bytes == wrong) {
        zip[at..at + wrong.len()].copy_from_slice(first.as_bytes());
    }
    assert!(read("a.zip", &zip).is_err_and(|error| error.to_string().contains("twice")));
    let tar = read("a.tar", &tar_of(&[(first, BODY.as_bytes()), (first, BODY.as_bytes())])).unwrap();
    let refused = &tar.functions["psi_neo_hookean"];
    assert!(matches!(refused, Source::Refused { reason, .. } if reason.contains("twice")), "{refused:?}");
}

#[test]
fn links_are_refused() {
    let mut tar = tar::Builder::new(Vec::new());
    let mut header = tar::Header::new_gnu();
    header.set_entry_type(tar::EntryType::Symlink);
    header.set_size(0);
    tar.append_link(&mut header, "src/psi_neo_hookean.rs", "/etc/passwd").unwrap();
    let submission = read("a.tar", &tar.into_inner().unwrap()).unwrap();
    assert!(
        matches!(&submission.functions["psi_neo_hookean"], Source::Refused { reason, .. } if reason.contains("link"))
    );
}

#[test]
fn a_bomb_costs_neither_memory_nor_the_grader() {
    let zeros = vec![0; 80 << 20];
    let large_file = read("a.zip", &zip_of(&[("src/psi_neo_hookean.rs", &zeros)])).unwrap();
    assert!(matches!(large_file.functions["psi_neo_hookean"], Source::Refused { .. }));
    let bomb = read("a.tgz", &gzip(&tar_of(&[("data/zeros", &zeros), ("src/psi_neo_hookean.rs", b"")])));
    assert!(bomb.is_err_and(|error| error.to_string().contains("64 MiB")));
    let long = format!("src/{}", "x".repeat(2000));
    assert!(read("a.zip", &zip_of(&[(&long, b"")])).is_err_and(|error| error.to_string().contains("1024 bytes")));
    let folder = tempfile::tempdir().unwrap();
    let sparse = folder.path().join("a.zip");
    fs::File::create(&sparse).unwrap().set_len(1 << 40).unwrap();
    assert!(read_submission(&sparse).is_err_and(|error| error.to_string().contains("128 MiB")));
    let names: Vec<_> = (0..10_001).map(|i| format!("data/{i}")).collect();
    let many: Vec<_> = names.iter().map(|name| (name.as_str(), &b""[..])).collect();
    assert!(read("a.zip", &zip_of(&many)).is_err_and(|error| error.to_string().contains("10000")));
}
