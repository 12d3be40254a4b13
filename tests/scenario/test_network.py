#!/usr/bin/env python3
"""Faults of the network and of a foreign MCS: MCS-ACS test vectors 9 to 12 over the test's own sockets."""

import contextlib
import datetime
import json
import os
import signal
import socket
import time
import unittest
import urllib.request

from mcs_stub import McsStub
from plan_samples import make_carrying_plan, make_tray_memory_plan
from scenario_case import ScenarioCase, main

POSITION_SECONDS = 0.2
BLOCKED_SECONDS = 10
# Linux gives at least twice 1152 bytes, of which a part is its own: some of the messages of 330 bytes.
SMALLEST_RECEIVE_BUFFER = 1
ANSWER_SECONDS = 2
REQUEST_PERIOD = 0.05
STOP_SECONDS = 8
MEMORY_MARGIN = 8 << 20
FINAL = ("Completed", "Failed", "Cancelled", "Aborted")


def get_resident_bytes(pid):
    with open(f"/proc/{pid}/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def get_sent_time(message):
    """The timestamp of acsd, in seconds."""
    return datetime.datetime.fromisoformat(message.body["timestamp"]).timestamp()


class Network(ScenarioCase):
    def start_stub(self, **options):
        stub = McsStub(**options)
        self.addCleanup(stub.close)
        return stub

    def start_acsd(self, stub, *overrides, **options):
        acsd = self.line.start_acsd(stub.address, self.start_robots(), *overrides, **options)
        acsd.wait_ready()
        return acsd

    @staticmethod
    def submit(stub, plan, **options):
        """Returns the Ack."""
        start = stub.count()
        stub.send_request("ExecutionPlan", plan, **options)
        return stub.wait_for("ExecutionPlanAck", lambda ack: ack.payload["planId"] == plan["planId"], start)[1].body

    @staticmethod
    def wait_for_idle(stub, robot, start=0):
        return stub.wait_for("RobotStatusUpdate", lambda message: message.payload["robotId"] == robot
                             and message.payload["robotStatus"] == "Idle", start)

    def assert_snapshot_after_replay(self, stub, connection, replayed):
        """6, Connect: Registration, what has no Ack, oldest first, the two states, each robot, then positions."""
        index, _ = stub.wait_for("RobotPositionUpdate", lambda message: message.connection == connection)
        messages = [message for message in stub.get(0, index) if message.connection == connection]
        self.assertEqual(messages[0].command, "Registration")
        states = next(i for i, message in enumerate(messages) if message.command == "TscStateUpdate")
        self.assertEqual([message.body["transactionId"] for message in messages[1:1 + len(replayed)]], replayed)
        self.assertTrue(all(message.command.endswith("Report") for message in messages[1:states]))
        rest = [message.command for message in messages[states:] if not message.command.endswith("Report")]
        self.assertEqual(rest[:4],
                         ["TscStateUpdate", "AcsCommStateUpdate", "RobotStatusUpdate", "RobotStatusUpdate"])
        robots = [message.payload["robotId"] for message in messages if message.command == "RobotStatusUpdate"]
        self.assertEqual(robots[:2], ["CR01", "LR01"])

    def test_13_10_a_closed_rejected_or_reset_link_loses_nothing(self):
        """Close 1008, 403 on the upgrade, RST in the middle of a frame: registration, replay, snapshot, and the plan
        has each of its reports once."""

        def refuse(stub):
            stub.refuse_upgrades(2)
            stub.close_link(1000)
            stub.wait_until_refused(2)

        breaks = {"close 1008": lambda stub: stub.close_link(1008), "403 on upgrade": refuse,
                  "RST mid-frame": lambda stub: stub.reset_link()}
        stub = self.start_stub()
        self.start_acsd(stub)
        self.wait_for_idle(stub, "LR01")
        for number, (name, break_link) in enumerate(breaks.items()):
            with self.subTest(name):
                plan = make_carrying_plan(f"P{number}")
                start, connection = stub.count(), stub.get(-1)[0].connection
                stub.withhold_acks_from("JobReport")
                self.assertEqual(self.submit(stub, plan)["result"], "Success")
                hold, _ = stub.wait_for("JobReport", start=start)
                stub.wait_until_acks_are_read()  # else a reset may take the last of them away
                break_link(stub)
                index, registration = stub.wait_for("Registration", start=hold)
                unanswered = list(dict.fromkeys(
                    message.body["transactionId"] for message in stub.get(hold, index)
                    if message.command.endswith("Report")))
                self.assertGreater(registration.connection, connection)
                self.assert_snapshot_after_replay(stub, registration.connection, unanswered)
                stub.wait_for("PlanReport", lambda message: message.payload["status"] in FINAL, start)
                self.assert_reported_once(stub.get(start), plan)

    def assert_reported_once(self, messages, plan):
        """By transactionId: a repeated report has the same transactionId."""
        reports = {message.body["transactionId"]: (message.command, *[
            message.payload.get(name) for name in ("stepNo", "jobId", "status")]) for message in messages
            if message.command in ("PlanReport", "StepReport", "JobReport")}
        expected = [("PlanReport", None, None, "InProgress")]
        for step in plan["steps"]:
            number = step["stepNo"]
            expected += [("StepReport", number, None, status) for status in ("Dispatched", "InProgress")]
            expected += [("JobReport", number, job["jobId"], status) for job in step["jobs"]
                         for status in ("Instructed", "InProgress", "Completed")]
            expected.append(("StepReport", number, None, "Completed"))
        expected.append(("PlanReport", None, None, "Completed"))
        self.assertEqual(list(reports.values()), expected)

    def test_13_11_a_long_plan_in_fragments_is_accepted_and_executed(self):
        stub = self.start_stub()
        self.start_acsd(stub)
        self.wait_for_idle(stub, "CR01")
        plan = make_tray_memory_plan("LONG", 75)
        ack = self.submit(stub, plan, fragments=3)
        self.assertEqual((ack["result"], ack["payload"]), ("Success", {"planId": "LONG"}))
        stub.wait_for("JobReport", lambda message: message.payload["status"] == "Completed"
                      and message.payload["jobId"] == plan["steps"][0]["jobs"][1]["jobId"])
        listed = stub.ask("RequestAcsPlans", {})
        self.assertEqual([entry["planId"] for entry in listed["payload"]["plans"]], ["LONG"])

    def test_13_12_a_blocked_socket_costs_no_memory_and_no_burst(self):
        """R14 too: before and after, positions come, at most every 200 ms."""
        environment = os.environ | {"ASAN_OPTIONS": os.environ.get("ASAN_OPTIONS", "") + ":quarantine_size_mb=1"}
        stub = self.start_stub(receive_buffer=SMALLEST_RECEIVE_BUFFER)
        acsd = self.start_acsd(stub, "mcs.ping_interval=60s", environment=environment)
        self.wait_for_idle(stub, "CR01")
        first, _ = stub.wait_for("RobotPositionUpdate")
        self.wait_for_positions(stub, first, 20)
        self.assert_no_burst(stub.get(first))
        before = get_resident_bytes(acsd.process.pid)
        stub.stop_reading()
        blocked = stub.count()
        time.sleep(BLOCKED_SECONDS)  # what the vector is about, not a wait for something
        grown = get_resident_bytes(acsd.process.pid) - before
        self.assertLess(grown, MEMORY_MARGIN)
        resumed = time.time()
        stub.resume_reading()
        fresh, _ = stub.wait_for("RobotPositionUpdate", lambda message: get_sent_time(message) > resumed, blocked)
        # Only what was in the socket buffers arrives late; nothing else was queued. The timestamps of acsd show when each
        # was sent, however slow this machine is.
        late = [message for message in stub.get(blocked, fresh) if message.command == "RobotPositionUpdate"]
        self.assertLess(len(late), BLOCKED_SECONDS / POSITION_SECONDS / 2)
        self.wait_for_positions(stub, fresh, 20)
        self.assert_no_burst(stub.get(fresh))
        self.assertEqual({message.connection for message in stub.get()}, {1}, "the link was dropped")

    @staticmethod
    def wait_for_positions(stub, start, count):
        for _ in range(count):
            start, _ = stub.wait_for("RobotPositionUpdate", start=start)
            start += 1

    def assert_no_burst(self, messages):
        """At most one per period, by the timestamps of acsd. On a slow machine there are fewer; unit tests and
        acsd_robots_load check the lower limit."""
        times = [get_sent_time(message) for message in messages if message.command == "RobotPositionUpdate"]
        self.assertEqual(times, sorted(times))
        self.assertLessEqual(len(times), (times[-1] - times[0]) / POSITION_SECONDS + 3)

    def test_13_9_an_ack_with_a_foreign_transaction_is_matched_by_its_command_and_counted(self):
        stub = self.start_stub()
        acsd = self.start_acsd(stub, "mcs.ack_timeout=2s")
        self.wait_for_idle(stub, "LR01")
        stub.unacknowledged = ("StepReport",)
        start = stub.count()
        self.assertEqual(self.submit(stub, make_carrying_plan("P"))["result"], "Success")
        _, report = stub.wait_for("StepReport", start=start)
        stub.send_request("StepReportAck", {}, envelope={"transactionId": "of-nobody", "result": "Success", "message": ""})
        stub.wait_for("StepReport", lambda message: message.payload["status"] == "Completed", start)
        stub.unacknowledged = ()
        stub.wait_for("PlanReport", lambda message: message.payload["status"] == "Completed", start)
        times = [message.body["transactionId"] for message in stub.get(start)]
        self.assertEqual(times.count(report.body["transactionId"]), 1, "it was sent again")
        with urllib.request.urlopen(f"http://{acsd.addresses['http']}/metrics", timeout=20) as response:
            self.assertIn('acsd_mcs_notes_total{what="ack with a foreign transactionId"} 1\n', response.read().decode())

    def assert_lively(self, acsd, requests=50):
        """Each request is answered in time, and the link to the broker is down."""
        for _ in range(requests):
            with urllib.request.urlopen(f"http://{acsd.addresses['http']}/livez", timeout=ANSWER_SECONDS) as response:
                self.assertEqual(response.status, 200)
            time.sleep(REQUEST_PERIOD)
        self.assertFalse(self.read_status(acsd.addresses["operator"])["links"]["mqtt"])

    def hold_resolver(self):
        """A file that is to be opened before names are resolved, and the environment of the program that waits for it."""
        library = self.line.bin_dir / "libscenario_held_resolver.so"
        if not library.exists():
            self.skipTest("not built with sanitizers")
        gate = self.line.folder / "resolver"
        os.mkfifo(gate)
        return gate, os.environ | {"LD_PRELOAD": str(library), "ACS_HELD_RESOLVER": str(gate)}

    def test_a_silent_name_server_does_not_stop_acsd(self):
        gate, environment = self.hold_resolver()
        stub = self.start_stub()
        arm = self.start_robots()
        url = f"mqtt.url=mqtt://broker.test:{self.line.broker_port}"
        acsd = self.line.start_acsd(stub.address, arm, url, environment=environment)
        address = acsd.wait_ready()["operator"]
        self.assert_lively(acsd)
        writer = os.open(gate, os.O_WRONLY)
        os.close(writer)
        self.wait_for_status(address, lambda status: status["links"]["mqtt"])
        self.wait_for_idle(stub, "LR01")

        # The next attempt hangs in the name server when acsd is to stop.
        self.line.broker.stop()
        self.line.forget(self.line.broker)
        self.wait_for_status(address, lambda status: not status["links"]["mqtt"])
        self.assert_lively(acsd)
        acsd.send_signal(signal.SIGTERM)
        self.assertEqual(acsd.wait(STOP_SECONDS), 0)

    def test_a_silent_name_server_of_the_mcs_delays_neither_an_arm_nor_a_stop(self):
        _, environment = self.hold_resolver()
        stub = self.start_stub()
        arm = self.start_robots()
        acsd = self.line.start_acsd(stub.address.replace("127.0.0.1", "mcs.test"), arm, environment=environment)
        address = acsd.wait_ready()["operator"]
        self.wait_for_status(address, lambda status: any(robot.get("armUp") for robot in status["robots"]))
        self.assertFalse(self.read_status(address)["links"]["mcs"])
        acsd.send_signal(signal.SIGTERM)
        self.assertEqual(acsd.wait(STOP_SECONDS), 0)

    def test_a_silent_name_server_of_one_broker_does_not_delay_the_next_broker(self):
        _, environment = self.hold_resolver()
        stub = self.start_stub()
        arm = self.start_robots()
        port = self.line.broker_port
        urls = [f"mqtt://broker.test:{port}", f"mqtt://127.0.0.1:{port}"]
        acsd = self.line.start_acsd(stub.address, arm, f"mqtt.urls={json.dumps(urls)}", config=self.write_cluster_config(),
                                    environment=environment)
        address = acsd.wait_ready()["operator"]
        for _ in range(2):
            self.wait_for_status(address, lambda status: status["links"]["mqtt"])
            self.line.broker.stop()
            self.line.forget(self.line.broker)
            self.wait_for_status(address, lambda status: not status["links"]["mqtt"])
            self.line.start_broker(port)  # the first attempt still hangs
        self.wait_for_status(address, lambda status: status["links"]["mqtt"])
        self.assertIn(f"trying 127.0.0.1:{port} next", acsd.log.read_text())
        acsd.send_signal(signal.SIGTERM)
        self.assertEqual(acsd.wait(STOP_SECONDS), 0)

    def test_a_broker_with_a_full_accept_queue_does_not_stop_acsd(self):
        arm = self.start_robots()
        stub = self.start_stub()
        with socket.create_server(("127.0.0.1", 0), backlog=0) as server, contextlib.ExitStack() as stack:
            port = server.getsockname()[1]
            for _ in range(4):
                client = stack.enter_context(socket.socket())
                client.setblocking(False)
                client.connect_ex(("127.0.0.1", port))
            for host in ("127.0.0.1", "localhost"):
                with self.subTest(host=host):
                    acsd = self.line.start_acsd(stub.address, arm, f"mqtt.url=mqtt://{host}:{port}")
                    acsd.wait_ready()
                    self.assert_lively(acsd)
                    acsd.send_signal(signal.SIGTERM)
                    self.assertEqual(acsd.wait(STOP_SECONDS), 0)
                    acsd.stop()
                    self.line.forget(acsd)


if __name__ == "__main__":
    main()
