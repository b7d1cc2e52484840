//! Landlock: restricts the program to some files, without network and without access to other processes.

use std::path::{Path, PathBuf};

use landlock::{
    ABI, Access, AccessFs, AccessNet, BitFlags, PathBeneath, PathFd, Ruleset, RulesetAttr, RulesetCreatedAttr,
    RulesetStatus, Scope,
};

use super::{Confined, Profile};

/// The newest version that this code uses. Older kernels enforce the rules that they know.
const VERSION: ABI = ABI::V6;

const DEVICES: [&str; 3] = ["/dev/null", "/dev/zero", "/dev/urandom"];

/// Folders with the loader that the kernel starts in place of a program with shared libraries.
const LOADERS: [&str; 3] = ["/lib64", "/lib", "/usr/lib"];

/// Restricts this process, for good.
pub fn restrict(confined: &Confined) -> Result<(), String> {
    let read = AccessFs::ReadFile | AccessFs::ReadDir;
    let readable = match confined.profile {
        Profile::Compiler => read | AccessFs::Execute,
        Profile::Submission => read,
    };
    let everything = AccessFs::from_all(VERSION);
    let made = AccessFs::MakeChar | AccessFs::MakeBlock | AccessFs::MakeSock | AccessFs::MakeFifo;
    let writable = everything & !(made | AccessFs::Execute | AccessFs::IoctlDev);
    let mut rules = Vec::new();
    rules.extend(confined.readable.iter().map(|path| (path.clone(), readable)));
    rules.extend(confined.writable.iter().map(|path| (path.clone(), writable)));
    rules.extend(DEVICES.iter().map(|path| (PathBuf::from(path), AccessFs::ReadFile | AccessFs::WriteFile)));
    rules.extend(loaders().into_iter().map(|path| (path, read | AccessFs::Execute)));
    rules.push((confined.program.clone(), read | AccessFs::Execute));

    let failed = |error: landlock::RulesetError| error.to_string();
    let mut ruleset = Ruleset::default()
        .handle_access(everything)
        .and_then(|ruleset| ruleset.handle_access(AccessNet::from_all(VERSION)))
        .and_then(|ruleset| ruleset.scope(Scope::from_all(VERSION)))
        .and_then(Ruleset::create)
        .map_err(failed)?;
    for (path, access) in rules {
        ruleset = ruleset.add_rule(rule(&path, access)?).map_err(failed)?;
    }
    match ruleset.restrict_self().map_err(failed)?.ruleset {
        RulesetStatus::NotEnforced => Err("the kernel does not have it".to_string()),
        RulesetStatus::FullyEnforced | RulesetStatus::PartiallyEnforced => Ok(()),
    }
}

fn rule(path: &Path, access: BitFlags<AccessFs>) -> Result<PathBeneath<PathFd>, String> {
    let opened = PathFd::new(path).map_err(|error| error.to_string())?;
    // Rights over folders are invalid for a file.
    let access = if path.is_dir() { access } else { access & AccessFs::from_file(VERSION) };
    Ok(PathBeneath::new(opened, access))
}

/// The loaders that are there, such as `/lib64/ld-linux-x86-64.so.2`.
fn loaders() -> Vec<PathBuf> {
    let folders = LOADERS.iter().filter_map(|folder| Path::new(folder).read_dir().ok());
    let files = folders.flat_map(|entries| entries.flatten().map(|entry| entry.path()));
    let is_loader = |path: &PathBuf| {
        path.file_name()
            .and_then(|name| name.to_str())
            .is_some_and(|name| name.starts_with("ld-") && name.contains(".so"))
    };
    // A link to a file that the program may not see is left out.
    files.filter(is_loader).filter(|path| path.exists()).collect()
}
