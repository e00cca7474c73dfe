"""Kills cached runs and sweeps at random times. Parameters and the scan change between them, the cache stays: nothing stale or damaged
may come out of it."""
import collections, os, pathlib, random, shutil, signal, subprocess, time

import cases

VOXELS = ["10 cm", "11 cm", "12 cm", "15 cm", "20 cm"]
RUNS_PER_CACHE = 40  # then the cache is checked, and the next begins empty
MOST_KILLS = 3  # one after the other, before a run that is left alone


class Lane:
    """One cache, one folder of runs, one scan that is replaced by another of the same size now and then."""

    def __init__(self, program, folder, draw, references):
        self.program, self.folder, self.draw, self.references = program, folder, draw, references
        self.seconds = collections.defaultdict(lambda: 1.0)  # of each kind of run
        folder.mkdir()
        shutil.copytree(folder.parent / "in", folder / "in")

    def choose(self):
        kind = self.draw.choices(["run", "sweep", "isolated"], [6, 2, 2])[0]
        scan, voxel = self.draw.randrange(2), self.draw.choice(VOXELS)
        shutil.copy(self.folder / "in" / f"scan-{scan}.ply", self.folder / "in" / "scan.ply")
        return kind, scan, voxel

    def command(self, kind, voxel):
        place = self.folder / "in"
        end = ["-q", "-j", "2", "--out", str(self.folder / kind), "--cache", str(self.folder / "cache"), "-s", f"scan={place}/scan.ply"]
        if kind == "run":
            return [self.program, "run", str(place / "cloud.yaml"), "-s", f"voxel={voxel}", *end]
        return [self.program, "sweep", "run", str(place / "sweep.yaml"), *end, *(["--isolate"] if kind == "isolated" else [])]

    def kill(self, kind, voxel):
        """Whether the run was killed before it ended."""
        process = subprocess.Popen(self.command(kind, voxel), env={**os.environ, "ATRIUM_CACHE": "off"}, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        time.sleep(self.draw.random() * 1.2 * self.seconds[kind])
        victim = process.pid
        if kind == "isolated" and self.draw.random() < 0.5:
            victim = self.draw.choice(descendants(process.pid) or [victim])
        try:
            os.kill(victim, signal.SIGKILL)
        except ProcessLookupError:
            pass
        process.wait()
        return process.returncode != 0

    def complete(self, kind, scan, voxel):
        """What is wrong with a run that is left alone, or nothing."""
        start = time.monotonic()
        end = cases.run(self.command(kind, voxel))
        self.seconds[kind] = 0.7 * self.seconds[kind] + 0.3 * (time.monotonic() - start)
        if end.code != 0:
            return f"the next {kind} ends with {end.code}: {end.said}"
        expected = self.references[("run", scan, voxel) if kind == "run" else ("sweep", scan)]
        files = cases.written(self.folder / kind)
        if files != expected:
            names = sorted(n for n in files.keys() | expected.keys() if files.get(n) != expected.get(n))
            return f"the next {kind} (scan {scan}, voxel {voxel}) gives another {', '.join(names)}"
        if cases.unfinished(self.folder / kind):
            return f"the next {kind} leaves {cases.unfinished(self.folder / kind)}"
        return None

    def check_cache(self):
        end = cases.run([self.program, "cache", "verify", "--cache", str(self.folder / "cache")])
        shutil.rmtree(self.folder / "cache")
        for kind in ("run", "sweep", "isolated"):
            shutil.rmtree(self.folder / kind, ignore_errors=True)
        return None if end.code == 0 else f"cache verify ends with {end.code}: {end.printed}{end.said}"


def descendants(process):
    """Processes that it has started, and those that they have."""
    try:
        children = pathlib.Path(f"/proc/{process}/task/{process}/children").read_text().split()
    except OSError:
        return []
    return [d for child in children for d in [int(child), *descendants(int(child))]]


def make_references(program, folder):
    references = {}
    for scan in (0, 1):
        place = folder / "in"
        shutil.copy(place / f"scan-{scan}.ply", place / "scan.ply")
        for voxel in [*VOXELS, None]:
            out = folder / "reference"
            words = ["run", str(place / "cloud.yaml"), "-s", f"voxel={voxel}"] if voxel else ["sweep", "run", str(place / "sweep.yaml")]
            end = cases.run([program, *words, "--out", str(out), "--no-cache", "-s", f"scan={place}/scan.ply"])
            if end.code != 0:
                raise SystemExit(f"faults: a run that nobody kills fails: {end.said}")
            references[("run", scan, voxel) if voxel else ("sweep", scan)] = cases.written(out)
            shutil.rmtree(out)
    return references


def kill_at_random(program, seconds, seed, folder):
    draw = random.Random(seed)
    (folder / "in").mkdir()
    cases.write_inputs(folder / "in")
    references = make_references(program, folder)
    lane = Lane(program, folder / "lane", draw, references)
    end = time.monotonic() + seconds
    tally, findings, runs = collections.Counter(), [], 0
    while time.monotonic() < end:
        choice = lane.choose()
        for _ in range(draw.randint(1, MOST_KILLS)):
            tally["killed " + choice[0] if lane.kill(choice[0], choice[2]) else "ended before"] += 1
            if draw.random() < 0.3:
                choice = lane.choose()
        problem = lane.complete(*choice)
        runs += 1
        if problem is None and runs % RUNS_PER_CACHE == 0:
            problem = lane.check_cache()
        if problem:
            findings.append(problem)
            print(f"faults: FOUND after {sum(tally.values())} kills: {problem}", flush=True)
            shutil.copytree(lane.folder, f"{folder}-finding-{len(findings)}")
            if len(findings) == 10:
                break
        if runs % 100 == 0:
            print(f"faults: {dict(tally)}, {runs} runs after them, {len(findings)} findings", flush=True)
    killed = sum(n for what, n in tally.items() if what.startswith("killed"))
    print(f"faults: seed {seed}: {killed} kills ({', '.join(f'{w} {n}' for w, n in sorted(tally.items()))}), "
          f"{runs} runs after them, {len(findings)} findings")
    return 1 if findings else 0
