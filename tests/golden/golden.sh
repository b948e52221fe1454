#!/bin/sh
# golden.sh GALLERY ORRERY SCENES OUTPUT: renders the gallery again and compares every picture with the committed one.
# The bytes are the same where nothing changed; where rounding or random numbers did, by less than the noise of two seeds.
set -eu

gallery=$1 orrery=$2 scenes=$3 output=$4
again=$(mktemp -d)
trap 'rm -rf "$again"' EXIT
"$gallery" "$scenes" "$again"
status=0
for picture in "$again"/*.png; do
    name=${picture##*/}
    [ -f "$output/$name" ] || { echo "$name is not committed" && status=1 && continue; }
    cmp -s "$picture" "$output/$name" && continue
    echo "$name has changed:"
    "$orrery" compare "$picture" "$output/$name" --max-rmse 0.05 || status=1
done
exit $status
