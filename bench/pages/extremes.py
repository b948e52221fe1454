#!/usr/bin/env python3
"""bench/EXTREMES.md's figures: extremes.py RESULTS.csv, as orrery_extremes prints them."""

import sys

from page import in_order, publish_file, table


def figure(x):
    return f"{float(x):.2g}"


def line(row):
    return [row["case"], row["mode"], row["trials"], *map(figure, (row["worst"], row["quantile"], row["limit"])),
            row["unit"]]


def blocks(facts, rows):
    head = ["case", "mode", "trials", "worst", "99.9 %", "limit", "unit"]
    cases, nearest = f"TIMES was {facts['times']}.\n", []
    for group in in_order(row["group"] for row in rows):
        of_group = [row for row in rows if row["group"] == group]
        modes = sorted({row["mode"] for row in of_group})
        trials = (sum(int(row["trials"]) for row in of_group if row["mode"] == mode) for mode in modes)
        cases += f"\n## {group}\n\n{table(head, map(line, of_group))}\nTrials in all: " \
                 f"{', '.join(f'{count} ({mode})' for mode, count in zip(modes, trials))}.\n"
        worst = max(of_group, key=lambda row: float(row["worst"]) / (float(row["limit"]) or 1))
        nearest.append([group, *line(worst)])
    return {"nearest": table(["group", *head], nearest), "cases": cases}


if __name__ == "__main__":
    publish_file("EXTREMES", sys.argv[1], blocks)
