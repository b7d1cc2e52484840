#!/usr/bin/env bash
# Measures how long builds take, and prints a Markdown table: processor seconds (user and system), wall time, compiled units, and
# the ten units of the release build that take longest. Without arguments all rows are measured, each in an empty target folder;
# `benches/build.sh release grader` measures those two.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
rows=${*:-release grader dev touch check test}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export CARGO_TERM_COLOR=never
TIMEFORMAT='%U %S %R'

# Prints a row: its name, the folder of the build products, the command. 1 is the exit code of checks that have found something.
row() {
    local name=$1 target=$2 code=0
    shift 2
    { time CARGO_TARGET_DIR=$work/$target "$@" >"$work/log" 2>&1; } 2>"$work/time" || code=$?
    [ "$code" -le 1 ] || { tail -n 20 "$work/log" >&2; exit 1; }
    awk -v name="$name" -v packages="$(grep -c '^ *Compiling' "$work/log" || true)" \
        '{ printf "| %s | %.0f | %.0f | %s |\n", name, $1 + $2, $3, packages }' "$work/time"
}

# Prints the number of units of a build and those that took longest, from what `--timings` wrote.
longest() {
    awk -F'": ' '
        function value() { gsub(/^"|",?$|,$/, "", $2); return $2 }
        /^const UNIT_DATA/ { inside = 1 }
        inside && /^];/ { exit }
        inside && /"name"/ { name = value() }
        inside && /"target"/ { target = value() }
        inside && /"duration"/ { printf "%s %s%s\n", value(), name, target }
    ' "$1" >"$work/units"
    printf '\n%s units; the longest, wall seconds beside others:\n\n| unit | s |\n|---|---|\n' "$(wc -l <"$work/units")"
    sort -rn "$work/units" | sed 10q | awk '{ seconds = $1; $1 = ""; printf "|%s | %.0f |\n", $0, seconds }'
}

printf '| build | processor s | wall s | packages |\n|---|---|---|---|\n'
for one in $rows; do
    case $one in
    release) row '`cargo build --release`, from nothing' release cargo build --release --timings ;;
    grader) row 'grader and fem-bench after it' release cargo build --release -p grader -p fem-bench ;;
    dev) row '`cargo build`, from nothing' dev cargo build ;;
    touch)
        [ -d "$work/dev" ] || row '`cargo build`, from nothing' dev cargo build
        changed=crates/engine/src/integrators/implicit_euler.rs
        cp "$changed" "$work/before"
        trap 'cp "$work/before" "$changed"; rm -rf "$work"' EXIT
        sed -i 's/fn accept(&mut self) {}/fn accept(\&mut self) { std::hint::black_box(()); }/' "$changed"
        ! cmp -s "$changed" "$work/before" || { echo "$changed: no line to change" >&2; exit 1; }
        row '`cargo run -- arma --headless --steps 1` after a change of an integrator' dev cargo run -- arma --headless --steps 1
        cp "$work/before" "$changed"
        trap 'rm -rf "$work"' EXIT
        ;;
    check)
        CARGO_TARGET_DIR=$work/dev cargo run --quiet -p grader -- handout "$work/handout" >"$work/log" 2>&1
        cd "$work/handout"
        row '`cargo run -p grader -- check`, in a fresh handout' handout cargo run -p grader -- check
        cd "$root"
        ;;
    test) row '`cargo test --workspace`, from nothing' test cargo test --workspace ;;
    *) echo "no row $one: release, grader, dev, touch, check, test" >&2; exit 2 ;;
    esac
done
if [ -e "$work/release/cargo-timings/cargo-timing.html" ]; then longest "$work/release/cargo-timings/cargo-timing.html"; fi
