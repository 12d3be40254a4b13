"""Faults of a real line, one at a time: each begins, is in the event feed, and ends. The tests that show how acsd names them
share this module."""

import json
import os
import signal
import urllib.request

from link_proxy import LinkProxy
from mcs_stub import McsStub
from plan_samples import make_carrying_plan, make_tray_memory_plan
from scenario_case import FINISH_SECONDS, STATUS_SECONDS, TIME_SCALE, ScenarioCase
import operator_api  # which scenario_case makes known

LR_VEHICLE, CR_VEHICLE = "LR01,type=LR", "CR01,type=CR,node=D-A02.CP01"


def has_alarm(changes, code):
    return any(alarm["errorCode"] == code for alarm in changes.get("alarms", []))


def find_links(changes):
    return changes.get("status", {}).get("links", [])


class FaultCase(ScenarioCase):
    """A line with a scripted MCS. Both robots are Idle when it has started."""

    def start_line(self, make_port=lambda port: port, overrides=(), **options):
        """The base of LR01 has a process of its own, and connects to the port that the function makes."""
        self.stub = McsStub()
        self.addCleanup(self.stub.close)
        self.line.start_broker()
        self.vehicle, other = (self.line.start_vehicles(TIME_SCALE, (vehicle,), port=port) for vehicle, port in (
            (LR_VEHICLE, make_port(self.line.broker_port)), (CR_VEHICLE, self.line.broker_port)))
        self.arm = self.line.start_arm(TIME_SCALE).wait_ready()
        for vehicle in (self.vehicle, other):
            vehicle.wait_ready()
        self.acsd = self.line.start_acsd(self.stub.address, self.arm, *overrides, **options)
        self.address = self.acsd.wait_ready()["operator"]
        for robot in ("LR01", "CR01"):
            self.stub.wait_for("RobotStatusUpdate", lambda message, robot=robot: message.payload["robotId"] == robot
                               and message.payload["robotStatus"] == "Idle")

    def submit(self, plan):
        self.assertEqual(self.stub.ask("ExecutionPlan", plan)["result"], "Success")

    def wait_for_plan(self, plan_id, status):
        self.stub.wait_for("PlanReport", lambda message: message.payload["planId"] == plan_id
                           and message.payload["status"] == status)

    def post(self, path, body=None, expected=202):
        answer = operator_api.post(self.address, path, body)
        self.assertEqual(answer[0], expected, answer)
        return answer[1]

    def read_changes(self):
        """The changes of the event feed from now on, as they come."""
        return self.follow_changes(self.read_json("/v1/snapshot")["eventId"])

    def read_json(self, path):
        with urllib.request.urlopen(f"http://{self.address}{path}", timeout=STATUS_SECONDS) as response:
            return json.load(response)

    def follow_changes(self, after):
        with urllib.request.urlopen(f"http://{self.address}/v1/events?after={after}", timeout=FINISH_SECONDS) as feed:
            event = None
            for line in feed:
                if line.startswith(b"event: "):
                    event = line[7:].strip()
                elif line.startswith(b"data: ") and event == b"changes":
                    yield json.loads(line[6:])

    def begin(self, fault):
        """Returns the changes after those that have the fault first."""
        changes = self.read_changes()
        fault.begin()
        for change in changes:
            if fault.is_in(change):
                break
        return changes

    def wait_until_over(self, fault):
        """After its end the plans complete, and acsd has nothing to report."""
        for plan in fault.plans:
            self.wait_for_plan(plan, "Completed")
        self.wait_for_status(self.address, lambda status: not status["notReadyReasons"] and not status["alarms"])


class LineFault:
    """`cause` and `remedy` are parts of what acsctl prints about acsd and about the last of the plans; both are set when the
    fault has begun."""

    plans = ("P1",)
    code = None  # of the alarm; without one the page shows the fault elsewhere
    cause, remedy = "", ""

    def __init__(self, case):
        self.case = case

    def start(self):
        """The line, with a plan in progress."""
        self.case.start_line()
        self.start_plan()

    def start_plan(self):
        self.case.submit(make_carrying_plan("P1"))
        self.case.wait_for_plan("P1", "InProgress")

    def begin(self):
        raise NotImplementedError

    def is_in(self, changes):
        """Whether these changes of the event feed have the fault."""
        return has_alarm(changes, self.code)

    def end(self):
        raise NotImplementedError


class BrokerGone(LineFault):
    cause, remedy = "The link mqtt is down", "Check the MQTT broker and the network to it."

    def begin(self):
        line = self.case.line
        self._port = line.broker_port
        line.forget(line.broker)
        line.broker.stop()

    def is_in(self, changes):
        return any(link["name"] == "mqtt" and not link["up"] for link in find_links(changes))

    def end(self):
        self.case.line.start_broker(self._port)


class RegistrationRefused(LineFault):
    cause, remedy = "Refused by the test", "it must accept the registration of this ACS"

    def begin(self):
        self.case.stub.refused = ("Registration",)
        self.case.stub.reset_link()

    def is_in(self, changes):
        return any(not link["up"] and self.cause in (link["reason"] or "") for link in find_links(changes))

    def end(self):
        self.case.stub.refused = ()


class ReportsRefused(LineFault):
    cause, remedy = "of plan P1: Refused by the test.", "Correct the plan in the MCS"

    def start(self):
        self.case.start_line()

    def begin(self):
        self.case.stub.refused = ("JobReport", "StepReport")
        self.case.submit(make_carrying_plan("P1"))

    def is_in(self, changes):
        return changes.get("status", {}).get("refusedReports", {}).get("count", 0) > 0

    def end(self):
        self.case.stub.refused = ()


class EdgeBlocked(LineFault):
    """All edges to the first station of the plan."""

    def start(self):
        self.case.start_line()

    def begin(self):
        site = self.case.read_json("/v1/site")
        docks = next(station["nodeIds"] for station in site["stations"] if station["stationId"] == "A01.CP01")
        self.edges = [edge["edgeId"] for edge in site["edges"] if edge["endNodeId"] in docks]
        self.cause, self.remedy = f"Edge {self.edges[0]} is blocked", f"acsctl unblock edge {self.edges[0]}"
        for edge in self.edges:
            self.case.post("/v1/site/block", {"kind": "edge", "id": edge, "reason": "wet floor"})
        self.case.submit(make_carrying_plan("P1"))

    def is_in(self, changes):
        return any(plan["waits"] for plan in changes.get("plans", []))

    def end(self):
        for edge in self.edges:
            self.case.post("/v1/site/unblock", {"kind": "edge", "id": edge})


class StationBlocked(LineFault):
    """That of the second step, while the robot executes the first one: it waits there."""

    code = "ACS-1015"
    place = {"kind": "station", "id": "A01.CP02"}
    cause, remedy = "Station A01.CP02 is blocked", "acsctl unblock station A01.CP02"

    def start(self):
        self.case.start_line(overrides=("drive.wait_timeout=1s",))
        self.start_plan()

    def begin(self):
        self.case.post("/v1/site/block", {**self.place, "reason": "wet floor"})

    def end(self):
        self.case.post("/v1/site/unblock", self.place)


class VehicleLost(LineFault):
    """The network to the vehicle is interrupted."""

    code = "ACS-1002"
    cause, remedy = "ACS-1002 Robot disconnected of LR01", "Check power, network and broker"

    def start(self):
        self.case.start_line(self._make_port)
        self.start_plan()

    def _make_port(self, port):
        self._proxy = LinkProxy(port)
        self.case.addCleanup(self._proxy.close)
        return self._proxy.port

    def begin(self):
        self._proxy.cut()

    def end(self):
        self._proxy.mend()


class VehicleKilled(LineFault):
    """The controller of the vehicle ends without a farewell: the broker publishes its will, CONNECTIONBROKEN."""

    code = "ACS-1002"
    cause, remedy = VehicleLost.cause, VehicleLost.remedy

    def begin(self):
        self.case.line.forget(self.case.vehicle)
        self.case.vehicle.send_signal(signal.SIGKILL)
        self.case.vehicle.stop()

    def end(self):
        """It is started again where it was."""
        node = self.case.read_json("/v1/robots/LR01")["node"]
        self.case.line.start_vehicles(TIME_SCALE, (f"{LR_VEHICLE},node={node}",)).wait_ready()


class ArmMotorOff(LineFault):
    """The emergency stop of the arm is pressed."""

    code = "ARM-motorOff"
    cause, remedy = "ARM-motorOff Arm motor off of CR01", "Release the emergency stop"

    def start(self):
        self.case.start_line()

    def press(self, value):
        request = urllib.request.Request(f"http://{self.case.arm['http']}/project/robot/emergency_stop",
                                         data=json.dumps({"val": value}).encode(), headers={"Content-Type": "application/json"})
        urllib.request.urlopen(request, timeout=STATUS_SECONDS).close()

    def begin(self):
        self.press(1)
        self.case.wait_for_status(self.case.address, lambda status: has_alarm(status, self.code))
        self.case.submit(make_tray_memory_plan("P1", 2))

    def end(self):
        self.press(0)


class DiskFull(LineFault):
    """No file of the store can be written. P2 waits for LR01, which executes P1."""

    plans = ("P1", "P2")
    code = "ACS-1005"
    cause = "ACS-1005 Store failing of acsd"

    def start(self):
        library = self.case.line.bin_dir / "libscenario_full_disk.so"
        if not library.exists():
            self.case.skipTest("not built with sanitizers")
        self.directory = self.case.line.folder / "store"
        self._switch = self.case.line.folder / "store.full"
        self.remedy = f"free space on the disk of {self.directory}"
        self.environment = os.environ | {"LD_PRELOAD": str(library), "ACS_FULL_DISK": str(self.directory)}
        self.case.start_line(environment=self.environment)
        self.start_plan()
        self.case.submit(make_carrying_plan("P2"))

    def begin(self, only=""):
        """With the name of a function only this one fails."""
        self._switch.write_text(only)

    def end(self):
        self._switch.unlink()
