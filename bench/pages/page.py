"""What the pages of bench/ share: tables of results in, figures between markers and plots out.

A results file is CSV behind lines `# key: value` that say how it was measured. Of a whole run (`# whole: yes`) its page,
plots and results replace those of bench/; of any other they go to build/pages, so that trying something out costs no
committed figure. Nothing is written before everything is computed, and each file is replaced in one step.
"""

import csv
import io
import os
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
BENCH = ROOT / "bench"


def parse(text):
    """(facts, rows) of a results file: {key: value} and a list of {column: text}."""
    lines = text.splitlines()
    facts = dict(line[2:].split(": ", 1) for line in lines if line.startswith("# "))
    return facts, list(csv.DictReader(line for line in lines if not line.startswith("# ")))


def format_results(facts, rows):
    out = io.StringIO()
    for key, value in facts.items():
        out.write(f"# {key}: {value}\n")
    writer = csv.DictWriter(out, rows[0].keys(), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return out.getvalue()


def processor():
    """"Intel(R) Xeon(R) Processor (family 6, model 207)", of this machine; clouds hide the rest of the name."""
    found = dict(re.findall(r"^(.*?)\s*:\s*(.*)$", pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8"), re.M))
    return f"{found.get('model name')} (family {found.get('cpu family')}, model {found.get('model')})"


def with_blocks(page, blocks):
    """The page with each block between its own `<!-- begin NAME -->` and `<!-- end NAME -->`; all else stays."""
    for name, block in blocks.items():
        begin, end = f"<!-- begin {name} -->\n", f"<!-- end {name} -->"
        before, found, rest = page.partition(begin)
        old, ended, after = rest.partition(end)
        if not found or not ended:
            raise ValueError(f"the page has no place for '{name}', or it does not end")
        page = before + begin + block + end + after
    return page


def table(head, rows):
    """Markdown; columns of numbers are aligned to the right."""
    rows = [list(map(str, row)) for row in rows]
    numbers = [all(re.match(r"\**-?\d|$", cell) for cell in column) for column in zip(*rows)]
    rule = ["--:" if of_numbers else "---" for of_numbers in numbers]
    lines = [f"| {' | '.join(head)} |", f"|{'|'.join(rule)}|", *(f"| {' | '.join(row)} |" for row in rows)]
    return "\n".join(lines) + "\n"


def listed(names):
    names = list(names)
    return " and ".join(filter(None, [", ".join(names[:-1]), *names[-1:]]))


def in_order(values):
    """Each once, in the order of their first appearance."""
    return list(dict.fromkeys(values))


def write(file, data):
    file.parent.mkdir(parents=True, exist_ok=True)
    temporary = file.with_name(f".{file.name}.{os.getpid()}")
    temporary.write_bytes(data if isinstance(data, bytes) else data.encode())
    os.replace(temporary, file)


def publish_file(name, file, blocks):
    """Publishes page NAME.md, which has no plots, from a results file that is kept as results/name.csv."""
    text = pathlib.Path(file).read_text()
    facts, rows = parse(text)
    publish(f"{name}.md", facts, {f"{name.lower()}.csv": text}, blocks(facts, rows), dict)


def publish(name, facts, results, blocks, plots):
    """Page NAME with these blocks, {file name: text or SVG}, beside it. `plots` is called for the plots, as only they
    need matplotlib."""
    page = with_blocks((BENCH / name).read_text(), blocks)
    whole = facts.get("whole") == "yes"
    folder = BENCH if whole else ROOT / "build" / "pages"
    files = {f"plots/{plot}": svg for plot, svg in plots().items() if svg}
    for file, text in {**files, **{f"results/{file}": text for file, text in results.items()}, name: page}.items():
        write(folder / file, text)
    print(f"{folder / name}" + ("" if whole else f": no whole run, so {BENCH / name} stays as it is"), file=sys.stderr)


# ---------------------------------------------------------------------------------------------------------------- plots


def figure(title, x_label, y_label, draw):
    """SVG of draw(axes): no background, so that the page's shows, in greys that are read on light and dark."""
    import matplotlib

    matplotlib.use("svg")
    from matplotlib import pyplot

    grey = "#808080"
    settings = {"svg.fonttype": "none", "svg.hashsalt": "orrery", "font.size": 9, "grid.alpha": 0.35, "grid.color": grey}
    settings |= {key: grey for key in ("text.color", "axes.labelcolor", "axes.edgecolor", "xtick.color", "ytick.color")}
    with pyplot.rc_context(settings):
        canvas, axes = pyplot.subplots(figsize=(7.6, 4.2), layout="constrained")
        axes.set(title=title, xlabel=x_label, ylabel=y_label)
        axes.grid(True, which="both")
        draw(axes)
        axes.spines[["top", "right"]].set_visible(False)
        axes.legend(loc="center left", bbox_to_anchor=(1, 0.5), frameon=False)
        out = io.BytesIO()
        canvas.savefig(out, format="svg", transparent=True, metadata={"Date": None, "Creator": None})
        pyplot.close(canvas)
    return out.getvalue()


def colour(i):
    from matplotlib import colormaps

    palette = colormaps["tab20"].colors  # dark and light by turns
    return [*palette[::2], *palette[1::2]][i % 20]


def round_ticks(axis):
    """Ticks of a logarithmic axis at 1, 2 and 5, or at powers of ten where there are many, written as 0.5, 20, 65k."""
    from matplotlib import ticker

    low, high = axis.get_view_interval()
    axis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5) if high / low < 1e4 else (1,)))
    axis.set_minor_locator(ticker.NullLocator())
    axis.set_major_formatter(ticker.EngFormatter(sep="") if axis.axis_name == "x" else ticker.FormatStrFormatter("%g"))


def lines(title, x_label, y_label, series):
    """`series`: (name, [(x, y)], dashed, number of its colour), over logarithmic axes. None where there is nothing to draw."""

    def draw(axes):
        for name, points, dashed, i in series:
            axes.loglog(*zip(*points), "--" if dashed else "-", marker=".", color=colour(i), label=name)
        round_ticks(axes.xaxis)
        round_ticks(axes.yaxis)

    return figure(title, x_label, y_label, draw) if any(points for _, points, _, _ in series) else None


def bars(title, y_label, groups, series, logarithmic=False):
    """`series`: {name: [a value of each group, or None]}. None where there is nothing to draw."""

    def draw(axes):
        width = 0.8 / len(series)
        for i, (name, values) in enumerate(series.items()):
            at = [(g + (i + 0.5) * width - 0.4, v) for g, v in enumerate(values) if v]
            axes.bar([x for x, _ in at], [v for _, v in at], width, label=name, color=colour(i))
        axes.set_xticks(range(len(groups)), groups, rotation=25, ha="right")
        axes.grid(False, axis="x")
        if logarithmic:
            axes.set_yscale("log")
            round_ticks(axes.yaxis)

    return figure(title, "", y_label, draw) if any(map(any, series.values())) else None
