"""A line whose acsd writes a message trace: for tests of what LR01 was commanded, what it reported and what was moved."""

import json
import signal
import time

from scenario_case import FINISH_SECONDS, PLANS, STATUS_SECONDS, ScenarioCase
import operator_api  # which scenario_case makes known

# Slow enough for a fault between two nodes, which are 2 m apart.
TIME_SCALE = 5
VEHICLES = ("LR01,type=LR", "CR01,type=CR,node=D-CHG02")


class TracedLineCase(ScenarioCase):
    def post(self, path, body=None):
        self.assertEqual(operator_api.post(self.operator, path, body, STATUS_SECONDS)[0], 202)

    def start_line(self, *faults, vehicles=VEHICLES, overrides=(), tables="", plans=(PLANS[0],), world=None):
        """The faults are those of the first vehicle, which has a process of its own, as each vehicle has."""
        self.line.share_world()
        if world is not None:
            self.line.world.write_text(json.dumps(world))
        self.line.start_broker()
        started = [self.line.start_vehicles(TIME_SCALE, (vehicle,), faults=faults if vehicle == vehicles[0] else ())
                   for vehicle in vehicles]
        for program in started:
            program.wait_ready()
        self.vehicle = started[0]
        self.arm = self.line.start_arm(TIME_SCALE).wait_ready()
        self.mcs = self.line.start_mcs(plans)
        self.mcs_address = self.mcs.wait_ready()["ws"]
        self.trace = self.line.folder / "trace"
        site = self.line.site_dir
        self.config = self.line.folder / "acsd.toml"
        self.config.write_text(
            (site / "acsd.toml").read_text().replace('"site.lif.json"', f'"{site / "site.lif.json"}"') + tables)
        self.overrides = overrides
        self.start_acsd()

    def start_acsd(self):
        self.acsd = self.line.start_acsd(self.mcs_address, self.arm, *self.overrides, config=self.config,
                                         arguments=("--trace", self.trace))
        addresses = self.acsd.wait_ready()
        self.http, self.operator = addresses["http"], addresses["operator"]

    def resume_with_all_vehicles(self):
        """With tsc.initial=paused: the first plan goes to the nearest vehicle, LR01, not to the first one that connects."""
        self.wait_for_status(self.operator, lambda status: all(
            robot["status"] not in ("Init", "Disconnected") for robot in status["robots"]))
        self.post("/v1/tsc/resume")

    def kill(self, program):
        self.line.forget(program)
        program.send_signal(signal.SIGKILL)
        program.stop()

    def read_moves(self):
        """(from, to) of each carrier that was moved, in the order of time."""
        journal = self.line.folder / "world.json.journal"
        lines = journal.read_text().splitlines(keepends=True) if journal.exists() else []
        events = [json.loads(line) for line in lines if line.endswith("\n")]
        return [(event["from"], event["to"]) for event in events if event["event"] == "CarrierMoved"]

    def finish(self, robot="LR01"):
        """The plan is completed, and everything was moved once, by this robot."""
        self.assertEqual(self.mcs.wait(FINISH_SECONDS), 0)
        self.assertEqual(self.mcs.tail(2), ["1 carriers delivered, 0 misplaced", "1 plans completed, 0 failed"])
        self.line.forget(self.acsd)
        self.acsd.stop()  # else the end of the trace may be missing
        self.assertEqual(self.read_moves(), [("A01.CP01", f"{robot}.CP01"), (f"{robot}.CP01", "A02.CP03")])

    def read_trace(self):
        """(direction, vehicle, topic, message) of each MQTT message; the last line may not be complete yet."""
        files = sorted(self.trace.iterdir()) if self.trace.exists() else []
        lines = [line for file in files for line in file.read_text().splitlines(keepends=True) if line.endswith("\n")]
        for entry in map(json.loads, lines):
            if entry["link"] == "mqtt":
                vehicle, topic = entry["topic"].split("/")[-2:]
                yield entry["direction"], vehicle, topic, json.loads(entry["text"] or "{}")

    def read_messages(self, direction, topic):
        """What acsd sent to or received from LR01 on the topic."""
        return [message for *place, message in self.read_trace() if place == [direction, "LR01", topic]]

    def find_last_state(self):
        states = self.read_messages("in", "state")
        return states[-1] if states else None

    def wait_for(self, is_due, what):
        deadline = time.monotonic() + FINISH_SECONDS
        while not is_due():
            self.assertLess(time.monotonic(), deadline, what)
            self.assertTrue(self.acsd.is_running(), "acsd has ended by itself")
            time.sleep(0.02)

    def has_error(self, error_type):
        state = self.find_last_state()
        return state is not None and any(error["errorType"] == error_type for error in state["errors"])

    def wait_for_error(self, error_type):
        """A fault of vda-sim holds the vehicle in a phase and shows this error."""
        self.wait_for(lambda: self.has_error(error_type), error_type)

    def read_drives(self):
        """The nodes of each order to LR01 that is a drive, in the order of sending."""
        return [order["nodes"] for order in self.read_messages("out", "order")
                if order["orderUpdateId"] == 0 and len(order["nodes"]) > 1]

    def read_actions(self):
        """The actionType of each job order to LR01, in the order of sending."""
        return [action["actionType"] for order in self.read_messages("out", "order") for node in order["nodes"]
                for action in node["actions"]]

    def assert_begins(self, nodes, *node_ids):
        self.assertEqual([node["nodeId"] for node in nodes[:len(node_ids)]], list(node_ids))
