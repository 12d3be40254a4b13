#!/usr/bin/env python3
"""Each rule of wire_rules.py finds its violation, and nothing else."""

import copy
import unittest
import uuid

from wire_rules import WireRules

STAMP = "2025-07-02T21:00:01.123+09:00"
STATUS = {"robotId": "LR01", "robotType": "LR", "robotStatus": "Idle", "position": "A01.CP01", "carrierIds": [None],
          "planId": None, "stepNo": None, "jobId": None, "message": ""}
ENTRY = {"planId": "P", "robotId": None, "status": "Pending", "stepNo": 1, "jobId": "J", "currentAction": "Start",
         "startTime": STAMP, "endTime": None}
ERROR = {"robotId": "LR01", "state": True, "errorCode": "ACS-1001", "level": "heavy", "message": "lost"}


def request(command, payload, **members):
    return {"command": command, "transactionId": str(uuid.uuid4()), "timestamp": STAMP, "payload": payload} | members


def ack(command, payload, **members):
    return request(command, payload, result="Success", message="") | members


def line(direction, message, moment="2025-07-02T21:00:02.000+09:00", connection=1):
    return {"time": moment, "direction": direction, "connection": connection, "message": message}


START = [line("in", request("Registration", {})), line("out", ack("RegistrationAck", {}))]


def judge(*messages):
    return WireRules("+09:00").judge(START + [line("in", message) for message in messages])


class Rules(unittest.TestCase):
    def assert_rule(self, rule, violations):
        self.assertTrue(any(rule in text.split(":")[0] for text in violations), (rule, violations))

    def test_a_valid_trace_has_no_violation(self):
        history = ENTRY | {"status": "Completed", "stepNo": 0, "jobId": None, "currentAction": None, "endTime": STAMP}
        lines = START + [line("out", request("RequestAcsPlans", {}, transactionId="T")), *[line("in", message) for message in (
            request("RobotStatusUpdate", STATUS),
            ack("RequestAcsPlansAck", {"plans": [ENTRY]}, transactionId="T"),
            ack("RequestAcsPlanHistoryAck", {"plans": [history]}), ack("RequestAcsErrorListAck", {"errors": [ERROR]}),
            ack("CancelPlanAck", {"planId": "P"}, result="Fail", message="unknown"))]]
        self.assertEqual(WireRules("+09:00").judge(lines), [])

    def test_each_rule_finds_its_violation(self):
        status = lambda **members: request("RobotStatusUpdate", STATUS | members)  # noqa: E731
        plans = lambda name="RequestAcsPlansAck", **members: ack(name, {"plans": [ENTRY | members]})  # noqa: E731
        errors = lambda **members: ack("RequestAcsErrorListAck", {"errors": [ERROR | members]})  # noqa: E731
        without_job = {name: value for name, value in STATUS.items() if name != "jobId"}
        plan = {"planId": "P", "status": "Completed", "message": ""}
        pose = {"robotId": "LR01", "x": 1, "y": 1, "angle": 0, "battery": 50}
        done = {"status": "Completed", "endTime": STAMP}
        rows = [
            ("6.1", "no JSON"), ("6.1", {"payload": {}}), ("6.1", request("PlanReport", plan, result=None)),
            ("6.1", request("Hello", {})), ("R19", request("PlanReport", plan, timestamp="2025-07-02T12:00:01.123Z")),
            ("R19", request("PlanReport", plan, timestamp="2025-07-02T21:00:01.123+01:00")),
            ("R19", plans(startTime="2025-07-02T12:00:00Z")), ("D-12", request("PlanReport", plan, transactionId="7")),
            ("D-13", request("PlanReport", plan | {"robotId": "LR01"})), ("D-27", request("RobotStatusUpdate", without_job)),
            ("D-8", request("PlanReport", plan | {"status": "Retrying"})), ("D-3", status(robotStatus="Arrived")),
            ("D-1", request("CancelResultReport", {"planId": "P", "result": "Fail", "message": ""})),
            ("R17", status(position="A1.CP1")), ("R13", status(carrierIds=[""])), ("5.9", status(planId="P")),
            ("6.19", request("RobotPositionUpdate", {"robots": [pose | {"angle": 360}]})),
            ("6.19", request("RobotPositionUpdate", {"robots": [pose | {"battery": 75.5}]})),
            ("D-2", ack("CancelPlanAck", {"planId": "P"}, result="success")),
            ("6.1", ack("CancelPlanAck", {"planId": "P"}, result="Fail")),
            ("R10", plans(**done)), ("R10", plans(endTime=STAMP)), ("D-28", plans(
                "RequestAcsPlanHistoryAck", status="Failed", endTime="2025-07-02T21:00:09.000+09:00")),
            ("R11", plans("RequestAcsPlanHistoryAck", **done)), ("R11", plans(stepNo=0, jobId=None, currentAction=None)),
            ("6.17", errors(state=False)), ("D-27", errors(planId=None)), ("D-30", errors(errorCode="E7")),
        ]
        for rule, message in rows:
            with self.subTest(rule=rule, message=message):
                self.assert_rule(rule, judge(message))

    def test_a_violation_over_several_messages_is_found(self):
        plan = request("PlanReport", {"planId": "P", "status": "Completed", "message": ""})
        changed = copy.deepcopy(plan) | {"timestamp": "2025-07-02T21:00:05.123+09:00"}
        self.assertEqual(judge(plan, plan), [])
        self.assert_rule("9", judge(plan, changed))
        self.assert_rule("5", WireRules().judge([line("in", plan)]))
        asked = line("out", request("CancelPlan", {"planId": "P"}, transactionId="T"))
        self.assert_rule("R1", WireRules().judge([*START, asked]))
        foreign = line("in", ack("CancelPlanAck", {"planId": "P"}, transactionId="X"))
        self.assert_rule("R2", WireRules().judge([*START, asked, foreign]))
        self.assertEqual(WireRules().judge([*START, asked, line("in", request("Registration", {}), connection=2)]), [])

    def test_the_period_of_the_positions_is_measured(self):
        def make(milliseconds):
            return START + [line("in", request("RobotPositionUpdate", {"robots": []}),
                                 f"2025-07-02T21:00:{number * milliseconds / 1000:06.3f}+09:00") for number in range(30)]

        texts = WireRules().judge(make(200))
        self.assertEqual(texts, [])
        self.assert_rule("R14", WireRules().judge(make(500)))
        self.assert_rule("R14", WireRules().judge(make(20)))


if __name__ == "__main__":
    unittest.main()
