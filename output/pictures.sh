#!/bin/sh
# pictures.sh ORRERY FOLDER, both absolute: renders every picture of REPORT.md, beside this file, into FOLDER and prints the
# report with the figures of these renders. A picture's row holds its command, and its figures in the cells behind it.
set -eu

orrery=$1 folder=$2
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
cd "$here/.."
statistics=$(mktemp)
trap 'rm -f "$statistics"' EXIT

# number KEY: the first that the statistics have under it.
number() {
    sed -n 's/^ *"'"$1"'": \([-0-9.e+]*\),\{0,1\}$/\1/p' "$statistics" | head -n 1
}

word() {
    sed -n 's/^ *"'"$1"'": "\(.*\)",\{0,1\}$/\1/p' "$statistics" | head -n 1
}

while IFS= read -r line; do
    case $line in
    '| !['*')'*'`'*'`'*) ;;
    'Rendered with '*)
        printf 'Rendered with %s and %s threads on %s.\n' "$(word isa)" "$(number threads)" \
            "$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)"
        continue
        ;;
    *) printf '%s\n' "$line" && continue ;;
    esac
    picture=${line#*](}
    picture=${picture%%)*}
    command=${line#*\`}
    command=${command%%\`*}
    # shellcheck disable=SC2086 # a scene and options
    "$orrery" render scenes/$command -o "$folder/$picture" --stats "$statistics" >&2
    printf '%s |' "${line%%\` |*}\`"
    echo "$(number samples_per_pixel) $(number estimate) $(number seconds) $(number rays_per_second)" | LC_ALL=C awk '{
        printf (100 * $2 < 10 ? " %d | %.2g %% |" : " %d | %.0f %% |") " %.2f | %.0f |\n", $1, 100 * $2, $3, $4 / 1e6
    }'
done <output/REPORT.md
