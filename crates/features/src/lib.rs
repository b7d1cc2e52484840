//! One set of features for the packages that the program and the grader share. Cargo compiles a package anew for each set that a
//! command asks for, with everything that depends on it; since both depend on this package, they ask for the union. It has no
//! code. `benches/one-build.sh` shows that nothing is compiled twice, or names the package whose features belong in `Cargo.toml`.
