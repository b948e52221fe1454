#!/bin/sh
# run_test.sh RUN: the script `run` in checkouts made for the purpose, where apt-get, cmake and their like only note how
# shellcheck disable=SC2016 # what stands in single quotes is for the stand-ins
# they were called. Ends with 1 where anything was not as it should be.
set -eu
unset CI

script=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
faults=0

# Programs that `run` may use as they are, and nothing else.
mkdir "$folder/tools"
for tool in sh env sed grep tr rm mkdir dirname uname nproc cat; do
    ln -s "$(command -v "$tool")" "$folder/tools/$tool"
done

# stand_in NAME COMMANDS: a program that notes its call and then does this.
stand_in() {
    printf '#!/bin/sh\necho "%s $*" >>"%s/calls"\n%s\n' "$1" "$folder" "$2" >"$folder/tools/$1"
    chmod +x "$folder/tools/$1"
}

# A checkout that was built, on a system where all packages are there and the user is root.
fresh() {
    rm -rf "$folder/checkout" "$folder/calls"
    mkdir -p "$folder/checkout/build" "$folder/checkout/scenes"
    cp "$script" "$folder/checkout/run"
    checkout=$(cd "$folder/checkout" && pwd -P)
    echo "CMAKE_HOME_DIRECTORY:INTERNAL=$checkout" >"$checkout/build/CMakeCache.txt"
    : >"$checkout/build/build.ninja"
    printf '#!/bin/sh\necho "orrery ($ORRERY_COMMAND) $*"\n' >"$checkout/build/orrery"
    chmod +x "$checkout/build/orrery"
    : >"$folder/calls"
    rm -f "$folder/tools/sudo"
    stand_in id 'echo 0'
    stand_in dpkg-query 'echo installed'
    stand_in apt-get ':'
    stand_in cmake 'case "$*" in *" -n") echo "ninja: no work to do." ;; esac'
}

# run_it ARGUMENT...: leaves $code, and what was said in $said.
run_it() {
    code=0
    said=$(cd "$checkout" && PATH="$folder/tools" COLUMNS=60 ./run "$@" 2>&1) || code=$?
}

fault() {
    echo "FAULT in $case: $1; exit code $code, it said:"
    echo "$said"
    echo "and called:"
    cat "$folder/calls"
    faults=$((faults + 1))
}
says() { case $said in *"$1"*) ;; *) fault "did not say '$1'" ;; esac; }
does_not_say() { case $said in *"$1"*) fault "said '$1'" ;; esac; }
calls() { grep -qF -- "$1" "$folder/calls" || fault "did not call '$1'"; }
does_not_call() { if grep -qF -- "$1" "$folder/calls"; then fault "called '$1'"; fi; }
ends_with() { [ "$code" -eq "$1" ] || fault "ended with $code instead of $1"; }

case='nothing to build'
fresh
run_it render a.json --spp 4
ends_with 0
[ "$said" = "orrery (./run) render a.json --spp 4" ] || fault "said something else"
[ "$(grep -c '^cmake' "$folder/calls")" -eq 1 ] || fault "built"

case='something to build'
fresh
stand_in cmake ':'
run_it info a.json
ends_with 0
calls 'cmake --build --preset release --target orrery'
does_not_call 'cmake --preset'

case='a checkout that was moved'
fresh
echo "CMAKE_HOME_DIRECTORY:INTERNAL=$folder/elsewhere" >"$checkout/build/CMakeCache.txt"
run_it render a.json
says "build/ was made for $folder/elsewhere: starting it afresh"
calls 'cmake --preset release'
[ ! -e "$checkout/build/orrery" ] || fault "kept the other build"

case='a checkout that was copied, with the original still there'
fresh
mkdir -p "$folder/original"
echo "CMAKE_HOME_DIRECTORY:INTERNAL=$folder/original" >"$checkout/build/CMakeCache.txt"
run_it render a.json
says "starting it afresh"
calls 'cmake --preset release'

case='the same checkout by another path'
fresh
ln -sfn "$checkout" "$folder/link"
echo "CMAKE_HOME_DIRECTORY:INTERNAL=$folder/link" >"$checkout/build/CMakeCache.txt"
run_it render a.json
ends_with 0
does_not_say afresh

case='a build folder half made'
fresh
rm "$checkout/build/build.ninja" "$checkout/build/orrery"
stand_in cmake 'echo "CMake Error: the generator is another" >&2; exit 1'
run_it render a.json
ends_with 1
says 'CMake Error: the generator is another'
says 'CMake says why, above'
says "$checkout/build"
does_not_say 'libfmt-dev'

case='missing packages, as root'
fresh
stand_in dpkg-query 'case "$*" in *libfmt-dev) exit 1 ;; *) echo installed ;; esac'
stand_in apt-get 'case "$*" in *print-uris*) printf "%s\n" "'"'http://a/x' x.deb 2000000 SHA256:1"'" "'"'http://a/y' y.deb 1600000 SHA256:2"'" ;; esac'
run_it render a.json
ends_with 0
says 'Missing packages: libfmt-dev'
says '4 MB to download'
calls 'apt-get install -q -y --no-install-recommends libfmt-dev'

case='missing packages, without root'
fresh
stand_in dpkg-query 'case "$*" in *libfmt-dev | *ninja-build) exit 1 ;; *) echo installed ;; esac'
stand_in id 'echo 1000'
run_it render a.json
ends_with 1
says 'apt-get update && apt-get install --yes --no-install-recommends ninja-build libfmt-dev'
does_not_call apt-get
does_not_call 'cmake --'

case='missing packages, sudo refuses'
stand_in sudo 'exit 1'
run_it render a.json </dev/null
ends_with 1
says 'apt-get update && apt-get install --yes --no-install-recommends ninja-build libfmt-dev'
does_not_call apt-get

case='missing packages, with sudo'
: >"$folder/calls"
stand_in sudo 'case "$1" in -*) ;; *) "$@" ;; esac'
run_it render a.json </dev/null
ends_with 0
calls 'sudo env DEBIAN_FRONTEND=noninteractive apt-get install'

case='a system without apt-get, without CMake'
fresh
rm "$folder/tools/apt-get" "$folder/tools/cmake" "$checkout/build/build.ninja"
run_it render a.json
ends_with 1
says 'cmake is missing'
says 'libfmt-dev'

case='a system without apt-get, without a library'
fresh
rm "$folder/tools/apt-get" "$checkout/build/build.ninja"
stand_in cmake 'echo "orrery needs libraries that are not here: fmt" >&2; exit 1'
run_it render a.json
ends_with 1
says 'not here: fmt'
says 'libfmt-dev'

case='warnings are errors where changes are judged'
fresh
rm "$checkout/build/build.ninja"
run_it render a.json
does_not_call ORRERY_WERROR
export CI=true
run_it render a.json
unset CI
calls '-DORRERY_WERROR=ON'

case='misspelt commands'
fresh
for pair in rendr:render Render:render tset:test benhc:bench gnerate:generate halp:help; do
    run_it "${pair%:*}"
    ends_with 2
    says "found '${pair%:*}'"
    says "did you mean ${pair#*:}?"
done
for word in xyzzy '*' 'a b' ''"$(printf '\033[31m')"; do
    run_it "$word"
    ends_with 2
    does_not_say 'did you mean'
    does_not_say "$(printf '\033')"
done
does_not_call 'cmake --'

case='help is as wide as it may be'
fresh
run_it help
ends_with 0
says './run render SCENE [...]'
printf '%s\n' "$said" | {
    while read -r line; do [ ${#line} -le 60 ] || exit 1; done
} || fault 'broke no line'

[ "$faults" -eq 0 ]
