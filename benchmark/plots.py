#!/usr/bin/env python3
"""Draws what a picture says better than a table.

    plots.py FIGURES OUTAGES FOLDER

FIGURES is what report.py reads: growth with the number of robots is drawn from those of `scale`.
OUTAGES is what wlan_benchmark --plot-data writes: the age of each picture around an outage of the radio.
FOLDER gets scale.png and outage.png; what a file lacks is not drawn.
"""
import argparse
import collections
import csv
import json
import os
import re
import statistics

import matplotlib

matplotlib.use("Agg")  # needs no display
import matplotlib.pyplot as plt  # noqa: E402

OUTAGE = 3.0  # s: long enough to see what each way does
OUTAGE_BEGIN = 2.0  # s, as in the trials
COLORS = {"TCP": "tab:blue", "UDP": "tab:orange", "plain TCP": "tab:gray"}


def pictures_around_outage(path):
    """Times and ages of pictures, by the way they came."""
    ways = collections.defaultdict(lambda: ([], []))
    with open(path, encoding="utf-8") as lines:
        for way, outage, time, age in csv.reader(lines):
            if float(outage) == OUTAGE:
                ways[way][0].append(float(time))
                ways[way][1].append(float(age))
    return ways


def draw_outage(ways, path):
    figure, axes = plt.subplots(figsize=(8, 4))
    axes.axvspan(OUTAGE_BEGIN, OUTAGE_BEGIN + OUTAGE, color="0.9", label="nothing gets through")
    for way in ("plain TCP", "TCP", "UDP"):
        axes.plot(*ways[way], ".", color=COLORS[way], label=way, markersize=4)
    axes.set_yscale("log")
    axes.set_xlabel("time of delivery, s")
    axes.set_ylabel("age of the picture, ms")
    axes.set_title(f"Pictures around an outage of {OUTAGE:g} s, emulated 802.11b at 11 Mbit/s")
    axes.legend(loc="upper right")
    axes.grid(alpha=0.3)
    figure.tight_layout()
    save(figure, path)


def scale_figures(path):
    """Medians of the figures of `scale`, by what is measured and how the drivers run: {robots: median}."""
    title = re.compile(r"(\d+) robots?, ([^:]+): (.+)")
    growth = collections.defaultdict(dict)
    with open(path, encoding="utf-8") as lines:
        for entry in (json.loads(line) for line in lines if line.startswith('{"figure"')):
            match = title.fullmatch(entry["figure"])
            if match:
                robots, kind, what = match.groups()
                growth[what, kind][int(robots)] = statistics.median(entry["rounds"])
    return growth


def draw_scale(growth, path):
    shown = (("processor share of a driver", "processor share of a driver, %"), ("memory of a driver", "its memory, MB"),
             ("pictures a second, fewest of a robot", "pictures a second of a robot, the fewest"))
    figure, all_axes = plt.subplots(1, len(shown), figsize=(12, 4.5))
    for axes, (what, label) in zip(all_axes, shown):
        highest = 0
        for (figure_name, kind), medians in growth.items():
            if figure_name == what:
                robots = sorted(medians)
                axes.plot(robots, [medians[number] for number in robots], "o-", label=kind)
                highest = max(highest, *medians.values())
        axes.set_ylim(0, 1.1 * highest or 1)
        axes.set_xlabel("robots")
        axes.set_title(label, fontsize="medium")
        axes.grid(alpha=0.3)
    lines, labels = all_axes[0].get_legend_handles_labels()
    figure.legend(lines, labels, loc="lower center", ncol=2)
    figure.tight_layout(rect=(0, 0.12, 1, 1))
    save(figure, path)


def save(figure, path):
    figure.savefig(path, dpi=100)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("figures")
    parser.add_argument("outages")
    parser.add_argument("folder")
    options = parser.parse_args()
    growth = scale_figures(options.figures)
    if growth:
        draw_scale(growth, os.path.join(options.folder, "scale.png"))
    ways = pictures_around_outage(options.outages) if os.path.exists(options.outages) else {}
    if ways:
        draw_outage(ways, os.path.join(options.folder, "outage.png"))


if __name__ == "__main__":
    main()
