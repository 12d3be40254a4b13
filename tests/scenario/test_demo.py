#!/usr/bin/env python3
"""The demo: it ends as documented, and leaves no process or file, however it is ended."""

import os
import pathlib
import pty
import random
import signal
import subprocess
import sys
import tempfile
import unittest
import uuid

from scenario_case import FINISH_SECONDS, REPOSITORY, ScenarioCase, main

MARK = "ACS_DEMO_TEST_MARK"
INTERRUPTIONS = 5
LATEST_INTERRUPTION = 6.0


def find_processes(mark):
    """All processes with the inherited mark: the demo and its children."""
    wanted = f"{MARK}={mark}".encode()
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                if wanted in (entry / "environ").read_bytes().split(b"\0"):
                    found.append((entry / "cmdline").read_bytes().replace(b"\0", b" ").decode())
            except OSError:
                pass
    return found


class Demo(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.mark = uuid.uuid4().hex

    def start(self, *arguments):
        environment = {**os.environ, "TMPDIR": self.folder, MARK: self.mark, "PYTHONDONTWRITEBYTECODE": "1"}
        return subprocess.Popen(
            ["env", "--block-signal=INT,TERM,HUP", sys.executable, REPOSITORY / "scripts" / "demo.py", "--bin", ScenarioCase.bin_dir, *arguments],
            env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def assert_nothing_left(self):
        self.assertEqual(find_processes(self.mark), [])
        self.assertEqual(os.listdir(self.folder), [])

    def test_the_demo_completes_its_plans(self):
        demo = self.start("--time-scale", "20")
        output, _ = demo.communicate(timeout=FINISH_SECONDS)
        self.assertEqual(demo.returncode, 0, output)
        self.assertEqual(output.splitlines()[-2:], ["3 carriers delivered, 0 misplaced", "2 plans completed, 0 failed"])
        self.assert_nothing_left()

    def test_repeated_plans_deliver_new_carriers_each_time(self):
        demo = self.start("--time-scale", "20", "--plans", "3")
        output, _ = demo.communicate(timeout=FINISH_SECONDS)
        self.assertEqual(demo.returncode, 0, output)
        self.assertEqual(output.splitlines()[-2:], ["9 carriers delivered, 0 misplaced", "6 plans completed, 0 failed"])
        self.assert_nothing_left()

    def run_in_shell(self, redirections):
        """The demo with redirections that only a shell can make."""
        return subprocess.run(
            ["bash", "-c", f'exec python3 "$1" --bin "$2" --time-scale 20 {redirections}', "bash",
             REPOSITORY / "scripts" / "demo.py", ScenarioCase.bin_dir],
            env={**os.environ, "TMPDIR": self.folder, MARK: self.mark, "PYTHONDONTWRITEBYTECODE": "1"},
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
            timeout=FINISH_SECONDS, check=False)

    def test_an_unread_output_ends_the_demo_with_one_line(self):
        for redirections in (">/dev/full", "> >(head -n 1 >/dev/null)"):
            with self.subTest(redirections):
                demo = self.run_in_shell(redirections)
                self.assertEqual(demo.returncode, 1, demo.stderr)
                self.assertEqual(len(demo.stderr.splitlines()), 1, demo.stderr)
                self.assertIn("demo: the output cannot be written", demo.stderr)
                self.assert_nothing_left()

    def test_a_log_folder_that_cannot_be_used_is_refused_before_anything_is_started(self):
        with tempfile.TemporaryDirectory() as place:
            file = pathlib.Path(place, "file")
            file.touch()
            for folder in (file, file / "logs", "/proc/logs"):
                with self.subTest(folder):
                    demo = self.start("--logs", str(folder))
                    output, _ = demo.communicate(timeout=FINISH_SECONDS)
                    self.assertEqual(demo.returncode, 2, output)
                    self.assertIn(f"demo: error: --logs: {folder}: ", output.splitlines()[-1])
                    self.assertNotIn("Traceback", output)
                    self.assert_nothing_left()

    def test_logs_that_cannot_be_copied_are_reported_in_one_line(self):
        with tempfile.TemporaryDirectory() as folder:
            os.mkdir(pathlib.Path(folder, "mcs-sim.log"))
            demo = self.start("--time-scale", "20", "--logs", folder)
            output, _ = demo.communicate(timeout=FINISH_SECONDS)
        self.assertEqual(demo.returncode, 1, output)
        self.assertEqual(output.splitlines()[-2], "2 plans completed, 0 failed")
        self.assertIn(f"demo: the logs cannot be copied to {folder}: ", output.splitlines()[-1])
        self.assert_nothing_left()

    def test_the_logs_are_copied(self):
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place, "new", "logs")
            demo = self.start("--time-scale", "20", "--logs", str(folder))
            output, _ = demo.communicate(timeout=FINISH_SECONDS)
            self.assertEqual(demo.returncode, 0, output)
            self.assertLessEqual({"acsd.log", "mcs-sim.log"}, {path.name for path in folder.iterdir()})

    def test_closed_streams_are_not_a_failure(self):
        demo = self.run_in_shell("<&- >&-")
        self.assertEqual((demo.returncode, demo.stderr), (0, ""))
        self.assert_nothing_left()

    def test_a_terminal_that_only_prints_gets_plain_lines(self):
        master, slave = pty.openpty()
        with subprocess.Popen(
                [sys.executable, REPOSITORY / "scripts" / "demo.py", "--bin", ScenarioCase.bin_dir, "--time-scale", "20"],
                env={**os.environ, "TMPDIR": self.folder, MARK: self.mark, "PYTHONDONTWRITEBYTECODE": "1",
                     "TERM": "dumb"},
                stdin=slave, stdout=slave, stderr=slave) as demo:
            os.close(slave)
            output = b""
            try:
                while chunk := os.read(master, 65536):
                    output += chunk
            except OSError:
                pass  # the end of a pseudo terminal
            os.close(master)
            self.assertEqual(demo.wait(FINISH_SECONDS), 0)
        self.assertNotIn(b"\x1b", output)
        self.assertIn(b"JobReport", output)

    def test_an_interruption_at_any_moment_leaves_nothing(self):
        seed = int.from_bytes(os.urandom(4), "big")
        print(f"seed {seed}")
        moments = random.Random(seed)
        for i in range(INTERRUPTIONS):
            moment = moments.uniform(0.0, LATEST_INTERRUPTION)
            with self.subTest(i=i, moment=moment):
                demo = self.start()
                try:
                    demo.wait(moment)
                except subprocess.TimeoutExpired:
                    pass
                demo.send_signal(signal.SIGINT)
                output, _ = demo.communicate(timeout=60)
                self.assertNotIn("Traceback", output)
                self.assert_nothing_left()

    def test_a_program_that_dies_is_reported_with_the_end_of_its_log(self):
        demo = self.start("--time-scale", "1")
        for line in demo.stdout:
            if "registered" in line.lower() or "InProgress" in line:
                break
        victims = [pid for pid in os.listdir("/proc") if pid.isdigit() and self.is_marked(pid, "acsd")]
        self.assertEqual(len(victims), 1)
        os.kill(int(victims[0]), signal.SIGKILL)
        output, _ = demo.communicate(timeout=60)
        self.assertEqual(demo.returncode, 1)
        self.assertIn("acsd ended with exit code -9", output)
        self.assertIn("the end of acsd's log", output)
        self.assert_nothing_left()

    def is_marked(self, pid, program):
        try:
            arguments = pathlib.Path("/proc", pid, "cmdline").read_bytes().split(b"\0")
            environment = pathlib.Path("/proc", pid, "environ").read_bytes().split(b"\0")
        except OSError:
            return False
        return pathlib.Path(arguments[0].decode()).name == program and f"{MARK}={self.mark}".encode() in environment


if __name__ == "__main__":
    main()
