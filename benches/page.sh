#!/usr/bin/env bash
# Measures again what the book says about speed: runs each command of docs/book whose line `<!-- $ COMMAND -->` contains one of the
# arguments, and puts what it prints between this line and the next `<!-- end -->`. `benches/page.sh scaling frame` writes two tables.
# Peers are compiled first, as docs/book/performance.md says; EIGEN and FENRIS name their programs.
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -gt 0 ] || { grep -h '^<!-- \$ ' docs/book/*.md; echo "name a part of one of these commands" >&2; exit 2; }
output=$(mktemp)
trap 'rm -f "$output"' EXIT

for part in "$@"; do
    found=
    for page in docs/book/*.md; do
        while IFS= read -r line; do
            found=yes
            command=${line#'<!-- $ '}
            command=${command%' -->'}
            echo "$command" >&2
            bash -c "set -euo pipefail; $command" >"$output"
            # The page is written at once, and only after the command has succeeded.
            LINE=$line awk -v output="$output" '
                inside && $0 == "<!-- end -->" { inside = 0 }
                !inside { print }
                $0 == ENVIRON["LINE"] { inside = 1; print ""; while ((getline text < output) > 0) print text; print "" }
            ' "$page" >"$page.new"
            mv "$page.new" "$page"
        done < <(grep '^<!-- \$ ' "$page" | grep -F -- "$part")
    done
    [ -n "$found" ] || { echo "no command of docs/book contains: $part" >&2; exit 2; }
done
