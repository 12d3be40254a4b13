#!/usr/bin/env python3
"""Draws what scripts/demo prints as an SVG picture of a terminal, from a real run."""

import argparse
import html
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PICTURE = ROOT / "docs" / "guide" / "pictures" / "terminal-demo.svg"
PROMPT, COMMAND, OMITTED = "$ ", "./scripts/demo", "…"
SHOWN = re.compile(r"\bPlanReport\b.*\(")  # of the reports; everything after them is shown
REPORT = re.compile(r"^(?:\d+\.\d{3}|ready:) ")
CONTROL = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]|\r")
SIZE, WIDTH, HEIGHT, MARGIN = 14, 8.4, 19, 16  # of a letter and a line, in pixels
BACKGROUND, TEXT, DIM, STRONG = "#10151c", "#d5dbe3", "#8893a2", "#7fd18b"


def run_demo(programs):
    """Its output, without the build."""
    command = [sys.executable, "-B", str(ROOT / "scripts" / "demo.py"), "--bin", str(programs)]
    ran = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, check=False, text=True)
    if ran.returncode != 0:
        end = "\n".join(ran.stdout.splitlines()[-10:])
        sys.exit(f"terminal_picture: the demo ended with {ran.returncode}; its last lines:\n{end}")
    return CONTROL.sub("", ran.stdout)


def select_lines(output):
    """The command, the reports about whole plans, and the summary."""
    shown, bOmitted = [PROMPT + COMMAND], False
    for line in output.splitlines():
        if REPORT.match(line) and not SHOWN.search(line):
            bOmitted = True
            continue
        if bOmitted:
            shown.append(OMITTED)
        bOmitted = False
        shown.append(line.rstrip())
    return shown


def choose_colour(line):
    if line.startswith(PROMPT) or re.match(r"\d+ (?:carriers|plans) ", line):
        return STRONG
    return DIM if line == OMITTED or "─" in line else TEXT


def draw(lines):
    columns = max(len(line) for line in lines)
    width, height = round(columns * WIDTH + 2 * MARGIN), len(lines) * HEIGHT + 2 * MARGIN
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}">',
             f"<title>{html.escape(COMMAND)} in a terminal</title>",
             f'<rect width="{width}" height="{height}" rx="8" fill="{BACKGROUND}"/>',
             f'<g font-family="ui-monospace, DejaVu Sans Mono, Menlo, Consolas, monospace" font-size="{SIZE}">']
    for number, line in enumerate(lines):
        text = line.lstrip(" ")
        if text:
            x, y = MARGIN + (len(line) - len(text)) * WIDTH, MARGIN + (number + 0.75) * HEIGHT
            # The length keeps the columns, whichever font the viewer has.
            place = f'x="{x:.1f}" y="{y:.1f}" textLength="{len(text) * WIDTH:.1f}"'
            parts.append(f'<text {place} fill="{choose_colour(line)}" xml:space="preserve">{html.escape(text, quote=False)}</text>')
    return "\n".join([*parts, "</g>", "</svg>", ""])


def read_labels(picture):
    """What the lines of a picture are about, without their numbers and ids."""
    lines = [html.unescape(line).strip() for line in re.findall(r"<text [^>]*>([^<]*)</text>", picture)]
    return {re.sub(r"\d[\w.-]*", "0", re.split(r"  +|PLAN", line)[0]) for line in lines}


def main():
    parser = argparse.ArgumentParser(description="Draws what scripts/demo prints as an SVG picture of a terminal.")
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build" / "release" / "bin", help="folder of the programs")
    parser.add_argument("--out", type=pathlib.Path, default=PICTURE, help=f"file (default: {PICTURE.relative_to(ROOT)})")
    parser.add_argument("--check", action="store_true", help="only compares the picture with a run: the same lines, but for numbers")
    arguments = parser.parse_args()
    picture = draw(select_lines(run_demo(arguments.bin)))
    if not arguments.check:
        arguments.out.write_text(picture, encoding="utf-8")
        return 0
    differences = read_labels(arguments.out.read_text(encoding="utf-8")) ^ read_labels(picture)
    for label in sorted(differences):
        print(f"{arguments.out.name}: '{label}' is only in the picture or only in the output of the demo; "
              "to make it again: scripts/pictures terminal")
    return 1 if differences else 0


if __name__ == "__main__":
    sys.exit(main())
