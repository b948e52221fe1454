"""The scripts of bench/pages: their arithmetic, and that every page's figures are those of its committed results. Needs
no plotting library."""

import json
import pathlib
import re
import sys
import tempfile
import unittest
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "bench/pages"))

import bench  # noqa: E402
import coverage  # noqa: E402
import extremes  # noqa: E402
import page  # noqa: E402
import tradeoff  # noqa: E402
from tradeoff import Figure  # noqa: E402

PAGE = "Prose.\n<!-- begin a -->\nold\n<!-- end a -->\nMore.\n<!-- begin b -->\n<!-- end b -->\n"


def benchmark(name, family, **counters):
    return {"name": name + "/manual_time", "family_index": family, "run_type": "iteration", "real_time": 1.0, **counters}


RUN = {
    "context": {"processor": "Some(R) CPU @ 2.50GHz", "embree": "3.13.5", "whole": "yes", "host_name": "secret"},
    "benchmarks": [
        benchmark("peer/random-8/primary/embree-8", 3, **{"Rays/s": 2e7, "spheres": 8}),
        benchmark("peer/random-8/primary/avx512", 2, **{"Rays/s": 1e8, "spheres": 8}),
        benchmark("peer/random-8/primary/avx2", 1, **{"Rays/s": 0.6e8, "spheres": 8}),
        benchmark("peer/random-8/primary/embree-16", 4, **{"Rays/s": 2.5e7, "spheres": 8}),
        benchmark("peer/random-8/primary/avx512", 2, **{"Rays/s": 2e8, "spheres": 8}),
        {"name": "peer/random-8/primary/avx512_mean", "family_index": 2, "run_type": "aggregate", "Rays/s": 9e9},
        benchmark("build/1048576/1/ours/iterations:3", 5, **{"seconds": 0.5, "bytes/sphere": 29.7}),
        benchmark("build/1048576/1/ours/iterations:3", 5, **{"seconds": 0.4, "bytes/sphere": 29.7}),
    ],
}


class Markers(unittest.TestCase):
    def test_what_stands_between_them_is_replaced_and_nothing_else(self):
        blocks = {"a": "new\n", "b": "| 1 |\n"}
        new = page.with_blocks(PAGE, blocks)
        self.assertEqual(new, PAGE.replace("old\n", "new\n").replace("<!-- end b", "| 1 |\n<!-- end b"))
        self.assertEqual(page.with_blocks(new, blocks), new)

    def test_without_a_place_or_an_end_they_are_refused(self):
        for text, name in ((PAGE, "c"), ("<!-- begin a -->\n", "a"), ("<!-- end a -->\n<!-- begin a -->\n", "a")):
            with self.assertRaises(ValueError):
                page.with_blocks(text, {name: ""})


class Publishing(unittest.TestCase):
    def test_only_a_whole_run_replaces_the_page_in_the_repository(self):
        new = page.with_blocks(PAGE, {"a": "new\n"})
        kept = {"bench/A.md": PAGE, "build/pages/A.md": new, "build/pages/results/a.csv": "x\n"}
        for whole, expected in (("yes", {"bench/A.md": new, "bench/results/a.csv": "x\n"}), ("no", kept)):
            with tempfile.TemporaryDirectory() as folder:
                root = pathlib.Path(folder)
                (root / "bench").mkdir()
                (root / "bench/A.md").write_text(PAGE)
                with mock.patch.multiple(page, ROOT=root, BENCH=root / "bench"):
                    page.publish("A.md", {"whole": whole}, {"a.csv": "x\n"}, {"a": "new\n"}, dict)
                found = {str(file.relative_to(root)): file.read_text() for file in root.rglob("*") if file.is_file()}
            self.assertEqual(found, expected)


class Benchmarks(unittest.TestCase):
    def test_the_fastest_repetition_counts_in_the_order_of_registration(self):
        facts, rows = bench.from_json(json.dumps(RUN))
        self.assertEqual([row["variant"] for row in rows], ["avx2", "avx512", "embree-8", "embree-16", "ours"])
        self.assertEqual(rows[1]["Rays/s"], "200000000")
        self.assertEqual(rows[4]["seconds"], "0.4")
        text = page.format_results(facts, rows)
        self.assertNotIn("secret", text)
        self.assertEqual(page.parse(text), (facts, rows))

    def test_the_widest_instruction_set_meets_the_best_of_embree(self):
        facts, rows = bench.from_json(json.dumps(RUN))
        self.assertIn("| random-8 | 8 | primary | 200 | 25 | embree-16 | 8.00 | 2.40 |",
                      bench.tables(facts, bench.Results(rows), "x.csv")["peers"])

    def test_a_wrong_result_makes_no_page(self):
        wrong = {**RUN, "benchmarks": [{"name": "a/b/c/d", "family_index": 0, "error_occurred": True}]}
        with self.assertRaises(ValueError):
            bench.from_json(json.dumps(wrong))

    def test_a_file_is_named_by_the_plain_part_of_the_processor(self):
        for processor, name in (("Intel(R) Xeon(R) Processor @ 2.50GHz", "intel-xeon-2.50ghz"), ("", "unknown"),
                                ("AMD Ryzen 9 7950X 16-Core Processor", "amd-ryzen-9-7950x-16-core")):
            self.assertEqual(bench.file_name(processor), name)
        self.assertNotIn("/", bench.file_name("../../etc"))


class Tradeoff(unittest.TestCase):
    def run_of(self, cells):
        rows = []
        for options, mrse in cells.items():
            for samples, share in ((16, 4), (64, 1)):
                error = mrse[samples == 64] * share
                rows.append({"scene": "ball", "options": options, "samples": str(samples), "renders": "9",
                             "seconds": str(samples / 64), "seconds_error": "0.001", "mrse": str(error),
                             "mrse_error": str(error / 50), "slope": "-1", "slope_error": "0.01", "floor": "0",
                             "floor_error": "1", "reference_samples": "1000", "reference_mrse": "1e-6"})
        return tradeoff.Run({}, rows)

    def test_ratios_add_relative_errors_in_quadrature(self):
        ratio = Figure(6, 0.3 * 6) / Figure(2, 0.4 * 2)
        self.assertAlmostEqual(ratio.value, 3)
        self.assertAlmostEqual(ratio.error, 3 * 0.5)

    def test_the_best_is_chosen_by_other_renders_than_those_it_is_judged_by(self):
        run = self.run_of({"defaults": (1, 1), "--transport nee": (0.8, 1.01), "--light-sampling area": (1.1, 0.7)})
        options, gain = run.best("ball")
        self.assertEqual(options, "--transport nee")
        self.assertAlmostEqual(gain.value, 1 / 1.01)
        self.assertIn("Leave the defaults alone for ball", tradeoff.advice(run))

    def test_sentences_follow_the_figures(self):
        run = self.run_of({"defaults": (1, 1), "--estimator sobol": (0.9, 0.9), "--estimator uniform": (2, 2)})
        text = tradeoff.advice(run)
        self.assertIn("`--estimator sobol`: 1.11 ± 0.03 times, on ball alone. **Better** on ball (1.11)", text)
        self.assertIn("`--estimator uniform`: 0.50 ± 0.01 times, on ball alone. Nowhere better, worse on 1", text)
        self.assertIn("ahead of the defaults is `--estimator sobol` (1.11 ± 0.03): these defaults should change", text)
        run.cells["ball", "defaults"][-1].slope = Figure(-0.8, 0.05)
        run.cells["ball", "defaults"][-1].floor = Figure(0.04, 0.01)
        self.assertIn("* ball, defaults: **bias**, the error tends to 20 %", tradeoff.slopes(run))
        self.assertIn("* ball, defaults: slope -0.80 ± 0.05.", tradeoff.slopes(run))


class Coverage(unittest.TestCase):
    def test_wilsons_interval(self):
        low, high = coverage.wilson(19, 20)
        self.assertAlmostEqual(low, 0.7639, 4)
        self.assertAlmostEqual(high, 0.9911, 4)

    def test_ways_to_stop(self):
        for way, kind in (("64 samples", "samples"), ("`--error 2%`", "`--error`"), ("`--time 0.05s`", "`--time`"),
                          ("`--error 2.5% --adaptive off`", "`--error --adaptive off`")):
            self.assertEqual(coverage.stopped_by({"way": way}), kind)


class Committed(unittest.TestCase):
    def check(self, name, file, blocks):
        text = (ROOT / "bench" / name).read_text()
        self.assertEqual(page.with_blocks(text, blocks(*page.parse((ROOT / "bench/results" / file).read_text()))), text)

    def test_readme(self):
        file = re.search(r"\(results/(.*?)\)", (ROOT / "bench/README.md").read_text())[1]
        self.check("README.md", file, lambda facts, rows: bench.tables(facts, bench.Results(rows), file))

    def test_tradeoff(self):
        self.check("TRADEOFF.md", "tradeoff.csv", lambda facts, rows: tradeoff.blocks(tradeoff.Run(facts, rows)))

    def test_tradeoff_prose(self):
        facts, rows = page.parse((ROOT / "bench/results/tradeoff.csv").read_text())
        run = tradeoff.Run(facts, rows)
        self.assertEqual(list(tradeoff.false_claims(run)), [])
        run.cells["assignment_08", "--estimator stratified"][-1].seconds = Figure(0.01, 0)
        self.assertRegex("".join(tradeoff.false_claims(run)), "Sobol's sequences win .* on assignment_08")

    def test_coverage(self):
        self.check("COVERAGE.md", "coverage.csv", coverage.blocks)

    def test_extremes(self):
        self.check("EXTREMES.md", "extremes.csv", extremes.blocks)


if __name__ == "__main__":
    unittest.main()
