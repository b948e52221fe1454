#!/usr/bin/env python3
"""bench/README.md's figures: bench.py RESULTS, where RESULTS is what Google Benchmark wrote (.json) or a file of
bench/results (.csv)."""

import json
import pathlib
import re
import sys

from page import bars, in_order, lines, format_results, parse, publish, table

ISAS = {"sse2": "SSE2", "avx2": "AVX2", "avx512": "AVX-512"}
NOT_OURS = {"family_index", "per_family_instance_index", "repetitions", "repetition_index", "threads", "iterations",
            "real_time", "cpu_time"}  # what Google Benchmark writes beside our counters


def speed(counters):
    return counters.get("Rays/s") or counters.get("Operations/s") or 1 / counters["seconds"]


def from_json(text):
    """(facts, rows) of a run. A benchmark's name is group/subject/what/variant; of its repetitions the fastest counts:
    what slows a run on a shared machine is never its own. An error of any benchmark makes no page."""
    run = json.loads(text)
    fastest = {}
    for benchmark in run["benchmarks"]:
        if benchmark.get("error_occurred"):
            raise ValueError(f"{benchmark['name']}: {benchmark.get('error_message')}")
        if benchmark["run_type"] != "iteration":
            continue
        counters = {key: value for key, value in benchmark.items()
                    if isinstance(value, (int, float)) and not isinstance(value, bool) and key not in NOT_OURS}
        place, name = benchmark["family_index"], benchmark["name"].split("/")[:4]
        if place not in fastest or speed(counters) > speed(fastest[place][1]):
            fastest[place] = name, counters
    def text(x):
        return f"{x:.0f}" if x == int(x) and x < 1e9 else f"{x:.5g}"

    columns = sorted({column for _, counters in fastest.values() for column in counters})
    rows = []
    for _, (name, counters) in sorted(fastest.items()):
        row = dict(zip(("group", "subject", "what", "variant"), name, strict=True))
        rows.append(row | {column: text(counters[column]) if column in counters else "" for column in columns})
    context = run["context"]
    return {key: context[key] for key in ("processor", "embree", "whole")}, rows


def file_name(processor):
    """"Intel(R) Xeon(R) Processor @ 2.50GHz" -> "intel-xeon-2.50ghz"."""
    words = re.findall(r"[a-z0-9.]+", re.sub(r"\(.*?\)", "", processor.lower()))
    return "-".join(word for word in words if word not in ("processor", "cpu")) or "unknown"


class Results:
    def __init__(self, rows):
        self.rows = {(row["group"], row["subject"], row["what"], row["variant"]): row for row in rows}

    def names(self, place, *start):
        """What stands at that place of the names that begin so, in the order of the run."""
        return in_order(key[place] for key in self.rows if key[: len(start)] == start)

    def get(self, counter, *name):
        return float(self.rows.get(name, {}).get(counter) or 0)

    def rate(self, *name):
        return self.get("Rays/s", *name) / 1e6

    def peers(self):
        """(scene, queue, our variant, Embree's): ours with the last instruction set measured, as they come worst first,
        Embree's the fastest of its ways."""
        for scene in self.names(1, "peer"):
            for queue in self.names(2, "peer", scene):
                variants = self.names(3, "peer", scene, queue)
                ours = [v for v in variants if not v.startswith("embree")]
                theirs = sorted((v for v in variants if v.startswith("embree")),
                                key=lambda v: self.rate("peer", scene, queue, v))
                yield scene, queue, ours[-1], theirs[-1] if theirs else None


def number(x):
    return "" if not x else f"{x:.3g}" if x < 100 else f"{x:.0f}"


def ratio(a, b):
    return f"{a / b:.2f}" if a and b else ""


def tables(facts, results, csv_name):
    name = results.rows.keys()
    machine = table(["operation", "", "10^9 per second"],
                    [[s, f"{w}, {v}", f"{results.get('Operations/s', g, s, w, v) / 1e9:.2f}"]
                     for g, s, w, v in name if g == "machine"])
    for key in name:
        if key[0] == "linear":
            tests, bound = results.get("tests/us", *key), results.get("bound/us", *key)
            machine += (f"\n{key[2]} rays: {tests:.1f} tests of 16 rays per microsecond of {bound:.1f} that the ports "
                        f"allow, **{100 * tests / bound:.0f} %**.\n")
    renders = []
    for scene in results.names(1, "render"):
        rates = [results.rate("render", scene, "1", isa) for isa in ISAS]
        two = results.rate("render", scene, "2", "avx512")
        spheres = max(results.get("spheres", "render", scene, "1", isa) for isa in ISAS)
        renders.append([scene, f"{spheres:.0f}", *map(number, rates[:2]), f"**{number(rates[2])}**", number(two), ratio(rates[0], rates[2]),
                        ratio(rates[1], rates[2]), ratio(two, rates[2])])
    peers = []
    for scene, queue, ours, embree in results.peers():
        mine, best = (results.rate("peer", scene, queue, v) for v in (ours, embree))
        peers.append([scene, f"{results.get('spheres', 'peer', scene, queue, ours):.0f}", queue, number(mine),
                      number(best), embree or "", ratio(mine, best),
                      ratio(results.rate("peer", scene, queue, "avx2"), best)])
    builds = [[v, s, w, f"{results.get('seconds', g, s, w, v):.3f}", f"{results.get('bytes/sphere', g, s, w, v):.1f}"]
              for g, s, w, v in name if g == "build"]
    stages = ""
    for scene in results.names(1, "stage"):
        rows = []
        for stage in results.names(2, "stage", scene):
            keys = [("stage", scene, stage, isa) for isa in ISAS]
            rows.append([stage, f"{max(results.get('bytes/ray', *key) for key in keys):.0f}",
                         *(number(results.rate(*key)) for key in keys),
                         *(f"{results.get('cycles/ray', *key):.3g}" for key in keys)])
        head = ["stage @ bounce", "bytes/ray", "Mrays/s: SSE2", "AVX2", "AVX-512", "cycles/ray: SSE2", "AVX2", "AVX-512"]
        stages += f"<details><summary>{scene}</summary>\n\n{table(head, rows)}\n</details>\n"
    isas = list(ISAS.values())
    return {
        "setting": f"{facts['processor']}; one thread unless a row says otherwise; float. Embree: {facts['embree']}. "
                   f"All figures: [results/{csv_name}](results/{csv_name}).\n",
        "machine": machine,
        "renders": table(["scene", "spheres", *isas, "2 threads", "SSE2 / AVX-512", "AVX2 / AVX-512", "2 threads / 1"],
                         renders),
        "peers": table(["scene", "spheres", "queue", "ours", "Embree's best", "which", "ours / Embree", "AVX2 / Embree"],
                       peers),
        "builds": table(["", "spheres", "threads", "seconds", "bytes/sphere"], builds),
        "stages": stages,
    }


def plots(results):
    spheres = []
    for colour, queue in enumerate(("primary", "diffuse", "shadow")):
        ours, embree = [], []
        for scene, of_queue, mine, best in results.peers():
            if of_queue == queue and scene.startswith("random-"):
                x = results.get("spheres", "peer", scene, queue, mine)
                ours.append((x, results.rate("peer", scene, queue, mine)))
                if best:
                    embree.append((x, results.rate("peer", scene, queue, best)))
        spheres += [(f"{queue}, {who}", points, who == "Embree", colour)
                    for who, points in (("ours", ours), ("Embree", embree)) if points]
    # All stages of camera rays, and those that trace later ones.
    scene = "assignment_08"
    stages = [stage for stage in results.names(2, "stage", scene)
              if stage.endswith("@0") or stage.startswith(("intersect", "shadow"))]
    scenes = results.names(1, "render")
    return {
        "spheres.svg": lines("Random spheres, one thread", "spheres", "million rays per second", spheres),
        "stages.svg": bars(f"Stages of {scene}, stage @ bounce", "cycles per ray", stages,
                           {title: [results.get("cycles/ray", "stage", scene, stage, isa) for stage in stages]
                            for isa, title in ISAS.items()}, logarithmic=True),
        "renders.svg": bars("Whole renders, one thread", "million rays per second", scenes,
                            {title: [results.rate("render", scene, "1", isa) for scene in scenes]
                             for isa, title in ISAS.items()}),
    }


def main(file):
    text = pathlib.Path(file).read_text()
    facts, rows = from_json(text) if file.endswith(".json") else parse(text)
    results, csv_name = Results(rows), file_name(facts["processor"]) + ".csv"
    publish("README.md", facts, {csv_name: format_results(facts, rows)}, tables(facts, results, csv_name),
            lambda: plots(results))


if __name__ == "__main__":
    main(*sys.argv[1:])
