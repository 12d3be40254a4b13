#!/usr/bin/env python3
"""docs/reference/openapi.json by itself, and the checks of test_openapi.py: each finds a planted deviation."""

import copy
import json
import re
import unittest

from api_description import REPOSITORY, ApiDescription, load_description

ENUM_NAMES = REPOSITORY / "libplan" / "json" / "include" / "acs" / "plan_json" / "PlanEnumNames.hpp"
ENUMS = {"PlanStatus": "EPlanState", "StepStatus": "EStepState", "JobStatus": "EJobState", "RobotStatus": "ERobotStatus",
         "TscState": "ETscState", "AlarmLevel": "EAlarmLevel"}


class Description(unittest.TestCase):
    def test_the_description_is_valid(self):
        self.assertEqual(load_description().find_errors(), [])

    def test_words_are_those_of_the_source(self):
        text = ENUM_NAMES.read_text(encoding="utf-8")
        schemas = load_description().document["components"]["schemas"]
        for schema, enum in ENUMS.items():
            words = re.findall(rf'EnumWord<Planning::{enum}>\{{Planning::{enum}::\w+, "(\w+)"\}}', text)
            self.assertTrue(words, enum)
            self.assertEqual(sorted(schemas[schema]["enum"]), sorted(words))

    def plant(self, change):
        """The description with a change."""
        document = copy.deepcopy(load_description().document)
        change(document)
        return ApiDescription(document)

    def test_a_planted_deviation_of_the_description_is_found(self):
        def change_operation(change):
            return lambda document: change(document["paths"]["/v1/robots/{robotId}"]["get"])

        def change_robot(change):
            return lambda document: change(document["components"]["schemas"]["Robot"])

        deviations = {
            "#/components/schemas/Ghost does not exist": change_robot(
                lambda robot: robot["properties"].update(node={"$ref": "#/components/schemas/Ghost"})),
            "#/components/responses/Ghost is not used": lambda document: document["components"]["responses"].update(
                Ghost={"description": "None."}),
            "GET /v1/robots/{robotId}: the parameter robotId of the path is not declared": change_operation(
                lambda operation: operation.pop("parameters")),
            "GET /v1/robots/{robotId}: the tag ghost is not declared": change_operation(
                lambda operation: operation["tags"].append("ghost")),
            "two operations have the operationId getStatus": change_operation(
                lambda operation: operation.update(operationId="getStatus")),
            "Robot: node: it has no description": change_robot(lambda robot: robot["properties"]["node"].pop("description")),
            "Robot: additionalProperties is missing": change_robot(lambda robot: robot.pop("additionalProperties")),
            "Robot: ghost is required and not described": change_robot(lambda robot: robot["required"].append("ghost")),
        }
        for error, change in deviations.items():
            self.assertIn(error, self.plant(change).find_errors())

    def test_a_planted_deviation_of_an_answer_is_found(self):
        description = load_description()
        answer = json.dumps(description.make_value({"$ref": "#/components/schemas/Robot"}))

        def find_errors(described, target="/v1/robots/LR01", status=200, media="application/json", text=answer):
            return described.find_answer_errors("GET", target, status, {"Content-Type": media}, text)

        self.assertEqual(find_errors(description), [])
        for errors in (find_errors(description, "/v1/ghosts"), find_errors(description, status=418),
                       find_errors(description, media="text/html"), find_errors(description, text="{"),
                       find_errors(description, text=answer.replace('"node"', '"nodes"'))):
            self.assertTrue(errors)

        def forget_member(document):
            document["components"]["schemas"]["Robot"]["properties"].pop("node")
            document["components"]["schemas"]["Robot"]["required"].remove("node")

        def require_member(document):
            document["components"]["schemas"]["Robot"]["properties"]["ghost"] = {"type": "string", "description": "None."}
            document["components"]["schemas"]["Robot"]["required"].append("ghost")

        for change in (forget_member, require_member):
            self.assertTrue(find_errors(self.plant(change)))

    def test_a_planted_member_that_no_answer_has_is_found(self):
        def add_member(document):
            document["components"]["schemas"]["Robot"]["properties"]["ghost"] = {"type": "string", "description": "None."}

        described = self.plant(add_member)
        robot = described.make_value({"$ref": "#/components/schemas/Robot"})
        self.assertEqual(described.find_answer_errors("GET", "/v1/robots/LR01", 200, {"Content-Type": "application/json"},
                                                      json.dumps(robot)), [])
        unseen = described.list_unseen()
        self.assertIn(("Robot.ghost", "value"), unseen)
        self.assertIn(("Robot.node", "null"), unseen)
        self.assertNotIn(("Robot.node", "value"), unseen)

    def test_a_planted_path_is_found(self):
        description = load_description()
        served = {(method, path) for method, path, _ in description.list_operations()}
        self.assertEqual(description.find_route_errors(served), [])
        self.assertEqual(description.find_route_errors(served | {("GET", "/v1/ghosts")}),
                         ["GET /v1/ghosts is served and not described"])
        self.assertEqual(description.find_route_errors(served - {("GET", "/v1/status")}),
                         ["GET /v1/status is described and not served"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
