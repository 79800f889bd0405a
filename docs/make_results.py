#!/usr/bin/python3
"""Prints docs/results.md from the runs that docs/make_results.sh has made. Every number comes from their files."""

import json
import pathlib
import sys

root = pathlib.Path(sys.argv[1])


def read(run, name):
    return json.loads((root / run / name).read_text())


def variants(run):
    return read(run, "summary.json")["variants"]


def number(value, digits=3):
    if value is None:
        return "–"
    if isinstance(value, int):
        return str(value)
    return f"{value:.{digits}g}" if abs(value) >= 1e-6 or value == 0 else "0"


def fixed(value, places=2):
    return "–" if value is None else f"{value:.{places}f}"


def frames(summary, key):
    """A time in frames: never, or not there at all."""
    area = "lag_frames" if key.startswith("lag_") else "ghost_frames"
    if summary.get(key) is not None:
        return str(summary[key])
    return "never" if summary.get(area) is not None else "–"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


ORDER = ["static", "light-off", "light-on", "light-dim", "fill-light", "sparse-light", "light-color", "flicker",
         "light-move", "object-move", "unrelated-light", "camera-pan", "camera-cut"]


def suite_table():
    rows = []
    for name in ORDER:
        timing = read(f"suite/{name}", "timing.json")["variants"]
        for i, (variant, s) in enumerate(variants(f"suite/{name}").items()):
            rows.append([f"`{name}`" if i == 0 else "", variant] + [frames(s, k) for k in ("t50", "t90", "t99", "lag_t90")] +
                        [fixed(s.get("ghost_frames")), fixed(s.get("lag_frames")), number(s["rmse_settled"]), number(s["flip_settled"]),
                         number(s["flicker"], 2), number(s.get("noise_after_event")), number(s.get("rmse_moving")),
                         number(s.get("recovery_frames")), number(timing[variant]["ms_per_frame"])])
    return table(["experiment", "filter", "t50", "t90", "t99", "lag t90", "ghost frames", "lag frames", "RMSE", "FLIP", "flicker", "noise after",
                  "RMSE moving", "recovery", "ms"], rows)


def lambda_table():
    rows = []
    for name in ORDER:
        s = variants(f"suite/{name}")["asvgf"]
        rows.append([f"`{name}`", number(s.get("lambda_ideal_mean")), number(s.get("lambda_mean")), number(s.get("lambda_rmse")),
                     number(s.get("lambda_precision")), number(s.get("lambda_recall")), number(s.get("lambda_false"), 2)])
    return table(["experiment", "mean lambda*", "mean lambda", "RMSE", "precision", "recall", "false"], rows)


def competitor_table():
    rows = []
    for name in ["light-off", "light-on", "light-dim", "fill-light", "sparse-light", "light-color"]:
        for i, (variant, s) in enumerate(variants(f"competitors/{name}").items()):
            rows.append([f"`{name}`" if i == 0 else "", variant, frames(s, "t90"), frames(s, "lag_t90"), fixed(s["ghost_frames"]),
                         fixed(s["lag_frames"]), number(s["rmse_settled"]), number(s["flicker"], 2), number(s["noise_after_event"])])
    return table(["experiment", "filter", "t90", "lag t90", "ghost frames", "lag frames", "RMSE", "flicker", "noise after"], rows)


def moving_table():
    rows = []
    for name in ["light-move", "object-move"]:
        for i, (variant, s) in enumerate(variants(f"competitors/{name}").items()):
            rows.append([f"`{name}`" if i == 0 else "", variant, number(s["rmse_moving"]), number(s["trail_response"]),
                         number(s["ghost_energy"]), number(s["recovery_frames"]), number(s["rmse_settled"])])
    return table(["experiment", "filter", "RMSE moving", "trail response", "ghost energy", "recovery", "RMSE settled"], rows)


def option_table():
    names = ["fill-light", "light-dim", "light-on"]
    runs = {name: variants(f"options/{name}") for name in names}
    rows = []
    for variant in runs[names[0]]:
        row = [f"`{variant}`"]
        for name in names:
            s = runs[name][variant]
            row += [frames(s, "lag_t90"), fixed(s["lag_frames"]), number(s["noise_after_event"])]
        s = runs["fill-light"][variant]
        rows.append(row + [number(s["rmse_settled"], 4), number(s["flicker"], 3), number(s["lambda_false"], 2)])
    head = ["option"]
    for name in names:
        head += [f"{name}: lag t90", "lag frames", "noise after"]
    return table(head + ["RMSE", "flicker", "false"], rows)


def signal_table():
    rows = []
    for name in ["light-off", "light-dim", "fill-light", "sparse-light"]:
        for i, signal in enumerate(["both", "separate"]):
            for variant, s in variants(f"signals/{signal}/{name}").items():
                rows.append([f"`{name}`" if i == 0 and variant == "svgf" else "", signal, variant, frames(s, "lag_t90"), fixed(s["lag_frames"]),
                             number(s["rmse_settled"]), number(s["flip_settled"]), number(s["flicker"], 2)])
    return table(["experiment", "signal", "filter", "lag t90", "lag frames", "RMSE", "FLIP", "flicker"], rows)


def sweep_table():
    points = {}
    for s in variants("sweep").values():
        points.setdefault(s["sweep"]["value"], {})[s["sweep"]["variant"]] = s
    filters = list(next(iter(points.values())))
    rows = [[value] + [cell for f in filters for cell in (number(by[f]["rmse_settled"]), number(by[f]["flicker"], 2), frames(by[f], "lag_t90"), fixed(by[f]["lag_frames"]))]
            for value, by in points.items()]
    return table(["alpha"] + [f"{f}: {c}" if c == "RMSE" else c for f in filters for c in ("RMSE", "flicker", "lag t90", "lag frames")], rows)


run = read("suite/static", "experiment.json")
residual = max(r["residual_rmse"] for name in ORDER for r in read(f"suite/{name}", "experiment.json")["references"])
text = pathlib.Path(__file__).with_name("results_text.md").read_text()
for key, value in {
    "commit": run["commit"], "cpu": run["machine"]["cpu"], "threads": str(run["machine"]["threads"]), "os": run["machine"]["os"],
    "gl": run["gl"]["renderer"] + ", " + run["gl"]["version"], "residual": number(residual, 2),
    "suite": suite_table(), "lambda": lambda_table(), "competitors": competitor_table(), "moving": moving_table(), "options": option_table(), "signals": signal_table(), "sweep": sweep_table(),
}.items():
    text = text.replace("{{" + key + "}}", value)
assert "{{" not in text, "a table is missing: " + text[text.index("{{"):][:40]
sys.stdout.write(text)
