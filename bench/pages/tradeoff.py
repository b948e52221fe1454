#!/usr/bin/env python3
"""bench/TRADEOFF.md's figures and sentences: tradeoff.py RESULTS.csv, as orrery_tradeoff prints them."""

import pathlib
import sys
from math import exp, hypot, inf, log, sqrt
from typing import NamedTuple

from page import bars, in_order, lines, listed, parse, publish, table

# What counts as a difference to a user, how sure it has to be, and how sure among hundreds of settings.
WORTH, STANDARD_ERRORS, AMONG_MANY = 1.05, 2, 3.5
# What is not compared with the defaults: passes are what --error and --time need, the same for all pixels or not.
BASE = {"--adaptive on": "--adaptive off"}

# What the page's prose says beside the figures: options, scenes and what must be true of their gain.
CLAIMS = [
    ("strata win where light comes from points or is looked at", "--estimator uniform",
     ("assignment_01", "assignment_02", "assignment_07"), lambda gain: gain.worse()),
    ("Sobol's sequences win where light comes from lamps and other surfaces", "--estimator stratified",
     ("assignment_03", "assignment_06", "assignment_08", "showcase"), lambda gain: gain.worse()),
    ("weighing both ways to find a lamp is never far from the better one", "--transport nee",
     ("assignment_03", "assignment_05", "assignment_06", "assignment_08", "showcase"), lambda gain: gain.value < 1.15),
    ("roulette from the start loses", "--roulette-from 0", ("assignment_04", "assignment_08"), lambda gain: gain.value < 1),
    ("one lamp of dozens of unequal brightness is worth its noise", "--light-choice power", ("many_lights",),
     lambda gain: gain.better()),
]


class Figure(NamedTuple):
    """An estimate and its standard error."""
    value: float
    error: float

    def __truediv__(self, other):
        value = self.value / other.value
        return Figure(value, value * hypot(self.error / self.value, other.error / other.value))

    def __str__(self):
        return f"{self.value:.2f} ± {self.error:.2f}" if self.error < inf else "-"

    def above(self, bound, standard_errors=STANDARD_ERRORS):
        return self.value - standard_errors * self.error > bound

    def better(self):
        return self.value > WORTH and self.above(1)

    def worse(self):
        return (Figure(1, 0) / self).better()


def geometric_mean(ratios):
    mean = exp(sum(log(r.value) for r in ratios) / len(ratios))
    return Figure(mean, mean * sqrt(sum((r.error / r.value / len(ratios)) ** 2 for r in ratios)))


class Level:
    """A setting on a scene at one number of samples."""

    def __init__(self, row):
        self.row, self.samples = row, float(row["samples"])
        self.mrse, self.seconds, self.slope, self.floor = (
            Figure(float(row[name]), float(row[name + "_error"])) for name in ("mrse", "seconds", "slope", "floor"))

    def measured(self):
        return self.mrse.value > 0 and self.seconds.value > 0

    def cost(self):
        """Error times time: the less, the more efficient."""
        return Figure(self.mrse.value * self.seconds.value, self.mrse.value * self.seconds.value * hypot(
            self.mrse.error / self.mrse.value, self.seconds.error / self.seconds.value))

    def error(self):
        """Relative, in per cent."""
        return 100 * sqrt(max(0, self.mrse.value))


def about_time(options):
    """Instruction set and number format change the time, and of the image hardly anything."""
    return "--isa" in options or "--precision" in options


class Run:
    def __init__(self, facts, rows):
        self.facts = facts
        self.scenes = in_order(row["scene"] for row in rows)
        self.cells = {}  # (scene, options): levels, fewest samples first
        for row in rows:
            self.cells.setdefault((row["scene"], row["options"]), []).append(Level(row))
        self.options = in_order(options for _, options in self.cells)

    def of(self, scene):
        return {options: levels for (name, options), levels in self.cells.items() if name == scene}

    def gain(self, scene, options, level=-1):
        """Efficiency over that of what it replaces, at the largest number of samples; None where that is unknown."""
        mine, base = (self.cells.get((scene, o)) for o in (options, BASE.get(options, "defaults")))
        if not mine or not base or min(len(mine), len(base)) < -level:
            return None
        mine, base = mine[level], base[level]
        if not mine.measured() or not base.measured():
            return None
        return base.seconds / mine.seconds if about_time(options) else base.cost() / mine.cost()

    def effects(self):
        """{options: {scene: gain}} of every option by itself, wherever it changes anything."""
        alone = (options for options in self.options if options.count("--") == 1)
        effects = {options: {scene: self.gain(scene, options) for scene in self.scenes} for options in alone}
        effects = {options: {s: gain for s, gain in gains.items() if gain} for options, gains in effects.items()}
        return {options: gains for options, gains in effects.items() if gains}

    def best(self, scene):
        """(options, gain): chosen by the renders of the second largest number of samples. Their gain is then read off
        the largest, which are other renders: the best of twenty settings by the same renders is ahead by luck as well."""
        gains = {options: self.gain(scene, options, -2) for options in self.of(scene)
                 if not about_time(options) and options not in BASE}
        chosen = max((o for o, gain in gains.items() if gain), key=lambda o: gains[o].value, default="defaults")
        return chosen, self.gain(scene, chosen) if chosen != "defaults" else None


def name_of(options):
    return f"`{options}`" + (f", against `{BASE[options].split()[-1]}`" if options in BASE else "")


def advice(run):
    kept, changed = [], []
    for scene in run.scenes:
        options, gain = run.best(scene)
        if gain and gain.better():
            changed.append(f"{scene} (`{options}`, {gain} times)")
        else:
            kept.append(scene)
    text = f"Leave the defaults alone for {listed(kept)}: what did best there at fewer samples is not ahead by more " \
           "than a twentieth, as far as the error bars tell.\n" if kept else ""
    text += f"Other settings are more efficient on {listed(changed)}.\n" if changed else ""
    text += "\nOption by option, each instead of its default and alone: how many times as efficient it is on average over " \
            "the scenes, which means that much less time for the same error, and where it differs by more than a " \
            "twentieth and two error bars:\n\n"
    overall = {}
    for options, gains in run.effects().items():
        won, lost = ([f"{scene} ({gain.value:.2f})" for scene, gain in gains.items() if judge(gain)]
                     for judge in (Figure.better, Figure.worse))
        where = {len(run.scenes): "", 1: f", on {listed(gains)} alone"}.get(len(gains), f" over the {len(gains)} it changes")
        text += f"* {name_of(options)}: {geometric_mean(gains.values())} times{where}. "
        text += {(True, True): f"For {listed(won)}; not for {listed(lost)}.\n",
                 (True, False): f"**Better** on {listed(won)}, nowhere worse.\n",
                 (False, True): f"Nowhere better, worse on {len(lost)}.\n",
                 (False, False): "No difference on any scene beyond the error bars.\n"}[bool(won), bool(lost)]
        if options not in BASE:
            unchanged = [Figure(1, 0)] * (len(run.scenes) - len(gains))
            overall[options] = geometric_mean([*gains.values(), *unchanged])
    ahead = [f"`{options}` ({mean})" for options, mean in overall.items() if mean.better()]
    nearest = sorted(overall, key=lambda options: -overall[options].value)[:2]
    text += "\nOver all scenes, those that an option does not change included, "
    if ahead:
        return text + f"more than a twentieth ahead of the defaults is {listed(ahead)}: these defaults should change.\n"
    return text + "no option is ahead of its default by more than a twentieth and two error bars: the defaults stay. " \
                  f"Nearest come {listed(f'`{options}` ({overall[options]})' for options in nearest)}.\n"


def best(run):
    rows = []
    for scene in run.scenes:
        usual, (options, gain) = run.of(scene)["defaults"][-1], run.best(scene)
        rows.append([f"[{scene}](plots/tradeoff_{scene}.svg)", f"{usual.samples:.0f}", f"{usual.error():.2g} %", options,
                     gain or "1"])
    head = ["scene", "samples", "error with the defaults", "best at fewer samples", "times the defaults' efficiency"]
    return table(head, rows)


def options_table(run):
    rows = []
    for options, gains in run.effects().items():
        low, high = (pick(gains, key=lambda scene: gains[scene].value) for pick in (min, max))
        rows.append([name_of(options), len(gains), geometric_mean(gains.values()), f"{gains[low]} ({low})",
                     f"{gains[high]} ({high})"])
    return table(["instead of the default", "scenes", "mean gain", "worst", "best"], rows)


def slopes(run):
    def slope(scene, options):
        levels = run.of(scene).get(options)
        return levels[-1].slope if levels else "-"

    text = table(["scene", "`--estimator uniform`", "defaults"],
                 [[scene, slope(scene, "--estimator uniform"), slope(scene, "defaults")] for scene in run.scenes])
    last = {key: levels[-1] for key, levels in run.cells.items()}
    biased = [f"* {scene}, {options}: **bias**, the error tends to {100 * sqrt(level.floor.value):.2g} % "
              f"({level.floor.value / level.floor.error:.1f} standard errors)\n"
              for (scene, options), level in last.items() if level.floor.above(0, AMONG_MANY)]
    slow = {key: level for key, level in last.items()
            if level.slope.error < inf and level.slope.above(-1, AMONG_MANY)}
    text += f"\nOf {len(last)} settings of scenes {len(biased) or 'none'} has a floor above zero by more than " \
            f"{AMONG_MANY} standard errors, and {len(slow) or 'none'} a slope above -1 by as much.\n\n"
    text += "".join(biased)
    for (scene, options), level in slow.items():
        text += f"* {scene}, {options}: slope {level.slope}"
        if not level.floor.above(0, AMONG_MANY):
            text += f"; its floor is {level.floor.value / level.floor.error:.1f} standard errors from zero. The MRSE " \
                    f"of few samples comes out too low, and its error bar with it, where few renders meet a bright path"
        text += ".\n"
    return text.rstrip("\n") + "\n"


def references(run):
    rows = []
    for scene in run.scenes:
        usual = run.of(scene)["defaults"][-1]
        own = float(usual.row["reference_mrse"])
        rows.append([scene, f"{float(usual.row['reference_samples']):.0f}", f"{100 * sqrt(own):.2g} %",
                     f"{100 * own / (own + usual.mrse.value):.2g} %"])
    return table(["scene", "samples per pixel", "its own error", "share of the defaults' MRSE"], rows)


def setting(run):
    facts, rounds = run.facts, next(iter(run.cells.values()))[0].row["renders"]
    return (f"{facts['processor']}, {facts['threads']} threads, {facts['isa']}. {rounds} rounds in {facts['seconds']} s: "
            f"{len(run.cells)} combinations of scene and settings, each rendered at up to four numbers of samples, the "
            f"largest of about {facts['milliseconds']} ms of processor time; images of {facts['pixels']} pixels or about."
            + (" So few rounds leave the error bars themselves uncertain." if int(rounds) < 8 else "") + "\n")


def error_plot(run, scene):
    """Combinations count for the front only: as lines they were a thicket. Instruction sets change the time alone."""
    series, everything = [], []
    for options, levels in run.of(scene).items():
        points = [(1e3 * level.seconds.value, level.error()) for level in levels if level.measured()]
        everything += points
        if points and options.count("--") < 2 and "--isa" not in options:
            series.append((options.removeprefix("--"), points, False, len(series)))
    front = []
    for point in sorted(everything):
        if not front or point[1] < front[-1][1]:
            front.append(point)
    series.append(("best of all settings", front, True, len(series)))
    return lines(f"{scene}: error against time", "milliseconds of processor time", "relative error, per cent", series)


def plots(run):
    gains = {options.removeprefix("--"): [gains[scene].value if scene in gains else None for scene in run.scenes]
             for options, gains in run.effects().items() if "--isa" not in options}
    return {"tradeoff_efficiency.svg": bars("Efficiency over the defaults'", "1 / (MRSE x seconds), relative", run.scenes,
                                            gains, logarithmic=True),
            **{f"tradeoff_{scene}.svg": error_plot(run, scene) for scene in run.scenes}}


def false_claims(run):
    for claim, options, scenes, holds in CLAIMS:
        for scene in scenes:
            gain = run.gain(scene, options)
            if gain and not holds(gain):
                yield f"The page says that {claim}, and the gain of {options} on {scene} is {gain}: reword it"


def blocks(run):
    return {"setting": setting(run), "advice": advice(run), "best": best(run), "options": options_table(run),
            "slopes": slopes(run), "references": references(run)}


def classes(facts, rows):
    names = [name for name in in_order(row["class"] for row in rows) if name != "all"]
    error = {(row["scene"], row["options"], row["class"]): float(row["mrse"]) for row in rows}
    lines = []
    for scene, options in in_order((row["scene"], row["options"]) for row in rows):
        total = error[scene, options, "all"]
        shares = [100 * error[scene, options, name] / total if total else 0 for name in names]
        lines.append([scene, f"`{options}`" if options[0] == "-" else options, f"{total:.2g}",
                      *(f"{share:.0f}" if share >= 0.5 else "" for share in shares)])
    return f"{facts['processor']}, {facts['samples']} samples.\n\n" + table(["scene", "options", "MRSE x samples", *names], lines)


def main(file):
    text = pathlib.Path(file).read_text()
    facts, rows = parse(text)
    if "class" in rows[0]:
        publish("TRADEOFF.md", facts, {"classes.csv": text}, {"classes": classes(facts, rows)}, dict)
        return
    run = Run(facts, rows)
    publish("TRADEOFF.md", run.facts, {"tradeoff.csv": text}, blocks(run), lambda: plots(run))
    print(*false_claims(run), sep="\n", end="", file=sys.stderr)


if __name__ == "__main__":
    main(*sys.argv[1:])
