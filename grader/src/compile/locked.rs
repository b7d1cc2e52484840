//! The part of a lock file that a program is built from.

/// The entries of a lock file that a package and its dependencies have.
pub fn locked<'a>(lock: &'a str, package: &'a str) -> Vec<&'a str> {
    let entries: Vec<&str> = lock.split("[[package]]\n").skip(1).collect();
    let (mut found, mut open) = (Vec::new(), vec![package]);
    while let Some(name) = open.pop() {
        let head = format!("name = \"{name}\"\n");
        for entry in entries.iter().copied().filter(|entry| entry.starts_with(&head)) {
            if !found.contains(&entry) {
                found.push(entry);
                let dependencies = entry.lines().filter_map(|line| line.strip_prefix(" \"")?.split([' ', '"']).next());
                open.extend(dependencies);
            }
        }
    }
    found.sort_unstable();
    found
}

#[cfg(test)]
mod tests {
    use super::locked;

    #[test]
    fn of_a_lock_file_the_entries_of_a_package_and_its_dependencies_count() {
        let entry = |name: &str, dependencies: &str| {
            format!("[[package]]\nname = \"{name}\"\nversion = \"1\"\ndependencies = [\n{dependencies}]\n\n")
        };
        let used = [entry("child", " \"a 1\",\n \"b\",\n"), entry("a", " \"b\",\n"), entry("b", "")];
        let lock = format!("version = 4\n\n{}{}", used.concat(), entry("c", " \"a 1\",\n"));
        let names: Vec<_> = locked(&lock, "child").iter().filter_map(|entry| entry.lines().next()).collect();
        assert_eq!(names, ["name = \"a\"", "name = \"b\"", "name = \"child\""]);
        assert_ne!(
            locked(&lock, "child"),
            locked(&lock.replace("\"b\"\nversion = \"1", "\"b\"\nversion = \"2"), "child")
        );
    }
}
