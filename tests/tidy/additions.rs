//! An addition is one file, its lines in lists, and its row in the book: a law, an integrator, a preconditioner, a force field and a scene
//! table are added to a copy of the repository, and the files are counted.
//!
//! `cargo test --no-default-features --test tidy -- --ignored additions` compiles the copy and runs a scene with each of them.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::{assert_none, read, root};

/// Largest number of files of the product that an addition may touch, its own among them; and of pages.
const MOST: (usize, usize) = (3, 1);

/// The number after the text grows by one.
const ONE_MORE: &str = "one more";

/// Something that is added.
struct Addition {
    name: &'static str,
    /// A new file: its path, the file that it is a copy of, and the words that differ; a text of its own without words.
    file: (&'static str, &'static str, &'static [(&'static str, &'static str)]),
    /// Files, pages among them, and in each a text and what takes its place everywhere, or [`ONE_MORE`].
    edits: &'static [(&'static str, &'static str, &'static str)],
    /// Changes of [`SCENE`] that use it.
    scene: &'static [(&'static str, &'static str)],
}

/// A scene that each addition changes.
const SCENE: &str = "pipeline = \"engine\"\n[mesh]\nbox = { size = [2, 1, 1], cells_per_unit = 2 }\n[material]\nmodel = \"yeoh\"\nC1 = 1e4\nC2 = 0\n\
                     C3 = 0\nD = 4e4\ndensity = 1000.0\n[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n[time]\ndt = 0.001\nsteps = 5\n\
                     integrator = \"implicit_euler\"\n";

const ADDITIONS: [Addition; 5] = [
    Addition {
        name: "a law",
        file: (
            "crates/elements/src/materials/green.rs",
            "crates/elements/src/materials/st_venant_kirchhoff.rs",
            &[("StVenantKirchhoff", "Green"), ("\"st_venant_kirchhoff\"", "\"green\"")],
        ),
        edits: &[
            ("crates/elements/src/materials/mod.rs", "mod hencky;\n", "mod green;\nmod hencky;\n"),
            ("crates/elements/src/materials/mod.rs", "gent::Gent,\n", "gent::Gent,\n                green::Green,\n"),
            (
                "crates/model/src/law.rs",
                "    StVenantKirchhoff(Elastic),\n",
                "    StVenantKirchhoff(Elastic),\n    /// Another.\n    Green(Elastic),\n",
            ),
            ("crates/model/src/law.rs", "FACTS: [LawFacts; ", ONE_MORE),
            (
                "crates/model/src/law.rs",
                "            of(\"neo_hookean\"",
                "            of_elastic(\"green\", false, None, |given| Self::Green(elastic(given))),\n            of(\"neo_hookean\"",
            ),
            (
                "crates/model/src/law.rs",
                "Self::StVenantKirchhoff(_) =>",
                "Self::Green(_) => \"green\",\n            Self::StVenantKirchhoff(_) =>",
            ),
            (
                "crates/model/src/law.rs",
                "| Self::StVenantKirchhoff(elastic)",
                "| Self::StVenantKirchhoff(elastic) | Self::Green(elastic)",
            ),
            ("docs/book/materials.md", "| `gent` |", "| `green` | | | | |\n| `gent` |"),
        ],
        scene: &[(
            "model = \"yeoh\"\nC1 = 1e4\nC2 = 0\nC3 = 0\nD = 4e4",
            "model = \"green\"\nyoung = 1e5\npoisson = 0.3",
        )],
    },
    Addition {
        name: "an integrator",
        file: (
            "crates/engine/src/integrators/symplectic_euler.rs",
            "crates/engine/src/integrators/semi_implicit_euler.rs",
            &[("SemiImplicitEuler", "SymplecticEuler")],
        ),
        edits: &[
            ("crates/engine/src/integrators/mod.rs", "mod vbd;\n", "mod symplectic_euler;\nmod vbd;\n"),
            (
                "crates/engine/src/integrators/mod.rs",
                "        Kind::Rk2 =>",
                "        Kind::SymplecticEuler => Box::new(symplectic_euler::SymplecticEuler::new(system)),\n        Kind::Rk2 =>",
            ),
            (
                "crates/model/src/integrator.rs",
                "    SemiImplicitEuler,\n",
                "    SemiImplicitEuler,\n    /// Another.\n    SymplecticEuler,\n",
            ),
            ("crates/model/src/integrator.rs", "FACTS: [(Self, Facts); ", ONE_MORE),
            (
                "crates/model/src/integrator.rs",
                "            (Self::Rk2,",
                "            (Self::SymplecticEuler, facts(\"symplectic_euler\", \"symplectic Euler\", Explicit, Some(1), true, None)),\n\
                 \x20           (Self::Rk2,",
            ),
            ("docs/book/integrators.md", "| `rk2` | 2 |", "| `symplectic_euler` | 1 | | | |\n| `rk2` | 2 |"),
        ],
        scene: &[("implicit_euler", "symplectic_euler")],
    },
    Addition {
        name: "a preconditioner",
        file: (
            "crates/solvers/src/preconditioners/node_blocks.rs",
            "crates/solvers/src/preconditioners/block_jacobi.rs",
            &[("BlockJacobi", "NodeBlocks"), ("block_jacobi.", "node_blocks.")],
        ),
        edits: &[
            ("crates/solvers/src/preconditioners/mod.rs", "mod ssor;\n", "mod node_blocks;\nmod ssor;\n"),
            (
                "crates/solvers/src/preconditioners/mod.rs",
                "        Preconditioner::Ssor =>",
                "        Preconditioner::NodeBlocks => Box::new(node_blocks::NodeBlocks::new(pattern)),\n        Preconditioner::Ssor =>",
            ),
            (
                "crates/model/src/solver.rs",
                "    BlockJacobi,\n",
                "    BlockJacobi,\n    /// Another.\n    NodeBlocks,\n",
            ),
            (
                "crates/model/src/solver.rs",
                "impl Preconditioner {\n    /// All preconditioners, their names in scene files, and what they are.\n    pub const FACTS: [(Self, &'static str, &'static str); ",
                ONE_MORE,
            ),
            (
                "crates/model/src/solver.rs",
                "        (Self::Multigrid,",
                "        (Self::NodeBlocks, \"node_blocks\", \"the blocks of the nodes\"),\n        (Self::Multigrid,",
            ),
            ("docs/book/solvers.md", "| `ssor` |", "| `node_blocks` | |\n| `ssor` |"),
        ],
        scene: &[("[fixed]", "[solver]\nkind = \"pcg\"\npreconditioner = \"node_blocks\"\n[fixed]")],
    },
    Addition {
        name: "a force field",
        file: (
            "crates/engine/src/forces/attraction.rs",
            "crates/engine/src/forces/central_gravity.rs",
            &[("CentralGravity", "Attraction"), ("central_gravity", "attraction")],
        ),
        edits: &[
            ("crates/engine/src/forces/mod.rs", "mod central_gravity;\n", "mod attraction;\nmod central_gravity;\n"),
            ("crates/engine/src/forces/mod.rs", "-> [Kind<T>; ", ONE_MORE),
            (
                "crates/engine/src/forces/mod.rs",
                "        Kind { name: contact::NAME,",
                "        Kind { name: attraction::NAME, tables: \"[attraction]\", build: attraction::build },\n        Kind { name: contact::NAME,",
            ),
            (
                "crates/model/src/fields.rs",
                "            central_gravity: CentralGravity,\n",
                "            central_gravity: CentralGravity,\n            /// `[attraction]`\n            attraction: Attraction,\n",
            ),
            (
                "crates/model/src/fields.rs",
                "/// `[central_gravity]`: gravity",
                "/// `[attraction]`: another.\n#[derive(Clone, Debug, Deserialize, PartialEq)]\n#[serde(deny_unknown_fields)]\n\
                 pub struct Attraction {\n    /// m\n    pub center: [f64; 3],\n    /// m³/s²\n    pub strength: f64,\n    /// m\n    pub softening: f64,\n}\n\n\
                 impl Attraction {\n    fn check(&self) -> Result<(), Refusal> {\n        \
                 check_positive(\"attraction.softening\", self.softening, \" of m\")\n    }\n\n    \
                 fn check_on(&self, _: &BodyMesh) -> Result<(), Refusal> {\n        Ok(())\n    }\n}\n\n\
                 /// `[central_gravity]`: gravity",
            ),
            ("docs/book/scene-reference.md", "## [central_gravity]\n", "## [attraction]\n\n## [central_gravity]\n"),
        ],
        scene: &[("[fixed]", "[attraction]\ncenter = [9, 0, 0]\nstrength = 10\nsoftening = 1\n[fixed]")],
    },
    Addition {
        name: "a scene table",
        file: (
            "crates/scene/src/tables/wind.rs",
            "//! `[wind]`: a force on every part of the body.\n\nuse fem_model::numbers::check_vector;\nuse fem_model::{Body, Refusal};\n\
             use serde::Deserialize;\n\n/// `[wind]`: a force on every part of the body.\n#[derive(Clone, Debug, Deserialize, PartialEq)]\n\
             #[serde(deny_unknown_fields)]\npub struct WindTable {\n    /// Force per undeformed volume, N/m³.\n    pub force: [f64; 3],\n}\n\n\
             impl WindTable {\n    /// Adds the force to a body.\n    pub(crate) fn add_to(&self, body: &mut Body) -> Result<(), Refusal> {\n        \
             check_vector(\"wind.force\", &self.force)?;\n        \
             body.body_force = Some(body.body_force.unwrap_or_default() + nalgebra::Vector3::from(self.force));\n        \
             Ok(())\n    }\n}\n",
            &[],
        ),
        edits: &[
            (
                "crates/scene/src/tables/mod.rs",
                "mod vectors;\n",
                "mod vectors;\nmod wind;\n\npub use wind::WindTable;\n",
            ),
            (
                "crates/scene/src/tables/mod.rs",
                "            /// `[batch]`\n",
                "            /// `[wind]`\n            pub wind: Option<WindTable>,\n            /// `[batch]`\n",
            ),
            (
                "crates/scene/src/body.rs",
                "    body.contact = contact(scene, &body)?;\n",
                "    body.contact = contact(scene, &body)?;\n    scene.wind.iter().try_for_each(|wind| wind.add_to(&mut body))?;\n",
            ),
            ("docs/book/scene-reference.md", "\n## [batch]\n", "\n## [wind]\n\n## [batch]\n"),
        ],
        scene: &[("[fixed]", "[wind]\nforce = [0, -100, 0]\n[fixed]")],
    },
];

/// The files that some additions change, with their new texts, and what is wrong with the script.
fn changed<'a>(additions: impl IntoIterator<Item = &'a Addition>) -> (BTreeMap<PathBuf, String>, Vec<String>) {
    let (mut texts, mut problems) = (BTreeMap::new(), Vec::new());
    for Addition { name, file: (path, from, words), edits, .. } in additions {
        let text = if words.is_empty() { (*from).to_owned() } else { read(from) };
        let text = words.iter().fold(text, |text, (old, new)| text.replace(old, new));
        if root().join(path).exists() || texts.insert(PathBuf::from(path), text).is_some() {
            problems.push(format!("{name}: {path} exists already; give the new file another name"));
        }
        for (path, old, new) in *edits {
            let text = texts.entry(PathBuf::from(path)).or_insert_with(|| read(path));
            if !text.contains(old) {
                problems
                    .push(format!("{name}: {path} has no text `{old}`; correct the script in tests/tidy/additions.rs"));
            }
            *text = if *new == ONE_MORE { with_one_more(text, old) } else { text.replace(old, new) };
        }
    }
    (texts, problems)
}

/// The text with the number after `before`, which stands in it once, grown by one.
fn with_one_more(text: &str, before: &str) -> String {
    let Some((start, rest)) = text.split_once(before) else { return text.to_owned() };
    let digits = rest.chars().take_while(char::is_ascii_digit).count();
    let number: usize = rest[..digits].parse().unwrap();
    format!("{start}{before}{}{}", number + 1, &rest[digits..])
}

#[test]
fn an_addition_touches_at_most_three_files_of_the_product_and_one_page() {
    let mut problems = Vec::new();
    for addition in &ADDITIONS {
        let (texts, wrong) = changed([addition]);
        problems.extend(wrong);
        let (pages, product): (BTreeSet<_>, BTreeSet<_>) = texts.keys().partition(|path| path.starts_with("docs"));
        if product.len() > MOST.0 || pages.len() > MOST.1 {
            problems.push(format!("{} touches {product:?} and {pages:?}; let a list say what is known", addition.name));
        }
        let scene = addition.scene.iter().fold(SCENE.to_owned(), |scene, (old, new)| scene.replace(old, new));
        if scene == SCENE {
            problems.push(format!("{}: its scene does not use it; correct the script", addition.name));
        }
    }
    assert_none(problems);
}

#[test]
#[ignore = "compiles the engine anew: .ci/long"]
fn a_copy_with_all_additions_compiles_and_runs_a_scene_with_each() {
    let copy = tempfile::tempdir().unwrap();
    for name in
        ["Cargo.toml", "Cargo.lock", "src", "crates", "grader", "benches", "examples", "tests", "include-docs", "docs"]
    {
        copied(&root().join(name), &copy.path().join(name));
    }
    let (texts, problems) = changed(&ADDITIONS);
    assert_none(problems);
    texts.iter().for_each(|(path, text)| fs::write(copy.path().join(path), text).unwrap());
    // Always the same place, so that cargo finds what it has built.
    let built = std::env::var_os("CARGO_TARGET_DIR").map_or(root().join("target"), PathBuf::from).join("additions");
    let program = ["run", "--quiet", "--no-default-features", "--features", "engine", "--"];
    for addition in &ADDITIONS {
        let scene = addition.scene.iter().fold(SCENE.to_owned(), |scene, (old, new)| scene.replace(old, new));
        let file = copy.path().join("scene.toml");
        fs::write(&file, scene).unwrap();
        let mut cargo = Command::new(env!("CARGO"));
        cargo.args(program).arg(&file).arg("--headless").current_dir(copy.path()).env("CARGO_TARGET_DIR", &built);
        let output = cargo.output().expect("cargo starts");
        let told = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
        assert!(output.status.success() && told.contains("5 steps"), "{}: {}: {told}", addition.name, output.status);
    }
}

/// Copies a file or a folder, without hidden files and build products.
fn copied(from: &Path, to: &Path) {
    if from.is_file() {
        fs::copy(from, to).unwrap();
        return;
    }
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap().flatten() {
        let name = entry.file_name();
        if name != "target" && !name.to_string_lossy().starts_with('.') && !entry.path().join("CACHEDIR.TAG").exists() {
            copied(&entry.path(), &to.join(name));
        }
    }
}
