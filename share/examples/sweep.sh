#!/usr/bin/env bash
# Drives a sweep from bash: which number of planes suits a room best?
#   share/examples/sweep.sh [FOLDER]     FOLDER: the sweep's folder (default: runs/example)
# ATRIUM names the program (default: build/bin/atrium). A variant that fails is reported and left out.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
atrium=${ATRIUM:-$root/build/bin/atrium}
folder=${1:-runs/example}
mkdir -p "$(dirname "$folder")"

# 1. What to vary. Paths are meant from the file that they stand in.
temporary=$(mktemp -d)
trap 'rm -r "$temporary"' EXIT
file=$temporary/example.yaml
cat >"$file" <<EOF
atrium: 1
sweep: "$root/pipelines/ablations/base.yaml"
set: {paper/objects.type: object.none}
scenes: {room: {scene.pipeline: "$root/pipelines/comparisons/scenes/room.yaml", scene.points: 60000}}
grid: {paper/planes.max_planes: [1, 8, 70]}
metrics:
  completeness: {of: quality.structure.b50mm.completeness, unit: "%"}
  triangles: faces.faces.triangles
EOF

# 2. Run it. What is done in the folder is not done again. 0: all is well; 4: some variants failed; else there is nothing to read.
code=0
"$atrium" sweep run "$file" --out "$folder" --quiet >/dev/null || code=$?
case $code in
  0) ;;
  4) echo "some variants failed:" >&2
     awk -F, 'NR > 1 && $NF != "ok"' "$folder/table.csv" >&2 ;;
  *) echo "the sweep failed (exit code $code)" >&2; exit "$code" ;;
esac

# 3. Read the table (no name here has a comma in it): id, scene, max_planes, completeness, triangles, status.
awk -F, 'NR > 1 && $NF == "ok" && (best == "" || $4 > most) { best = $1; most = $4; planes = $3; triangles = $5 }
         END { if (best == "") exit 1
               printf "best: %s planes, completeness %.1f %%, %d triangles (variants/%s)\n", planes, most, triangles, best }' \
  "$folder/table.csv"
