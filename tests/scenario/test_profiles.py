#!/usr/bin/env python3
"""vda-sim imitates makes of vehicles: each completes the LR plan with acsd, and rejects every order that breaks its rules."""

import copy
import json
import shutil
import subprocess
import threading
import time
import unittest

from scenario_case import FINISH_SECONDS, PLANS, TIME_SCALE, ScenarioCase, main

ANSWER_SECONDS = 20
RESEND_SECONDS = 2.0  # of acsd
NODES = ("N001", "N002", "N003", "N004")
FIRST_X, DISTANCE, Y = 3.0, 2.0, 4.0
PROFILES = ("strict-lengths", "no-horizon", "manual-clears", "slow-accept", "partial-factsheet", "node-actions", "blocking",
            "line-guided")
# The make knows neither height nor side.
SHORT_PARAMETERS = """
[robots.LR01.actions.CassetteLoad]
vehicle_action = "pick"
parameters = { stationType = "{station.type}", stationName = "{place}", loadType = "cassette", loadId = "{carrier}" }

[robots.LR01.actions.CassetteUnload]
vehicle_action = "drop"
parameters = { stationName = "{place}", loadId = "{carrier}" }
"""


class CompletedPlans(ScenarioCase):
    def run_plan(self, profile, *overrides, vehicle="", faults=(), tables="", time_scale=TIME_SCALE):
        """The LR plan is completed, and the world's journal has each move once."""
        self.line.share_world()
        self.line.start_broker()
        vehicles = (f"LR01,type=LR,profile={profile}{vehicle}", "CR01,type=CR,node=D-CHG02")
        self.line.start_vehicles(time_scale, vehicles, faults=faults).wait_ready()
        arm = self.line.start_arm(time_scale).wait_ready()
        mcs = self.line.start_mcs([PLANS[0]])
        site = self.line.site_dir
        config = self.line.folder / "acsd.toml"
        config.write_text((site / "acsd.toml").read_text().replace('"site.lif.json"', f'"{site / "site.lif.json"}"')
                          + tables)
        trace = self.line.folder / "trace"
        acsd = self.line.start_acsd(mcs.wait_ready()["ws"], arm, *overrides, config=config, arguments=("--trace", trace))
        exit_code = mcs.wait(FINISH_SECONDS)
        self.line.forget(acsd)
        acsd.stop()  # else the last line of the trace may be half written
        self.entries = [json.loads(line) for file in sorted(trace.iterdir()) for line in file.read_text().splitlines()]
        self.assertEqual(exit_code, 0)
        self.assertEqual(mcs.tail(2), ["1 carriers delivered, 0 misplaced", "1 plans completed, 0 failed"])
        events = map(json.loads, (self.line.folder / "world.json.journal").read_text().splitlines())
        moves = [(event["from"], event["to"]) for event in events if event["event"] == "CarrierMoved"]
        self.assertEqual(moves, [("A01.CP01", "LR01.CP01"), ("LR01.CP01", "A02.CP03")])

    def read_messages(self, direction, topic):
        return [json.loads(entry["text"]) for entry in self.entries
                if entry["link"] == "mqtt" and entry["direction"] == direction and entry["topic"].endswith(f"/LR01/{topic}")]

    def assert_nothing_was_rejected(self):
        rejections = [error for state in self.read_messages("in", "state") for error in state["errors"]
                      if any(reference["referenceKey"] == "orderId" for reference in error.get("errorReferences", ()))]
        self.assertEqual(rejections, [])

    def assert_only_what_crossed_a_change_of_mode_was_rejected(self):
        """An order may be under way when the vehicle leaves the automatic mode, which acsd learns from the next state."""
        is_automatic, sent = True, set()
        for entry in self.entries:
            topic = entry["topic"].rpartition("/LR01/")[2] if entry["link"] == "mqtt" else ""
            if (entry["direction"], topic) == ("out", "order") and is_automatic:
                sent.add(str(json.loads(entry["text"])["headerId"]))
            elif (entry["direction"], topic) == ("in", "state"):
                state = json.loads(entry["text"])
                is_automatic = state["operatingMode"] == "AUTOMATIC"
                for error in state["errors"]:
                    self.assert_crossed(error, sent)

    def assert_crossed(self, error, sent):
        references = {reference["referenceKey"]: reference["referenceValue"] for reference in error.get("errorReferences", ())}
        if "orderId" in references:
            self.assertEqual(error["errorDescription"], "the operating mode takes no orders")
            self.assertIn(references["headerId"], sent, "acsd knew that the mode takes no orders")

    def test_strict_lengths(self):
        self.run_plan("strict-lengths")
        self.assert_nothing_was_rejected()
        self.assertLessEqual(max(len(order["nodes"]) for order in self.read_messages("out", "order")), 3)

    def test_no_horizon(self):
        self.run_plan("no-horizon")
        self.assertTrue(any(error["errorDescription"].startswith("the vehicle accepts no horizon")
                            for state in self.read_messages("in", "state") for error in state["errors"]))

    def test_manual_clears_on_a_node(self):
        self.run_plan("manual-clears", "robot.load_timeout=1s", faults=("LR01 mode node=N046 for=2s",))
        self.assert_only_what_crossed_a_change_of_mode_was_rejected()

    def test_manual_clears_between_two_nodes(self):
        self.run_plan("manual-clears", "robot.load_timeout=1s", faults=("LR01 mode node=N046 at=200ms for=2s",), time_scale=5)
        self.assertTrue(any(state["lastNodeId"] == "" for state in self.read_messages("in", "state")))

    def test_manual_clears_with_a_load_on_board(self):
        self.run_plan("manual-clears", "robot.load_timeout=1s", faults=("LR01 mode node=N060 for=2s",))
        self.assert_only_what_crossed_a_change_of_mode_was_rejected()

    def test_slow_accept(self):
        self.run_plan("slow-accept")
        orders = [(order["orderId"], order["orderUpdateId"]) for order in self.read_messages("out", "order")]
        self.assertGreater(len(orders), len(set(orders)))  # some were sent again
        self.assert_nothing_was_rejected()

    def test_partial_factsheet(self):
        self.run_plan("partial-factsheet", tables=SHORT_PARAMETERS)
        self.assert_nothing_was_rejected()

    def test_node_actions(self):
        self.run_plan("node-actions")
        self.assert_nothing_was_rejected()

    def test_blocking(self):
        self.run_plan("blocking", 'robots.LR01.protocol="2.1.0"', vehicle=",protocol=2.1.0")
        self.assert_nothing_was_rejected()

    def test_line_guided(self):
        self.run_plan("line-guided")
        self.assert_nothing_was_rejected()
        self.assertFalse(any("agvPosition" in state for state in self.read_messages("in", "state")))


def make_action(action_type, action_id, blocking_type="HARD", **parameters):
    return {"actionType": action_type, "actionId": action_id, "blockingType": blocking_type,
            "actionParameters": [{"key": key, "value": value} for key, value in parameters.items()]}


def make_pick(action_id):
    return make_action("pick", action_id, stationType="rack", loadType="cassette")


def make_order(profile, order_id, count=3):
    """A drive along the first nodes with a pick on the second; every profile accepts it."""
    nodes = [{"nodeId": node, "sequenceId": 2 * index, "released": True, "actions": [],
              "nodePosition": {"x": FIRST_X + DISTANCE * index, "y": Y, "mapId": "floor-1"}}
             for index, node in enumerate(NODES[:count])]
    edges = [{"edgeId": f"{start}-{end}", "sequenceId": 2 * index + 1, "released": True, "startNodeId": start,
              "endNodeId": end, "maxSpeed": 1.0, "actions": []}
             for index, (start, end) in enumerate(zip(NODES, NODES[1:count]))]
    nodes[min(1, count - 1)]["actions"].append(make_pick(f"{order_id}-pick"))
    if profile == "line-guided":
        for node in nodes:
            del node["nodePosition"]
    return {"orderId": order_id, "orderUpdateId": 0, "nodes": nodes, "edges": edges}


def make_change(path, value):
    """A function that sets the member at the path of keys and indices, or appends to the list there."""
    def change(order):
        *parents, last = path
        for key in parents:
            order = order[key]
        if isinstance(order, dict) and isinstance(order.get(last), list):
            order[last].append(copy.deepcopy(value))
        else:
            order[last] = value
    return change


def extend(order):
    order.update({key: make_order("", order["orderId"], 4)[key] for key in ("nodes", "edges")})


def add_horizon(order):
    order["nodes"][2]["released"] = order["edges"][1]["released"] = False


def stay(order):
    """The order of a job: the pick on the node of the vehicle."""
    order.update({key: make_order("", order["orderId"], 1)[key] for key in ("nodes", "edges")})


def stay_without_position(order):
    stay(order)
    del order["nodes"][0]["nodePosition"]


def stay_beside(order):
    stay(order)
    order["nodes"][0]["nodePosition"]["y"] += 0.3


def drop_position(order):
    del order["nodes"][1]["nodePosition"]


LINE = {"degree": 1, "knotVector": [0.0, 0.0, 1.0, 1.0],
        "controlPoints": [{"x": FIRST_X, "y": Y}, {"x": FIRST_X + DISTANCE, "y": Y}]}
CURVE = {"degree": 1, "knotVector": [0.0, 0.0, 0.25, 0.5, 0.75, 1.0, 1.0],
         "controlPoints": [{"x": FIRST_X + DISTANCE * part / 4, "y": Y} for part in range(5)]}
PICK = ("nodes", 1, "actions", 0)
POSITION = "order.nodes.nodePosition"
# profile, reference, change of the correct order
VIOLATIONS = [
    ("strict-lengths", ("parameter", "maxArrayLens.order.nodes"), extend),
    ("strict-lengths", ("parameter", "maxArrayLens.order.edges"), extend),
    ("strict-lengths", ("parameter", "maxArrayLens.node.actions"),
     make_change(("nodes", 1, "actions"), make_action("finePositioning", "more"))),
    ("strict-lengths", ("parameter", "maxArrayLens.actions.actionsParameters"),
     lambda order: order["nodes"][1]["actions"][0]["actionParameters"].extend(
         {"key": key, "value": "any"} for key in ("lhd", "stationName", "loadId", "side", "more"))),
    ("strict-lengths", ("parameter", "maxArrayLens.trajectory.controlPoints"), make_change(("edges", 0, "trajectory"), CURVE)),
    ("strict-lengths", ("parameter", "maxStringLens.idLen"), make_change((*PICK, "actionId"), "x" * 37)),
    ("strict-lengths", ("parameter", "maxStringLens.msgLen"), make_change(("nodes", 1, "nodeDescription"), "x" * 4096)),
    ("no-horizon", ("edgeId", "N002-N003"), add_horizon),
    ("no-horizon", ("nodeId", "N003"), add_horizon),
    ("partial-factsheet", ("parameter", f"{POSITION}.theta"), make_change(("nodes", 1, "nodePosition", "theta"), 0.0)),
    ("partial-factsheet", ("parameter", f"{POSITION}.allowedDeviationXY"),
     make_change(("nodes", 1, "nodePosition", "allowedDeviationXY"), 0.5)),
    ("partial-factsheet", ("parameter", "order.edges.length"), make_change(("edges", 0, "length"), DISTANCE)),
    ("partial-factsheet", ("parameter", "order.edges.trajectory"), make_change(("edges", 0, "trajectory"), LINE)),
    ("partial-factsheet", ("parameter", "height"),
     make_change((*PICK, "actionParameters"), {"key": "height", "value": 0.8})),
    ("partial-factsheet", ("parameter", "actionType"),
     make_change(PICK, make_action("finePositioning", "fine"))),
    ("node-actions", ("parameter", POSITION), drop_position),
    ("node-actions", ("parameter", POSITION), stay_without_position),
    ("node-actions", ("parameter", POSITION), stay_beside),
    ("node-actions", ("edgeId", "N001-N002"),
     make_change(("edges", 0, "actions"), make_action("finePositioning", "fine"))),
    ("blocking", ("parameter", "blockingType"), make_change((*PICK, "blockingType"), "SOFT")),
    ("blocking", ("parameter", "blockingType"), make_change((*PICK, "blockingType"), "NONE")),
    ("line-guided", ("parameter", POSITION),
     make_change(("nodes", 1, "nodePosition"), {"x": FIRST_X + DISTANCE, "y": Y, "mapId": "floor-1"})),
    ("line-guided", ("parameter", "order.edges.trajectory"), make_change(("edges", 0, "trajectory"), LINE)),
]


class RejectedOrders(ScenarioCase):
    """A real vda-sim with a vehicle of each profile and without acsd."""

    def setUp(self):
        super().setUp()
        self.line.start_broker()
        self.states = {}
        self.changed = threading.Condition()
        pending = [b""]

        def read(chunk):
            *lines, pending[0] = (pending[0] + chunk).split(b"\n")
            with self.changed:
                for state in map(json.loads, lines):
                    self.states.setdefault(state["serialNumber"], []).append(state)
                self.changed.notify_all()

        self.line.start("mosquitto_sub", "-p", self.line.broker_port, "-t", "uagv/v2/ACS/+/state",
                        binary=shutil.which("mosquitto_sub"), on_output=read)
        self.names = {profile: f"LR{number:02}" for number, profile in enumerate(PROFILES, 1)}
        self.line.start_vehicles(TIME_SCALE, [f"{name},type=LR,node=N001,profile={profile}"
                                              for profile, name in self.names.items()]).wait_ready()
        for profile in PROFILES:
            self.wait_for_state(profile, lambda state: True)
        self.header_id = 0

    def publish(self, topic, message):
        subprocess.run(["mosquitto_pub", "-p", str(self.line.broker_port), "-q", "1", "-t", topic, "-s"], check=True,
                       input=message.encode(), timeout=ANSWER_SECONDS)

    def send(self, profile, topic, message):
        self.header_id += 1
        name = self.names[profile]
        header = {"headerId": self.header_id, "timestamp": "2025-11-25T12:00:00.000Z", "version": "2.0.0",
                  "manufacturer": "ACS", "serialNumber": name}
        self.publish(f"uagv/v2/ACS/{name}/{topic}", json.dumps(header | message))

    def wait_for_state(self, profile, is_wanted, seconds=ANSWER_SECONDS):
        """The last state, once it is as wanted."""
        with self.changed:
            states = self.states.setdefault(self.names[profile], [])
            reached = self.changed.wait_for(lambda: states and is_wanted(states[-1]), seconds)
            self.assertTrue(reached, f"{profile}: {states[-1:]}")
            return states[-1]

    def wait_for_errors(self, profile, key, value):
        """The references of each error of the state that has this one."""
        def read(state):
            errors = [(error["errorType"], [(reference["referenceKey"], reference["referenceValue"])
                                            for reference in error["errorReferences"]]) for error in state["errors"]]
            return [(kind, references) for kind, references in errors if (key, value) in references]
        return read(self.wait_for_state(profile, read))

    def test_each_violation_of_a_profile_is_rejected_with_a_reference_to_it(self):
        for number, (profile, reference, change) in enumerate(VIOLATIONS):
            with self.subTest(profile=profile, reference=reference, number=number):
                order = make_order(profile, f"wrong-{number}")
                change(order)
                self.send(profile, "order", order)
                errors = self.wait_for_errors(profile, "orderId", order["orderId"])
                self.assertEqual({kind for kind, _ in errors}, {"orderError"})
                self.assertIn(reference, [found for _, references in errors for found in references])
        for profile in PROFILES:
            with self.subTest(profile=profile):
                self.assertEqual({state["orderId"] for state in self.states[self.names[profile]]}, {""})
                self.send(profile, "order", make_order(profile, "right"))
                state = self.wait_for_state(profile, lambda state: state["lastNodeId"] == "N003")
                self.assertEqual(state["errors"], [])
                self.assertEqual([action["actionStatus"] for action in state["actionStates"]], ["FINISHED"])
        self.assertFalse(any("agvPosition" in state for state in self.states[self.names["line-guided"]]))

    def test_too_many_and_unlisted_instant_actions_are_rejected(self):
        requests = [make_action("stateRequest", f"request-{number}", "NONE") for number in (1, 2)]
        self.send("strict-lengths", "instantActions", {"actions": requests})
        errors = self.wait_for_errors("strict-lengths", "actionId", "request-2")
        self.assertIn(("parameter", "maxArrayLens.instantActions"), errors[0][1])
        self.send("partial-factsheet", "instantActions", {"actions": [make_action("logReport", "log", "NONE", reason="a")]})
        errors = self.wait_for_errors("partial-factsheet", "actionId", "log")
        self.assertIn(("parameter", "actionType"), errors[0][1])

    def test_a_slow_vehicle_executes_an_order_once_that_is_sent_again_before_it_shows_it(self):
        order = make_order("slow-accept", "slow", 1)
        begin = time.monotonic()
        self.send("slow-accept", "order", order)
        time.sleep(RESEND_SECONDS)
        self.send("slow-accept", "order", order)
        self.wait_for_state("slow-accept", lambda state: state["orderId"] == "slow")
        self.assertGreater(time.monotonic() - begin, RESEND_SECONDS)
        self.wait_for_state("slow-accept", lambda state: state["loads"])
        time.sleep(RESEND_SECONDS)
        state = self.wait_for_state("slow-accept", lambda state: True)
        self.assertEqual((len(state["loads"]), len(state["actionStates"]), state["errors"]), (1, 1, []))

    def test_a_vehicle_that_forgets_in_manual_shows_only_its_loads(self):
        self.send("manual-clears", "order", make_order("manual-clears", "lost", 1))
        self.wait_for_state("manual-clears", lambda state: state["loads"])
        self.publish("vda-sim/control", f"{self.names['manual-clears']} mode")
        state = self.wait_for_state("manual-clears", lambda state: state["operatingMode"] == "MANUAL")
        self.assertEqual((state["orderId"], state["orderUpdateId"], state["actionStates"], state["lastNodeId"]),
                         ("", 0, [], "N001"))
        self.assertEqual(len(state["loads"]), 1)


if __name__ == "__main__":
    main()
