#!/usr/bin/env python3
"""The program as a user starts it, and the Python client of its page, taken from there and run against it."""

import argparse
import contextlib
import json
import pathlib
import re
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.error
import urllib.request

LIMIT = 30
PAGE = pathlib.Path(__file__).resolve().parents[4] / "docs" / "reference" / "openstream-sim.md"
PROGRAM = None


class ReadmeClient(unittest.TestCase):
    def start_for_ready(self, *arguments):
        """Starts a simulator on free ports; returns the addresses of its ready line. The process is self.process."""
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
        code = re.search(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL).group(1)
        _, stream, http = self.start("--time-scale", "10", "--program", "11=3s")
        with tempfile.NamedTemporaryFile("w", suffix=".py", encoding="utf-8") as client:
            client.write(code)
            client.flush()
            result = subprocess.run([sys.executable, client.name, stream.split(":")[1], http.split(":")[1]],
                                    capture_output=True, text=True, timeout=LIMIT, check=False)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout.splitlines()[-1], "finished, started 1 ended 1")

    def test_the_shell_sessions_of_the_readme_print_what_they_say(self):
        blocks = re.findall(r"```bash\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
        self.assertEqual(len(blocks), 3)
        ready = self.start_for_ready("--ready", "--control", "127.0.0.1:0")
        self.assertEqual(list(ready), ["stream", "http", "control"])
        for block in blocks:
            with self.subTest(block.splitlines()[0]):
                code = block.replace("127.0.0.1/49000", ready["stream"].replace(":", "/"))
                code = code.replace("127.0.0.1:8888", ready["http"]).replace("127.0.0.1:8890", ready["control"])
                result = subprocess.run(["bash", "-euo", "pipefail", "-c", code], capture_output=True, text=True,
                                        timeout=LIMIT, check=False)
                self.assertEqual(result.returncode, 0, result.stderr)
                printed = result.stdout.splitlines()
                expected = [line[2:] for line in block.splitlines() if line.startswith("# ")]
                self.assertEqual(len(printed), len(expected), result.stdout)
                for line, pattern in zip(printed, expected):
                    self.assertRegex(line, r"\A" + re.escape(pattern).replace("…", ".*") + r"\Z")

    def test_it_ends_cleanly_with_many_controllers_in_the_middle_of_their_faults(self):
        with tempfile.NamedTemporaryFile("w", suffix=".faults", encoding="utf-8") as faults:
            faults.write("# all at once\n* slow time=1m\n* hole every=200ms\n\n1 drop at=1h\n2 mode silence=1h\n")
            faults.flush()
            for number in (signal.SIGINT, signal.SIGTERM):
                with self.subTest(number.name):
                    ready = self.start_for_ready("--controllers", "20", "--fault-file", faults.name, "--fault",
                                                 "* estop every=50ms for=10ms", "--control", "127.0.0.1:0")
                    with contextlib.ExitStack() as stack:
                        for name, address in ready.items():
                            host, port = address.split(":")
                            client = stack.enter_context(socket.create_connection((host, int(port)), timeout=LIMIT))
                            if name.startswith("http"):
                                client.sendall(b"GET /api_ver HTTP/1.1\r\nHost: x\r\n\r\n")
                            elif name.startswith("stream"):
                                client.sendall(b'{"cmd":"HANDSHAKE","payload":{"major":1}}\n'
                                               b'{"cmd":"MONITOR","payload":{"method":"GET","url":"/api_ver","period_ms":2}}\n')
                                self.assertIn(b"_ack", client.recv(1000))
                        self.process.send_signal(number)
                        self.assertEqual(self.process.wait(LIMIT), 0)

    def post(self, address, text, path="/faults"):
        """Status and text of the answer."""
        try:
            with urllib.request.urlopen(f"http://{address}{path}", text.encode(), timeout=LIMIT) as answer:
                return answer.status, answer.read().decode()
        except urllib.error.HTTPError as refused:
            with refused as answer:
                return answer.code, answer.read().decode()

    def test_faults_are_taken_while_it_runs_all_of_a_message_or_none(self):
        ready = self.start_for_ready("--controllers", "2", "--ready", "--control", "127.0.0.1:0")
        control = ready["control"]

        def is_pressed(name):
            with urllib.request.urlopen(f"http://{ready[name]}/project/robot/emergency_stop", timeout=LIMIT) as answer:
                return json.load(answer)["val"]

        self.assertEqual(self.post(control, "2 estop"), (200, "ok: controllers=1 estop\n"))
        self.assertEqual((is_pressed("http"), is_pressed("http2")), (0, 1))
        self.assertEqual(self.post(control, "# all\n* end estop\n1 estop\n"),
                         (200, "ok: controllers=2 ended=1\nok: controllers=1 estop\n"))
        self.assertEqual((is_pressed("http"), is_pressed("http2")), (1, 0))
        for text, part in (("* end\n2 explode", "line 2, fault: expected one of silence"), ("", "no command"),
                           ("3 estop", "no controller 3; give one from 1 to 2"),
                           ("2 estop\n3 estop", "no controller 3"), ("\xff", "error: ")):
            with self.subTest(text):
                status, answer = self.post(control, text)
                self.assertEqual(status, 400)
                self.assertTrue(answer.startswith("error: "), answer)
                self.assertIn(part, answer)
        self.assertEqual((is_pressed("http"), is_pressed("http2")), (1, 0))
        self.assertEqual(self.post(control, "* end", path="/")[0], 404)
        with self.assertRaises(urllib.error.HTTPError) as refused:
            urllib.request.urlopen(f"http://{control}/faults", timeout=LIMIT)
        with refused.exception as answer:
            self.assertEqual(answer.code, 405)

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

    def connect(self, address):
        host, port = address.split(":")
        client = socket.create_connection((host, int(port)), timeout=LIMIT)
        self.addCleanup(client.close)
        return client

    def test_a_ninth_client_is_served_while_eight_others_stay_silent(self):
        _, stream, _ = self.start()
        silent = [self.connect(stream) for _ in range(8)]
        ninth = self.connect(stream)
        begin = time.monotonic()
        ninth.sendall(b'{"cmd":"HANDSHAKE","payload":{"major":1}}\n')
        self.assertIn(b"handshake_ack", ninth.recv(1000))
        self.assertLess(time.monotonic() - begin, 5.0)
        self.assertIn(b"handshake_rejected", silent[0].recv(1000))

    def test_a_connection_without_a_handshake_is_closed_at_its_deadline(self):
        _, stream, _ = self.start("--handshake-timeout", "50ms")
        silent = self.connect(stream)
        self.assertIn(b"session_timeout", silent.recv(1000))
        self.assertEqual(silent.recv(1000), b"")

    def test_the_number_of_sessions_can_be_set(self):
        _, stream, _ = self.start("--sessions", "1")
        first = self.connect(stream)
        first.sendall(b'{"cmd":"HANDSHAKE","payload":{"major":1}}\n')
        self.assertIn(b"handshake_ack", first.recv(1000))
        self.assertIn(b"handshake_rejected", self.connect(stream).recv(1000))

    def test_programs_move_carriers_on_the_floor_that_the_world_file_describes(self):
        with tempfile.TemporaryDirectory() as folder:
            world = pathlib.Path(folder) / "floor.json"
            world.write_text('{"version":1,"carriers":{"TRAY_01":"CR02.TP01","TRAY_02":"CR01.TP03"}}', encoding="utf-8")
            programs = pathlib.Path(folder) / "programs.toml"
            programs.write_text('[11]\nfrom = ["{robot}.TP{ml106}"]\nto = ["{robot}.TP{ml107}"]\n', encoding="utf-8")
            ready = self.start_for_ready("--controllers", "2", "--ready", "--time-scale", "100", "--world", str(world),
                                         "--programs", str(programs), "--robot", "1=CR01", "--robot", "2=CR02")
            for http, outcome in (("http2", [1, 1, 0, 11, 4711]), ("http", [1, 0, 1, 11, 4711])):
                for name, value in (("ml105", 4711), ("ml106", 1), ("ml107", 2)):
                    self.post(ready[http], json.dumps({"name": name, "value": value}), "/project/plc/set_relay_value")
                self.post(ready[http], '{"pno":11,"ext_sel":1}', "/project/context/tasks[0]/cur_prog_cnt")
                self.assertEqual(self.post(ready[http], "{}", "/project/robot/start")[0], 200)
                end = time.monotonic() + LIMIT
                words = []
                while words[3:4] != [11] and time.monotonic() < end:
                    with urllib.request.urlopen(f"http://{ready[http]}/project/plc/m/val_s32?st=400&len=5",
                                                timeout=LIMIT) as answer:
                        words = json.load(answer)
                self.assertEqual(words, outcome)
            lines = [json.loads(line) for line in pathlib.Path(f"{world}.journal").read_text(encoding="utf-8").splitlines()]
            moves = [line for line in lines if line.get("event") == "CarrierMoved"]
            self.assertEqual(moves, [{"event": "CarrierMoved", "robot": "CR02", "carrier": "TRAY_01", "from": "CR02.TP01",
                                      "to": "CR02.TP02"}])

    def test_each_mistake_of_the_programs_is_one_line_with_file_line_and_key(self):
        with tempfile.NamedTemporaryFile("w", suffix=".toml", encoding="utf-8") as programs:
            programs.write('[11]\necho = "q1"\n[12]\nbutton = ["A{ml106}"]\n')
            programs.flush()
            result = self.run_program("--programs", programs.name)
        self.assertEqual(result.returncode, 2)
        lines = result.stderr.strip().splitlines()
        self.assertEqual(len(lines), 2, result.stderr)
        self.assertIn(f"{programs.name}:2: 11.echo: expected", lines[0])
        self.assertIn(f"{programs.name}:4: 12.button: expected", lines[1])

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
        for arguments in (
                ("--program", "0=3s"), ("--time-scale", "-1"), ("--time-scale", "nan"), ("--listen", "nowhere"),
                ("--http", "127.0.0.1:99999"), ("--controllers", "0"), ("--controllers", "9999"), ("--control", "8890"),
                ("--sessions", "0"), ("--handshake-timeout", "5"), ("--controller-version", "70"), ("--robot-model", ""),
                ("--robot", "CR01"), ("--world", "/nowhere"), ("--programs", ""),
                ("--fault", "explode"), ("--fault", "1 hole for=5"), ("--fault", "1 end"), ("--fault", "*"), ("--fault", ""),
                ("--fault-file", "/nowhere"), ("--fault-file", "/"), ("--log-level", "loud"), ("--frobnicate",)):
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

    def test_a_fault_for_a_controller_that_is_not_there_is_one_line_and_exit_code_2(self):
        result = self.run_program("--controllers", "2", "--fault", "3 silence")
        self.assertEqual(result.returncode, 2)
        self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
        self.assertIn("1 to 2", result.stderr)

    def test_a_port_of_the_control_that_is_in_use_is_named(self):
        with socket.create_server(("127.0.0.1", 0)) as taken:
            address = f"127.0.0.1:{taken.getsockname()[1]}"
            result = self.run_program("--listen", "127.0.0.1:0", "--http", "127.0.0.1:0", "--control", address)
        self.assertEqual(result.returncode, 1)
        self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
        self.assertIn(address, result.stderr)

    def ask(self, address, request):
        """The whole answer to the bytes, to the end of the connection."""
        host, port = address.split(":")
        with socket.create_connection((host, int(port)), timeout=LIMIT) as client:
            # A server that has refused may stop to read before all is sent.
            with contextlib.suppress(ConnectionError):
                client.sendall(request)
            answer = b""
            while chunk := client.recv(65536):
                answer += chunk
            return answer

    def test_hostile_http_costs_an_answer_and_no_more(self):
        _, stream, http = self.start()
        end = b" HTTP/1.1\r\nHost: x\r\nConnection: close\r\n"
        rows = [
            (b"GET /api_ver" + end + b"\r\n", 200, b"\r\n\r\n5"),
            (b"HEAD /api_ver" + end + b"\r\n", 200, b"Content-Length: 1\r\n\r\n"),
            (b"GET /api_ver HTTP/1.1\r\nHost: x\r\n\r\n" * 20 + b"GET /api_ver" + end + b"\r\n", 200, b"5"),
            (b"GET /project/robot%00" + end + b"\r\n", 404, b'"err_code":-2'),
            (b"GET /project/%ff" + end + b"\r\n", 404, b'"err_code":-2'),
            (b"GET /project/../api_ver" + end + b"\r\n", 404, b'"err_code":-2'),
            (b"GET /project/context/tasks%255B0%255D/x" + end + b"\r\n", 404, b'"err_code":-2'),
            (b"GET /%zz" + end + b"\r\n", 400, b"percent-encoded"),
            (b"GET api_ver" + end + b"\r\n", 400, b"begins with /"),
            (b"POST /project/robot/tool_no" + end + b"Content-Length: 10000000\r\n\r\n" + bytes(10_000_000), 413, b"longer"),
            (b"POST /project/robot/tool_no" + end + b"Content-Length: 200000\r\n\r\n" + b"[" * 200_000, 400, b"64 levels"),
            (b"POST /project/robot/tool_no" + end + b"Transfer-Encoding: chunked\r\n\r\n9\r\n{\"val\":1}\r\n0\r\n\r\n", 200, b"_type"),
            (b"POST /project/robot/tool_no" + end + b"Transfer-Encoding: chunked\r\n\r\n5;" + b"x" * 1_000_000, 400, b"not an HTTP"),
            (b"POST /project/robot/tool_no" + end + b"Content-Length: -1\r\n\r\n", 400, b"not an HTTP"),
            (b"POST /project/robot/tool_no" + end + b"Transfer-Encoding: gzip\r\n\r\n" + b"GET /api_ver" + end + b"\r\n", 501, b"chunked"),
            (b"GET /api_ver HTTP/1.1\r\n\r\n", 400, b"one Host"),
            (b"\x16\x03\x01 no HTTP\r\n\r\n", 400, b"not an HTTP"),
        ]
        rows += [(method + b" /api_ver" + end + b"\r\n", 404, b'"err_code":-2')
                 for method in (b"OPTIONS", b"TRACE", b"CONNECT", b"PATCH", b"BREW", b"get", b"PUT")]
        host, port = stream.split(":")
        with socket.create_connection((host, int(port)), timeout=LIMIT) as client:
            client.sendall(b'{"cmd":"HANDSHAKE","payload":{"major":1}}\n')
            for request, status, part in rows:
                with self.subTest(request[:60]):
                    answer = self.ask(http, request)
                    self.assertTrue(answer.startswith(b"HTTP/1.1 %d " % status), answer[:300])
                    self.assertIn(part, answer)
            self.assertIn(b"handshake_ack", client.recv(1000))
            client.sendall(b'{"cmd":"STOP","payload":{"target":"session"}}\n')
            self.assertIn(b"stop_ack", client.recv(1000))

    def test_slow_http_clients_keep_others_waiting_only_as_long_as_they_stay(self):
        _, _, http = self.start()
        host, port = http.split(":")
        with contextlib.ExitStack() as stack:
            slow = [stack.enter_context(socket.create_connection((host, int(port)), timeout=LIMIT)) for _ in range(80)]
            for client in slow:
                client.sendall(b"GET /api_ver HT")
            for client in slow[:40]:
                client.close()
            self.assertTrue(self.ask(http, b"GET /api_ver HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n").endswith(b"\r\n\r\n5"))

    def test_help_tells_what_the_programs_do(self):
        result = self.run_program("--help")
        self.assertEqual(result.returncode, 0)
        for text in ("--controllers", "--control", "1 hole at=5s every=2s", "protective-stop", "program-fails [when=start|end]",
                     "--program", "byte 400", "byte 404", "byte 408", "byte 412", "val_s32?st=400"):
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
