#!/bin/sh
# pictures.sh ORRERY FOLDER, both absolute: renders every picture of REPORT.md, beside this file, into FOLDER and prints the
# report with the figures of these renders. A picture's row holds its command, and its figures in the cells behind it.
set -eu

orrery=$1 folder=$2
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
cd "$here/.."
new=$(mktemp -d)
trap 'rm -rf "$new"' EXIT
statistics=$new/statistics.json

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
    "$orrery" render scenes/$command -o "$new/picture.png" --stats "$statistics" >&2
    # A picture names the revision that made it: the same pixels are no reason for another file.
    "$orrery" compare "$new/picture.png" "$folder/$picture" --max-rmse 0 >/dev/null 2>&1 ||
        cp "$new/picture.png" "$folder/$picture"
    printf '%s |' "${line%%\` |*}\`"
    echo "$(number samples_per_pixel) $(number estimate) $(number seconds) $(number rays_per_second)" | LC_ALL=C awk '{
        printf (100 * $2 < 10 ? " %d | %.2g %% |" : " %d | %.0f %% |") " %.2f | %.0f |\n", $1, 100 * $2, $3, $4 / 1e6
    }'
done <output/REPORT.md
