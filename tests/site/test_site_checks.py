#!/usr/bin/env python3
"""Plants one error at a time in a copy of the example site and expects its check to report it."""

import copy
import importlib.util
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import check_site
import site_checks as checks

LIF = checks.read_json(check_site.SITE / "site.lif.json")
CONFIG = checks.read_toml(check_site.SITE / "acsd.toml")
TEXT = (check_site.SITE / "acsd.toml").read_text(encoding="utf-8")
KEYS = check_site.KEYS.read_text(encoding="utf-8")


def find(entries, key, value):
    return next(entry for entry in entries if entry[key] == value)


class Site:
    """A copy of the example site to plant an error in."""

    def __init__(self):
        self.lif = copy.deepcopy(LIF)
        self.layout = self.lif["layouts"][0]
        self.nodes, self.edges, self.stations = (self.layout[key] for key in ("nodes", "edges", "stations"))

    def node(self, node_id):
        return find(self.nodes, "nodeId", node_id)

    def dock(self, station_id):
        return self.node(f"D-{station_id}")

    def edge_to(self, station_id):
        return find(self.edges, "endNodeId", f"D-{station_id}")

    def edge_from(self, station_id):
        return find(self.edges, "startNodeId", f"D-{station_id}")

    def lane(self):
        """The first lane edge, a part of the loop."""
        return self.edges[0]

    def add_edge(self, start, end):
        edge = copy.deepcopy(self.lane())
        edge |= {"edgeId": f"{start}-{end}", "startNodeId": start, "endNodeId": end}
        self.edges.append(edge)

    def rename_node(self, old, new):
        for entry in self.edges:
            entry |= {key: new for key in ("startNodeId", "endNodeId") if entry[key] == old}

    def reverse(self, edge):
        start, end = edge["startNodeId"], edge["endNodeId"]
        edge |= {"edgeId": f"{end}-{start}", "startNodeId": end, "endNodeId": start}


class LayoutChecks(unittest.TestCase):
    def complain(self, check, spoil, words):
        site = Site()
        self.assertEqual(check(site.lif), [], "the check must accept the unchanged site")
        spoil(site)
        errors = check(site.lif)
        self.assertTrue(any(words in error for error in errors), f"'{words}' not in {errors[:5]}")

    def test_true_site_is_clean(self):
        for check in checks.LAYOUT_CHECKS:
            self.assertEqual(check(copy.deepcopy(LIF)), [], check.__name__)

    def test_shape(self):
        self.complain(checks.check_shape, lambda site: site.lif["layouts"].append(site.layout), "exactly one layout")
        self.complain(checks.check_shape, lambda site: site.nodes[3].update(mapId="floor-2"), "one mapId")
        self.complain(checks.check_shape, lambda site: site.lif["metaInformation"].update(lifVersion="2"), "lifVersion")
        self.complain(checks.check_shape,
                      lambda site: site.lane()["vehicleTypeEdgeProperties"][0].update(trajectory={}), "trajectory")

    def test_ids(self):
        for key in ("nodes", "edges", "stations"):
            self.complain(checks.check_ids, lambda site, key=key: site.layout[key].append(site.layout[key][0]), "twice")
        self.complain(checks.check_ids, lambda site: site.lane().update(edgeId="E1"), "named after")

    def test_references(self):
        self.complain(checks.check_references, lambda site: site.lane().update(endNodeId="N999"), "unknown node")
        self.complain(checks.check_references,
                      lambda site: site.stations[0].update(interactionNodeIds=["D-A01.CP02"]), "own dock")
        self.complain(checks.check_references, lambda site: site.nodes.remove(site.dock("CHG01")), "CHG01")

    def test_stations(self):
        self.complain(checks.check_stations, lambda site: site.stations.pop(7), "is missing")
        self.complain(checks.check_stations, lambda site: site.stations[7].update(stationId="A03.CP01"), "not a place")
        self.complain(checks.check_stations, lambda site: site.dock("A01.SET03")["vehicleTypeNodeProperties"].append(
            {"vehicleTypeId": "lr-base"}), "A01.SET03 is not for")

    def test_numbering(self):
        def swap(site, first, second):
            one, two = site.dock(first), site.dock(second)
            one["nodePosition"], two["nodePosition"] = two["nodePosition"], one["nodePosition"]

        def swap_rows(site):
            for i in range(1, 7):
                swap(site, f"A02.SET{i:02}", f"A02.SET{i + 6:02}")

        self.complain(checks.check_numbering, lambda site: swap(site, "A01.CP02", "A01.CP05"), "left to right")
        self.complain(checks.check_numbering, swap_rows, "upper row")

    def test_extents(self):
        def in_millimetres(site):
            for node in site.nodes:
                node["nodePosition"] = {axis: value * 1000 for axis, value in node["nodePosition"].items()}

        def tiny(site):
            places = [node["nodePosition"] for node in site.nodes]
            for place in places + [station["stationPosition"] for station in site.stations]:
                place.update(x=10 + place["x"] / 10, y=10 + place["y"] / 10)

        self.complain(checks.check_extents, in_millimetres, "off the floor")
        self.complain(checks.check_extents,
                      lambda site: site.stations[0]["stationPosition"].update(x=-1), "off the floor")
        self.complain(checks.check_extents, tiny, "covers")

    def test_clearance(self):
        self.complain(checks.check_clearance,
                      lambda site: site.dock("A01.CP01")["nodePosition"].update(site.dock("A01.CP02")["nodePosition"]),
                      "nodes D-A01.CP01 and D-A01.CP02")
        self.complain(checks.check_clearance, lambda site: site.add_edge("N001", "N003"), "passes node N002")

    def test_lengths(self):
        self.complain(checks.check_lengths, lambda site: site.node("N001")["nodePosition"].update(x=1.0), "N001-N002")
        self.complain(checks.check_lengths, lambda site: site.dock("CHG01")["nodePosition"].update(x=1.0), "D-CHG01")

    def test_crossings(self):
        def cross(site):
            # From the south lane to the middle one, over the lane at x = 19 that runs north.
            site.add_edge("N008", "N065")

        def touch(site):
            site.dock("A01.SET01")["nodePosition"].update(site.node("N041")["nodePosition"])

        self.complain(checks.check_crossings, cross, "N008-N065 cross")
        self.complain(checks.check_crossings, touch, "cross")

    def test_lanes(self):
        def without_choice(site):
            loop = {f"N{i:03}" for i in range(1, 50)}
            site.edges[:] = [edge for edge in site.edges if {edge["startNodeId"], edge["endNodeId"]} <= loop]

        def turn_all(site):
            for edge in site.edges:
                site.reverse(edge)

        self.complain(checks.check_lanes, lambda site: site.add_edge("N002", "N001"), "both ways")
        self.complain(checks.check_lanes, without_choice, "choice of routes")
        self.complain(checks.check_lanes, turn_all, "clockwise")
        self.complain(checks.check_lanes, lambda site: site.edges.remove(site.lane()), "not closed")

    def test_spurs(self):
        self.complain(checks.check_spurs, lambda site: site.edges.remove(site.edge_from("A01.SET05")), "D-A01.SET05")
        self.complain(checks.check_spurs, lambda site: site.add_edge("N001", "D-A01.CP01"), "D-A01.CP01")
        self.complain(checks.check_spurs, lambda site: site.rename_node(
            site.edge_to("A01.CP01")["startNodeId"], site.edge_to("A01.CP02")["startNodeId"]), "serves two docks")

    def test_edge_properties(self):
        def spoil(edge_of, **values):
            return lambda site: edge_of(site)["vehicleTypeEdgeProperties"][0].update(values)

        def forget(edge_of, key):
            return lambda site: edge_of(site)["vehicleTypeEdgeProperties"][0].pop(key)

        def way_in(site):
            return site.edge_to("A02.SET12")

        def way_out(site):
            return site.edge_from("A02.SET12")

        for spoiled, words in (
                (spoil(way_in, maxSpeed=1.2), "1.2 m/s"), (spoil(Site.lane, maxSpeed=12), "12 m/s"),
                (forget(way_in, "maxSpeed"), "m/s"),
                (spoil(way_out, vehicleOrientation=0.0), "orientation"),
                (spoil(way_out, vehicleOrientation=3.14159), "orientation"),  # radians where degrees belong
                (spoil(way_in, vehicleOrientation=180.0), "orientation"),
                (spoil(Site.lane, orientationType="GLOBAL"), "orientation"),
                (forget(Site.lane, "rotationAllowed"), "rotation"),
                (spoil(way_in, vehicleTypeId="lr-base"), "vehicle types of both its ends")):
            self.complain(checks.check_edge_properties, spoiled, words)

    def test_headings(self):
        def spoil(theta):
            return lambda site: site.dock("A01.CP01")["vehicleTypeNodeProperties"][0].update(theta=theta)

        self.complain(checks.check_headings, spoil(-90.0), "not in radians")
        self.complain(checks.check_headings, spoil(1.570796), "heading")
        self.complain(checks.check_headings,
                      lambda site: site.dock("CHG02")["vehicleTypeNodeProperties"][0].pop("theta"), "no theta")

    def test_reachability(self):
        self.complain(checks.check_reachability, lambda site: site.edges.remove(site.edge_from("A01.CP03")),
                      "no way from A01.CP03")
        # One vehicle type alone is excluded from an edge that no other route avoids.
        self.complain(checks.check_reachability,
                      lambda site: find(site.edges, "startNodeId", "N052")["vehicleTypeEdgeProperties"].pop(),
                      "cr-base finds no way")
        self.complain(checks.check_reachability,
                      lambda site: [edge["vehicleTypeEdgeProperties"].append({"vehicleTypeId": "lr-base"})
                                    for edge in (site.edge_to("A01.SET01"), site.edge_from("A01.SET01"))],
                      "lr-base may drive")

    def test_no_way_leads_through_a_dock(self):
        site = Site()
        out = site.edge_from("A01.CP01")
        site.edges.remove(find([edge for edge in site.edges if "D-" not in edge["endNodeId"]], "startNodeId", "N052"))
        site.add_edge(out["startNodeId"], "N053")  # would make the dock a piece of lane
        self.assertIn("lr-base finds no way from CHG01", "\n".join(checks.check_reachability(site.lif)))

    @unittest.skipUnless(check_site.find_schema_or_none() and importlib.util.find_spec("jsonschema"),
                         "needs ACS_SPEC_DIR and python3-jsonschema")
    def test_schema(self):
        schema = checks.read_json(check_site.find_schema_or_none())

        def check(lif):
            return checks.check_schema(lif, schema)

        self.complain(check, lambda site: site.nodes[0].pop("nodePosition"), "nodePosition")
        self.complain(check, lambda site: site.nodes[0].update(colour="red"), "colour")
        self.complain(check, lambda site: site.lane().update(vehicleTypeEdgeProperties="none"), "EdgeProperties")


class ConfigurationChecks(unittest.TestCase):
    def complain(self, spoil, words):
        config = copy.deepcopy(CONFIG)
        self.assertEqual(checks.check_config(config, LIF), [])
        spoil(config)
        errors = checks.check_config(config, LIF)
        self.assertTrue(any(words in error for error in errors), f"'{words}' not in {errors[:5]}")

    def test_ports(self):
        self.complain(lambda config: config["site"]["ports"].pop(), "reference map")
        self.complain(lambda config: config["site"]["ports"].append("A01.CP01-06.TP01-04"), "nor a range")
        self.complain(lambda config: config["site"]["ports"].append("A01.CP01.TP04-01"), "nor a range")
        self.complain(lambda config: config["site"]["ports"].append("A01.CP01.TP04-05"), "twice")

    def test_robots(self):
        def spoil(**values):
            return lambda config: config["robots"]["CR01"].update(values)

        self.complain(spoil(start_node="D-CHG01"), "start_node")
        self.complain(spoil(start_node="D-ST01.CP01", home="ST01.CP01"), "home")
        self.complain(spoil(ports=["TP01-02"]), "TP03.MP01")

    def test_actions(self):
        self.complain(lambda config: config["actions"]["CassetteLoad"].update(arm_program=3), "not one of")
        self.complain(lambda config: config["actions"]["Start"].pop("arm_program"), "not one of")
        self.complain(lambda config: config["robots"].pop("LR01"), "no robot is a LR")
        self.complain(lambda config: config["robots"]["CR01"].pop("arm"), "no CR has an arm")

    def test_key_table(self):
        self.assertEqual(checks.check_key_table(CONFIG, TEXT, KEYS), [])
        self.assertIn("mcs.urls", str(checks.check_key_table(CONFIG, TEXT, KEYS.replace("`mcs.url`", "`mcs.urls`"))))
        self.assertIn("mcs.host is not in acsd.toml", str(checks.check_key_table(CONFIG, TEXT.replace("# host =", "# hosts ="), KEYS)))
        self.assertIn("key mcs.url is not", str(checks.check_key_table(CONFIG, TEXT, KEYS.replace("`mcs.url`", ""))))


class PlanChecks(unittest.TestCase):
    def complain(self, spoil, words):
        plan = checks.read_json(check_site.PLANS / "cr-tray.json")
        self.assertEqual(checks.check_plan(plan, CONFIG), [])
        spoil(plan["steps"])
        errors = checks.check_plan(plan, CONFIG)
        self.assertTrue(any(words in error for error in errors), f"'{words}' not in {errors}")

    def test_plans(self):
        self.complain(lambda steps: steps[0]["jobs"][0].update({"from": "A01.CP01.TP05"}), "A01.CP01.TP05")
        self.complain(lambda steps: steps[1]["jobs"][0].update({"from": "AMR.TP01.MP26"}), "AMR.TP01.MP26")
        self.complain(lambda steps: steps[1].update(position="A03.SET01"), "A03.SET01")
        self.complain(lambda steps: steps[1].update(action="End"), "action End")
        self.complain(lambda steps: steps[1].update(stepNo=5), "numbered")
        self.complain(lambda steps: steps[2]["jobs"].append(steps[2]["jobs"][0]), "twice")


class Generator(unittest.TestCase):
    def run_generator(self, *arguments):
        command = [sys.executable, check_site.ROOT / "scripts/make_site.py", *arguments]
        return subprocess.run(command, check=False, capture_output=True, text=True)

    def test_a_file_that_differs_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            names = ("site.lif.json", "site.svg")
            copies = [pathlib.Path(shutil.copy(check_site.SITE / name, folder)) for name in names]
            options = ["--out", copies[0], "--svg", copies[1]]
            self.assertEqual(self.run_generator("--check", *options).returncode, 0)
            for path in copies:
                text = path.read_text(encoding="utf-8")
                path.write_text(text.replace("N002", "N02"), encoding="utf-8")
                result = self.run_generator("--check", *options)
                self.assertEqual(result.returncode, 1)
                self.assertIn(path.name, result.stderr)
                path.unlink()
                self.assertEqual(self.run_generator("--check", *options).returncode, 1, "a missing file")
                self.assertEqual(self.run_generator(*options).returncode, 0)
                self.assertEqual(path.read_text(encoding="utf-8"), text)


if __name__ == "__main__":
    unittest.main()
