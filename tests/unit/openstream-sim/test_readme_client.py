#!/usr/bin/env python3
"""The program as a user starts it, and the Python client of its README, taken from there and run against it."""

import argparse
import json
import pathlib
import re
import signal
import socket
import subprocess
import sys
import tempfile
import unittest
import urllib.error
import urllib.request

LIMIT = 30
README = pathlib.Path(__file__).resolve().parents[3] / "apps" / "openstream-sim" / "README.md"
PROGRAM = None


class ReadmeClient(unittest.TestCase):
    def start_for_ready(self, *arguments):
        """A simulator on free ports; what its ready line says. The process is self.process."""
        process = subprocess.Popen([PROGRAM, "--listen", "127.0.0.1:0", "--http", "127.0.0.1:0", "--log-level", "error",
                                    *arguments], stdout=subprocess.PIPE, text=True)
        self.process = process
        self.addCleanup(process.wait, LIMIT)
        self.addCleanup(process.kill)
        self.addCleanup(process.stdout.close)
        line = process.stdout.readline()
        self.assertRegex(line, r"\Aready:( \w+=127\.0\.0\.1:\d+)+\n\Z")
        return dict(part.split("=") for part in line.split()[1:])

    def start(self, *arguments):
        """One controller; (process, stream address, http address)."""
        ready = self.start_for_ready(*arguments)
        self.assertEqual(list(ready), ["stream", "http"])
        return self.process, ready["stream"], ready["http"]

    def run_program(self, *arguments):
        return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=LIMIT, check=False)

    def test_the_client_of_the_readme_runs_a_program_to_its_end(self):
        code = re.search(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL).group(1)
        _, stream, http = self.start("--time-scale", "10", "--program", "11=3s")
        with tempfile.NamedTemporaryFile("w", suffix=".py", encoding="utf-8") as client:
            client.write(code)
            client.flush()
            result = subprocess.run([sys.executable, client.name, stream.split(":")[1], http.split(":")[1]],
                                    capture_output=True, text=True, timeout=LIMIT, check=False)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout.splitlines()[-1], "finished, started 1 ended 1")

    def test_it_ends_cleanly_on_both_signals_with_a_client_connected(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number.name):
                process, stream, _ = self.start()
                host, port = stream.split(":")
                with socket.create_connection((host, int(port)), timeout=LIMIT) as client:
                    client.sendall(b'{"cmd":"HANDSHAKE","payload":{"major":1}}\n')
                    self.assertIn(b"handshake_ack", client.recv(1000))
                    process.send_signal(number)
                    self.assertEqual(process.wait(LIMIT), 0)

    def test_a_port_in_use_is_one_line_that_names_it(self):
        with socket.create_server(("127.0.0.1", 0)) as taken:
            address = f"127.0.0.1:{taken.getsockname()[1]}"
            for arguments in (("--listen", address, "--http", "127.0.0.1:0"), ("--http", address, "--listen", "127.0.0.1:0")):
                with self.subTest(arguments[0]):
                    result = self.run_program(*arguments)
                    self.assertEqual(result.returncode, 1)
                    self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
                    self.assertIn(address, result.stderr)

    def test_a_bad_value_is_one_line_and_exit_code_2(self):
        for arguments in (("--program", "0=3s"), ("--time-scale", "-1"), ("--listen", "nowhere"), ("--frobnicate",)):
            with self.subTest(arguments[0]):
                result = self.run_program(*arguments)
                self.assertEqual(result.returncode, 2)
                self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
                self.assertIn(arguments[0], result.stderr)

    def test_each_of_several_controllers_has_ports_and_an_arm_of_its_own(self):
        ready = self.start_for_ready("--controllers", "3", "--ready")
        self.assertEqual(list(ready), ["stream", "http", "stream2", "http2", "stream3", "http3"])
        self.assertEqual(len(set(ready.values())), 6)
        urllib.request.urlopen(f"http://{ready['http2']}/project/robot/tool_no", b'{"val":1}', timeout=LIMIT).close()
        for name, tool in (("http", 0), ("http2", 1), ("http3", 0)):
            with urllib.request.urlopen(f"http://{ready[name]}/project/robot", timeout=LIMIT) as answer:
                self.assertEqual(json.load(answer)["tool_no"], tool, name)
        for name in ("stream", "stream2", "stream3"):
            host, port = ready[name].split(":")
            with socket.create_connection((host, int(port)), timeout=LIMIT) as client:
                client.sendall(b'{"cmd":"HANDSHAKE","payload":{"major":1}}\n')
                self.assertIn(b"handshake_ack", client.recv(1000), name)

    def test_of_several_controllers_the_port_that_cannot_be_had_is_named(self):
        # Two free neighbours; the second is then taken.
        for _ in range(100):
            with socket.create_server(("127.0.0.1", 0)) as first:
                port = first.getsockname()[1]
                try:
                    taken = socket.create_server(("127.0.0.1", port + 1))
                except (OSError, OverflowError):
                    continue
            with taken:
                result = self.run_program("--controllers", "2", "--listen", f"127.0.0.1:{port}", "--http", "127.0.0.1:0")
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
            self.assertIn(f"127.0.0.1:{port + 1}", result.stderr)
            return
        self.fail("there are no two free ports side by side")

    def test_help_tells_what_the_programs_do(self):
        result = self.run_program("--help")
        self.assertEqual(result.returncode, 0)
        for text in ("--program", "byte 400", "byte 404", "byte 408", "byte 412", "val_s32?st=400"):
            self.assertIn(text, result.stdout)

    def test_the_http_side_answers_as_documented(self):
        _, _, http = self.start("--ready")
        with self.assertRaises(urllib.error.HTTPError) as refused:
            urllib.request.urlopen(urllib.request.Request(f"http://{http}/project/robot/start", b"{}"), timeout=LIMIT)
        with refused.exception as answer:
            self.assertEqual(answer.code, 403)
            self.assertEqual(answer.headers["Content-Type"], "application/json; charset=utf-8")
            self.assertIn(b'"err_code":-3', answer.read())


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    options, rest = parser.parse_known_args()
    PROGRAM = options.program
    unittest.main(argv=[sys.argv[0], *rest])
