#!/usr/bin/env python3
"""The figures of docs/tuning.md.

    python3 crates/glidepath/examples/tuning/figures.py target/release/glidepath

Plans corners.ngc with the built-in machine, with other limits of jerk and other tolerances, and
draws what comes of it. Needs nothing but Python.
"""

import csv
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).parent
DOCS = HERE.parent.parent / "docs"
PROGRAM = HERE / "corners.ngc"
COLOURS = ["#1a6fb5", "#111111", "#c2410c"]


def plan(binary, folder, jerk=40000.0, tolerance=0.02):
    """The report of a plan, and its rows."""
    text = subprocess.run(
        [binary, "config", "--default"], check=True, capture_output=True, text=True
    ).stdout
    text = re.sub(r"max_jerk = 40000\.0", f"max_jerk = {jerk:.1f}", text)
    # Three stops have to fit into it, and gentle ones take long.
    text = text.replace("horizon_s = 0.6", "horizon_s = 2.0")
    config, rows = folder / "machine.toml", folder / "rows.csv"
    config.write_text(text)
    command = [
        binary,
        "plan",
        str(PROGRAM),
        "--config",
        str(config),
        "--tolerance",
        str(tolerance),
        "--setpoints",
        str(rows),
        "--json",
    ]
    report = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    with rows.open() as file:
        return report, [
            {key: float(row[key]) for key in ("time_s", "pos_X", "pos_Y", "acc_X")}
            for row in csv.DictReader(file)
        ]


class Chart:
    """Axes in a part of the picture."""

    def __init__(self, left, top, width, height, x, y, title, unit):
        self.box, self.x, self.y, self.parts = (left, top, width, height), x, y, []
        self.parts.append(f'<text x="{left}" y="{top - 12}" class="t">{title}</text>')
        self.parts.append(
            f'<rect x="{left}" y="{top}" width="{width}" height="{height}" class="f"/>'
        )
        self.parts.append(
            f'<text x="{left + width / 2:.0f}" y="{top + height + 32}" class="m">{unit}</text>'
        )

    def at(self, x, y):
        left, top, width, height = self.box
        along = lambda value, ends: (value - ends[0]) / (ends[1] - ends[0])
        return left + along(x, self.x) * width, top + height - along(y, self.y) * height

    def ticks(self, xs, ys):
        left, top, width, height = self.box
        for value, words in xs:
            x, _ = self.at(value, self.y[0])
            self.parts.append(f'<text x="{x:.1f}" y="{top + height + 15}" class="m">{words}</text>')
        for value, words in ys:
            _, y = self.at(self.x[0], value)
            self.parts.append(
                f'<line x1="{left}" y1="{y:.1f}" x2="{left + width}" y2="{y:.1f}" class="g"/><text x="{left - 6}" y="{y + 4:.1f}" class="e">{words}</text>'
            )

    def line(self, points, colour, dots=False):
        places = [self.at(x, y) for x, y in points]
        self.parts.append(
            f'<polyline points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in places)}" fill="none" stroke="{colour}" stroke-width="1.6"/>'
        )
        if dots:
            self.parts += [
                f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{colour}"/>' for x, y in places
            ]

    def key(self, words):
        left, top, width, _ = self.box
        for row, (text, colour) in enumerate(words):
            y = top + 16 + 17 * row
            self.parts.append(
                f'<line x1="{left + 10}" y1="{y - 4}" x2="{left + 34}" y2="{y - 4}" stroke="{colour}" stroke-width="2"/><text x="{left + 40}" y="{y}" class="s">{text}</text>'
            )


STYLE = "text{font:12px sans-serif;fill:#222}.t{font-weight:bold;font-size:13px}.m{text-anchor:middle}.e{text-anchor:end}.f{fill:none;stroke:#888}.g{stroke:#ddd}"


def picture(name, charts, words):
    body = "\n".join(part for chart in charts for part in chart.parts)
    (DOCS / name).write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 860 340" role="img" aria-label="{words}"><style>{STYLE}</style>'
        f'<rect width="860" height="340" fill="#fff"/>\n{body}\n</svg>\n'
    )


def jerk(binary, folder):
    limits = [5000, 10000, 20000, 40000, 80000, 160000, 320000]
    plans = {limit: plan(binary, folder, jerk=limit) for limit in limits}
    times = [(math.log10(limit), report["cycle_time_s"]) for limit, (report, _) in plans.items()]
    most = max(time for _, time in times)
    whole = lambda limit: plans[limit][0]["smoothness"]["whole"]["axes"]["X"][
        "acceleration_above_30_hz"
    ]
    print("jerk, cycle time, X acceleration above 30 Hz")
    for limit in limits:
        print(f"{limit:7} {plans[limit][0]['cycle_time_s']:.3f} {whole(limit):.1f}")
    a = Chart(
        60,
        40,
        330,
        240,
        (math.log10(4000), math.log10(400000)),
        (0, math.ceil(most)),
        "Cycle time, s",
        "limit of jerk, mm/s³",
    )
    a.ticks(
        [(math.log10(limit), f"{limit:,}".replace(",", " ")) for limit in limits[::2]],
        [(value, value) for value in range(math.ceil(most) + 1)],
    )
    a.line(times, COLOURS[0], dots=True)
    shown = [5000, 40000, 320000]
    b = Chart(
        480, 40, 360, 240, (0, 0.6), (-2200, 2200), "X acceleration at the first corner, mm/s²", "s"
    )
    b.ticks(
        [(t / 10, f"{t / 10:.1f}") for t in range(7)],
        [(value, value) for value in range(-2000, 2001, 1000)],
    )
    for limit, colour in zip(shown, COLOURS):
        rows = plans[limit][1]
        corner = next(row["time_s"] for row in rows if row["pos_Y"] > 0.001)
        b.line(
            [
                (row["time_s"] - corner + 0.35, row["acc_X"])
                for row in rows
                if -0.35 <= row["time_s"] - corner <= 0.25
            ],
            colour,
        )
    b.key([(f"{limit:,} mm/s³".replace(",", " "), colour) for limit, colour in zip(shown, COLOURS)])
    picture(
        "tuning-jerk.svg",
        [a, b],
        "cycle time over the limit of jerk, and the acceleration at a corner for three limits",
    )


def tolerance(binary, folder):
    values = [0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5]
    plans = {value: plan(binary, folder, tolerance=value) for value in values}
    print("tolerance, cycle time, deviation")
    for value in values:
        print(
            f"{value:6} {plans[value][0]['cycle_time_s']:.3f} {plans[value][0]['max_deviation_mm']:.4f}"
        )
    times = [(math.log10(value), report["cycle_time_s"]) for value, (report, _) in plans.items()]
    most = max(time for _, time in times)
    a = Chart(
        60,
        40,
        330,
        240,
        (math.log10(0.0016), math.log10(0.6)),
        (0, math.ceil(most)),
        "Cycle time, s",
        "tolerance, mm",
    )
    a.ticks(
        [(math.log10(value), value) for value in values],
        [(value, value) for value in range(math.ceil(most) + 1)],
    )
    a.line(times, COLOURS[0], dots=True)
    shown = [0.02, 0.1, 0.5]
    b = Chart(500, 40, 320, 240, (38.0, 40.0 + 2 / 3), (-0.4, 1.6), "The first corner", "mm")
    b.ticks([(x, x) for x in (38.0, 39.0, 40.0)], [(y, y) for y in (0.0, 1.0)])
    b.line([(38.0, 0.0), (40.0, 0.0), (40.0, 1.6)], "#bbbbbb")
    for value, colour in zip(shown, COLOURS):
        rows = plans[value][1]
        end = next(i for i, row in enumerate(rows) if row["pos_Y"] > 1.6)
        b.line([(row["pos_X"], row["pos_Y"]) for row in rows[:end] if row["pos_X"] >= 38.0], colour)
    b.key([(f"{value} mm", colour) for value, colour in zip(shown, COLOURS)])
    picture(
        "tuning-tolerance.svg",
        [a, b],
        "cycle time over the tolerance, and the path at a corner for three tolerances",
    )


def main():
    binary = sys.argv[1] if len(sys.argv) > 1 else "glidepath"
    with tempfile.TemporaryDirectory() as folder:
        jerk(binary, pathlib.Path(folder))
        tolerance(binary, pathlib.Path(folder))


main()
