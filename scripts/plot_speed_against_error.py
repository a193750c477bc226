#!/usr/bin/python3
"""Draws what speed_against_error --csv wrote: error against cost, one panel a scene, readable without colours.

usage: plot_speed_against_error.py RESULTS.csv PICTURE.png [SCENE...]     only these scenes, by default all
"""

import collections
import csv
import math
import sys

import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt

# Markers and shades differ, so that a black and white print tells the engines apart.
STYLES = {
    'block_world': dict(marker='*', color='black', markersize=11),
    'Box2D': dict(marker='s', color='0.45', markersize=5),
    'Chipmunk': dict(marker='^', color='0.30', markersize=6),
    'Bullet': dict(marker='o', color='0.60', markersize=5),
    'ODE': dict(marker='D', color='0.20', markersize=4),
}
FLOOR = 1e-17  # what no error at all is drawn at; of what is counted a tenth


def floor(unit):
    return 0.1 if unit == 'hits' else FLOOR


def read(path):
    """Per scene, its first measure with its unit, and per engine the points (cost in us, error, is_default)."""
    scenes = collections.OrderedDict()
    with open(path, newline='') as file:
        for row in csv.DictReader(file):
            scene = scenes.setdefault(row['scene'], (row['error_name'], row['unit'], collections.OrderedDict()))
            points = scene[2].setdefault(row['engine'], [])
            if row['error_name'] != scene[0] or row['error'].startswith('n/a'):
                continue
            error = float(row['error'])
            if math.isfinite(error):
                points.append((1e6 * float(row['cpu_s_per_simulated_s']), max(error, floor(row['unit'])),
                               row['setting'].endswith('(default)')))
    return scenes


def draw(axes, name, scene):
    error_name, unit, engines = scene
    for engine, points in engines.items():
        for is_default in (False, True):
            chosen = [point for point in points if point[2] == is_default]
            axes.loglog([point[0] for point in chosen], [point[1] for point in chosen], linestyle='none',
                        markerfacecolor=STYLES[engine]['color'] if is_default else 'none', **STYLES[engine])
    axes.set_title(name, fontsize=9)
    axes.set_ylabel(f'{error_name}, {unit}', fontsize=7)
    axes.tick_params(labelsize=7)
    axes.set_ylim(bottom=floor(unit) / 3)
    axes.grid(True, which='major', color='0.9')


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__.strip())
    scenes = read(sys.argv[1])
    wanted = sys.argv[3:] or list(scenes)
    unknown = [name for name in wanted if name not in scenes]
    if unknown:
        sys.exit(f'plot_speed_against_error.py: {sys.argv[1]} has no scene {unknown[0]!r}; it has: ' + ', '.join(scenes))
    columns = min(4, len(wanted))
    rows = math.ceil(len(wanted) / columns)
    figure, panels = plt.subplots(rows, columns, figsize=(3.2 * columns, 2.5 * rows + 0.6), squeeze=False)
    panels = panels.flatten()
    for axes, name in zip(panels, wanted):
        draw(axes, name, scenes[name])
    for axes in panels[len(wanted):]:
        axes.set_visible(False)
    for axes in panels[max(0, len(wanted) - columns):len(wanted)]:
        axes.set_xlabel('CPU time per simulated second, µs', fontsize=7)
    engines = list(next(iter(scenes.values()))[2])
    handles = [plt.Line2D([], [], linestyle='none', label=engine, **STYLES[engine]) for engine in engines]
    figure.legend(handles=handles, ncol=len(engines), loc='upper center', fontsize=9, frameon=False,
                  title='filled: as shipped; open: other settings; no error at all: on the lowest line', title_fontsize=8)
    figure.tight_layout(rect=(0, 0, 1, 1 - 0.7 / figure.get_figheight()))
    figure.savefig(sys.argv[2], dpi=110)


if __name__ == '__main__':
    main()
