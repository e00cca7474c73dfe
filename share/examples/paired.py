#!/usr/bin/env python3
"""Differences of a sweep's metrics from one choice, seed by seed (standard library only).

    share/examples/paired.py FOLDER COLUMN REFERENCE [METRIC...]

for instance: share/examples/paired.py runs/th_sep paper.th_sep "50 cm" "completeness [%]"

Each number is the mean over the seeds of (variant - reference with the same seed and the same choices of everything else that the
sweep varies), with the standard deviation of these differences: what the seeds have in common drops out. Without METRIC: all
columns that hold numbers.
"""
import csv
import json
import pathlib
import statistics
import sys


def number(text):
    try:
        return float(text)
    except ValueError:
        return None


def is_numeric(rows, name):
    filled = [row[name] for row in rows if row[name]]
    return bool(filled) and all(number(text) is not None for text in filled)


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    folder, column, reference = pathlib.Path(sys.argv[1]), *sys.argv[2:4]
    with open(folder / "table.csv", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["status"] == "ok"]
    if not rows:
        sys.exit("no variant is done")
    with open(folder / "sweep.json") as file:
        sweep = json.load(file)
    axes = [axis["name"] for axis in sweep["axes"]]
    if column not in axes:
        sys.exit(f"the sweep does not vary '{column}'; it varies: {', '.join(axes)}")
    # The table shows what random samples drew, too.
    varied = set(axes).union(*(choice["set"] for axis in sweep["axes"] for choice in axis["choices"]))
    others = [axis for axis in axes if axis != column]
    shown = [axis for axis in others if axis != "seed" and len({row[axis] for row in rows}) > 1]
    numeric = [name for name in rows[0] if name not in varied | {"id", "status"} and is_numeric(rows, name)]
    metrics = sys.argv[4:] or numeric
    for metric in metrics:
        if metric not in numeric:
            sys.exit(f"no metric '{metric}' that is a number; there are: {', '.join(numeric)}")

    def place(row):
        return tuple(row[axis] for axis in others)

    references = {place(row): row for row in rows if row[column] == reference}
    if not references:
        sys.exit(f"no variant has {column} = {reference}")
    groups = {}
    for row in rows:
        if place(row) in references and row[column] != reference:
            key = (*(row[axis] for axis in shown), row[column])
            groups.setdefault(key, []).append((row, references[place(row)]))
    print("| " + " | ".join([*shown, column, *metrics]) + " |")
    print("|" + " --- |" * (len(shown) + 1) + " --: |" * len(metrics))
    for key, pairs in groups.items():
        cells = []
        for metric in metrics:
            differences = [number(a[metric]) - number(b[metric]) for a, b in pairs if a[metric] and b[metric]]
            spread = f" ± {statistics.stdev(differences):.2f}" if len(differences) > 1 else ""
            cells.append(f"{statistics.mean(differences):+.2f}{spread}" if differences else "–")
        print("| " + " | ".join([*key, *cells]) + " |")


if __name__ == "__main__":
    main()
