#!/usr/bin/env python3
"""A site of 5,000 nodes: acsd starts, answers, and executes plans."""

from large_site import make_large_site
from line_faults import FaultCase
from plan_samples import make_carrying_plan
from scenario_case import main

NODES = 5000


class LargeSite(FaultCase):
    def test_acsd_answers_and_plans_are_executed(self):
        path = self.line.folder / "site.lif.json"
        nodes, edges = make_large_site(path, NODES)
        self.start_line(overrides=(f"site.map={path}",))
        self.submit(make_carrying_plan("P1"))
        site = self.read_json("/v1/site")
        self.assertEqual((len(site["nodes"]), len(site["edges"])), (nodes, edges))
        snapshot = self.read_json("/v1/snapshot")
        self.assertEqual([plan["planId"] for plan in snapshot["plans"]], ["P1"])
        self.post("/v1/site/block", {"kind": "node", "id": "G04999"})
        self.wait_until(lambda: [block["id"] for block in self.read_json("/v1/site")["blocked"]] == ["G04999"], "not blocked")
        self.wait_for_plan("P1", "Completed")


if __name__ == "__main__":
    main()
