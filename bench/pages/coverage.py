#!/usr/bin/env python3
"""bench/COVERAGE.md's figures: coverage.py RESULTS.csv, as orrery_coverage prints them."""

import re
import sys
from math import sqrt

from page import in_order, publish_file, table

COUNTS = ("renders", "inside", "above", "below", "at_least")


def wilson(count, trials):
    """The 95 % interval of a share."""
    z, n, p = 1.96, trials, count / trials
    middle, half = p + z * z / (2 * n), z * sqrt(p * (1 - p) / n + z * z / (4 * n * n))
    return (middle - half) / (1 + z * z / n), (middle + half) / (1 + z * z / n)


def share(count, trials):
    low, high = wilson(count, trials)
    return f"{100 * count / trials:.1f} % ({100 * low:.0f} to {100 * high:.0f})"


def counted(row):
    return [share(row["inside"], row["renders"]), row["above"], row["below"], row["at_least"]]


def stopped_by(row):
    return re.sub(r" ?[\d.]+[%s]|^\d+ ", "", row["way"]).strip()


def blocks(facts, rows):
    rows = [row | {count: int(row[count]) for count in COUNTS} for row in rows]
    keys = {"all": lambda row: "all", "scene": lambda row: row["scene"], "estimator": lambda row: row["estimator"],
            "stopped by": stopped_by, "side": lambda row: f"{row['side']} pixels"}
    groups = []
    for name, key in keys.items():
        for value in in_order(map(key, rows)):
            total = {count: sum(row[count] for row in rows if key(row) == value) for count in COUNTS}
            groups.append([name, value, total["renders"], *counted(total)])
    lines = [[row["scene"], row["side"], row["estimator"], row["way"], f"{float(row['samples']):.0f}",
              f"{100 * float(row['made']):.3g} %", f"{100 * float(row['stated']):.3g} %",
              f"{float(row['made']) / float(row['stated']):.3f}", *counted(row),
              f"{float(row['width']):.2f} times" if float(row["width"]) else "-"] for row in rows]
    counts = ["inside", "above", "below", '"at least"']
    return {
        "setting": f"{facts['processor']}, {facts['threads']} threads, {facts['isa']}. {len(rows)} rows of "
                   f"{rows[0]['renders']} renders in {facts['seconds']} s.\n",
        "groups": table(["", "", "renders", *counts], groups),
        "rows": table(["scene", "side", "estimator", "", "samples", "error made", "stated", "made / stated", *counts,
                       "upper end"], lines),
    }


if __name__ == "__main__":
    publish_file("COVERAGE", sys.argv[1], blocks)
