#!/usr/bin/env bash
# Shows that the README's commands compile every package with one set of features, so that no command builds anew what another
# has built. The root library is the one exception: the grader takes it without the program.
set -euo pipefail
cd "${1:-$(dirname "$0")/..}"

# Prints `package version|features` for the packages that a command builds; those of build scripts and macros among them.
packages() {
    cargo tree --locked --prefix none --format '{p}|{f}' "$@" | sed -E 's/ \([^|]*\)//; s/ \(\*\)$//' | sort -u
}

{
    packages --edges normal,build                    # cargo build, cargo run -- arma
    packages --edges normal,build --package grader   # cargo run -p grader -- check
    packages --edges normal,build,dev --workspace    # cargo test --workspace
    [ ! -d benches/src ] || packages --edges normal,build --package fem-bench
} | sort -u | awk -F'|' '
    $1 ~ /^finite-elements-3d / { next }
    { sets[$1] = sets[$1] "\n    " ($2 == "" ? "no features" : $2); count[$1]++ }
    END {
        for (package in count) if (count[package] > 1) { print package " is compiled with" sets[package]; bad = 1 }
        if (bad) print "ask for the union of them in crates/features/Cargo.toml"
        exit bad
    }'
