#!/usr/bin/env python3
"""Turns figures into a table: median of the rounds, comparison in the same run, and mark.

    report.py FIGURES [--results FILE] [--check]

FIGURES has a line of JSON for each figure (figures.h), or is what Google Benchmark writes as JSON in one line. A line
{"section": "NAME"} begins a section of the table.
--results FILE also writes the table to this file, with machine, date and versions.
--check fails if a figure is worse than its mark by more than the noise of its rounds.
"""
import argparse
import datetime
import json
import os
import platform
import re
import statistics
import subprocess
import sys

# Counters of the Google Benchmarks that are compared: counter, name, unit, counter and name of the other one, mark of
# the ratio.
COMPARED = (("rcserver_us", "processor time", "us", "turbo_jpeg_us", "bare TurboJPEG", {"at_most": 1.0}),
            ("rcserver_us", "processor time", "us", "libjpeg_us", "bare libjpeg", {}),
            ("rcserver_bytes", "bytes", "", "turbo_jpeg_bytes", "bare TurboJPEG", {}))


def numbers_in(name):
    return [int(number) for number in re.findall(r"\d+", name)]


def in_words(name):
    """For example "encode picture, width 104, quality 50" for encodePicture/width:104/quality:50."""
    name = re.sub("/min_time:[^/]*", "", name)
    name = re.sub("[A-Z]", lambda letter: " " + letter[0].lower(), name)
    return name.replace(":", " ").replace("/", ", ")


def figures_of(google_benchmark):
    """The figures in a report of Google Benchmark."""
    runs = {}
    for run in google_benchmark["benchmarks"]:
        if run.get("run_type") != "aggregate":
            runs.setdefault(run["run_name"], []).append(run)
    for name, rounds in sorted(runs.items(), key=lambda run: numbers_in(run[0])):  # they ran in a random order
        name = in_words(name)
        compared = [comparison for comparison in COMPARED if comparison[0] in rounds[0]]
        if not compared:
            yield {"figure": name + ": time", "unit": rounds[0]["time_unit"],
                   "rounds": [r["cpu_time"] for r in rounds]}
        for counter, what, unit, other, rival, mark in compared:
            yield {"figure": name + ": " + what, "unit": unit, "rounds": [r[counter] for r in rounds],
                   "with": rival, "with_rounds": [r[other] for r in rounds], **mark}


def read(path):
    with open(path, encoding="utf-8") as lines:
        for line in (line for line in lines if line.startswith("{")):  # roscpp logs to stdout
            entry = json.loads(line)
            if "benchmarks" in entry:
                yield from figures_of(entry)
            else:
                yield entry


def readable(value):
    return f"{value:,.0f}" if abs(value) >= 10000 else f"{value:.0f}" if abs(value) >= 1000 else f"{value:.4g}"


class Judged:
    """A figure with its median, its ratio to what it is compared with, and whether it meets its mark."""

    def __init__(self, entry):
        self.name, self.unit, self.rival = entry["figure"], entry["unit"], entry.get("with", "")
        self.median = statistics.median(entry["rounds"])
        judged = entry["rounds"]
        self.rival_median = self.ratio = None
        if self.rival:
            judged = [own / other for own, other in zip(entry["rounds"], entry["with_rounds"]) if other]
            self.rival_median = statistics.median(entry["with_rounds"])
            self.ratio = statistics.median(judged) if judged else None
            if entry.get("mark_is_of_value"):
                judged = entry["rounds"]
        value = self.judged = statistics.median(judged) if judged else None
        noise = (max(judged) - min(judged)) / 2 if judged else 0
        self.mark = self.verdict = ""
        for key, sign, text in (("at_most", 1, "at most"), ("at_least", -1, "at least")):
            if key in entry and value is not None:
                self.mark = f"{text} {entry[key]:g}"
                excess = sign * (value - entry[key])
                self.verdict = "yes" if excess <= 0 else "within its noise" if excess <= noise else "**no**"

    @property
    def missed(self):
        return self.verdict == "**no**"

    def explanation(self):
        beside = f" beside {self.rival}" if self.rival else ""
        return f"{self.name}{beside}: {readable(self.judged)}, {self.mark}"

    def row(self):
        compared = f"{self.rival}: {readable(self.rival_median)}" if self.rival else ""
        ratio = f"{self.ratio:.2f}" if self.ratio is not None else ""
        return (f"| {self.name} | {readable(self.median)} {self.unit} | {compared} | {ratio} | {self.mark} | "
                f"{self.verdict} |")


class Section:
    """The row that begins a section of the table."""

    verdict, missed = "", False

    def __init__(self, name):
        self.name = name

    def row(self):
        return f"| **{self.name}** | | | | | |"


def table(rows):
    return "\n".join(["| figure | median | compared with | ratio | mark | met |", "|---|---|---|---|---|---|"]
                     + [row.row() for row in rows])


def summary(rows):
    """How many marks are met, and which are not."""
    missed = [row.explanation() for row in rows if row.missed]
    marks = sum(row.verdict != "" for row in rows)
    text = f"{marks - len(missed)} of {marks} marks are met."
    return text + (" Not met:\n\n" + "".join(f"- {line}\n" for line in missed) if missed else "\n")


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as lines:
        for line in lines:
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return platform.machine()


def version():
    folder = os.path.dirname(os.path.abspath(__file__))
    result = subprocess.run(["git", "-C", folder, "describe", "--always", "--dirty"], capture_output=True, text=True,
                            check=False)
    return result.stdout.strip() or "unknown"


def machine():
    with open("/etc/os-release", encoding="utf-8") as lines:
        system = dict(line.rstrip().split("=", 1) for line in lines if "=" in line).get("PRETTY_NAME", "").strip('"')
    return (f"Measured on {datetime.date.today()}, version {version()}, {os.cpu_count()} processors "
            f"({processor()}), {system}, Linux {platform.release()}.")


def pictures_beside(path):
    """Links to the pictures that plots.py has drawn beside this file."""
    captions = {"outage.png": "Age of pictures around an outage of the radio", "scale.png": "Growth with robots"}
    folder = os.path.dirname(os.path.abspath(path))
    return "".join(f"\n![{caption}]({name})\n" for name, caption in captions.items()
                   if os.path.exists(os.path.join(folder, name)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("figures")
    parser.add_argument("--results")
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    rows = [Section(entry["section"]) if "section" in entry else Judged(entry) for entry in read(options.figures)]
    print(table(rows) + "\n\n" + summary(rows), end="")
    if options.results:
        with open(options.results, "w", encoding="utf-8") as results:
            results.write("# Results\n\n`scripts/benchmark` writes this file. A figure is the median of its rounds. A "
                          "ratio compares it\nwith a limit or a rival in the same run. Only ratios say something about "
                          "another machine.\n\n" + machine() + "\n\n" + summary(rows) + "\n" + table(rows) + "\n" +
                          pictures_beside(options.results))
    return 1 if options.check and any(row.missed for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
