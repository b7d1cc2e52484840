//! Job arrays for Slurm: each shard of a study is a job, and one more joins them.

use std::fs;
use std::io;
use std::path::Path;

use fem_mesh::write::save_bytes;

const SUBMIT: &str = include_str!("templates/submit.sh");
const ARRAY: &str = include_str!("templates/array.sbatch");

/// Writes `submit.sh` and `array.sbatch` for a study with these arguments of the program. The jobs run in the folder in which they are submitted.
pub fn slurm(arguments: &[String], out: &Path) -> io::Result<()> {
    fs::create_dir_all(out)?;
    let quoted: Vec<String> = arguments.iter().map(|argument| quoted(argument)).collect();
    for (name, template) in [("submit.sh", SUBMIT), ("array.sbatch", ARRAY)] {
        let text = template.replace("@ARGUMENTS@", &quoted.join(" "));
        save_bytes(&out.join(name), text.as_bytes()).map_err(io::Error::other)?;
    }
    Ok(())
}

/// An argument for a shell: without quotes if they are not needed.
fn quoted(argument: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./=,".contains(c);
    if !argument.is_empty() && argument.chars().all(is_plain) {
        return argument.to_owned();
    }
    format!("'{}'", argument.replace('\'', "'\\''"))
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn arguments_with_signs_of_the_shell_are_quoted() {
        assert_eq!(
            ["a/b-c.toml", "x y", "it's", "[0,1]"].map(quoted),
            ["a/b-c.toml", "'x y'", "'it'\\''s'", "'[0,1]'"]
        );
    }
}
