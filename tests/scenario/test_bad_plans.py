#!/usr/bin/env python3
"""MCS-ACS 4.1, 10 and 13: every plan that acsd rejects, with the field and the reason that it names, and every oddity
that it accepts, over a real socket. The TSC is paused, so that accepted plans stay in the queue."""

import copy
import json
import unittest

from mcs_stub import McsStub
from plan_samples import make_carrying_plan, make_memory_plan
from scenario_case import FINISH_SECONDS, ScenarioCase, main

ABSENT = object()
LONGEST_ID = 128


def make_set_plan(plan_id="P"):
    return {"planId": plan_id, "lotId": "LOT", "steps": [
        {"stepNo": 1, "action": "OpenSetCover", "position": "A01.SET01", "jobs": [{"jobId": plan_id + "-1"}]}]}


def make_tray_plan(plan_id="P"):
    return {"planId": plan_id, "lotId": "LOT", "steps": [
        {"stepNo": 1, "action": "TrayLoad", "position": "A01.CP01", "carrierIds": ["T"],
         "jobs": [{"jobId": plan_id + "-1", "from": "A01.CP01.TP01", "to": "AMR.TP01"}]},
        {"stepNo": 2, "action": "TrayUnload", "position": "A01.CP02", "carrierIds": ["T"],
         "jobs": [{"jobId": plan_id + "-2", "from": "AMR.TP01", "to": "A01.CP02.TP01"}]}]}


def change(plan, path, value):
    """A copy whose member at the path ("steps.0.jobs") is replaced or removed."""
    plan = copy.deepcopy(plan)
    *parents, last = [int(part) if part.isdigit() else part for part in path.split(".")]
    target = plan
    for parent in parents:
        target = target[parent]
    if value is ABSENT:
        del target[last]
    else:
        target[last] = value
    return plan


def make_refusals():
    """(the error, payload, words of the message: the field first)."""
    carrying, trays, memory = make_carrying_plan("P"), make_tray_plan(), make_memory_plan("P", 2)
    rows = [(f"payload {json.dumps(payload)}", payload, ["payload"]) for payload in (None, [], "plan", 7, True)]
    rows += [
        ("planId missing", change(carrying, "planId", ABSENT), ["planId"]),
        ("planId null", change(carrying, "planId", None), ["planId"]),
        ("planId empty", change(carrying, "planId", ""), ["planId"]),
        ("planId a list", change(carrying, "planId", ["P"]), ["planId"]),
        ("planId too long", change(carrying, "planId", "P" * (LONGEST_ID + 1)), ["planId", str(LONGEST_ID)]),
        ("planId with a line break", change(carrying, "planId", "P\n1"), ["planId", "control characters"]),
        ("lotId with an escape", change(carrying, "lotId", "\x1b[2J"), ["lotId", "control characters"]),
        ("carrierId with a tab", change(carrying, "steps.0.carrierIds", ["C\t"]),
         ["steps[0].carrierIds[0]", "control characters"]),
        ("jobId with U+007F", change(carrying, "steps.0.jobs.0.jobId", "J\x7f"),
         ["steps[0].jobs[0].jobId", "control characters"]),
        ("steps missing", change(carrying, "steps", ABSENT), ["steps"]),
        ("steps empty", change(carrying, "steps", []), ["steps", "0"]),
        ("steps an object", change(carrying, "steps", {}), ["steps"]),
        ("a step that is a text", change(carrying, "steps.1", "step"), ["steps[1]"]),
        ("stepNo missing", change(carrying, "steps.1.stepNo", ABSENT), ["steps[1].stepNo"]),
        ("stepNo null", change(carrying, "steps.1.stepNo", None), ["steps[1].stepNo"]),
        ("stepNo 0", change(carrying, "steps.0.stepNo", 0), ["stepNo", "from 1", "0"]),
        ("stepNo -1", change(carrying, "steps.0.stepNo", -1), ["stepNo", "-1"]),
        ("stepNo 1.5", change(carrying, "steps.0.stepNo", 1.5), ["steps[0].stepNo"]),
        ("stepNo twice", change(carrying, "steps.1.stepNo", 1), ["steps[1].stepNo", "unique"]),
        ("jobId missing", change(carrying, "steps.0.jobs.0.jobId", ABSENT), ["steps[0].jobs[0].jobId"]),
        ("jobId empty", change(carrying, "steps.0.jobs.0.jobId", ""), ["steps[0].jobs[0].jobId"]),
        ("jobId twice", change(carrying, "steps.1.jobs.0.jobId", "P-1"), ["steps[1].jobs[0].jobId", "unique", "P-1"]),
        ("jobId too long", change(carrying, "steps.0.jobs.0.jobId", "J" * (LONGEST_ID + 1)), ["steps[0].jobs[0].jobId"]),
        ("carrierId too long", change(carrying, "steps.0.carrierIds", ["C" * (LONGEST_ID + 1)]),
         ["steps[0].carrierIds[0]"]),
        ("priority a word", change(carrying, "priority", "high"), ["priority"]),
        ("action missing", change(carrying, "steps.0.action", ABSENT), ["steps[0].action"]),
        ("action unknown", change(carrying, "steps.0.action", "Fly"), ["steps[0].action", "CassetteLoad", "Fly"]),
        ("position missing", change(carrying, "steps.0.position", ABSENT), ["steps[0].position"]),
        ("position no location", change(carrying, "steps.0.position", "over there"), ["steps[0].position"]),
        ("position number 00", change(carrying, "steps.0.position", "A01.CP00"), ["steps[0].position", "A01.CP00"]),
        ("position off the map", change(carrying, "steps.0.position", "A09.CP01"), ["steps[0].position", "A09.CP01"]),
        ("position a set of no area", change(make_set_plan(), "steps.0.position", "SET99"),
         ["steps[0].position", "SET99"]),
        ("from no location", change(carrying, "steps.0.jobs.0.from", "A01..CP01"), ["steps[0].jobs[0].from"]),
        ("from off the map", change(carrying, "steps.0.jobs.0.from", "A01.CP77"),
         ["steps[0].jobs[0].from", "A01.CP77"]),
        ("to a port that no robot has", change(carrying, "steps.0.jobs.0.to", "AMR.CP09"), ["AMR.CP09"]),
        ("to missing", change(carrying, "steps.1.jobs.0.to", ABSENT), ["steps[1].jobs[0].to", "nothing"]),
        ("jobs of a load missing", change(carrying, "steps.0.jobs", ABSENT), ["steps[0].jobs", "CassetteLoad"]),
        ("jobs of a load empty", change(carrying, "steps.0.jobs", []), ["steps[0].jobs", "CassetteLoad"]),
        ("jobs of an unload null", change(carrying, "steps.1.jobs", None), ["steps[1].jobs", "CassetteUnload"]),
        ("jobs of a tray load empty", change(trays, "steps.0.jobs", []), ["steps[0].jobs", "TrayLoad"]),
        ("jobs of a tray unload empty", change(trays, "steps.1.jobs", []), ["steps[1].jobs", "TrayUnload"]),
        ("jobs of a pick and place empty", change(memory, "steps.0.jobs", []),
         ["steps[0].jobs", "MemoryPickAndPlace"]),
        # 13.3
        ("a robot that there is not", change(carrying, "steps.0.jobs.0.to", "RBT01.CP01"),
         ["steps[0].jobs[0].to", "RBT01"]),
        ("two robots", change(change(carrying, "steps.0.jobs.0.to", "LR01.CP01"), "steps.1.jobs.0.from", "CR01.CP01"),
         ["CR01", "LR01"]),
        ("a robot of the other type", change(trays, "steps.0.jobs.0.to", "LR01.TP01"), ["LR01"]),
        ("work of both types", change(carrying, "steps.1", make_set_plan("Q")["steps"][0] | {"stepNo": 2}),
         ["steps[1].action", "LR", "OpenSetCover"]),
    ]
    # From or to of the wrong kind, for each action that has them.
    for plan, places in ((carrying, ("A01.CP01.TP01", "AMR.TP01", "A01.SET01.MP01")),
                         (trays, ("A01.CP01", "AMR.CP01", "A01.SET01.MP01")),
                         (memory, ("A01.CP01", "AMR.TP01", "A01.SET01"))):
        for step in range(len(plan["steps"])):
            for end in ("from", "to"):
                rows += [(f"{plan['steps'][step]['action']} {end} {place}",
                          change(plan, f"steps.{step}.jobs.0.{end}", place), [f"steps[{step}].jobs[0].{end}", place])
                         for place in places]
    return rows


def make_oddities():
    """(the oddity, payload): 4.1 "not refused", the tolerance of section 2, the grammar of section 10, D-rows."""
    carrying, trays, cover = make_carrying_plan("P"), make_tray_plan(), make_set_plan()
    rows = [("nothing", carrying), ("nothing of the other robot", trays)]
    for action in ("OpenSetCover", "CloseSetCover", "Start"):
        plan = change(cover, "steps.0.action", action)
        rows += [(f"{action}, jobs {name}", change(plan, "steps.0.jobs", jobs)) for name, jobs in (
            ("absent", ABSENT), ("null", None), ("empty", []), ("without places", [{"jobId": "J"}]),
            ("with null and empty places", [{"jobId": "J", "from": None, "to": ""}]),
            ("with places", [{"jobId": "J", "from": "A01.CP01", "to": "AMR.CP01"}]),
            ("with invalid places", [{"jobId": "J", "from": "left", "to": "right"}]))]
    lower = json.loads(json.dumps(carrying).replace("A01.CP0", "a01.cp").replace("AMR.CP01", "amr.cp1"))
    rows += [
        ("carrierIds absent", change(carrying, "steps.0.carrierIds", ABSENT)),
        ("carrierIds null", change(carrying, "steps.0.carrierIds", None)),
        ("carrierIds empty", change(carrying, "steps.0.carrierIds", [])),
        ("R18: carrierIds of a pick and place empty", change(make_memory_plan("P", 1), "steps.0.carrierIds", [])),
        ("R18: carrierIds of a pick and place absent", make_memory_plan("P", 1)),
        ("a gap in stepNo", change(carrying, "steps.1.stepNo", 7)),
        ("steps out of order", change(carrying, "steps", carrying["steps"][::-1])),
        ("lotId absent", change(carrying, "lotId", ABSENT)),
        ("lotId null", change(carrying, "lotId", None)),
        ("priority absent", change(carrying, "priority", ABSENT)),
        ("priority null", change(carrying, "priority", None)),
        ("D-6: priority a numeric text", change(carrying, "priority", "5")),
        ("priority 0", change(carrying, "priority", 0)),
        ("stepNo a numeric text", change(carrying, "steps.0.stepNo", "1")),
        ("an unknown member", change(carrying, "color", "green")),
        ("D-12: a jobId that is no UUID", change(carrying, "steps.0.jobs.0.jobId", "a4184b0d-bc13-4eb2-b9e2-2ab3a150a1c12")),
        ("the longest planId", change(carrying, "planId", "P" * LONGEST_ID)),
        ("an action in lower case", change(carrying, "steps.0.action", "cassetteload")),
        ("R17: locations in lower case and without padding", lower),
        ("13.4: alias and id of one robot", change(carrying, "steps.0.jobs.0.to", "LR01.CP01")),
        ("D-29: a tray port as position", change(trays, "steps.0.position", "A01.CP01.TP01")),
        ("D-29: a memory port as position", change(cover, "steps.0.position", "A01.SET01.MP01")),
        ("10: a set without area, of the position's",
         change(make_memory_plan("P", 1), "steps.0.jobs.0.to", "SET01.MP15")),
        ("10: from set to tray", change(change(make_memory_plan("P", 1), "steps.0.jobs.0.from", "A01.SET01.MP01"),
                                        "steps.0.jobs.0.to", "AMR.TP01.MP01")),
    ]
    return rows


class BadPlans(ScenarioCase):
    def start_acsd(self, *overrides):
        """A stub whose ACS is registered and begins no plan; this needs no robot."""
        stub = McsStub()
        self.addCleanup(stub.close)
        self.line.broker_port = 1
        self.acsd = self.line.start_acsd(stub.address, {"stream": "127.0.0.1:1", "http": "127.0.0.1:1"}, *overrides)
        self.acsd.wait_ready()
        stub.wait_for("RobotPositionUpdate")
        return stub

    def list_plans(self, stub):
        return [plan["planId"] for plan in stub.ask("RequestAcsPlans", {})["payload"]["plans"]]

    def test_an_invalid_plan_is_rejected_with_field_and_reason(self):
        stub = self.start_acsd("tsc.initial=paused")
        for name, payload, words in make_refusals():
            with self.subTest(name):
                ack = stub.ask("ExecutionPlan", payload)
                self.assertEqual(ack["result"], "Fail", ack)
                for word in words:
                    self.assertIn(word, ack["message"])
        with self.subTest("no payload"):
            start = stub.count()
            stub.send_text('{"command":"ExecutionPlan","transactionId":"T","timestamp":"2025-07-02T21:00:00+09:00"}')
            ack = stub.wait_for("ExecutionPlanAck", start=start)[1].body
            self.assertEqual((ack["transactionId"], ack["result"]), ("T", "Fail"))
        self.assertEqual(self.list_plans(stub), [], "nothing is queued")
        self.assertEqual([message.command for message in stub.get() if message.command.endswith("Report")], [])

    def test_a_plan_with_oddities_is_accepted(self):
        stub = self.start_acsd("tsc.initial=paused")
        accepted = []
        for number, (name, payload) in enumerate(make_oddities()):
            with self.subTest(name):
                text = json.dumps(payload)
                plan_id = payload["planId"] if len(payload["planId"]) > 1 else f"P{number}"
                ack = stub.ask("ExecutionPlan", json.loads(text) | {"planId": plan_id})
                self.assertEqual((ack["result"], ack["payload"]), ("Success", {"planId": plan_id}), ack)
                accepted.append(plan_id)
        self.assertEqual(sorted(self.list_plans(stub)), sorted(accepted))

    def test_a_plan_with_an_odd_envelope_is_accepted(self):
        """Section 2 and 13.1: the request is decoded as intended."""
        stub = self.start_acsd("tsc.initial=paused")
        rows = {
            "13.1: result and message null": {"result": None, "message": None},
            "a foreign member": {"sender": "MCS"},
            "Z": {"timestamp": "2025-07-02T12:00:00Z"},
            "seven digits": {"timestamp": "2025-07-02T21:00:00.1234567+09:00"},
            "an offset without a colon": {"timestamp": "2025-07-02T21:00:00+0900"},
            "no offset": {"timestamp": "2025-07-02T21:00:00"},
            "no time": {"timestamp": "noon"},
            "no timestamp": {"timestamp": None},
            "a transactionId that is no UUID": {"transactionId": "7"},
            "a command in lower case": {"command": "executionplan"},
        }
        for number, (name, members) in enumerate(rows.items()):
            with self.subTest(name):
                start = stub.count()
                transaction = stub.send_request("ExecutionPlan", make_carrying_plan(f"E{number}"), envelope=members)
                ack = stub.wait_for("ExecutionPlanAck", start=start)[1].body
                self.assertEqual((ack["transactionId"], ack["result"]), (transaction, "Success"), ack)
        for name, prefix, suffix in (("a BOM", "\ufeff", ""), ("white space", " \r\n\t", "\n\n")):
            with self.subTest(name):
                request = {"command": "ExecutionPlan", "transactionId": name, "timestamp": "2025-07-02T21:00:00+09:00",
                           "payload": make_carrying_plan(name)}
                start = stub.count()
                stub.send_text(prefix + json.dumps(request) + suffix)
                ack = stub.wait_for("ExecutionPlanAck", start=start)[1].body
                self.assertEqual((ack["transactionId"], ack["result"]), (name, "Success"), ack)

    def test_what_is_no_json_is_ignored_and_the_connection_continues(self):
        """Section 2 and D-11: nothing to acknowledge, and no second registration."""
        stub = self.start_acsd("tsc.initial=paused")
        good = json.dumps({"command": "RequestAcsPlans", "transactionId": "T", "timestamp": "", "payload": {}})
        texts = ["", "plan", "[1,2]", "7", "null", '{"transactionId":"x"}', '{"command":7}', good[:-1],
                 good[:-1] + ",}", "// plan\n" + good, good + "}", '{"command":"RequestAcsPlans",' + good[1:]]
        start = stub.count()
        for text in texts:
            if text:
                stub.send_text(text)
        self.assertEqual(stub.ask("RequestAcsPlans", {})["result"], "Success")
        acks = [message.body for message in stub.get(start) if message.command.endswith("Ack")]
        # The one with a duplicate command is answered, but not executed.
        self.assertEqual([ack["result"] for ack in acks if ack["result"] == "Success"], ["Success"], acks)
        self.assertEqual([m for m in stub.get(start) if m.command == "Registration"], [])

    def test_r4_a_known_plan_and_one_beyond_the_queue_are_rejected(self):
        stub = self.start_acsd("tsc.initial=paused", "queue.max_plans=2")
        first = make_carrying_plan("P1")
        for plan in (first, make_carrying_plan("P2")):
            self.assertEqual(stub.ask("ExecutionPlan", plan)["result"], "Success")
        for plan, word in ((make_carrying_plan("P3"), "Queue Full"), (first, "Duplicated Plan")):
            ack = stub.ask("ExecutionPlan", plan)
            self.assertEqual((ack["result"], ack["payload"]), ("Fail", {"planId": plan["planId"]}))
            self.assertIn(word, ack["message"])
        self.assertEqual(self.list_plans(stub), ["P1", "P2"])

    def test_13_5_the_same_message_again_has_the_same_ack_and_is_executed_once(self):
        stub = self.start_acsd("tsc.initial=paused")
        envelope = {"transactionId": "T", "timestamp": "2025-07-02T21:00:00.123+09:00"}
        acks = []
        for _ in range(2):
            start = stub.count()
            stub.send_request("ExecutionPlan", make_carrying_plan("P"), envelope=envelope)
            acks.append(stub.wait_for("ExecutionPlanAck", start=start)[1].body)
        self.assertEqual(acks[0], acks[1])
        self.assertEqual(acks[0]["result"], "Success")
        self.assertEqual(self.list_plans(stub), ["P"])
        self.assertEqual(stub.ask("ExecutionPlan", make_carrying_plan("P"))["result"], "Fail")

    def test_a_plan_during_the_stop_of_acsd_is_rejected(self):
        stub = self.start_acsd("tsc.initial=paused")
        stub.unacknowledged = ("AcsCommStateUpdate",)
        self.line.forget(self.acsd)
        start = stub.count()
        self.acsd.process.terminate()
        stub.wait_for("AcsCommStateUpdate", lambda message: message.payload == {"isConnected": False}, start)
        ack = stub.ask("ExecutionPlan", make_carrying_plan("P"))
        self.assertEqual(ack["result"], "Fail", ack)
        self.assertEqual(self.acsd.process.wait(FINISH_SECONDS), 0)


if __name__ == "__main__":
    main()
