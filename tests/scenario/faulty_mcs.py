"""An MCS that is correct except for one defect, for the test of acs-sim. It sends one plan after the other. DEFECTS names the rule
of acs-sim that each defect violates, and the faults of acs-sim that show it."""

import json
import uuid

from mcs_stub import TEXT, McsStub, make_frame, make_timestamp

FINAL = ("Completed", "Failed", "Cancelled", "Aborted")

# defect: (rule, faults)
DEFECTS = {
    "no-registration-ack": ("registration", ()),
    "registration-refused": ("registration", ()),
    "plan-before-registration": ("before-registration", ()),
    "no-registration-ack-after-reconnect": ("reconnect", ("reconnect",)),
    "not-json": ("json", ()),
    "no-payload": ("envelope", ()),
    "no-uuid": ("transaction-id", ()),
    "transaction-used-twice": ("transaction-id", ()),
    "bad-timestamp": ("timestamp", ()),
    "command-of-an-acs": ("command", ()),
    "history-without-ids": ("request-payload", ()),
    "no-ack": ("ack", ()),
    "ack-twice": ("ack-once", ()),
    "wrong-transaction": ("ack-transaction", ()),
    "wrong-ack-command": ("ack-command", ()),
    "unknown-result": ("ack-result", ()),
    "reports-refused": ("report-accepted", ()),
    "repeated-report-refused": ("report-repeated", ("duplicate-report",)),
    "forgets-at-reconnect": ("report-reconnect", ("reconnect",)),
    "accepts-bad-payload": ("undefined-payload", ("bad-payload",)),
    "no-answer-to-unknown-command": ("unknown-command", ("unknown-command",)),
    "dies-on-malformed": ("malformed-text", ("malformed",)),
    "silent-after-malformed": ("malformed-text", ("malformed",)),
    "position-ack": ("position", ()),
    "plan-without-steps": ("plan-payload", ()),
    "malformed-location": ("plan-location", ()),
    "unpadded-location": ("plan-location", ()),
    "step-used-twice": ("plan-steps", ()),
    "unknown-action": ("plan-action", ()),
    "load-from-a-robot": ("plan-action", ()),
    "carriers-of-memories": ("plan-carriers", ()),
    "duplicate-plan-id": ("plan-id", ()),
    "plan-while-not-connected": ("plan-withheld", ("not-connected=always",)),
    "control-of-unknown-plan": ("control", ()),
    "control-of-refused-plan": ("control", ("refuse-plan=2",)),
}


def make_plan():
    def make_job(start, end):
        return {"jobId": str(uuid.uuid4()), "from": start, "to": end}
    carriers = ["TRAY_01"]
    return {"planId": f"PLAN-{uuid.uuid4()}", "lotId": "LOT", "priority": 1, "steps": [
        {"stepNo": 1, "action": "TrayLoad", "position": "A01.CP01", "carrierIds": carriers,
         "jobs": [make_job("A01.CP01.TP01", "AMR.TP01")]},
        {"stepNo": 2, "action": "MemoryPickAndPlace", "position": "A01.SET01", "carrierIds": [],
         "jobs": [make_job("AMR.TP01.MP01", "A01.SET01.MP01")]},
        {"stepNo": 3, "action": "TrayUnload", "position": "A01.CP01", "carrierIds": carriers,
         "jobs": [make_job("AMR.TP01", "A01.CP01.TP02")]}]}


def spoil_plan(defect, plan):
    first = plan["steps"][0]
    if defect == "plan-without-steps":
        plan["steps"] = []
    elif defect == "malformed-location":
        first["jobs"][0]["from"] = "A01.XY01"
    elif defect == "unpadded-location":
        first["position"] = "A01.CP1"
    elif defect == "step-used-twice":
        plan["steps"][1]["stepNo"] = 1
    elif defect == "unknown-action":
        first["action"] = "Dance"
    elif defect == "load-from-a-robot":
        first["jobs"][0]["from"] = "AMR.TP02"
    elif defect == "carriers-of-memories":
        plan["steps"][1]["carrierIds"] = ["TRAY_01"]


class FaultyMcs(McsStub):
    """One ACS. All state belongs to the thread that reads the connection."""

    def __init__(self, defect=None):
        self.defect = defect
        self._plans = {}  # transactionId: plan
        self._open = None  # the transactionId of the plan that is executed
        self._is_answered = False  # the plan that is executed
        self._controls = {}  # transactionId: command and planId of what has no Ack yet
        self._seen = set()  # transactionIds of the ACS
        self._registrations = 0
        self._is_connected = True
        self._is_dead = False
        super().__init__()

    def _say(self, peer, message):
        self._send(peer, make_frame(TEXT, json.dumps(message).encode()))

    def _request(self, peer, command, payload, **members):
        request = {"command": command, "transactionId": str(uuid.uuid4()), "timestamp": make_timestamp(), "payload": payload}
        request |= members
        self._say(peer, request)
        return request["transactionId"]

    def _send_plan(self, peer):
        plan = make_plan()
        spoil_plan(self.defect, plan)
        self._open = self._request(peer, "ExecutionPlan", plan)
        self._plans[self._open] = plan
        self._is_answered = False

    def _control(self, peer, command, plan):
        self._controls[self._request(peer, command, {"planId": plan})] = command, plan

    def _begin(self, peer):
        if self._open is None and self._is_connected:
            self._send_plan(peer)

    def _take(self, peer, connection, payload):
        try:
            body = json.loads(payload)
        except ValueError:
            if self.defect == "dies-on-malformed":
                raise EOFError from None
            self._is_dead = self.defect == "silent-after-malformed"
            return
        if self._is_dead:
            return
        command = body["command"]
        if command.endswith("Ack"):
            self._take_ack(peer, body)
        elif command == "Registration":
            self._take_registration(peer, body)
        elif command == "RobotPositionUpdate":
            if self.defect == "position-ack":
                self._acknowledge(peer, body)
        else:
            self._take_report(peer, body)

    def _acknowledge(self, peer, body, result="Success", **members):
        self._say(peer, {"command": body["command"] + "Ack", "transactionId": body["transactionId"],
                         "timestamp": make_timestamp(), "result": result, "message": "", "payload": {}} | members)

    def _take_registration(self, peer, body):
        self._registrations += 1
        if self.defect == "plan-before-registration":
            self._send_plan(peer)
        if self.defect == "no-registration-ack" or (
                self.defect == "no-registration-ack-after-reconnect" and self._registrations > 1):
            return
        self._acknowledge(peer, body, "Fail" if self.defect == "registration-refused" else "Success")
        self._is_connected = True
        self._ask_after_registration(peer)
        if self._open is not None and not self._is_answered and self.defect != "plan-before-registration":
            self._request(peer, "ExecutionPlan", self._plans[self._open], transactionId=self._open)
        self._begin(peer)

    def _ask_after_registration(self, peer):
        if self.defect is None:
            self._request(peer, "RequestAcsPlans", {})
            for transaction, (command, plan) in self._controls.items():
                self._request(peer, command, {"planId": plan}, transactionId=transaction)
        elif self.defect == "not-json":
            self._send(peer, make_frame(TEXT, b"hello"))
        elif self.defect == "no-payload":
            self._say(peer, {"command": "RequestAcsPlans", "transactionId": str(uuid.uuid4()), "timestamp": make_timestamp()})
        elif self.defect == "no-uuid":
            self._request(peer, "RequestAcsPlans", {}, transactionId="17")
        elif self.defect == "transaction-used-twice":
            transaction = self._request(peer, "RequestAcsPlanHistory", {"planIds": ["A"]})
            self._request(peer, "RequestAcsPlanHistory", {"planIds": ["B"]}, transactionId=transaction)
        elif self.defect == "bad-timestamp":
            self._request(peer, "RequestAcsPlans", {}, timestamp="yesterday")
        elif self.defect == "command-of-an-acs":
            self._request(peer, "TscStateUpdate", {"state": "Auto"})
        elif self.defect == "history-without-ids":
            self._request(peer, "RequestAcsPlanHistory", {})
        elif self.defect == "control-of-unknown-plan":
            self._request(peer, "PausePlan", {"planId": "PLAN-UNKNOWN", "reason": ""})

    def _take_ack(self, peer, body):
        self._controls.pop(body["transactionId"], None)
        plan = self._plans.get(body["transactionId"])
        if plan is None or body["command"] != "ExecutionPlanAck":
            return
        self._is_answered = self._is_answered or body["transactionId"] == self._open
        if self.defect == "duplicate-plan-id" and len(self._plans) == 1:
            self._plans[self._request(peer, "ExecutionPlan", plan)] = plan
        elif body["result"] != "Success" and body["transactionId"] == self._open:
            if self.defect == "control-of-refused-plan":
                self._request(peer, "CancelPlan", {"planId": plan["planId"], "reason": ""})
            self._open = None
            self._begin(peer)

    def _take_report(self, peer, body):
        command, payload = body["command"], body["payload"]
        if command == "InventedCommand" and self.defect == "no-answer-to-unknown-command":
            return
        is_bad = command == "InventedCommand" or (command == "ErrorReport" and "robotId" not in payload)
        is_new = body["transactionId"] not in self._seen
        self._answer(peer, body, "Fail" if is_bad and self.defect != "accepts-bad-payload" else "Success")
        if command == "AcsCommStateUpdate":
            self._is_connected = payload["isConnected"]
            if not self._is_connected and self.defect == "plan-while-not-connected":
                self._send_plan(peer)
        elif command == "PlanReport" and payload.get("status") in FINAL and self._open is not None:
            if payload["planId"] == self._plans[self._open]["planId"]:
                self._open = None
        if self.defect is None and is_new:
            self._pause_and_resume(peer, command, payload)
        self._begin(peer)

    def _pause_and_resume(self, peer, command, payload):
        """In the first step of each plan."""
        if command == "StepReport" and (payload["stepNo"], payload["status"]) == (1, "InProgress"):
            self._control(peer, "PausePlan", payload["planId"])
        elif command == "PauseResultReport" and payload["result"] == "Success":
            self._control(peer, "ResumePlan", payload["planId"])

    def _answer(self, peer, body, result):
        is_report = body["command"].endswith("Report")
        is_repeated = body["transactionId"] in self._seen
        self._seen.add(body["transactionId"])
        members = {}
        if not is_report:
            pass
        elif self.defect == "no-ack":
            return
        elif self.defect == "ack-twice":
            self._acknowledge(peer, body, result)
        elif self.defect == "wrong-transaction":
            members["transactionId"] = str(uuid.uuid4())
        elif self.defect == "wrong-ack-command":
            members["command"] = "SyncConfigAck"
        elif self.defect == "unknown-result":
            result = "Done"
        elif self.defect == "reports-refused" or (self.defect == "repeated-report-refused" and is_repeated) or (
                self.defect == "forgets-at-reconnect" and self._registrations > 1):
            result = "Fail"
        self._acknowledge(peer, body, result, **members)
