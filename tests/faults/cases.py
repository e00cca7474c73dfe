"""What tests/faults/run runs: small pipelines and sweeps, their inputs, and what they must write."""
import collections, os, pathlib, random, re, shutil, struct, subprocess

SOURCE = pathlib.Path(__file__).resolve().parents[2]
# Of the files that a run leaves these tell of times, places or processes.
UNSTABLE = {"manifest.json", "trace.json", "resolved.yaml", "written", "result.json", "variant.json", "sweep.json", "worker.log",
            "table.csv", "table.json", "table.txt", "table.md"}

CLOUD = """atrium: 1
vars: {scan: , voxel: 10 cm}
nodes:
  scan: {type: io.read_scan, params: {path: "${scan}"}}
  thin: {type: filter.voxel_grid, in: {cloud: scan.cloud}, params: {size: "${voxel}"}}
  sparse: {type: filter.voxel_grid, in: {cloud: thin.cloud}, params: {size: 30 cm}}
  a: {type: io.write_cloud, in: {cloud: thin.cloud}, params: {path: thin.ply}}
  b: {type: io.write_cloud, in: {cloud: sparse.cloud}, params: {path: text/sparse.csv}}
  c: {type: io.write_cloud, in: {cloud: sparse.cloud}, params: {path: sparse.pcd, binary: false}}
  d: {type: io.write_cloud, in: {cloud: thin.cloud}, params: {path: thin.las}}
outputs: {cloud: thin.cloud}
"""
SWEEP = """atrium: 1
sweep: cloud.yaml
grid: {voxel: [10 cm, 12 cm, 15 cm]}
"""


def box_points(seed, count):
    """Points on the walls, the floor and the ceiling of two rooms with a door between them."""
    draw = random.Random(seed)
    points = []
    while len(points) < count:
        x, y, z = draw.random() * 7, draw.random() * 4, draw.random() * 2.6
        at = [x, y, z]
        face = draw.randrange(7)
        if face < 6:
            at[face // 2] = (0, 7, 0, 4, 0, 2.6)[face]
        else:
            at[0] = draw.choice((3.94, 4.06))
            if 1 < y < 1.9 and z < 2.05:
                continue
        points.append([c + draw.gauss(0, 0.003) for c in at])
    return points


def write_ply(points, file):
    with open(file, "wb") as out:
        out.write(b"ply\nformat binary_little_endian 1.0\nelement vertex %d\n" % len(points))
        out.write(b"property double x\nproperty double y\nproperty double z\nend_header\n")
        for point in points:
            out.write(struct.pack("<3d", *point))


def write_inputs(folder):
    """scan-0.ply and scan-1.ply have the same size and other points; scan.xyz is the first as text."""
    for seed in (0, 1):
        points = box_points(seed, 20000)
        write_ply(points, folder / f"scan-{seed}.ply")
        if seed == 0:
            (folder / "scan.xyz").write_text("".join("%.4f %.4f %.4f\n" % tuple(p) for p in points))
    shutil.copy(folder / "scan-0.ply", folder / "scan.ply")
    (folder / "cloud.yaml").write_text(CLOUD)
    (folder / "sweep.yaml").write_text(SWEEP)
    shutil.copy(SOURCE / "pipelines/atrium.yaml", folder / "model.yaml")


class Case:
    """A command that leaves files. `{in}`, `{out}` and `{cache}` in its words stand for folders."""

    def __init__(self, name, words, cached=False, warm=False, every=True):
        self.name, self.words, self.cached, self.warm, self.every = name, words.split(), cached, warm, every
        self.files, self.printed, self.counts, self.seconds, self.before = {}, "", {}, 0.0, None

    def command(self, program, inputs, folder):
        use = ["--cache", str(folder / "cache")] if self.cached else ["--no-cache"]
        words = [w.replace("{in}", str(inputs)) for w in self.words]
        return [program, *words, "--out", str(folder / "out"), *use]

    def begin(self, folder):
        """An empty folder, or one with what an earlier run and its cache have left."""
        shutil.rmtree(folder, ignore_errors=True)
        if self.before is None:
            folder.mkdir(parents=True)
        else:
            shutil.copytree(self.before, folder, symlinks=True)


def cases():
    return [
        Case("cloud", "run {in}/cloud.yaml -s scan={in}/scan.xyz -j 2"),
        Case("cold", "run {in}/cloud.yaml -s scan={in}/scan.ply -j 2", cached=True),
        Case("warm", "run {in}/cloud.yaml -s scan={in}/scan.ply -j 2", cached=True, warm=True),
        Case("model", "run {in}/model.yaml -s scan={in}/scan.ply -j 2", cached=True, every=False),
        Case("sweep", "sweep run {in}/sweep.yaml -s scan={in}/scan.ply -j 2", cached=True, every=False),
        Case("isolated", "sweep run {in}/sweep.yaml -s scan={in}/scan.ply -j 2 --isolate", cached=True, every=False),
    ]


def written(out):
    """The files of a run or a sweep that are the same each time, with their bytes."""
    files = {}
    for root, folders, names in os.walk(out):
        folders[:] = [f for f in folders if f not in ("by_label", "farm")]
        for name in names:
            path = pathlib.Path(root) / name
            if name not in UNSTABLE and not name.startswith("."):
                files[str(path.relative_to(out))] = path.read_bytes()
    return files


def unfinished(out):
    """What writers leave that are ended in the midst of a file."""
    return [str(p) for p in pathlib.Path(out).rglob(".*.part")]


Ended = collections.namedtuple("Ended", "code said printed")  # code: -N if signal N ended it, None if it hangs


def run(command, environment=None, timeout=60):
    """How the command ended, with what it wrote to stderr (said) and stdout (printed)."""
    whole = {**os.environ, "ATRIUM_CACHE": "off", **(environment or {})}
    process = subprocess.Popen(command, env=whole, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    hangs = False
    try:
        printed, said = process.communicate(timeout=timeout)
    except subprocess.TimeoutExpired:
        process.kill()
        hangs = True
        printed, said = process.communicate()
    table = re.sub(r" +", " ", re.sub(r"\d+\.\d+(e-\d+)?", "#", printed.decode(errors="replace")))  # times, and what aligns them
    return Ended(None if hangs else process.returncode, said.decode(errors="replace"), table)
