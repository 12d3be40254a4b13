#!/usr/bin/env python3
"""e12_log_sink: the reader of the log stops, the program does not, and no line is lost without being counted."""

import re
import subprocess
import unittest

from scenario_case import FINISH_SECONDS, ScenarioCase, main

VISITORS = 1000
GAP = re.compile(r"WARNING log: (\d+) lines dropped: the reader of the log is too slow")
LINE = re.compile(r"info stream: an Open Stream (client connected|session ended) peer=127\.0\.0\.1:(\d+)( reason=.*)?")


class LogSink(ScenarioCase):
    def start_lesson(self):
        lesson = subprocess.Popen([self.bin_dir / "e12_log_sink"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(lesson.stderr.close)
        self.addCleanup(lesson.wait)
        self.addCleanup(lesson.kill)
        return lesson

    def test_a_reader_that_stops_loses_lines_that_are_counted(self):
        lesson = self.start_lesson()
        # Nothing is read from its standard output until all visitors were served.
        self.assertEqual(lesson.stderr.readline(), f"{VISITORS} visitors were served\n")
        with lesson.stdout as log:
            lines = log.read().splitlines()
        self.assertEqual(lesson.wait(FINISH_SECONDS), 0)
        gaps = [int(gap[1]) for gap in map(GAP.fullmatch, lines) if gap]
        visits = [visit[2] for visit in map(LINE.fullmatch, lines) if visit]
        self.assertEqual(len(visits) + len(gaps), len(lines), "a line is neither whole nor a gap")
        self.assertGreater(sum(gaps), 0, "the pipe took everything: the test shows nothing")
        self.assertEqual(len(visits) + sum(gaps), 2 * VISITORS)
        self.assertTrue(GAP.fullmatch(lines[-1]), "the gap is stated where it is")
        self.assertEqual(lesson.stderr.readline(), f"{sum(gaps)} lines were dropped\n")

    def test_a_reader_that_ends_does_not_end_the_program(self):
        lesson = self.start_lesson()
        lesson.stdout.readline()
        lesson.stdout.close()
        self.assertEqual(lesson.stderr.readline(), f"{VISITORS} visitors were served\n")
        self.assertGreater(int(lesson.stderr.readline().split()[0]), 0)
        self.assertEqual(lesson.wait(FINISH_SECONDS), 0)


if __name__ == "__main__":
    main()
