#!/usr/bin/env python3
"""e13_lif_to_svg: the picture has each node, edge and station of the LIF file, where the file has it."""

import json
import math
import subprocess
import unittest
import xml.etree.ElementTree

from scenario_case import FINISH_SECONDS, SITE, ScenarioCase, main

SVG = "{http://www.w3.org/2000/svg}"
PIXELS = 40
ROUNDING = 0.011  # of a pixel
# A quarter of a circle with a radius of 2 m around (5, 6), from (3, 6) to (5, 8).
QUARTER = {"degree": 2, "knotVector": [0, 0, 0, 1, 1, 1],
           "controlPoints": [{"x": 3, "y": 6}, {"x": 3, "y": 8, "weight": math.sqrt(0.5)}, {"x": 5, "y": 8}]}


def make_layout():
    """Two maps, ids with markup, a curve, and a station with two docks."""
    types = {"vehicleTypeNodeProperties": [{"vehicleTypeId": "t"}]}
    rule = {"vehicleTypeId": "t", "vehicleOrientation": 0.0, "rotationAllowed": True}

    def make_node(name, x, y, floor):
        return {"nodeId": name, "mapId": floor, "nodePosition": {"x": x, "y": y}, **types}

    def make_edge(name, start, end, **more):
        return {"edgeId": name, "startNodeId": start, "endNodeId": end, "vehicleTypeEdgeProperties": [{**rule, **more}]}

    return {
        "metaInformation": {"projectIdentification": "p", "creator": "c", "exportTimestamp": "2025-11-21T00:00:00Z",
                            "lifVersion": "1.0.0"},
        "layouts": [{
            "layoutId": "l", "layoutVersion": "1", "layoutLevelId": "v",
            "nodes": [make_node("<a&\"b>", 3, 6, "one"), make_node("B", 5, 8, "one"), make_node("C", 9, 1, "two")],
            "edges": [make_edge("curve", "<a&\"b>", "B", trajectory=QUARTER), make_edge("lift", "B", "C")],
            "stations": [{"stationId": "S", "interactionNodeIds": ["<a&\"b>", "B"]}],
        }]}


class LifToSvg(ScenarioCase):
    def run_lesson(self, lif, *arguments):
        self.svg = self.line.folder / "site.svg"
        return subprocess.run([self.bin_dir / "e13_lif_to_svg", lif, self.svg, *arguments], stdout=subprocess.PIPE, text=True,
                              timeout=FINISH_SECONDS, check=False)

    def draw(self, layout, *arguments):
        lif = self.line.folder / "site.lif.json"
        lif.write_text(json.dumps(layout))
        lesson = self.run_lesson(lif, *arguments)
        self.assertEqual(lesson.returncode, 0, lesson.stdout)
        svg = xml.etree.ElementTree.parse(self.svg).getroot()
        self.assertEqual(svg.tag, f"{SVG}svg")
        self.size = (float(svg.get("width")), float(svg.get("height")))
        nodes = {circle.findtext(f"{SVG}title"): (float(circle.get("cx")), float(circle.get("cy")))
                 for circle in svg.iter(f"{SVG}circle")}
        edges = {line.findtext(f"{SVG}title"): [tuple(map(float, point.split(","))) for point in line.get("points").split()]
                 for line in svg.iter(f"{SVG}polyline")}
        rects = [(float(rect.get("x")) + 6, float(rect.get("y")) + 6) for rect in svg.iter(f"{SVG}rect")]
        names = [text.text for text in svg.iter(f"{SVG}text")]
        self.assertEqual(len(rects), len(names))
        return nodes, edges, sorted(zip(names, rects))

    def assert_near(self, shown, expected):
        self.assertLess(math.dist(shown, expected), 2 * ROUNDING)

    def test_the_example_site(self):
        layout = json.loads((SITE / "site.lif.json").read_text())
        nodes, edges, docks = self.draw(layout)
        data = layout["layouts"][0]
        metres = {node["nodeId"]: (node["nodePosition"]["x"], node["nodePosition"]["y"]) for node in data["nodes"]}
        self.assertEqual(nodes.keys(), metres.keys())
        left = min(x for x, _ in metres.values())
        top = max(y for _, y in metres.values())
        margin = (min(x for x, _ in nodes.values()), min(y for _, y in nodes.values()))
        for name, (x, y) in metres.items():
            self.assert_near(nodes[name], (margin[0] + (x - left) * PIXELS, margin[1] + (top - y) * PIXELS))
            self.assertTrue(0 < nodes[name][0] < self.size[0] and 0 < nodes[name][1] < self.size[1], "outside the picture")
        ends = {edge["edgeId"]: [nodes[edge["startNodeId"]], nodes[edge["endNodeId"]]] for edge in data["edges"]}
        self.assertEqual(edges, ends)
        expected = [(station["stationId"], nodes[dock])
                    for station in data["stations"] for dock in station["interactionNodeIds"]]
        self.assertEqual([name for name, _ in docks], sorted(name for name, _ in expected))
        for (_, shown), (_, place) in zip(docks, sorted(expected)):
            self.assert_near(shown, place)

    def test_a_curve_and_ids_with_markup_on_one_of_two_maps(self):
        nodes, edges, docks = self.draw(make_layout())
        self.assertEqual(nodes.keys(), {"<a&\"b>", "B"})
        self.assertEqual(edges.keys(), {"curve"}, "an edge to another map has no place in this picture")
        self.assertEqual(docks, [("S", nodes["<a&\"b>"]), ("S", nodes["B"])])
        self.assertGreater(len(edges["curve"]), 10)
        self.assert_near(edges["curve"][0], nodes["<a&\"b>"])
        self.assert_near(edges["curve"][-1], nodes["B"])
        centre = (nodes["B"][0], nodes["<a&\"b>"][1])
        for point in edges["curve"]:
            self.assertAlmostEqual(math.dist(point, centre), 2 * PIXELS, delta=2 * ROUNDING)

    def test_the_other_map(self):
        nodes, edges, docks = self.draw(make_layout(), "two")
        self.assertEqual((list(nodes), edges, docks), (["C"], {}, []))

    def test_an_unknown_map_is_refused_with_the_known_ones_and_nothing_is_drawn(self):
        lif = self.line.folder / "site.lif.json"
        lif.write_text(json.dumps(make_layout()))
        lesson = self.run_lesson(lif, "three")
        self.assertEqual(lesson.returncode, 1, lesson.stdout)
        self.assertEqual(lesson.stdout, f"{lif}: no map three; its maps: one, two\n")
        self.assertFalse(self.svg.exists())

    def test_a_picture_that_cannot_be_written_is_an_error_with_its_reason(self):
        for target, reason in ((self.line.folder, "Is a directory"), ("/dev/full", "No space left on device")):
            lesson = subprocess.run([self.bin_dir / "e13_lif_to_svg", SITE / "site.lif.json", target], stdout=subprocess.PIPE, text=True,
                                    timeout=FINISH_SECONDS, check=False)
            self.assertEqual((lesson.returncode, lesson.stdout), (1, f"{target}: {reason}\n"))

    def test_an_invalid_file_is_refused_with_its_place_and_nothing_is_drawn(self):
        layout = make_layout()
        layout["layouts"][0]["edges"][1]["endNodeId"] = "D"
        lif = self.line.folder / "site.lif.json"
        lif.write_text(json.dumps(layout))
        for path, part in ((lif, "layouts[0].edges[1].endNodeId"), (self.line.folder / "missing", "cannot be read")):
            lesson = self.run_lesson(path)
            self.assertEqual(lesson.returncode, 1)
            self.assertIn(part, lesson.stdout)
            self.assertFalse(self.svg.exists())


if __name__ == "__main__":
    main()
