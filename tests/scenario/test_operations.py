#!/usr/bin/env python3
"""Operation of acsd as in docs/guide/operate.md: signals, the message trace, metrics."""

import concurrent.futures
import contextlib
import itertools
import json
import os
import re
import signal
import socket
import sqlite3
import subprocess
import threading
import time
import urllib.error
import urllib.request

from mcs_stub import McsStub
from plan_samples import make_carrying_plan
from scenario_case import TIME_SCALE, ScenarioCase, main
import operator_api  # which scenario_case makes known

DRAIN_SECONDS = 8
LOG_SECONDS = 20
SENDERS = 16
COMMANDS = 16_000
WAITING_COMMANDS = 1_000  # InputLimits::operatorCommands
WAITING_PLANS = 100  # queue.max_plans of the example
POSITIONS = 10


class Operations(ScenarioCase):
    def start_stub(self):
        stub = McsStub()
        self.addCleanup(stub.close)
        return stub

    def submit(self, stub, plan_id):
        return stub.ask("ExecutionPlan", make_carrying_plan(plan_id))

    def test_a_hanging_disk_is_reported_and_waiting_requests_continue_afterwards(self):
        library = self.line.bin_dir / "libscenario_held_disk.so"
        if not library.exists():
            self.skipTest("not built with sanitizers")
        gate = self.line.folder / "held"
        environment = os.environ | {"LD_PRELOAD": str(library), "ACS_HELD_DISK": str(gate)}
        stub = self.start_stub()
        acsd = self.line.start_acsd(stub.address, self.start_robots(), environment=environment)
        addresses = acsd.wait_ready()
        address = addresses["operator"]
        stub.wait_for("RobotStatusUpdate", lambda message: message.payload["robotStatus"] == "Idle")
        os.mkfifo(gate)
        start = stub.count()
        stub.send_request("ExecutionPlan", make_carrying_plan("P1"))
        self.wait_for_status(address, lambda status: "the store does not answer" in status["notReadyReasons"])
        with self.assertRaises(urllib.error.HTTPError) as refused:
            urllib.request.urlopen(f"http://{addresses['http']}/readyz", timeout=LOG_SECONDS)
        with refused.exception as answer:
            self.assertEqual((answer.code, answer.read()), (503, b"the store does not answer\nisConnected=true\n"))
        self.wait_for_log(acsd, "the store does not answer")
        self.assertFalse([message for message in stub.get(start) if message.command == "ExecutionPlanAck"])

        writer = os.open(gate, os.O_WRONLY)
        gate.unlink()
        os.close(writer)
        _, answer = stub.wait_for("ExecutionPlanAck", start=start)
        self.assertEqual(answer.body["result"], "Success")
        self.wait_for_log(acsd, "the store has answered")
        self.wait_for_status(address, lambda status: not status["notReadyReasons"])

    def list_stored_keys(self):
        """Of the commands that the store has; acsd shows the effect of a command before it is stored."""
        database = (self.line.folder / "store" / "acsd.db").resolve()
        with contextlib.closing(sqlite3.connect(f"{database.as_uri()}?mode=ro", uri=True)) as store:
            return [key for key, in store.execute("SELECT key FROM receipts ORDER BY sequence")]

    def test_after_a_crash_a_command_and_its_key_are_both_stored_or_neither(self):
        library = self.line.bin_dir / "libscenario_held_disk.so"
        if not library.exists():
            self.skipTest("not built with sanitizers")
        gate = self.line.folder / "held"
        environment = os.environ | {"LD_PRELOAD": str(library), "ACS_HELD_DISK": str(gate)}
        stub, robots = self.start_stub(), self.start_robots()

        def start():
            acsd = self.line.start_acsd(stub.address, robots, environment=environment)
            return acsd, acsd.wait_ready()["operator"]

        def crash(acsd):
            self.line.forget(acsd)
            acsd.send_signal(signal.SIGKILL)
            acsd.stop()

        def is_replayed(address, path, key):
            request = urllib.request.Request(f"http://{address}{path}", b"", {"Idempotency-Key": key})
            with urllib.request.urlopen(request, timeout=LOG_SECONDS) as response:
                self.assertEqual(response.status, 202)
                return response.headers["Idempotent-Replay"] == "true"

        acsd, address = start()
        self.assertFalse(is_replayed(address, "/v1/tsc/pause", "stored"))
        self.wait_until(lambda: self.list_stored_keys() == ["stored"], "the command is not stored")
        os.mkfifo(gate)
        self.assertEqual(self.post(address, "/v1/robots/CR01/maintenance", {"on": True})[0], 202)
        self.assertFalse(is_replayed(address, "/v1/tsc/resume", "waiting"))  # for the batch before it, until the crash
        crash(acsd)
        gate.unlink()

        acsd, address = start()
        self.assertEqual(self.read_status(address)["tsc"], "Paused")
        self.assertTrue(is_replayed(address, "/v1/tsc/pause", "stored"))
        self.assertFalse(is_replayed(address, "/v1/tsc/resume", "waiting"), "it was lost with its key")
        self.wait_for_status(address, lambda status: status["tsc"] == "Auto")

    def post_all(self, address, path, bodies):
        """The statuses of the answers, and the values of Retry-After; one connection, without waiting between requests."""
        requests = b"".join(f"POST {path} HTTP/1.1\r\nHost: {address}\r\nContent-Length: {len(body)}\r\n\r\n{body}".encode()
                            for body in bodies)
        statuses, waits = [], set()
        host, port = address.rsplit(":", 1)
        with socket.create_connection((host, int(port)), LOG_SECONDS) as connection:
            writer = threading.Thread(target=connection.sendall, args=(requests,))
            writer.start()
            with connection.makefile("rb") as reader:
                for _ in bodies:
                    statuses.append(int(reader.readline().split()[1]))
                    headers = dict(line.decode().strip().split(": ", 1) for line in iter(reader.readline, b"\r\n"))
                    reader.read(int(headers["Content-Length"]))
                    waits.add(headers.get("Retry-After"))
            writer.join()
        return statuses, waits

    def count_commits(self, address):
        with urllib.request.urlopen(f"http://{address}/metrics", timeout=LOG_SECONDS) as response:
            text = response.read().decode()
        return int(re.search(r"^acsd_store_commit_seconds_count (\d+)", text, re.MULTILINE).group(1))

    def test_commands_of_the_operator_that_wait_for_a_hanging_disk_are_limited_and_share_one_commit(self):
        library = self.line.bin_dir / "libscenario_held_disk.so"
        if not library.exists():
            self.skipTest("not built with sanitizers")
        gate = self.line.folder / "held"
        environment = os.environ | {"LD_PRELOAD": str(library), "ACS_HELD_DISK": str(gate)}
        stub = self.start_stub()
        acsd = self.line.start_acsd(stub.address, self.start_robots(), environment=environment)
        addresses = acsd.wait_ready()
        address = addresses["operator"]
        stub.wait_for("RobotStatusUpdate", lambda message: message.payload["robotStatus"] == "Idle"
                      and message.payload["robotId"] == "LR01")
        os.mkfifo(gate)
        self.post(address, "/v1/tsc/pause")
        commits = self.count_commits(addresses["http"])
        begin = time.monotonic()
        with concurrent.futures.ThreadPoolExecutor(SENDERS) as pool:
            bodies = [json.dumps({"on": number % 2 == 0}) for number in range(COMMANDS // SENDERS)]
            answers = list(pool.map(lambda _: self.post_all(address, "/v1/robots/CR01/maintenance", bodies), range(SENDERS)))
        end = time.monotonic()
        statuses = [status for answer, _ in answers for status in answer]
        self.assertEqual(len(statuses), COMMANDS)
        self.assertEqual(set(statuses), {202, 503})
        self.assertEqual(statuses.count(202), WAITING_COMMANDS)
        self.assertEqual(set.union(*(waits for _, waits in answers)), {None, "1"})
        self.assertLess(end - begin, LOG_SECONDS)

        # 101 plans wait, and one of them is refused. The positions continue.
        start = stub.count()
        for number in range(WAITING_PLANS + 1):
            stub.send_request("ExecutionPlan", make_carrying_plan(f"P{number}"))
        _, refused = stub.wait_for("ExecutionPlanAck", start=start)
        self.assertEqual(refused.body["result"], "Fail")
        self.assertIn("Send the request again later", refused.body["message"])
        for _ in range(POSITIONS):
            start, _ = stub.wait_for("RobotPositionUpdate", start=start)
            start += 1
        times = [message.time for message in stub.get() if message.command == "RobotPositionUpdate" and message.time > begin]
        self.assertLess(max(after - before for before, after in itertools.pairwise(times)), 1)

        writer = os.open(gate, os.O_WRONLY)
        gate.unlink()
        os.close(writer)
        for number in range(WAITING_PLANS):
            stub.wait_for("ExecutionPlanAck", lambda ack, number=number: ack.payload["planId"] == f"P{number}"
                          and ack.body["result"] == "Success")
        self.wait_for_status(address, lambda status: not status["notReadyReasons"])
        self.assertLess(self.count_commits(addresses["http"]) - commits, 100)

    def read_ready(self, address):
        try:
            with urllib.request.urlopen(f"http://{address}/readyz", timeout=LOG_SECONDS) as response:
                return response.status, response.read().decode()
        except urllib.error.HTTPError as error:
            with error:
                return error.code, error.read().decode()

    def post(self, address, path, body=None):
        return operator_api.post(address, path, body)

    def test_a_log_pipe_that_is_full_stops_no_plan_and_acsd_ends_at_sigterm(self):
        stub = self.start_stub()
        robots = self.start_robots()
        reader, writer = os.pipe()
        self.addCleanup(os.close, reader)
        os.set_blocking(writer, False)
        with self.assertRaises(BlockingIOError):
            while True:
                os.write(writer, b"x" * 4096)
        os.set_blocking(writer, True)
        try:
            acsd = self.line.start_acsd(stub.address, robots, "shutdown.drain_timeout=0ms", log_descriptor=writer)
        finally:
            os.close(writer)
        address = acsd.wait_ready()["http"]
        stub.wait_for("RobotStatusUpdate", lambda message: message.payload["robotStatus"] == "Idle"
                      and message.payload["robotId"] == "LR01")
        self.assertEqual(self.submit(stub, "P1")["result"], "Success")
        stub.wait_for("PlanReport", lambda message: message.payload["status"] == "Completed")
        self.assertEqual(self.read_ready(address)[0], 200)
        acsd.send_signal(signal.SIGTERM)
        self.assertEqual(acsd.wait(DRAIN_SECONDS), 0)

    def test_systemd_hears_that_acsd_is_ready_alive_and_stopping(self):
        stub = self.start_stub()
        robots = self.start_robots()
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as service:
            service.bind(str(self.line.folder / "notify"))
            service.settimeout(LOG_SECONDS)
            acsd = self.line.start_acsd(stub.address, robots, environment=os.environ | {
                "NOTIFY_SOCKET": str(self.line.folder / "notify"), "WATCHDOG_USEC": "400000"})
            acsd.wait_ready()
            self.assertEqual([service.recv(100) for _ in range(3)], [b"READY=1", b"WATCHDOG=1", b"WATCHDOG=1"])
            acsd.send_signal(signal.SIGTERM)
            while (state := service.recv(100)) == b"WATCHDOG=1":
                pass
            self.assertEqual(state, b"STOPPING=1")

    def test_a_removed_store_is_reported_saved_and_restored_at_the_next_start(self):
        stub = self.start_stub()
        robots = self.start_robots()
        overrides = ("tsc.initial=paused",)
        acsd = self.line.start_acsd(stub.address, robots, *overrides)
        addresses = acsd.wait_ready()
        address = addresses["operator"]
        directory = self.line.folder / "store"
        store = directory / "acsd.db"
        self.assertRegex(acsd.log.read_text(), rf"store: new, schema \d+ store={directory}\n")
        stub.wait_for("RobotStatusUpdate")
        self.assertEqual(self.submit(stub, "P1")["result"], "Success")
        self.wait_for_status(address, lambda status: status["plans"] and not status["notReadyReasons"])

        # Away and back: this is noticed without any write.
        away = self.line.folder / "away.db"
        store.rename(away)
        self.wait_for_status(address, lambda status: [alarm["errorCode"] for alarm in status["alarms"]] == ["ACS-1005"])
        code, text = self.read_ready(addresses["http"])
        self.assertEqual(code, 503)
        self.assertRegex(text, rf"the store cannot be written: {store}: expected the file .* restart.*\.rescued.*, found")
        refusal = self.submit(stub, "P2")
        self.assertEqual(refusal["result"], "Fail")
        self.assertIn("removed or moved away", refusal["message"])
        self.assertEqual(self.post(address, "/v1/tsc/resume")[0], 503)
        code, answer = self.post(address, "/v1/robots/LR01/maintenance", {"on": True})
        self.assertEqual((code, "This is not stored" in answer["message"]), (202, True))
        away.rename(store)
        self.wait_for_status(address, lambda status: not status["notReadyReasons"] and not status["alarms"])
        self.wait_for_log(acsd, "the store works again")
        self.assertEqual(self.submit(stub, "P3")["result"], "Success")
        self.assertEqual(self.post(address, "/v1/tsc/pause")[0], 202)

        # Removed for good: the next start has everything from before.
        store.unlink()
        self.wait_for_status(address, lambda status: any("store" in reason for reason in status["notReadyReasons"]))
        acsd.process.kill()
        acsd.stop()
        self.line.forget(acsd)
        acsd = self.line.start_acsd(stub.address, robots, *overrides)
        address = acsd.wait_ready()["operator"]
        status = self.read_status(address)
        self.assertEqual({plan["planId"] for plan in status["plans"]}, {"P1", "P3"})
        self.assertEqual({robot["robotId"] for robot in status["robots"] if robot["maintenance"]}, {"LR01"})
        self.assertRegex(acsd.log.read_text(), r"store: schema \d+, 2 open plans resumed, no ended plans, .*in maintenance "
                         r"LR01.*; restored from the copy that was made when the database was removed")
        self.assertTrue(store.exists())

    def test_acsd_logs_in_to_a_broker_with_the_password_in_its_file(self):
        stub = self.start_stub()
        passwords = self.line.folder / "passwords"
        passwords.touch(mode=0o600)
        subprocess.run(["mosquitto_passwd", "-b", passwords, "acsd", "secret"], check=True)
        self.line.start_broker(access=("allow_anonymous false", f"password_file {passwords}"))
        arm = self.line.start_arm(TIME_SCALE).wait_ready()
        for name, right in (("wrong", False), ("right", True)):
            file = self.line.folder / name
            file.touch(mode=0o600)
            file.write_text("secret\n" if right else "guess\n")
            acsd = self.line.start_acsd(stub.address, arm, "mqtt.username=acsd", f"mqtt.password_file={file}")
            address = acsd.wait_ready()["operator"]
            if right:
                self.wait_for_status(address, lambda status: status["links"]["mqtt"])
            else:
                self.wait_for_log(acsd, "check user name")
                self.assertFalse(self.read_status(address)["links"]["mqtt"])
            self.assertNotIn("can read", acsd.log.read_text())
            self.assertEqual(acsd.stop(), 0)
            self.line.forget(acsd)

    def test_a_plan_goes_over_mqtts_with_certificates_of_both_sides(self):
        """With an own CA; without its file the broker is rejected, and the log has the reason."""
        key, certificate = self.line.folder / "broker.key", self.line.folder / "broker.pem"
        subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes",
                        "-keyout", key, "-out", certificate, "-days", "2", "-subj", "/CN=broker",
                        "-addext", "subjectAltName=IP:127.0.0.1"], check=True, capture_output=True)
        broker_port = self.line.start_broker(access=(
            "allow_anonymous true", f"certfile {certificate}", f"keyfile {key}", f"cafile {certificate}",
            "require_certificate true"))
        url = f"mqtts://127.0.0.1:{broker_port}"
        arm = self.line.start_arm(TIME_SCALE).wait_ready()
        self.line.start("vda-sim", "--broker", url, "--tls-ca", certificate, "--tls-certificate", certificate,
                        "--tls-key", key, "--site", self.line.site_dir / "site.lif.json", "--time-scale", TIME_SCALE,
                        "--vehicle", "LR01,type=LR", "--vehicle", "CR01,type=CR").wait_ready()
        stub = self.start_stub()
        stranger = self.line.start_acsd(stub.address, arm, f"mqtt.url={url}")
        address = stranger.wait_ready()["operator"]
        self.wait_for_log(stranger, "certificate")
        self.assertFalse(self.read_status(address)["links"]["mqtt"])
        self.assertEqual(stranger.stop(), 0)
        self.line.forget(stranger)

        start = stub.count()
        self.line.start_acsd(stub.address, arm, f"mqtt.url={url}", f"mqtt.ca_file={certificate}",
                             f"mqtt.cert_file={certificate}", f"mqtt.key_file={key}").wait_ready()
        stub.wait_for("RobotStatusUpdate", lambda message: message.payload["robotStatus"] == "Idle", start)
        self.assertEqual(self.submit(stub, "P1")["result"], "Success")
        stub.wait_for("PlanReport", lambda message: message.payload["status"] == "Completed")

    def test_an_encrypted_key_is_reported_and_acsd_asks_for_no_passphrase(self):
        key, certificate = self.line.folder / "key.pem", self.line.folder / "certificate.pem"
        subprocess.run(["openssl", "req", "-x509", "-newkey", "rsa:2048", "-passout", "pass:secret", "-keyout", key,
                        "-out", certificate, "-days", "2", "-subj", "/CN=acsd"], check=True, capture_output=True)
        arm = self.start_robots()
        acsd = self.line.start_acsd(
            self.start_stub().address, arm, f"mqtt.url=mqtts://127.0.0.1:{self.line.broker_port}",
            f"mqtt.ca_file={certificate}", f"mqtt.cert_file={certificate}", f"mqtt.key_file={key}", stdin=subprocess.PIPE)
        self.addCleanup(acsd.process.stdin.close)
        acsd.wait_ready()
        self.wait_for_log(acsd, "cannot reach the MQTT broker")
        self.assertNotIn("pass phrase", acsd.log.read_text())
        acsd.send_signal(signal.SIGTERM)
        self.assertEqual(acsd.wait(DRAIN_SECONDS), 0)

    def test_sigterm_brings_all_reports_to_the_mcs_and_takes_no_more_plans(self):
        stub = self.start_stub()
        acsd = self.line.start_acsd(stub.address, self.start_robots(), "mcs.ack_timeout=200ms", "mcs.ack_retries=100",
                                    f"shutdown.drain_timeout={DRAIN_SECONDS}s")
        acsd.wait_ready()
        stub.wait_for("RobotStatusUpdate", lambda message: message.payload["robotStatus"] == "Idle")
        stub.unacknowledged = ("PlanReport",)
        self.assertEqual(self.submit(stub, "P1")["result"], "Success")
        _, held_back = stub.wait_for("PlanReport")
        start = stub.count()
        begun = time.monotonic()
        acsd.send_signal(signal.SIGTERM)
        stub.wait_for("AcsCommStateUpdate", lambda message: message.payload["isConnected"] is False, start)
        refusal = self.submit(stub, "P2")
        self.assertEqual((refusal["result"], refusal["message"]), ("Fail", "acsd draining for shutdown"))
        self.assertTrue(acsd.is_running())
        stub.unacknowledged = ()
        self.assertEqual(acsd.wait(DRAIN_SECONDS), 0)
        self.assertLess(time.monotonic() - begun, DRAIN_SECONDS)
        acsd.stop()  # closes its log
        self.line.forget(acsd)

        # Acknowledged reports are stored as such, and not sent again.
        start = stub.count()
        again = self.line.start_acsd(stub.address, {"stream": "127.0.0.1:1", "http": "127.0.0.1:1"})
        again.wait_ready()
        index, _ = stub.wait_for("TscStateUpdate", start=start)
        replayed = {message.body["transactionId"] for message in stub.get(start, index)
                    if message.command.endswith("Report")}
        self.assertNotIn(held_back.body["transactionId"], replayed)

    def test_trace_has_every_message_of_every_link(self):
        stub = self.start_stub()
        folder = self.line.folder / "trace"
        acsd = self.line.start_acsd(stub.address, self.start_robots(), arguments=("--trace", folder))
        addresses = acsd.wait_ready()
        http, commands = addresses["http"], addresses["operator"]
        stub.wait_for("RobotStatusUpdate", lambda message: message.payload["robotStatus"] == "Idle"
                      and message.payload["robotId"] == "LR01")
        self.assertEqual(self.submit(stub, "P1")["result"], "Success")
        stub.wait_for("PlanReport", lambda message: message.payload["status"] == "Completed")
        with urllib.request.urlopen(f"http://{http}/metrics", timeout=10) as response:
            metrics = response.read().decode()
        with urllib.request.urlopen(f"http://{commands}/v1/trace?limit=2", timeout=10) as response:
            newest = response.read().decode().splitlines()
        self.line.forget(acsd)
        self.assertEqual(acsd.stop(), 0)

        lines = [json.loads(line) for file in sorted(folder.iterdir()) for line in file.read_text().splitlines()]
        self.assertEqual([line for line in lines if line in map(json.loads, newest)], [json.loads(line) for line in newest])
        self.assertEqual(len(newest), 2)
        self.assertEqual([line["mono_us"] for line in lines], sorted(line["mono_us"] for line in lines))
        to_mcs = [json.loads(line["text"])["command"] for line in lines
                  if line["link"] == "mcs" and line["direction"] == "out"]
        self.assertEqual(to_mcs, [message.command for message in stub.get()])
        self.assertTrue(any(line["link"] == "mcs" and line["direction"] == "in" and "P1" in line["text"]
                            for line in lines))
        for direction, topic in (("in", "uagv/v2/ACS/LR01/state"), ("out", "uagv/v2/ACS/LR01/order")):
            self.assertTrue(any(line.get("topic") == topic and line["direction"] == direction
                                and line["robot"] == "LR01" and json.loads(line["text"]) for line in lines), topic)
        for direction in ("in", "out"):
            self.assertTrue(any(line["link"] == "arm" and line["direction"] == direction and line["robot"] == "CR01"
                                and json.loads(line["text"]) for line in lines))
        self.assertFalse([line for line in lines if line["link"] == "trace"])

        for figure in ('acsd_mcs_registered 1', 'acsd_mcs_connected 1', 'acsd_link_up{link="mqtt"} 1',
                       'acsd_plans{status="InProgress"} 0', 'acsd_robot_state{robot="LR01",state="Idle"} ',
                       'acsd_robot_battery{robot="LR01"} ', 'acsd_robot_last_seen_seconds{robot="CR01"} ',
                       'acsd_plan_duration_seconds_count{status="Completed"} 1',
                       'acsd_job_duration_seconds_count{action="CassetteLoad"} 1', 'acsd_arm_up{robot="CR01"} 1',
                       'acsd_mcs_ack_wait_seconds_count', 'acsd_store_commit_seconds_count',
                       'acsd_alarms_active{level="heavy"}', 'acsd_outbox_oldest_seconds',
                       'acsd_position_ticks_missed_total', 'acsd_trace_lost_total 0',
                       'acsd_log_lines_dropped_total 0'):
            self.assertIn(figure, metrics)
        self.assertNotIn("acsd_robot_oddities_total{", metrics)


if __name__ == "__main__":
    main()
