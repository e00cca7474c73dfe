#!/usr/bin/env python3
"""Runs a pipeline on scans as they are and disturbed, to see what is right by luck (standard library only).

    share/examples/disturbed_scans.py ATRIUM PIPELINE EXPECTED.tsv [VARIANT...]

for instance: share/examples/disturbed_scans.py build/bin/atrium pipelines/atrium.yaml ../shared/scans/expected.tsv

Each scan is read as points alone and made into the variants: plain, turned (by 37 degrees about z, 2 about x, and moved), third (of
the points), noisy (1 cm more on each axis), mirrored (and turned by 71 degrees), strays (1 % of points anywhere up to 2 m around it) and
dense (each point three times, 4 mm apart). A line of EXPECTED.tsv: file, anything, number of rooms (or LOW-HIGH; 0: the run is to
end with exit code 1), area and height of the largest room (LOW-HIGH), anything. Exit code 1 if anything is wrong.
"""
import array
import csv
import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile

TO_POINTS = """atrium: 1
summary: A scan as points in text.
seed: 1
vars: {scan: }
nodes:
  scan: {type: io.read_scan, params: {path: "${scan}", spacing: 3 cm}}
  points: {type: io.write_cloud, in: {cloud: scan.cloud}, params: {path: points.csv}}
"""


def about_z(points, degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return [(c * x - s * y, s * x + c * y, z) for x, y, z in points]


def about_x(points, degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return [(x, c * y - s * z, s * y + c * z) for x, y, z in points]


def jittered(points, deviation, dice):
    return [tuple(v + dice.gauss(0, deviation) for v in p) for p in points]


def with_strays(points, dice):
    low, high = [min(p[k] for p in points) - 2 for k in range(3)], [max(p[k] for p in points) + 2 for k in range(3)]
    return points + [tuple(dice.uniform(low[k], high[k]) for k in range(3)) for _ in range(len(points) // 100)]


VARIANTS = {
    'plain': lambda points, dice: points,
    'turned': lambda points, dice: [(x + 100, y - 50, z + 3) for x, y, z in about_x(about_z(points, 37), 2)],
    'third': lambda points, dice: [p for p in points if dice.random() < 1 / 3],
    'noisy': lambda points, dice: jittered(points, 0.01, dice),
    'mirrored': lambda points, dice: about_z([(-x, y, z) for x, y, z in points], 71),
    'strays': with_strays,
    'dense': lambda points, dice: [p for _ in range(3) for p in jittered(points, 0.004, dice)],
}


def write_ply(points, path):
    values = array.array('d', (v for p in points for v in p))
    if sys.byteorder == 'big':
        values.byteswap()
    with open(path, 'wb') as file:
        file.write(f'ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty double x\n'
                   'property double y\nproperty double z\nend_header\n'.encode())
        values.tofile(file)


def run(atrium, pipeline, scan, folder):
    return subprocess.run([atrium, 'run', pipeline, '-s', f'scan={scan}', '--no-cache', '--out', folder],
                          capture_output=True, text=True)


def points_of(atrium, scan, folder):
    pipeline = folder / 'points.yaml'
    pipeline.write_text(TO_POINTS)
    done = run(atrium, pipeline, scan, folder / 'points')
    if done.returncode:
        sys.exit(f'{scan}: {done.stderr}')
    with open(folder / 'points/points.csv', newline='') as file:
        return [tuple(map(float, row[:3])) for row in list(csv.reader(file))[1:]]


def bounds(text):
    low, _, high = text.partition('-')
    return float(low), float(high or low)


def verdict(done, folder, rooms, area, height):
    """Whether it is right, and what was found."""
    if done.returncode:
        return rooms == '0' and done.returncode == 1, f'exit {done.returncode}'
    building = json.loads((folder / 'building.json').read_text())
    largest = max(building['rooms'], key=lambda room: room['area'])
    found = [(len(building['rooms']), rooms), (largest['area'], area), (largest['height'], height)]
    right = rooms != '0' and all(bounds(want)[0] <= value <= bounds(want)[1] for value, want in found)
    return right, (f'{len(building["rooms"])} rooms, {largest["area"]:.1f} m2 ({area}), {largest["height"]:.2f} m ({height}), '
                   f'confidence {building["confidence"]:.2f}')


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    atrium, pipeline, expected = sys.argv[1:4]
    variants = sys.argv[4:] or list(VARIANTS)
    os.environ['ATRIUM_CACHE'] = 'off'
    right = {variant: 0 for variant in variants}
    lines = [line.rstrip('\n').split('\t') for line in open(expected) if not line.startswith('#')]
    for scan, _, rooms, area, height, *_ in lines:
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            points = points_of(atrium, pathlib.Path(expected).parent / scan, folder)
            for variant in variants:
                write_ply(VARIANTS[variant](points, random.Random(5)), folder / 'scan.ply')
                done = run(atrium, pipeline, folder / 'scan.ply', folder / variant)
                good, found = verdict(done, folder / variant, rooms, area, height)
                right[variant] += good
                print(f'{"ok" if good else "wrong":5} {scan:32} {variant:8} {found}', flush=True)
    print('right: ' + ', '.join(f'{variant} {right[variant]}' for variant in variants) +
          f': {sum(right.values())} of {len(lines) * len(variants)}')
    sys.exit(sum(right.values()) < len(lines) * len(variants))


if __name__ == '__main__':
    main()
