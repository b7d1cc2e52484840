#!/usr/bin/env bash
# Checks the plugin: formatting, lints, the tests of apps without a window on one and two threads of rayon, and positions bit for bit those of
# the command line. Too long for .ci/run; the first build of Bevy takes ten minutes or more on two cores.
set -euo pipefail
cd "$(dirname "$0")"
export CARGO_TERM_COLOR=never

step() { printf '\n== %s (%s s so far)\n' "$1" "$SECONDS"; }

step "formatting and lints"
cargo fmt --check -- --config-path ../../rustfmt.toml
cargo clippy --all-targets -- -D warnings
RUSTDOCFLAGS="-D warnings" cargo doc --no-deps

step "the program whose positions are compared"
root=$(cd ../.. && pwd)
program_target=${FEM_PROGRAM_TARGET:-$root/target}
(cd "$root" && CARGO_TARGET_DIR="$program_target" cargo build --release --no-default-features --features engine)
export FINITE_ELEMENTS_3D="$program_target/release/finite-elements-3d"

for threads in 1 2; do
    step "tests on $threads of rayon's threads"
    RAYON_NUM_THREADS=$threads cargo test
    RAYON_NUM_THREADS=$threads cargo test --test headless -- --ignored positions
done

step "memory after bodies that are gone"
cargo test --test headless -- --ignored --nocapture a_hundred_bodies_leave_no_memory

step "done"
