#!/bin/sh
# links.sh ROOT: every file that a document of the repository points to must be there, and every heading.
set -eu
cd "$1"

# headings PAGE: as GitHub names them in links.
headings() {
    sed -n 's/^##* //p' "$1" | LC_ALL=C tr '[:upper:]' '[:lower:]' | LC_ALL=C sed 's/[^a-z0-9_ -]//g; s/ /-/g'
}

find . -name 'build*' -prune -o -name '*.md' -print | (
    status=0 links=0
    while read -r page; do
        for link in $(sed -n 's/](/\n](/gp' "$page" | sed -n 's/^](\([^): ]\{1,\}\)[ )].*/\1/p'); do
            links=$((links + 1)) target=$page heading=
            case $link in '#'*) ;; *) target=${page%/*}/${link%%#*} ;; esac
            case $link in *'#'*) heading=${link#*#} ;; esac
            [ -e "$target" ] && { [ -z "$heading" ] || headings "$target" | grep -qxF -e "$heading"; } && continue
            echo "$page points to $link, which is not there" && status=1
        done
    done
    [ "$links" -gt 0 ] || { echo "no page has a link" && status=1; }
    exit $status
)
