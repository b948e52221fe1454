#!/bin/sh
# threads.sh ORRERY SCENES: renders in which threads hand each other most, with the program that ThreadSanitizer watches:
# it ends any of them with exit code 66 where two threads may race.
set -eu

orrery=$1 scenes=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
status=0

# expect CODE OPTION...: one render
expect() {
    code=$1 found=0
    shift
    echo "orrery $*"
    "$orrery" "$@" --threads 4 --quiet || found=$?
    [ $found -eq "$code" ] || { echo "ended with $found, not $code" && status=1; }
}

"$orrery" generate random --spheres 20000 -o "$folder/many.json" --quiet
for precision in float double; do
    expect 0 render "$scenes/assignment_08.json" --size 64x64 --spp 4 --precision $precision -o "$folder/a.exr"
done
expect 0 render "$scenes/assignment_05.json" --size 48x48 --error 20% --error-image "$folder/e.exr" -o "$folder/a.exr"
expect 0 render "$scenes/assignment_01.json" --size 48x48 --error 3% --estimator sobol -o "$folder/a.exr"
expect 0 render "$scenes/assignment_03.json" --size 48x48 --time 2s -o "$folder/a.exr"
expect 0 render "$folder/many.json" --size 64x64 --spp 2 --stats "$folder/a.json" -o "$folder/a.exr"
expect 0 render "$folder/many.json" --size 64x64 --spp 2 --profile -o "$folder/a.exr"
expect 0 render "$scenes/assignment_05.json" --size 64x64 --spp 16 --film "$folder/a.film" --film-every 1ms -o "$folder/a.exr"
expect 0 render "$scenes/assignment_05.json" --size 64x64 --error 20% --film "$folder/a.film" --film-every 1ms -o "$folder/a.exr"

# The signal comes in the middle of a render that would take minutes. A shell has it ignored by what it starts in the
# background, and so it would stay.
echo "orrery render, and SIGINT"
env --default-signal=INT "$orrery" render "$scenes/assignment_06.json" --size 256x256 --threads 4 --quiet -o "$folder/a.exr" &
program=$!
sleep 3
kill -INT $program
found=0
wait $program || found=$?
[ $found -eq 130 ] || { echo "ended with $found, not 130" && status=1; }
exit $status
