#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Writes docs/results.md and docs/counted.md from the runs that docs/make_results.sh has made. Every number comes from their files."""

import csv
import json
import pathlib
import re
import sys
import textwrap

root = pathlib.Path(sys.argv[1])


def read(run, name):
    return json.loads((root / run / name).read_text())


def variants(run):
    return read(run, "summary.json")["variants"]


METRICS = {row["key"]: row for row in read("suite/static", "experiment.json")["metrics"]}
TWO_DIGITS = {"flicker", "lambda_false"}


def number(value, digits):
    return f"{value:.{digits}g}" if abs(value) >= 1e-6 or value == 0 else "0"


def cell(key, summary, timing=None, digits=None):
    """A metric as it is shown: with its places after the point if it counts frames, else with a few digits."""
    row = METRICS[key]
    value = (timing if row["timing"] else summary).get(key)
    if value is None:
        return "never" if summary.get(row["reached_if"]) is not None else "–"
    if row["unit"] == "frames":
        return f"{value:.{row['digits']}f}"
    return number(value, digits or (2 if key in TWO_DIGITS else 3))


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def labels(keys):
    return [METRICS[key]["label"] for key in keys]


ORDER = ["static", "light-off", "light-on", "light-dim", "fill-light", "sparse-light", "light-color", "flicker",
         "light-move", "object-move", "unrelated-light", "camera-pan", "camera-cut", "bounce-off", "door", "gloss-off",
         "gloss-move", "mirror-walk", "color-bleed"]
ORDER = [name for name in ORDER if (root / "suite" / name / "summary.json").exists()]


def filter_table(folder, names, keys):
    """The metrics of every filter in these experiments."""
    rows = []
    for name in names:
        timing = read(f"{folder}/{name}", "timing.json")["variants"]
        for i, (variant, s) in enumerate(variants(f"{folder}/{name}").items()):
            rows.append([f"`{name}`" if i == 0 else "", variant] + [cell(k, s, timing[variant]) for k in keys])
    return table(["experiment", "filter"] + labels(keys), rows)


def suite_table():
    return filter_table("suite", ORDER, [key for key, row in METRICS.items() if "results" in row["shown"]])


def lambda_table():
    keys = ["lambda_ideal_mean", "lambda_mean", "lambda_rmse", "lambda_precision", "lambda_recall", "lambda_false"]
    rows = [[f"`{name}`"] + [cell(k, variants(f"suite/{name}")["asvgf"]) for k in keys] for name in ORDER]
    return table(["experiment"] + labels(keys), rows)


def competitor_table():
    return filter_table("competitors", ["light-off", "light-on", "light-dim", "fill-light", "sparse-light", "light-color"],
                        ["t90", "lag_t90", "ghost_frames", "lag_frames", "rmse_settled", "flicker", "noise_after_event"])


def moving_table():
    return filter_table("competitors", ["light-move", "object-move"],
                        ["rmse_moving", "trail_response", "ghost_energy", "recovery_frames", "rmse_settled"])


def option_table():
    names = ["fill-light", "light-dim", "light-on"]
    runs = {name: variants(f"options/{name}") for name in names}
    of_each = ["lag_t90", "lag_frames", "noise_after_event"]
    rows = []
    for variant in runs[names[0]]:
        s = runs["fill-light"][variant]
        rows.append([f"`{variant}`"] + [cell(k, runs[name][variant]) for name in names for k in of_each] +
                    [cell("rmse_settled", s, digits=4), cell("flicker", s, digits=3), cell("lambda_false", s)])
    head = [f"{name}: {label}" if i == 0 else label for name in names for i, label in enumerate(labels(of_each))]
    return table(["option"] + head + labels(["rmse_settled", "flicker", "lambda_false"]), rows)


def signal_table():
    keys = ["lag_t90", "lag_frames", "rmse_settled", "flip_settled", "flicker"]
    rows = []
    for name in ["light-off", "light-dim", "fill-light", "sparse-light"]:
        for i, signal in enumerate(["both", "separate"]):
            for variant, s in variants(f"signals/{signal}/{name}").items():
                rows.append([f"`{name}`" if i == 0 and variant == "svgf" else "", signal, variant] + [cell(k, s) for k in keys])
    return table(["experiment", "signal", "filter"] + labels(keys), rows)


def mean_of(run, variant, metric):
    """The mean of a metric of frames over a whole run."""
    values = [float(row["value"]) for row in csv.DictReader((root / run / "metrics.csv").open())
              if row["variant"] == variant and row["metric"] == metric]
    return sum(values) / len(values)


def counted_table():
    names = ["static", "fill-light", "light-dim", "light-color"]
    rows = []
    for variant, s in variants("counted/static").items():
        row = [f"`{variant}`", cell("rmse_settled", s), cell("flip_settled", s), cell("flicker", s)]
        for name in names[1:]:
            of = variants(f"counted/{name}")[variant]
            row += [number(mean_of(f"counted/{name}", variant, "rmse"), 3), cell("lag_frames", of), cell("noise_after_event", of)]
        rows.append(row)
    head = ["filter"] + ["static: " + labels(["rmse_settled"])[0]] + labels(["flip_settled", "flicker"])
    for name in names[1:]:
        head += [f"{name}: RMSE of all frames"] + labels(["lag_frames", "noise_after_event"])
    return table(head, rows)


def beside_table():
    """Every experiment of the suite: the error over all frames, and what else counts, of A-SVGF and counted."""
    keys = ["rmse_settled", "flip_settled", "flicker", "lag_t90", "lag_frames", "ghost_frames"]
    rows = []
    for name in ORDER:
        timing = read(f"suite/{name}", "timing.json")["variants"]
        for i, variant in enumerate(["svgf", "asvgf", "counted"]):
            s = variants(f"suite/{name}")[variant]
            rows.append([f"`{name}`" if i == 0 else "", variant, number(mean_of(f"suite/{name}", variant, "rmse"), 3)] +
                        [cell(k, s) for k in keys] + [cell("ms_per_frame", s, timing[variant])])
    return table(["experiment", "filter", "RMSE of all frames"] + labels(keys + ["ms_per_frame"]), rows)


def path_table():
    keys = ["rmse_settled", "flip_settled", "flicker", "lag_t90", "lag_frames", "rmse_moving"]
    rows = []
    for name in ["bounce-off", "gloss-off", "gloss-move", "fill-light"]:
        for i, signal in enumerate(["path", "split", "bounce"]):
            timing = read(f"paths/{signal}/{name}", "timing.json")["variants"]
            for variant, s in variants(f"paths/{signal}/{name}").items():
                run = f"paths/{signal}/{name}"
                rows.append([f"`{name}`" if i == 0 and variant == "asvgf" else "", signal, variant,
                             number(mean_of(run, variant, "rmse"), 3)] + [cell(k, s) for k in keys] +
                            [cell("ms_per_frame", s, timing[variant])])
    return table(["experiment", "signal", "filter", "RMSE of all frames"] + labels(keys + ["ms_per_frame"]), rows)


def sweep_table():
    points = {}
    for s in variants("sweep").values():
        points.setdefault(s["sweep"]["value"], {})[s["sweep"]["variant"]] = s
    filters = list(next(iter(points.values())))
    keys = ["rmse_settled", "flicker", "lag_t90", "lag_frames"]
    rows = [[value] + [cell(k, by[f]) for f in filters for k in keys] for value, by in points.items()]
    head = [f"{f}: {label}" if i == 0 else label for f in filters for i, label in enumerate(labels(keys))]
    return table(["alpha"] + head, rows)


def fill(name, tables):
    """The text of a document with its tables; a section of runs that were not made, {{#RUN}} to {{/RUN}}, is left out."""
    text = (here / name).read_text()
    for run, section in re.findall(r"(?s)\{\{#([^}]*)\}\}\n(.*?)\{\{/", text):
        marked = "{{#" + run + "}}\n" + section + "{{/" + run + "}}\n"
        text = text.replace(marked, section if (root / run / "report.html").exists() else "")
    for key, make in tables.items():
        if "{{" + key + "}}" in text:
            text = text.replace("{{" + key + "}}", make if isinstance(make, str) else make())
    assert "{{" not in text, "a table is missing: " + text[text.index("{{"):][:40]
    paragraphs = [textwrap.fill(p.replace("\n", " "), 120, break_long_words=False, break_on_hyphens=False)
                  if p.startswith("Made by") else p for p in text.rstrip("\n").split("\n\n")]
    return "\n\n".join(paragraphs) + "\n"


here = pathlib.Path(__file__).parent
run = read("suite/static", "experiment.json")
residual = max(r["residual_rmse"] for name in ORDER for r in read(f"suite/{name}", "experiment.json")["references"])
of_run = {
    "commit": run["commit"], "cpu": run["machine"]["cpu"], "threads": str(run["machine"]["threads"]), "os": run["machine"]["os"],
    "gl": run["gl"]["renderer"] + ", " + run["gl"]["version"], "residual": number(residual, 2),
}
(here / "counted.md").write_text(fill("counted_text.md", of_run | {
    "counted": counted_table, "beside": beside_table, "paths": path_table}))
(here / "results.md").write_text(fill("results_text.md", of_run | {
    "suite": suite_table, "lambda": lambda_table, "competitors": competitor_table, "moving": moving_table,
    "options": option_table, "signals": signal_table, "sweep": sweep_table}))
