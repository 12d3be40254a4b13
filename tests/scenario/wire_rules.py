"""Rules for every message of an ACS in any scenario: checks mcs-sim's trace against MCS-ACS 1.4.1, independently of mcs-sim.
Numbers are those of the rules (R), of the decision register (D) and of the sections."""

import datetime
import json
import re
import statistics

TIME = re.compile(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}[+-]\d\d:\d\d")
UUID_4 = re.compile(r"[0-9a-f]{8}-[0-9a-f]{4}-4[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}")
PLACE = re.compile(r"[A-Z]+\d\d+(\.[A-Z]+\d\d+)*")
ERROR_CODE = re.compile(r"ACS-\d{4}|AGV-.+|ARM-.+")

PLAN_STATUS = {"Pending", "InProgress", "Paused", "Completed", "Failed", "Cancelled", "Aborted"}
ACTIVE_STATUS = {"Pending", "InProgress", "Paused"}
ROBOT_STATUS = {"Init", "Disconnected", "Manual", "Idle", "Moving", "Arrival", "Docking", "UnDocking", "Working",
                "Charging", "Error", "Stopped"}
WORDS = {
    ("PlanReport", "status"): PLAN_STATUS,
    ("StepReport", "status"): {"Pending", "Dispatched", "InProgress", "Completed", "Failed", "Skipped"},
    ("JobReport", "status"): {"Pending", "Instructed", "InProgress", "Completed", "Failed"},
    ("RobotStatusUpdate", "robotStatus"): ROBOT_STATUS,
    ("RobotStatusUpdate", "robotType"): {"LR", "CR"},
    ("TscStateUpdate", "state"): {"Auto", "Paused", "Pausing"},
    ("ErrorReport", "level"): {"heavy", "light"},
    **{(f"{control}ResultReport", "result"): {"Success", "Failed"}
       for control in ("Cancel", "Abort", "Pause", "Resume")},
}
RESULT_MEMBERS = ({"planId", "result", "message"}, set())
ERROR_MEMBERS = ({"robotId", "state", "errorCode", "level", "message"}, {"planId", "stepNo", "jobId"})
# Members that a payload has, and those that it may have.
MEMBERS = {
    "Registration": (set(), set()),
    "TscStateUpdate": ({"state"}, set()),
    "AcsCommStateUpdate": ({"isConnected"}, set()),
    "PlanReport": ({"planId", "status", "message"}, set()),
    "StepReport": ({"planId", "robotId", "stepNo", "status", "message"}, set()),
    "JobReport": ({"planId", "robotId", "stepNo", "jobId", "status", "message"}, set()),
    **{f"{control}ResultReport": RESULT_MEMBERS for control in ("Cancel", "Abort", "Pause", "Resume")},
    "ErrorReport": ERROR_MEMBERS,
    "RobotStatusUpdate": ({"robotId", "robotType", "robotStatus", "position", "carrierIds", "planId", "stepNo", "jobId",
                           "message"}, set()),
    "RobotPositionUpdate": ({"robots"}, set()),
}
PLAN_ENTRY = {"planId", "robotId", "status", "stepNo", "jobId", "currentAction", "startTime", "endTime"}
POSITION_SECONDS = 0.2
POSITIONS_FOR_A_MEDIAN = 20


def read_message(text):
    """The text itself if it is not JSON."""
    try:
        return json.loads(text)
    except ValueError:
        return text


def read_trace(path):
    """The lines of the trace, each with its text as `message`."""
    lines = [json.loads(line) for line in path.read_text().splitlines()]
    return [line | {"message": read_message(line["text"])} for line in lines]


def parse_time(text):
    return datetime.datetime.fromisoformat(text)


class WireRules:
    """Judges a trace; `violations` are sentences."""

    def __init__(self, offset=None):
        self._offset = offset
        self._texts = {}
        self._registered = set()
        self._opened = set()
        self.violations = []

    def judge(self, lines):
        for line in lines:
            message = line["message"]
            if line["direction"] == "in":
                self._judge_message(line["connection"], message)
            elif isinstance(message, dict):
                self._judge_sent(line["connection"], message)
        self._judge_answers(lines)
        self._judge_period(lines)
        return self.violations

    def _note(self, rule, message):
        self.violations.append(f"{rule}: {json.dumps(message)[:400]}")

    def _judge_sent(self, connection, message):
        if message.get("command") == "RegistrationAck" and message.get("result") == "Success":
            self._registered.add(connection)

    def _judge_message(self, connection, message):
        if not isinstance(message, dict) or not isinstance(message.get("command"), str):
            self._note("6.1: no message", message)
            return
        command = message["command"]
        if connection not in self._registered and command != "Registration":
            self._note("5: before the registration", message)
        if connection not in self._opened and command != "Registration":
            self._note("5: the first message is Registration", message)
        self._opened.add(connection)
        timestamp = message.get("timestamp", "")
        if not TIME.fullmatch(timestamp) or (self._offset is not None and not timestamp.endswith(self._offset)):
            self._note("R19: timestamp", message)
            return
        if command.endswith("Ack"):
            self._judge_ack(message)
        else:
            self._judge_request(message)

    def _judge_request(self, message):
        command, payload = message["command"], message.get("payload")
        if set(message) != {"command", "transactionId", "timestamp", "payload"} or command not in MEMBERS:
            self._note("6.1: envelope", message)
            return
        if not UUID_4.fullmatch(message["transactionId"]):
            self._note("D-12: transactionId", message)
        if self._texts.setdefault(message["transactionId"], message) != message:
            self._note("9: sent again, but otherwise", message)
        required, optional = MEMBERS[command]
        if not required <= set(payload) <= required | optional:
            self._note("D-13, D-27: members", message)
            return
        for (name, member), words in WORDS.items():
            if name == command and payload[member] not in words:
                self._note("3, D-1, D-3, D-8: word", message)
        self._judge_values(message)

    def _judge_values(self, message):
        command, payload = message["command"], message["payload"]
        if command == "ErrorReport":
            self._judge_error(payload, message)
        elif command == "RobotStatusUpdate":
            if payload["position"] is not None and not PLACE.fullmatch(payload["position"]):
                self._note("R17: position", message)
            if not payload["carrierIds"] or "" in payload["carrierIds"]:
                self._note("R13: carrierIds", message)
            if (payload["planId"] is None) != (payload["stepNo"] is None):
                self._note("5.9: planId without stepNo", message)
        elif command == "RobotPositionUpdate":
            for robot in payload["robots"]:
                if set(robot) != {"robotId", "x", "y", "angle", "battery"} or not 0 <= robot["angle"] < 360 \
                        or robot["battery"] != int(robot["battery"]) or not 0 <= robot["battery"] <= 100:
                    self._note("6.19: position", message)

    def _judge_error(self, error, message):
        if None in error.values():
            self._note("D-27: null in an error", message)
        if not ERROR_CODE.fullmatch(error["errorCode"]):
            self._note("D-30: errorCode", message)

    def _judge_ack(self, message):
        if set(message) != {"command", "transactionId", "timestamp", "result", "message", "payload"} \
                or message["result"] not in ("Success", "Fail"):
            self._note("6.1, D-1, D-2: Ack", message)
            return
        payload = message["payload"]
        if message["result"] == "Fail" and not message["message"]:
            self._note("6.1: a Fail without a reason", message)
        for entry in payload.get("plans", ()):
            self._judge_entry(entry, message)
        for error in payload.get("errors", ()):
            required, optional = ERROR_MEMBERS
            if not required <= set(error) <= required | optional or error["state"] is not True:
                self._note("6.17: error entry", message)
            self._judge_error(error, message)

    def _judge_entry(self, entry, message):
        active = message["command"] != "RequestAcsPlanHistoryAck"
        if set(entry) != PLAN_ENTRY or entry["status"] not in (ACTIVE_STATUS if active else PLAN_STATUS):
            self._note("R10: plan entry", message)
            return
        final = entry["status"] not in ACTIVE_STATUS
        if entry["startTime"] is None or (entry["endTime"] is not None) != final:
            self._note("R10, R11: times of a plan entry", message)
        elif not all(TIME.fullmatch(entry[name] or message["timestamp"]) for name in ("startTime", "endTime")):
            self._note("R19: times of a plan entry", message)
        elif parse_time(entry["endTime"] or message["timestamp"]) > parse_time(message["timestamp"]):
            self._note("D-28: endTime", message)
        completed = (entry["stepNo"], entry["jobId"], entry["currentAction"]) == (0, None, None)
        if completed != (entry["status"] == "Completed"):
            self._note("R11: stepNo, jobId and action of a plan entry", message)

    def _judge_answers(self, lines):
        """R1, R2: by command and transactionId. What went over a link that was lost may have none."""
        last = max((line["connection"] for line in lines), default=0)
        acks = {(line["message"].get("command"), line["message"].get("transactionId")) for line in lines
                if line["direction"] == "in" and isinstance(line["message"], dict)}
        for line in lines:
            message = line["message"]
            if line["direction"] != "out" or line["connection"] != last or not isinstance(message, dict):
                continue
            command = message.get("command", "")
            if command and not command.endswith("Ack") and (command + "Ack", message["transactionId"]) not in acks:
                self._note("R1, R2: no Ack", message)
            if command == "RobotPositionUpdateAck":
                self._note("R14: an Ack of a position", message)

    def _judge_period(self, lines):
        """R14, by the time of arrival; the median tolerates a busy machine."""
        times = {}
        for line in lines:
            if line["direction"] == "in" and isinstance(line["message"], dict) \
                    and line["message"].get("command") == "RobotPositionUpdate":
                times.setdefault(line["connection"], []).append(parse_time(line["time"]).timestamp())
        for connection, moments in times.items():
            periods = [later - earlier for earlier, later in zip(moments, moments[1:])]
            if len(periods) >= POSITIONS_FOR_A_MEDIAN \
                    and abs(statistics.median(periods) - POSITION_SECONDS) > POSITION_SECONDS / 4:
                self._note(f"R14: period {statistics.median(periods):.3f} s", f"connection {connection}")
