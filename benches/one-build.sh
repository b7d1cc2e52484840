#!/usr/bin/env bash
# Shows that the README's commands compile every package with one set of features, and either for macros and build scripts alone or not,
# so that no command builds anew what another has built. The root library is the one exception: the grader takes it without the program.
set -euo pipefail
cd "${1:-$(dirname "$0")/..}"

tree() { cargo tree --locked --prefix none --format '{p}|{f}' "$@" | sed -E 's/ \([^|]*\)//; s/ \(\*\)$//' | sort -u; }

# Prints `package version|features`, and whether it is for macros and build scripts alone, for the packages that a command builds along
# these edges.
packages() {
    local edges=$1 all programs
    shift
    all=$(tree --edges "$edges,build" "$@")
    programs=$(tree --edges "$edges,no-proc-macro" "$@")
    comm -23 <(echo "$all") <(echo "$programs") | sed 's/$/, for macros and build scripts alone/'
    echo "$programs"
}

{
    packages normal                   # cargo build, cargo run -- arma
    packages normal --package grader  # cargo run -p grader -- check
    packages normal,dev --workspace   # cargo test --workspace
    [ ! -d benches/src ] || packages normal --package fem-bench
} | sort -u | awk -F'|' '
    $1 ~ /^finite-elements-3d / { next }
    { sets[$1] = sets[$1] "\n    features: " $2; count[$1]++ }
    END {
        for (package in count) if (count[package] > 1) { print package " is compiled with" sets[package]; bad = 1 }
        if (bad) print "ask for the union of them in crates/features/Cargo.toml"
        exit bad
    }'
