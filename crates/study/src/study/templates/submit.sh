#!/usr/bin/env bash
# Runs a study on a Slurm cluster: SHARDS jobs of an array, then one that joins them into OUT/merged.
# Submitting again runs only the cases that have no row yet. PROGRAM, the folder of the checkout and OUT must be visible on all nodes.
set -euo pipefail

if [ $# -lt 1 ]; then
    echo "usage: PROGRAM=target/release/finite-elements-3d bash $0 OUT [SHARDS]" >&2
    exit 2
fi
program=$(command -v "${PROGRAM:-target/release/finite-elements-3d}") || {
    echo "$0: no program; set PROGRAM to the one that cargo build --release made" >&2
    exit 2
}
program=$(realpath "$program")
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$1/logs"
out=$(realpath "$1")
shards=${2:-8}

array=$(sbatch --parsable --array="1-$shards" --output="$out/logs/shard-%a-%A.log" "$here/array.sbatch" "$program" "$out" "$shards")
array=${array%%;*}
folders=()
for ((k = 1; k <= shards; k++)); do folders+=("$out/shard-$k"); done
# Also after a shard that failed: the message names what is missing.
merge=$(sbatch --parsable --dependency="afterany:$array" --ntasks=1 --output="$out/logs/merge-%j.log" \
    --wrap="$(printf '%q ' "$program" merge "${folders[@]}" --out "$out/merged")")
echo "shards: job $array, merge: job ${merge%%;*}; the results will be in $out/merged"
