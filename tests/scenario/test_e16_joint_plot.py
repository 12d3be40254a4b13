#!/usr/bin/env python3
"""e16_joint_plot: the file and the plot show the motion that the controller's HTTP interface has commanded."""

import csv
import json
import math
import os
import pty
import re
import signal
import subprocess
import unittest
import urllib.request

from scenario_case import FINISH_SECONDS, STATUS_SECONDS, ScenarioCase, main

PERIOD = 20  # ms
TARGET = [60, 90, -50, 0, 30, 0]
AXIS = re.compile(r"J(\d) +(-?[\d.]+) \|(.*)\|")


def count_missing(times):
    """Periods without a sample, by the rule of StreamMeter: a sample that is only late, as on a busy machine, is none."""
    missing, due = 0, float(times[0])
    for time in times[1:]:
        steps = max(1, math.floor((time - due) / PERIOD + 1 / 8))
        delay = time - due - steps * PERIOD
        due = time - max(0.0, delay) * 15 / 16
        missing += steps - 1
    return missing


class JointPlot(ScenarioCase):
    def setUp(self):
        super().setUp()
        self.arm = self.line.start_arm(1, "--ready").wait_ready()
        self.csv = self.line.folder / "joints.csv"

    def get_command(self, samples):
        return [self.bin_dir / "e16_joint_plot", *self.arm["stream"].split(":"), self.csv, str(samples)]

    def move(self, angles):
        body = json.dumps({"stmt": f"move P,spd=1sec,accu=0,tool=0 {angles}"}).encode()
        url = f"http://{self.arm['http']}/project/context/tasks%5B0%5D/execute_move"
        with urllib.request.urlopen(urllib.request.Request(url, body), timeout=STATUS_SECONDS) as answer:
            self.assertEqual(answer.status, 200)

    def read_file(self):
        with open(self.csv, newline="") as file:
            rows = list(csv.DictReader(file))
        return [int(row["ts_ms"]) for row in rows], [[float(row[f"j{axis}"]) for axis in range(1, 7)] for row in rows]

    def assert_plotted(self, text, angles):
        """Each axis with its angle, and its star where the angle is on a scale from -180 to 180."""
        shown = AXIS.findall(text)[-6:]
        self.assertEqual([int(axis) for axis, _, _ in shown], list(range(1, 7)))
        for (_, number, scale), angle in zip(shown, angles):
            self.assertAlmostEqual(float(number), angle, delta=0.01)
            self.assertEqual(scale.index("*"), round((angle + 180) / 360 * (len(scale) - 1)))

    def test_the_file_has_each_sample_of_a_motion(self):
        samples = 100
        lesson = subprocess.Popen(self.get_command(samples), stdout=subprocess.PIPE, text=True)
        self.addCleanup(lesson.stdout.close)
        self.addCleanup(lesson.kill)
        self.move(TARGET)
        text, _ = lesson.communicate(timeout=FINISH_SECONDS)
        self.assertEqual(lesson.returncode, 0)
        times, angles = self.read_file()
        self.assertEqual(len(times), samples)
        self.assertEqual(re.search(r"(\d+) of (\d+) samples, (\d+) missing", text).groups(),
                         (str(samples), str(samples), str(count_missing(times))))
        for axis, target in enumerate(TARGET):
            moved = [row[axis] for row in angles]
            self.assertAlmostEqual(moved[-1], target, delta=0.1)
            self.assertEqual(moved, sorted(moved, reverse=target < moved[0]), "the axis went back")
        self.assertGreater(len({row[0] for row in angles}), 10, "no sample shows the arm on its way")
        self.assert_plotted(text, angles[-1])

    def test_a_terminal_is_redrawn_and_ctrl_c_keeps_the_file(self):
        ours, theirs = pty.openpty()
        self.addCleanup(os.close, ours)
        with subprocess.Popen(self.get_command(100_000), stdout=theirs) as lesson:
            os.close(theirs)
            text = ""
            while text.count("\x1b[H") < 4:
                text += os.read(ours, 4096).decode()
            lesson.send_signal(signal.SIGINT)
            self.assertEqual(lesson.wait(FINISH_SECONDS), 1, "the file has less than the wanted samples")
        times, angles = self.read_file()
        self.assertGreater(len(times), 3)
        self.assertEqual(angles[-1], [0, 90, 0, 0, 0, 0])
        self.assert_plotted(text.replace("\r", "").rsplit("\x1b[H", 1)[0], angles[-1])


if __name__ == "__main__":
    main()
