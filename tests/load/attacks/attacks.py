#!/usr/bin/env python3
"""Measures acsd under attack, with real processes: the delay of GET /livez (one request each 10 ms, each on a new connection), and
the intervals between the position updates that the MCS receives. Prints a table in Markdown, one row for each attack, beside a
row without an attack. Limits: 99 % of the requests are answered within 100 ms, and the mean interval is 200 ms within 2 %.

Fails when a limit is exceeded, an attack has no effect, or acsd does not recover; with --counts-only only when an attack has no
effect or acsd does not recover."""

import argparse
import itertools
import json
import math
import pathlib
import subprocess
import sys

from attack_kinds import ATTACKS, NoAttack
from attacked_line import POSITION_PERIOD, AttackedLine
from production_line import LineError

FOLDER = pathlib.Path(__file__).resolve().parent
LIVE_LIMIT = 0.1  # seconds, p99
POSITION_TOLERANCE = 0.02  # of the mean interval
EFFECT_SECONDS = 20
RECOVERY_SECONDS = 60
PROBE_SECONDS = 30  # after the end of the measurement
HEAD = ("attack", "/livez p50", "p99", "max", "position interval mean", "p99", "result")


def get_quantile(values, share):
    return sorted(values)[math.ceil(share * len(values)) - 1]


def find_intervals(times, begin, end):
    """Between position updates; that between the last one and the end counts if it is longer than a period may be."""
    inside = [time for time in times if begin <= time <= end]
    intervals = [after - before for before, after in itertools.pairwise(inside)]
    silence = end - (inside[-1] if inside else begin)
    return intervals + ([silence] if silence > 2 * POSITION_PERIOD or not intervals else [])


class Row:
    def __init__(self, attack, probe, times):
        self.attack = attack
        self.delays = probe["delays"]
        self.failed = probe["failed"]
        self.intervals = find_intervals(times, probe["begin"], probe["end"])
        self.effect = ""
        self.faults = []  # which are no matter of time

    def find_exceeded(self):
        mean = sum(self.intervals) / len(self.intervals)
        if get_quantile(self.delays, 0.99) > LIVE_LIMIT:
            yield "/livez"
        if abs(mean - POSITION_PERIOD) > POSITION_TOLERANCE * POSITION_PERIOD:
            yield "positions"

    def format(self, is_compared):
        values = [get_quantile(self.delays, 0.5), get_quantile(self.delays, 0.99), max(self.delays),
                  sum(self.intervals) / len(self.intervals), get_quantile(self.intervals, 0.99)]
        exceeded = list(self.find_exceeded())
        notes = [] if not is_compared else ["BEYOND: " + ", ".join(exceeded)] if exceeded else ["within"]
        notes += [note for note in (self.effect, self.attack.summarize()) if note]
        notes += [f"{self.failed} attempts failed"] if self.failed else []
        notes += self.faults
        return [self.attack.name, *(f"{1000 * value:.1f} ms" for value in values), "; ".join(notes)]


def measure(attack_type, arguments):
    """Runs the line for this attack alone."""
    line = AttackedLine(arguments.bin, arguments.acsd)
    with line:
        attack = attack_type(line.line.folder, line.line.bin_dir)
        line.start(attack)
        attack.begin(line)
        probe = subprocess.run([sys.executable, "-B", FOLDER / "live_probe.py", line.http, str(arguments.seconds)], check=True,
                               stdout=subprocess.PIPE, timeout=arguments.seconds + PROBE_SECONDS)
        row = Row(attack, json.loads(probe.stdout), [
            message.time for message in line.stub.get() if message.command == "RobotPositionUpdate" and (
                not attack.has_robots or any(robot["robotId"] == "LR01" for robot in message.payload["robots"]))])
        if line.has_become(lambda: attack.find_effect(line), EFFECT_SECONDS):
            row.effect = attack.find_effect(line)
        else:
            row.faults.append("no effect shown" if line.is_alive() else "acsd does not answer")
        attack.end(line)
        if not line.has_become(lambda: attack.has_recovered(line), RECOVERY_SECONDS):
            row.faults.append(f"not recovered after {RECOVERY_SECONDS} s")
        code = line.stop_acsd()
        if code != 0:
            row.faults.append(f"exit code {code}")
        return row, json.loads(probe.stdout)["late"]


def write_line(cells):
    print(f"| {' | '.join(cells)} |", flush=True)


def run(arguments):
    chosen = [attack for attack in ATTACKS if not arguments.attack or any(part in attack.name for part in arguments.attack)]
    if not chosen:
        return f"no attack matches; there are: {', '.join(attack.name for attack in ATTACKS)}"
    write_line(HEAD)
    write_line(["---"] * len(HEAD))
    failed, late = [], 0.0
    for attack in chosen:
        try:
            row, row_late = measure(attack, arguments)
        except (LineError, RuntimeError, subprocess.SubprocessError, AssertionError) as error:
            program = getattr(error, "program", None)
            return "\n".join([f"{attack.name}: {error}", *(program.tail() if program else ())])
        write_line(row.format(not arguments.counts_only))
        late = max(late, row_late)
        if row.faults or (not arguments.counts_only and list(row.find_exceeded())):
            failed.append(attack.name)
    print(f"\nThe program that sends the requests woke at most {1000 * late:.1f} ms late, which is not part of the delays.")
    return f"failed: {', '.join(failed)}" if failed else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, required=True, help="folder with acsd, vda-sim and libscenario_held_*.so")
    parser.add_argument("--acsd", type=pathlib.Path, help="another acsd, for example an older one (default: that in --bin)")
    parser.add_argument("--seconds", type=float, default=15, help="duration of each measurement (default 15)")
    parser.add_argument("--attack", action="append", default=[], metavar="PART",
                        help="only attacks whose name has this part; repeatable (default: all)")
    parser.add_argument("--counts-only", action="store_true", help="check no time")
    parser.add_argument("--list", action="store_true", help="print the names of the attacks and exit")
    arguments = parser.parse_args()
    if arguments.list:
        print(*(attack.name for attack in ATTACKS), sep="\n")
        return None
    arguments.acsd = (arguments.acsd or arguments.bin / "acsd").resolve()
    return run(arguments)


if __name__ == "__main__":
    sys.exit(main())
