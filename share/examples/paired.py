#!/usr/bin/env python3
"""Differences of a sweep's metrics from one choice, seed by seed (standard library only).

    share/examples/paired.py FOLDER COLUMN REFERENCE [METRIC...]

for instance: share/examples/paired.py runs/th_sep paper.th_sep "50 cm" "completeness [%]"

Each number is the mean over the seeds of (variant - reference with the same seed and scene), with the standard deviation of
these differences: what the seeds have in common drops out.
"""
import csv
import pathlib
import statistics
import sys


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    folder, column, reference = sys.argv[1:4]
    with open(pathlib.Path(folder) / "table.csv", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["status"] == "ok"]
    if not rows:
        sys.exit("no variant is done")
    if column not in rows[0]:
        sys.exit(f"no column '{column}'; there are: {', '.join(rows[0])}")
    metrics = sys.argv[4:] or [name for name in rows[0] if name not in ("id", "status", "scene", "seed", column)]
    place = lambda row: (row.get("scene", ""), row.get("seed", ""))
    references = {place(row): row for row in rows if row[column] == reference}
    if not references:
        sys.exit(f"no variant has {column} = {reference}")
    print("| scene | " + column + " | " + " | ".join(metrics) + " |")
    print("| --- | --- |" + " --: |" * len(metrics))
    groups = {}
    for row in rows:
        if place(row) in references:
            groups.setdefault((row.get("scene", ""), row[column]), []).append((row, references[place(row)]))
    for (scene, choice), pairs in groups.items():
        if choice == reference:
            continue
        cells = []
        for metric in metrics:
            differences = [float(a[metric]) - float(b[metric]) for a, b in pairs if a[metric] and b[metric]]
            spread = f" ± {statistics.stdev(differences):.2f}" if len(differences) > 1 else ""
            cells.append(f"{statistics.mean(differences):+.2f}{spread}" if differences else "–")
        print(f"| {scene} | {choice} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
