#!/usr/bin/env python3
"""Drives a sweep from Python (standard library only): which number of planes suits a room best?

    share/examples/sweep.py [FOLDER]     FOLDER: the sweep's folder (default: runs/example)

ATRIUM names the program (default: build/bin/atrium). A variant that fails is reported and left out.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
ATRIUM = os.environ.get("ATRIUM", str(ROOT / "build/bin/atrium"))
SOME_FAILED = 4  # exit code of `atrium sweep run`: the others are done


def sweep(folder, description):
    """Runs a sweep and returns its variants: a dict per variant, by the columns of the table."""
    # JSON is YAML: a sweep file can be written by json.dump. Paths are meant from the file that they stand in.
    with tempfile.TemporaryDirectory() as temporary:
        file = pathlib.Path(temporary) / "example.yaml"
        file.write_text(json.dumps(description))
        command = [ATRIUM, "sweep", "run", str(file), "--out", str(folder), "--quiet", "--json"]
        result = subprocess.run(command, stdout=subprocess.PIPE, text=True)
    if result.returncode not in (0, SOME_FAILED):
        sys.exit(f"the sweep failed (exit code {result.returncode})")
    return json.loads(result.stdout)["variants"]


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "runs/example")
    variants = sweep(folder, {
        "atrium": 1,
        "sweep": str(ROOT / "pipelines/ablations/base.yaml"),
        "set": {"paper/objects.type": "object.none"},
        "scenes": {"room": {"scene.pipeline": str(ROOT / "pipelines/comparisons/scenes/room.yaml"), "scene.points": 60000}},
        "grid": {"paper/planes.max_planes": [1, 8, 70]},
        "metrics": {
            "completeness": {"of": "quality.structure.b50mm.completeness", "unit": "%"},
            "triangles": "faces.faces.triangles",
        },
    })
    for variant in variants:
        if variant["status"] != "ok":
            print(f"{variant['paper/planes.max_planes']} planes: {variant['status']}", file=sys.stderr)
    done = [variant for variant in variants if variant["status"] == "ok"]
    if not done:
        sys.exit("no variant is done")
    best = max(done, key=lambda variant: float(variant["completeness [%]"]))
    # All that a variant showed, with its times, is in variants/ID/result.json.
    result = json.loads((folder / "variants" / best["id"] / "result.json").read_text())
    seconds = sum(node["wall_seconds"] for node in result["nodes"])
    print(f"best: {best['paper/planes.max_planes']} planes, completeness {float(best['completeness [%]']):.1f} %, "
          f"{float(best['triangles']):.0f} triangles (variants/{best['id']})")
    print(f"{len(result['nodes'])} nodes, {seconds:.2f} s", file=sys.stderr)


if __name__ == "__main__":
    main()
