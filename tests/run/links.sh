#!/bin/sh
# links.sh ROOT: every file that a document of the repository points to must be there.
set -eu
cd "$1"
find . -name 'build*' -prune -o -name '*.md' -print | (
    status=0
    while read -r page; do
        for target in $(sed -n 's/](/\n](/gp' "$page" | sed -n 's/^](\([^):# ]\{1,\}\)[)#].*/\1/p'); do
            [ -e "${page%/*}/$target" ] || { echo "$page points to $target, which is not there" && status=1; }
        done
    done
    exit $status
)
