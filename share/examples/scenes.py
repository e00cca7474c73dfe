#!/usr/bin/env python3
"""A table (Markdown) of the simulated scenes through atrium.yaml, a row each (standard library only).

    share/examples/scenes.py ATRIUM [-s SETTING]... [--out FOLDER] [SCENE...]

for instance: share/examples/scenes.py build/bin/atrium -s scene/scan.sensors=true split_level old_flat

Without SCENE: all of pipelines/comparisons/scenes that are simulated. Settings go to every run. Rooms: found, of them those
that share more than half of their plan with a true room on their level, and true ones. Completeness and correctness are within
5 cm. The area's error is the largest of a matched room, beside its true area. Doors and windows: right (half of the joint area is
common), found, true. What atrium refuses has its error instead.
Exit code 1 if a scene lacks rooms or has too many.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import time


def area(ring):
    return abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:] + ring[:1]))) / 2


def inside(ring, x, y):
    found = False
    for (ax, ay), (bx, by) in zip(ring, ring[1:] + ring[:1]):
        if (ay > y) != (by > y) and x < (bx - ax) * (y - ay) / (by - ay) + ax:
            found = not found
    return found


def cells(ring, step=0.1):
    """Squares of a common raster whose middle is in the ring."""
    low = [min(p[k] for p in ring) for k in (0, 1)]
    high = [max(p[k] for p in ring) for k in (0, 1)]
    ranges = [range(math.floor(a / step), math.ceil(b / step)) for a, b in zip(low, high)]
    return {(i, k) for i in ranges[0] for k in ranges[1] if inside(ring, (i + 0.5) * step, (k + 0.5) * step)}


def true_rooms(path):
    truth = json.loads(path.read_text())
    rooms = []
    for index, room in enumerate(truth['rooms']):
        ring = [p[:2] for p in room['outline']]
        level = room['outline'][0][2]
        holes = sum(area([p[:2] for p in hole]) for face in truth['faces']
                    if face['room'] == index and face['class'] == 'floor' and abs(face['outline'][0][2] - level) < 0.05
                    for hole in face.get('holes', []))
        rooms.append((cells(ring), area(ring) - holes, level))
    return rooms


def found_rooms(path):
    building = json.loads(path.read_text())
    return [(cells([p[:2] for p in room['outline']]), room['area'], room['outline'][0][2]) for room in building['rooms']]


def largest_error(true, found):
    """(error, true area) of the matched room whose area is furthest off."""
    pairs = sorted(((len(a[0] & b[0]) / max(1, len(a[0] | b[0])), i, k) for i, a in enumerate(true)
                    for k, b in enumerate(found) if abs(a[2] - b[2]) < 1), reverse=True)
    left, right, worst = set(), set(), (0, 0)
    for share, i, k in pairs:
        if share <= 0.5 or i in left or k in right:
            continue
        left.add(i)
        right.add(k)
        error = found[k][1] - true[i][1]
        if abs(error) > abs(worst[0]):
            worst = (error, true[i][1])
    return len(left), worst


def rectangles(openings, key, kinds):
    return [opening[key] for opening in openings if opening['kind'] in kinds]


def overlap(found, true):
    """Intersection over union of two rectangles in walls, seen on the wall of the true one; 0 if they are 0.5 m apart across it."""
    feet = sorted(true, key=lambda p: p[2])[:2]
    length = math.dist(feet[0][:2], feet[1][:2]) or 1
    along = [(feet[1][k] - feet[0][k]) / length for k in (0, 1)]
    spans = []
    for ring in (found, true):
        at = [(p[0] - feet[0][0]) * along[0] + (p[1] - feet[0][1]) * along[1] for p in ring]
        off = [(p[1] - feet[0][1]) * along[0] - (p[0] - feet[0][0]) * along[1] for p in ring]
        spans.append((min(at), max(at), min(p[2] for p in ring), max(p[2] for p in ring), sum(off) / len(off)))
    a, b = spans
    if abs(a[4] - b[4]) > 0.5:
        return 0
    common = max(0, min(a[1], b[1]) - max(a[0], b[0])) * max(0, min(a[3], b[3]) - max(a[2], b[2]))
    union = sum((s[1] - s[0]) * (s[3] - s[2]) for s in spans) - common
    return common / union if union > 0 else 0


def openings(out, kinds):
    """"right / found / true": right ones share half of their joint area with a true one."""
    true = rectangles(json.loads((out / 'truth.json').read_text())['openings'], 'outline', kinds)
    found = rectangles(json.loads((out / 'model/building.json').read_text())['openings'], 'outline_a', kinds)
    left, right = list(true), 0
    for ring in found:
        best = max(left, key=lambda t: overlap(ring, t), default=None)
        if best is not None and overlap(ring, best) >= 0.5:
            left.remove(best)
            right += 1
    return '%d / %d / %d' % (right, len(found), len(true))


def run(atrium, pipeline, scene, settings, out):
    swap = 'scene.pipeline=%s' % (pipeline.parent / 'scenes' / (scene + '.yaml'))
    command = [atrium, 'run', str(pipeline), '-s', swap, '--out', str(out), '--quiet']
    for setting in settings:
        command += ['-s', setting]
    begin = time.time()
    result = subprocess.run(command, capture_output=True, text=True)
    return result, time.time() - begin


def row(result, seconds, out):
    """The row's cells, and whether each true room is found and no other."""
    manifest = out / 'manifest.json'
    nodes = json.loads(manifest.read_text())['nodes'] if manifest.exists() else []
    warnings = sum(len(node.get('warnings', [])) for node in nodes if node['node'].startswith('model/'))
    if result.returncode:
        lines = [line for line in result.stderr.splitlines() if 'error' in line]
        said = lines[-1].replace('|', '/') if lines else 'exit code %d' % result.returncode
        return ['refused'] + ['–'] * 6 + [str(warnings), '%.1f' % seconds, said], False
    metrics = json.loads((out / 'metrics.json').read_text())

    def percent(name):
        entry = metrics
        for key in name.split('.'):
            entry = entry.get(key, {})
        return '%.1f' % (100 * entry.get('value', math.nan))

    true, found = true_rooms(out / 'truth.json'), found_rooms(out / 'model/building.json')
    confidence = json.loads((out / 'model/building.json').read_text()).get('confidence', math.nan)
    matched, (error, of) = largest_error(true, found)
    worst = '%+.2f of %.1f' % (error, of) if of else '–'
    return ['%d (%d) / %d' % (len(found), matched, len(true)), percent('structure.b50mm.completeness'),
            percent('structure.b50mm.correctness'), worst, openings(out, ('door', 'passage')), openings(out, ('window',)),
            '%.2f' % confidence, str(warnings),
            '%.1f' % seconds, ''], len(found) == len(true) == matched


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('atrium')
    parser.add_argument('-s', dest='settings', action='append', default=[])
    parser.add_argument('--out')
    parser.add_argument('scenes', nargs='*')
    options = parser.parse_intermixed_args()
    pipeline = pathlib.Path(__file__).resolve().parents[2] / 'pipelines/comparisons/base_scene.yaml'
    scenes = options.scenes or sorted(path.stem for path in pipeline.parent.glob('scenes/*.yaml')
                                      if 'synth.scan' in path.read_text())
    folder = pathlib.Path(options.out or tempfile.mkdtemp())
    print('| scene | rooms found (right) / true | completeness [%] | correctness [%] | largest error of an area [m2] '
          '| doors | windows | confidence | warnings | time [s] | error |\n'
          '| --- | --: | --: | --: | --: | --: | --: | --: | --: | --: | --- |')
    sound = True
    for scene in scenes:
        result, seconds = run(options.atrium, pipeline, scene, options.settings, folder / scene)
        cells, right = row(result, seconds, folder / scene)
        sound = sound and right
        print('| %s |' % ' | '.join([scene] + cells), flush=True)
    sys.exit(0 if sound else 1)


if __name__ == '__main__':
    main()
