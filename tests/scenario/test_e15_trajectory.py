#!/usr/bin/env python3
"""e15_trajectory: where the arm is and how it moved, according to the controller's HTTP interface."""

import json
import re
import signal
import socket
import unittest
import urllib.request

from scenario_case import FINISH_SECONDS, STATUS_SECONDS, ScenarioCase, main

TARGET = 30
FAR = 150  # Three seconds away.
LIMIT = 50  # Degrees per second: 1 degree in each period of 20 ms.
FREE_POINTS = 2048  # Of an empty buffer.


class Trajectory(ScenarioCase):
    def start_controller(self, *options):
        self.arm = self.line.start_arm(1, *options).wait_ready()

    def get(self, path):
        with urllib.request.urlopen(f"http://{self.arm['http']}/project/robot{path}", timeout=STATUS_SECONDS) as answer:
            return json.load(answer)

    def run_lesson(self, *arguments):
        """The exit code and the lines; the motion that HTTP has shown meanwhile is in self.speeds and self.positions."""
        lesson = self.line.start("e15_trajectory", *self.arm["stream"].split(":"), *arguments)
        self.speeds, self.positions = [], []
        while lesson.is_running():
            states = self.get("/joints/joint_states")
            self.speeds.append(max(map(abs, states["velocity"])))
            self.positions.append(states["position"])
        return lesson.wait(FINISH_SECONDS), lesson.log.read_text().splitlines()

    def assert_stationary_and_empty(self):
        self.assertLess(max(map(abs, self.get("/joints/joint_states")["velocity"])), 0.1)
        self.assertEqual(self.get("/trajectory/joint_traject_buf_avail")["val"], FREE_POINTS)

    def test_the_arm_arrives_in_small_steps(self):
        self.start_controller("--playing")
        self.assertEqual(self.run_lesson(TARGET), (0, [f"arrived at {TARGET}.00 degrees"]))
        for axis, angle in enumerate((TARGET, 90, 0, 0, 0, 0)):
            self.assertAlmostEqual(self.get("/joints/joint_states")["position"][axis], angle, delta=0.1)
        self.assert_stationary_and_empty()
        self.assertEqual(self.get("")["alarm"], -1, "E159: a step was too fast for the axis")
        self.assertGreater(max(self.speeds), LIMIT / 2)
        self.assertLess(max(self.speeds), LIMIT * 1.2)

    def test_stop_discards_the_points_and_stops_the_arm_on_the_way(self):
        self.start_controller("--playing")
        target = 90  # Far beyond the STOP: a busy machine sends it late.
        code, lines = self.run_lesson(target, 15)
        self.assertEqual(code, 0, lines)
        where = [float(re.fullmatch(pattern, line)[1]) for pattern, line in
                 zip((r"STOP at ([\d.]+) degrees", r"stopped at ([\d.]+) degrees"), lines, strict=True)]
        self.assertGreaterEqual(where[0], 15)
        self.assertLess(where[1], target - 1)
        self.assertAlmostEqual(self.get("/joints/joint_states")["position"][0], where[1], delta=0.1)
        self.assert_stationary_and_empty()

    def test_an_interruption_stops_the_arm(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number.name):
                self.start_controller("--playing")
                lesson = self.line.start("e15_trajectory", *self.arm["stream"].split(":"), FAR)
                while lesson.is_running() and abs(self.get("/joints/joint_states")["velocity"][0]) < LIMIT / 2:
                    pass
                lesson.send_signal(number)
                self.assertEqual(lesson.wait(FINISH_SECONDS), 1)
                interrupted, stopped = lesson.log.read_text().splitlines()[-2:]
                self.assertEqual(interrupted, "interrupted")
                where = float(re.fullmatch(r"stopped at ([\d.]+) degrees", stopped)[1])
                self.assertLess(where, FAR - 1)
                self.assertAlmostEqual(self.get("/joints/joint_states")["position"][0], where, delta=0.1)
                self.assert_stationary_and_empty()

    def test_an_interruption_without_a_controller_ends_the_lesson(self):
        with socket.create_server(("127.0.0.1", 0)) as server:
            lesson = self.line.start("e15_trajectory", "127.0.0.1", server.getsockname()[1], TARGET)
            connection = server.accept()[0]
            with connection:
                connection.recv(1)
                lesson.send_signal(signal.SIGINT)
                self.assertEqual(lesson.wait(FINISH_SECONDS), 1)
        self.assertEqual(lesson.log.read_text().splitlines()[0], "interrupted")

    def test_only_finite_numbers_are_accepted(self):
        for words in (("nan",), ("inf",), ("-inf",), (TARGET, "nan"), (TARGET, "inf")):
            lesson = self.line.start("e15_trajectory", "127.0.0.1", 1, *words)
            self.assertEqual(lesson.wait(FINISH_SECONDS), 2, words)
            self.assertIn("Usage: ", lesson.log.read_text())

    def test_refused_points_end_the_lesson(self):
        self.start_controller("--ready")  # No program is in playback.
        code, lines = self.run_lesson(TARGET)
        self.assertEqual(code, 1)
        self.assertIn("-1554", lines[0])
        self.assertEqual(self.get("/joints/joint_states")["position"][0], 0)
        self.assertEqual(max(position[0] for position in self.positions), 0)


if __name__ == "__main__":
    main()
