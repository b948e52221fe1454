"""race.py ORRERY: races it against POV-Ray and Blender's Cycles where they are installed, and rewrites bench/PEERS.md.

The page says how. References are kept in build/peers for the next race.
"""
import array
import hashlib
import json
import math
import os
import re
import resource
import shutil
import statistics
import subprocess
import sys
from pathlib import Path

import povray
import scene

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent / "pages"))
from page import BENCH, ROOT, processor, table, with_blocks, write

WORK = ROOT / "build" / "peers"
HEAD = ["scene", "setting", "error, %", "its seconds", "our samples", "our seconds", "times as long",
        "r, g, b off ours, %", "its start", "our start"]
SIZE, TURNS = 256, 3
# Samples per pixel of measured images and of references. Ours are squares, for strata; Cycles' powers of two.
OURS, OUR_REFERENCE = (1, 4, 9, 16, 36, 64, 144, 256), 8281
CYCLES, CYCLES_REFERENCE = 32, 512
POVRAY = {"one ray a pixel": "-A", "2 x 2 rays": "+AM1 +A0.0 +R2 -J", "4 x 4 rays": "+AM1 +A0.0 +R4 -J",
          "adaptive, `+AM2 +A0.3 +R3`": "+AM2 +A0.3 +R3 -J", "adaptive, `+AM2 +A0.05 +R4`": "+AM2 +A0.05 +R4 -J"}
POVRAY_REFERENCE = "+AM1 +A0.0 +R24 -J"


def call(*command):
    """What the program printed, and its processor seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, cwd=WORK, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        sys.exit(f"{command[0]} failed:\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout + done.stderr, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def kept(stem, ending, recipe, render):
    """The file `render` makes, or that of an earlier race by the same recipe."""
    file = WORK / f"{stem}_{hashlib.sha256(repr(recipe).encode()).hexdigest()[:12]}{ending}"
    if not file.exists():
        print(f"rendering the reference {file.name}", file=sys.stderr, flush=True)
        render(file.with_name("new_" + file.name))
        file.with_name("new_" + file.name).rename(file)
    return file


def error(image, reference, samples=0, reference_samples=1):
    """Relative error, the root of the mean of (a - b)^2 / (b^2 + 0.01), less the reference's own part of it."""
    out, _ = call(ORRERY, "compare", image, reference, "--json", "-")
    return math.sqrt(json.loads(out)["mrse"] / (1 + samples / reference_samples))


def values(image):
    (WORK / "black.pfm").write_bytes(b"PF\n%d %d\n-1\n" % (SIZE, SIZE) + bytes(12 * SIZE * SIZE))
    call(ORRERY, "compare", image, "black.pfm", "--difference", "values.pfm")
    return array.array("f", (WORK / "values.pfm").read_bytes()[-12 * SIZE * SIZE:])


def same_picture(peer, ours):
    """By how many percent the peer's means of red, green, blue are off ours, without the pixels that see a lamp."""
    lamps = [max(sphere["emission"]) for sphere in ours.scene["spheres"] if any(sphere["emission"])]
    a, b = values(peer.reference), values(ours.reference)
    seen = {i // 3 for i, value in enumerate(b) if value > 0.5 * min(lamps, default=math.inf)}
    around = {i + dx + SIZE * dy for i in seen for dx in (-1, 0, 1) for dy in (-1, 0, 1)}
    rest = [3 * i for i in range(SIZE * SIZE) if i not in around]
    return " ".join(f"{100 * (sum(a[i + c] for i in rest) / sum(b[i + c] for i in rest) - 1):+.1f}" for c in range(3))


class Ours:
    def __init__(self, name):
        self.file = ROOT / "scenes" / f"{name}.json"
        self.scene = scene.read(self.file)
        recipe = self.file.read_text(encoding="utf-8"), call(ORRERY, "--version")[0].split("+")[0], SIZE, OUR_REFERENCE
        self.reference = kept(name, ".pfm", recipe, lambda new: self.render(OUR_REFERENCE, 0, new))

    def render(self, samples, seed, image):
        return call(ORRERY, "render", self.file, "--size", f"{SIZE}x{SIZE}", "--spp", samples, "--seed", seed,
                    "--threads", 1, "-o", image)[1]

    def measure(self, seed):
        """Seconds for one sample per pixel, those for start and reading, the errors of OURS samples."""
        seconds, errors = [], []
        for samples in OURS:
            seconds.append(self.render(samples, seed, "ours.pfm"))
            errors.append(error("ours.pfm", self.reference, samples, OUR_REFERENCE))
        each = (seconds[-1] - seconds[0]) / (OURS[-1] - OURS[0])
        return each, seconds[0] - OURS[0] * each, errors


class Cycles:
    def __init__(self, name, lamps, ours):
        self.job = {"scene": ours.scene, "lamps": lamps, "size": SIZE}
        recipe = (HERE / "blender.py").read_text(encoding="utf-8"), self.job, CYCLES_REFERENCE
        self.reference = kept(f"{name}_{lamps}", ".exr", recipe, lambda new: self.render((CYCLES_REFERENCE, 0, new)))

    def render(self, *renders):
        jobs = [{"samples": samples, "seed": seed, "file": str(WORK / file)} for samples, seed, file in renders]
        (WORK / "job.json").write_text(json.dumps({**self.job, "renders": jobs}), encoding="utf-8")
        _, total = call("blender", "--background", "--factory-startup", "--threads", 1, "--python-exit-code", 1,
                        "--python", HERE / "blender.py", "--", "job.json")
        return total, *(float(Path(job["file"] + ".time").read_text(encoding="utf-8")) for job in jobs)

    def measure(self, seed):
        """Seconds of sampling, those of starting Blender and building the scene, the error."""
        total, one, all_of_them = self.render((1, seed, "one.exr"), (CYCLES, seed, "cycles.exr"))
        sampling = (all_of_them - one) * CYCLES / (CYCLES - 1)
        return sampling, total - one - sampling, error("cycles.exr", self.reference, CYCLES, CYCLES_REFERENCE)


class Povray:
    def __init__(self, name, setting, ours):
        self.text, self.setting = povray.translate(ours.scene), setting
        self.reference = kept(f"{name}_povray", ".exr", (self.text, POVRAY_REFERENCE, SIZE),
                              lambda new: self.render(POVRAY_REFERENCE, new.name))

    def render(self, setting, image):
        (WORK / "scene.pov").write_text(self.text, encoding="utf-8")
        out, total = call("povray", "+Iscene.pov", f"+O{image}", "+FE", f"+W{SIZE}", f"+H{SIZE}", "-D", "+WT1",
                          *setting.split())
        return float(re.search(r"Trace Time:.*?with\s+([\d.]+) CPU-seconds", out, re.S).group(1)), total

    def measure(self, _):
        trace, total = self.render(POVRAY[self.setting], "povray.exr")
        return trace, total - trace, error("povray.exr", self.reference)


def samples_for(wanted, errors):
    """Samples per pixel that we need for an error: linear in logarithms between OURS, beyond as 1 / sqrt(n)."""
    points = list(zip(OURS, errors))
    for (n, e), (m, f) in zip(points, points[1:]):
        if f <= wanted < e:
            return n * (m / n) ** (math.log(e / wanted) / math.log(e / f))
    n, e = points[0] if wanted >= errors[0] else points[-1]
    return n * (e / wanted) ** 2


def race(peer, ours):
    """A row's figures. Turn by turn, so that what else the machine does slows both."""
    turns = [(*peer.measure(seed), *ours.measure(seed)) for seed in range(1, TURNS + 1)]
    seconds, start, errors, each, our_start, our_errors = zip(*turns)
    rms = lambda found: math.sqrt(statistics.fmean(e * e for e in found))
    wanted, middle = rms(errors), statistics.median
    samples = samples_for(wanted, [rms(step) for step in zip(*our_errors)])
    alone = [turn[0] / (turn[3] * samples_for(turn[2], turn[5])) for turn in turns]
    return [f"{100 * wanted:.2f}", f"{middle(seconds):.2f}", f"{samples:.1f}", f"{samples * middle(each):.3f}",
            f"**{middle(seconds) / (samples * middle(each)):.3g}** ({min(alone):.3g} to {max(alone):.3g})",
            same_picture(peer, ours), f"{middle(start):.2f}", f"{middle(our_start):.2f}"]


def machine():
    return f"{processor()}, one thread on {os.cpu_count()} cores; load average when it began {os.getloadavg()[0]:.1f}"


def races(program, make, names, settings):
    if not shutil.which(program):
        print(f"skipped: {program} is missing. On Debian: apt-get install --no-install-recommends {program}")
        return
    version = re.search(r"(Blender|POV-Ray) [\d.]+\d", call(program, "--version")[0]).group()
    setting, rows = f"{version}; {machine()}.", []
    for name in names:
        ours = Ours(name)
        for choice in settings:
            rows.append([name.removeprefix("assignment_0"), choice, *race(make(name, choice, ours), ours)])
            print(program, *rows[-1], sep="  ", flush=True)
    page = BENCH / "PEERS.md"
    write(page, with_blocks(page.read_text(encoding="utf-8"), {program: f"{setting}\n\n{table(HEAD, rows)}"}))


if __name__ == "__main__":
    ORRERY = Path(sys.argv[1]).resolve()
    WORK.mkdir(parents=True, exist_ok=True)
    races("povray", Povray, ["assignment_01"], POVRAY)
    races("blender", Cycles, [f"assignment_0{n}" for n in (3, 5, 8)], ["mesh", "point"])
