#!/usr/bin/env python3
"""README's figures, measured by renders: figures.py ORRERY [REPEATS]. Of the repeats the fastest counts."""

import json
import pathlib
import re
import subprocess
import sys

from page import ROOT, table, with_blocks, write

SCENES = {1: ("Whitted, glass and mirror", 256), 2: ("Whitted, diffuse", 256), 3: ("path traced, glass and gloss", 128),
          4: ("path traced, a light and glass", 256), 5: ("path traced, three lights", 256)}
ISAS = {"avx512": "AVX-512", "avx2": "AVX2", "sse2": "SSE2"}
ONE_THREAD = {"scene 8 (`--transport nee`)": ("assignment_08", ["--transport", "nee"]), "`like_46`": ("bench/like_46", []),
              "`like_484`": ("bench/like_484", []), "the showcase": ("showcase", [])}


def processor():
    found = dict(re.findall(r"^(.*?)\s*:\s*(.*)$", pathlib.Path("/proc/cpuinfo").read_text(), re.M))
    return f"{found['model name']} (family {found['cpu family']}, model {found['model']})"


def fastest(orrery, repeats, scene, *options):
    command = [pathlib.Path(orrery).resolve(), "render", ROOT / "scenes" / f"{scene}.json", *options, "-o", "figures.pfm", "--stats", "-", "--quiet"]
    runs = []
    for _ in range(repeats):
        out = subprocess.run(map(str, command), check=True, stdout=subprocess.PIPE, text=True, cwd=ROOT / "build").stdout
        runs.append(json.loads(out))
    return min(runs, key=lambda run: run["seconds"])


def blocks(orrery, repeats):
    rows = []
    for number, (what, samples) in SCENES.items():
        runs = [fastest(orrery, repeats, f"assignment_{number:02}", "--spp", samples, "--isa", isa) for isa in ISAS]
        rows.append([f"{number} {what}", samples,
                     *(f"{run['seconds']:.2f} s, {run['rays_per_second'] / 1e6:.0f}" for run in runs)])
    single = [f"{fastest(orrery, repeats, scene, *options, '--size', '512x512', '--spp', 36, '--threads', 1)['rays_per_second'] / 1e6:.0f} on {name}"
              for name, (scene, options) in ONE_THREAD.items()]
    return {"figures": f"{processor()}, {runs[0]['threads']} threads, {runs[0]['precision']}; a shared machine. Of "
                       f"{repeats} runs the fastest.\n\n{table(['scene', 'samples', *ISAS.values()], rows)}\nOne thread of "
                       f"{ISAS[runs[0]['isa']]} casts so many million rays per second: {', '.join(single)} (512 x 512, 36 samples).\n"}


if __name__ == "__main__":
    README = ROOT / "README.md"
    write(README, with_blocks(README.read_text(), blocks(sys.argv[1], int((sys.argv[2:] or [3])[0]))).encode())
