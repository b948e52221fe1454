#!/bin/sh
# golden.sh ORRERY OUTPUT: renders the report's pictures again and compares each with the committed one.
# The pixels are the same where nothing changed; where rounding or random numbers did, by less than the noise of two seeds.
set -eu

orrery=$1 output=$2
again=$(mktemp -d)
trap 'rm -rf "$again"' EXIT
sh "$output/pictures.sh" "$orrery" "$again" >"$again/REPORT.md"
status=0
for picture in "$again"/*.png; do
    name=${picture##*/}
    [ -f "$output/$name" ] || { echo "$name is not committed" && status=1 && continue; }
    "$orrery" compare "$picture" "$output/$name" --max-rmse 0 >/dev/null && continue
    echo "$name has changed:"
    "$orrery" compare "$picture" "$output/$name" --max-rmse 0.05 || status=1
done
exit $status
