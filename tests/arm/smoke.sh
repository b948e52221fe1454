#!/bin/sh
# tests/arm/smoke.sh FOLDER LIBRARY...: builds the program for 64-bit Arm in FOLDER, runs it under an emulator, and
# compares its pictures with those of the scalar kernels of FOLDER/../build/orrery, which are to be the same bit for bit:
# they use no operation that IEEE 754 does not round correctly but the C library's, which is the same on both sides.
#
# Needs Debian's g++-aarch64-linux-gnu, qemu-user, cmake and ninja-build. LIBRARY...: the packages it is built with, for
# Arm unpacked below FOLDER: neither root nor a second architecture in the system's own list of packages is needed. Ends
# with 77 where they cannot be had.
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
mkdir -p "$1"
folder=$(CDPATH='' cd -- "$1" && pwd)
shift
libraries=$folder/libraries

# An apt that knows this folder and Arm alone.
arm_apt() {
    apt-get -q -o APT::Architecture=arm64 -o APT::Architectures=arm64 -o Dir::State="$folder/apt" \
        -o Dir::State::status="$folder/apt/status" -o Dir::Cache="$folder/apt" -o Debug::NoLocking=1 \
        -o APT::Sandbox::User="$(id -un)" "$@"
}

# Not those of the C library, which the compiler brings.
unpack_libraries() {
    mkdir -p "$folder/apt/lists/partial" "$folder/apt/archives/partial" "$libraries"
    : >"$folder/apt/status"
    arm_apt update && arm_apt install -y --no-install-recommends --download-only "$@" || exit 77
    for package in "$folder"/apt/archives/*.deb; do
        case ${package##*/} in
        libc6* | linux-libc-dev* | libcrypt* | gcc-* | libgcc* | libstdc++*) ;;
        *) dpkg-deb -x "$package" "$libraries" ;;
        esac
    done
    rm -rf "$folder/apt"
    touch "$folder/unpacked"
}

[ -f "$folder/unpacked" ] || unpack_libraries "$@"

# Debian 12 has some of them in /lib still.
shared=$libraries/usr/lib/aarch64-linux-gnu:$libraries/lib/aarch64-linux-gnu
cmake -S "$root" -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DORRERY_TESTS=OFF -DORRERY_WERROR=ON \
    -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 -DCMAKE_CXX_COMPILER=aarch64-linux-gnu-g++ \
    -DCMAKE_FIND_ROOT_PATH="$libraries" -DCMAKE_FIND_ROOT_PATH_MODE_PROGRAM=NEVER \
    -DCMAKE_FIND_ROOT_PATH_MODE_PACKAGE=ONLY -DCMAKE_FIND_ROOT_PATH_MODE_LIBRARY=ONLY \
    -DCMAKE_FIND_ROOT_PATH_MODE_INCLUDE=ONLY -DCMAKE_EXE_LINKER_FLAGS="-Wl,-rpath-link,$shared"
cmake --build "$folder/build" --target orrery

arm() { qemu-aarch64 -L /usr/aarch64-linux-gnu -E LD_LIBRARY_PATH="$shared" "$folder/build/orrery" "$@"; }
here() { "$root/build/orrery" "$@"; }

# Every integrator, float and double, a loop over spheres and a tree, caustics of lamps and of a point light.
render_both() {
    name=$1
    shift
    arm render "$@" --quiet -o "$folder/$name.arm.pfm" >/dev/null
    here render "$@" --quiet --isa scalar -o "$folder/$name.here.pfm" >/dev/null
    here compare "$folder/$name.arm.pfm" "$folder/$name.here.pfm" --max-rmse 0 >"$folder/$name.txt" || {
        echo "$name: Arm's picture is another, rmse $(sed -n 's/^rmse //p' "$folder/$name.txt")" >&2
        exit 1
    }
    echo "$name: the same picture"
}
render_both whitted "$root/scenes/assignment_01.json" --size 48x48 --spp 4
render_both paths "$root/scenes/assignment_03.json" --size 48x48 --spp 16
render_both lamps "$root/scenes/assignment_08.json" --size 48x48 --spp 16 --precision double
render_both caustics "$root/scenes/showcase.json" --size 64x36 --spp 4
render_both tree "$root/scenes/bench/like_484.json" --size 48x48 --spp 4
render_both depth "$root/scenes/assignment_05.json" --size 48x48 --spp 4 --integrator depth
