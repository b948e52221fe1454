#!/usr/bin/env python3
"""README's figures, measured by renders: figures.py ORRERY [REPEATS]. Of the repeats the fastest counts."""

import json
import pathlib
import subprocess
import sys

from page import ROOT, processor, table, with_blocks, write

SCENES = {1: ("Whitted, glass and mirror", 256), 2: ("Whitted, diffuse", 256),
          3: ("path traced, glass and gloss", 128), 4: ("path traced, a light and glass", 256),
          5: ("path traced, three lights", 256)}
ISAS = {"avx512": "AVX-512", "avx2": "AVX2", "sse2": "SSE2"}
ONE_THREAD = {"scene 8 (`--transport nee`)": ["assignment_08", "--transport", "nee"], "`like_46`": ["bench/like_46"],
              "`like_484`": ["bench/like_484"], "the showcase": ["showcase"]}


def render(orrery, scene, *options):
    """Statistics of one render, None where the machine lacks the instruction set."""
    command = [orrery, "render", ROOT / "scenes" / f"{scene}.json", *options,
               "-o", "figures.pfm", "--stats", "-", "--quiet"]
    run = subprocess.run(map(str, command), stdout=subprocess.PIPE, text=True, cwd=ROOT / "build")
    return json.loads(run.stdout) if run.returncode == 0 else None


def fastest(orrery, repeats, scene, *options):
    return min((render(orrery, scene, *options) for _ in range(repeats)), key=lambda run: run["seconds"])


def blocks(orrery, repeats):
    isas = [isa for isa in ISAS if render(orrery, "sample", "--size", "1x1", "--isa", isa)]
    rows = []
    for number, (what, samples) in SCENES.items():
        runs = [fastest(orrery, repeats, f"assignment_{number:02}", "--spp", samples, "--isa", isa) for isa in isas]
        rows.append([f"{number} {what}", samples,
                     *(f"{run['seconds']:.2f} s, {run['rays_per_second'] / 1e6:.0f}" for run in runs)])
    single = []
    for name, scene_and_options in ONE_THREAD.items():
        run = fastest(orrery, repeats, *scene_and_options, "--size", "512x512", "--spp", 36, "--threads", 1)
        single.append(f"{run['rays_per_second'] / 1e6:.0f} on {name}")
    return {"figures": f"{processor()}, {runs[0]['threads']} threads, {runs[0]['precision']}. Of {repeats} runs the "
                       f"fastest.\n\n{table(['scene', 'samples', *map(ISAS.get, isas)], rows)}\n"
                       f"One thread of {ISAS[isas[0]]} casts so many million rays per second: {', '.join(single)} "
                       "(512 x 512, 36 samples).\n"}


def main(orrery, repeats=3):
    page = ROOT / "README.md"
    write(page, with_blocks(page.read_text(), blocks(pathlib.Path(orrery).resolve(), int(repeats))))


if __name__ == "__main__":
    main(*sys.argv[1:])
