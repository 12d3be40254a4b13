"""The description of the operator API (docs/reference/openapi.json): its own rules, and answers compared with it."""

import collections
import json
import pathlib
import re
import sys

try:
    import jsonschema
except ImportError:
    print("skipped: python3-jsonschema is not installed", file=sys.stderr)
    sys.exit(77)

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
DESCRIPTION = REPOSITORY / "docs" / "reference" / "openapi.json"
METHODS = ("get", "post")
NDJSON = "application/x-ndjson"
EVENTS = "x-events"
ROOTS = {"openapi", "info", "servers", "security", "tags", "paths", "components"}
OPERATION_MEMBERS = {"operationId", "tags", "summary", "description", "parameters", "requestBody", "responses", "security"}
PARAMETER_MEMBERS = {"name", "in", "required", "description", "schema", "example"}


def list_references(value):
    """The targets of all $ref in the value."""
    if isinstance(value, dict):
        if isinstance(value.get("$ref"), str):
            yield value["$ref"]
        for item in value.values():
            yield from list_references(item)
    elif isinstance(value, list):
        for item in value:
            yield from list_references(item)


def load_description():
    return ApiDescription(json.loads(DESCRIPTION.read_text(encoding="utf-8")))


class ApiDescription:
    """OpenAPI 3.1, of which it uses a part: schemas with one type or a choice with null, and no default answers."""

    def __init__(self, document):
        self.document = document
        self._paths = [(re.compile("".join("[^/]+" if part.startswith("{") else re.escape(part)
                                           for part in re.split(r"(\{[^}]*\})", path))), path) for path in document["paths"]]
        self._validators = {}
        self.seen = set()  # (member, "value" or "null") of the answers
        self.statuses = collections.defaultdict(set)  # those of the answers, by (METHOD, path)

    def list_operations(self):
        """(METHOD, path, operation) of each."""
        return [(method.upper(), path, item[method]) for path, item in self.document["paths"].items()
                for method in METHODS if method in item]

    def resolve(self, value):
        """What a reference names, with the members beside it; any other value itself."""
        if not isinstance(value, dict) or "$ref" not in value:
            return value
        target = self.document
        for key in value["$ref"].removeprefix("#/").split("/"):
            target = target[key]
        return {**self.resolve(target), **{key: item for key, item in value.items() if key != "$ref"}}

    # Its own rules.

    def find_errors(self):
        """What is invalid in the description, a sentence each."""
        errors = [f"unknown member {name}" for name in self.document.keys() - ROOTS]
        if not self.document["openapi"].startswith("3.1."):
            errors.append("it is not OpenAPI 3.1")
        errors += self._find_reference_errors()
        if errors:
            return errors  # the other rules resolve references
        operation_ids = [operation["operationId"] for *_, operation in self.list_operations()]
        errors += [f"two operations have the operationId {name}" for name, count in
                   collections.Counter(operation_ids).items() if count > 1]
        for method, path, operation in self.list_operations():
            errors += [f"{method} {path}: {error}" for error in self._find_operation_errors(method, path, operation)]
        for name, schema in self.document["components"]["schemas"].items():
            errors += [f"{name}: {error}" for error in self._find_schema_errors(schema)]
        return errors

    def _find_reference_errors(self):
        errors = []
        used = set(list_references(self.document))
        for reference in used:
            try:
                self.resolve({"$ref": reference})
            except KeyError:
                errors.append(f"{reference} does not exist")
        for kind in ("parameters", "responses", "schemas"):
            errors += [f"#/components/{kind}/{name} is not used" for name in self.document["components"][kind]
                       if f"#/components/{kind}/{name}" not in used]
        return errors

    def _find_operation_errors(self, method, path, operation):
        errors = [f"unknown member {name}" for name in operation.keys() - OPERATION_MEMBERS]
        errors += [f"{name} is missing" for name in ("operationId", "tags", "summary", "responses") if not operation.get(name)]
        known_tags = {tag["name"] for tag in self.document["tags"]}
        errors += [f"the tag {tag} is not declared" for tag in operation.get("tags", []) if tag not in known_tags]
        parameters = [self.resolve(parameter) for parameter in operation.get("parameters", [])]
        declared = [(parameter["in"], parameter["name"]) for parameter in parameters]
        errors += [f"the parameter {name} is declared twice" for (_, name), count in collections.Counter(declared).items()
                   if count > 1]
        in_path = set(re.findall(r"\{([^}]*)\}", path))
        errors += [f"the parameter {name} of the path is not declared" for name in in_path if ("path", name) not in declared]
        errors += [f"the path has no {name}" for place, name in declared if place == "path" and name not in in_path]
        for parameter in parameters:
            errors += [f"the parameter {parameter['name']} has an unknown member {name}" for name in
                       parameter.keys() - PARAMETER_MEMBERS]
            if not parameter.get("description"):
                errors.append(f"the parameter {parameter['name']} has no description")
            if parameter["in"] == "path" and parameter.get("required") is not True:
                errors.append(f"the parameter {parameter['name']} of the path is not required")
            if "example" in parameter and self.find_schema_errors(parameter["schema"], parameter["example"]):
                errors.append(f"the example of the parameter {parameter['name']} is invalid")
        if method == "GET" and "requestBody" in operation:
            errors.append("a GET has no body")
        names = {scheme for requirement in operation.get("security", self.document["security"]) for scheme in requirement}
        errors += [f"the security scheme {name} is not declared" for name in
                   names - self.document["components"]["securitySchemes"].keys()]
        for status, reference in operation.get("responses", {}).items():
            answer = self.resolve(reference)
            if not re.fullmatch("[2-5][0-9][0-9]", status) or not answer.get("description"):
                errors.append(f"the answer {status} is invalid")
            errors += [f"the answer {status} has no schema" for media in answer.get("content", {}).values()
                       if "schema" not in media]
        return errors

    def _find_schema_errors(self, schema):
        try:
            jsonschema.Draft202012Validator.check_schema(schema)
        except jsonschema.SchemaError as error:
            return [error.message]
        errors = []
        resolved = self.resolve(schema)
        for example in schema.get("examples", []):
            errors += [f"the example {example!r} is invalid: {error}" for error in self.find_schema_errors(schema, example)]
        if not resolved.get("description"):
            errors.append("it has no description")
        if schema.get("type") == "object" and "additionalProperties" not in schema:
            errors.append("additionalProperties is missing")
        if schema.get("type") == "object" and "propertyNames" not in schema:
            if schema.get("additionalProperties") is not False:
                errors.append("additionalProperties is not false")
            errors += [f"{name} is required and not described" for name in
                       set(schema.get("required", [])) - schema.get("properties", {}).keys()]
        for name, member in schema.get("properties", {}).items():
            errors += [f"{name}: {error}" for error in self._find_schema_errors(member)]
        if schema.get("type") == "array" and schema["items"].get("type") == "object":
            errors += [f"items: {error}" for error in self._find_schema_errors(schema["items"])]
        for choice in schema.get("oneOf", []):
            errors += self._find_schema_errors(choice)
        return errors

    # Values.

    def find_schema_errors(self, schema, value):
        """What is invalid in the value, a sentence each."""
        key = json.dumps(schema, sort_keys=True)
        if key not in self._validators:
            self._validators[key] = jsonschema.Draft202012Validator({**schema, "components": self.document["components"]})
        return [f"{error.json_path}: {error.message[:300]}" for error in self._validators[key].iter_errors(value)]

    def make_value(self, schema):
        """A valid value: of the first example or word of each member. Members that may be absent need an example."""
        schema = self.resolve(schema)
        if "anyOf" in schema or "oneOf" in schema:
            return self.make_value((schema.get("anyOf") or schema.get("oneOf"))[0])
        for key in ("examples", "enum"):
            if key in schema:
                return schema[key][0]
        if "const" in schema:
            return schema["const"]
        kind = schema["type"] if isinstance(schema["type"], str) else schema["type"][0]
        if kind == "object":
            return {name: self.make_value(member) for name, member in schema.get("properties", {}).items()
                    if name in schema.get("required", []) or "examples" in member}
        if kind == "array":
            return [self.make_value(schema["items"])] * schema.get("minItems", 1)
        return {"string": "text", "integer": schema.get("minimum", 0), "number": 0.5, "boolean": True}[kind]

    def get_body_schema(self, operation):
        """The schema of the body of its request."""
        return operation["requestBody"]["content"]["application/json"]["schema"]

    def fill_path(self, path, operation, **values):
        """The path with these values of its parameters, else those of the examples."""
        for parameter in map(self.resolve, operation.get("parameters", [])):
            if parameter["in"] == "path":
                value = values.get(parameter["name"], parameter["example"])
                path = path.replace("{" + parameter["name"] + "}", str(value))
        return path

    # Answers.

    def find_path_or_none(self, target):
        """The path of the description that describes this one; a path without a parameter first."""
        path = target.split("?")[0]
        found = [described for pattern, described in self._paths if pattern.fullmatch(path)]
        return min(found, key=lambda described: described.count("{"), default=None)

    def find_answer_errors(self, method, target, status, headers, text):
        """What is in this answer that is not described, a sentence each. Notes the members that it has."""
        path = self.find_path_or_none(target)
        operation = None if path is None else self.document["paths"][path].get(method.lower())
        if operation is None:
            return [f"{method} {target} is not described"]
        if str(status) not in operation["responses"]:
            return [f"{method} {path}: the answer {status} is not described: {text[:300]}"]
        self.statuses[method, path].add(str(status))
        answer = operation["responses"][str(status)]
        label = answer.get("$ref", "").split("/")[-1]
        answer = self.resolve(answer)
        errors = self._find_header_errors(answer, label, headers)
        media = headers.get("Content-Type", "").split(";")[0]
        content = answer.get("content", {})
        if media not in content and (content or text):  # 304 has the type of the description
            errors.append(f"the type {media!r} is not described: {text[:300]}")
        elif media in content and not media.startswith("text/"):
            errors += self._find_text_errors(content[media]["schema"], media, text)
        return [f"{method} {path}: {status}: {error}" for error in errors]

    def _find_header_errors(self, answer, label, headers):
        errors = []
        for name, header in answer.get("headers", {}).items():
            if name in headers:
                value = int(headers[name]) if header["schema"]["type"] == "integer" else headers[name]
                errors += [f"{name}{error}" for error in self.find_schema_errors(header["schema"], value)]
                self.seen.add((f"{label}: {name}", "value"))
        return errors

    def _find_text_errors(self, schema, media, text):
        try:
            values = [json.loads(line) for line in (text.splitlines() if media == NDJSON else [text])]
        except ValueError as error:
            return [f"it is not JSON: {error}"]
        errors = [error for value in values for error in self.find_schema_errors(schema, value)]
        if not errors:
            for value in values:
                self.note(schema, value)
        return errors

    def list_missing_answers(self):
        """(METHOD, path, status) of each answer that was not given. One operation is enough for a status from 500."""
        given = {(method, path, status) for (method, path), statuses in self.statuses.items() for status in statuses}
        failures = {json.dumps(self.document["paths"][path][method.lower()]["responses"][status]) for method, path, status in given
                    if status >= "500"}
        return sorted((method, path, status) for method, path, operation in self.list_operations()
                      for status, answer in operation["responses"].items()
                      if (method, path, status) not in given and not (status >= "500" and json.dumps(answer) in failures))

    def find_event_errors(self, path, event, data):
        """As find_answer_errors, for an event of a stream."""
        media = self.document["paths"][path]["get"]["responses"]["200"]["content"]["text/event-stream"]
        if event not in media[EVENTS]:
            return [f"{path}: the event {event} is not described"]
        errors = [f"{path}: event {event}: {error}" for error in self.find_schema_errors(media[EVENTS][event], data)]
        if not errors:
            self.note(media[EVENTS][event], data)
        return errors

    # Which members were seen.

    @staticmethod
    def _get_label(schema, label):
        reference = schema.get("$ref", "")
        return reference.removeprefix("#/components/schemas/") if reference.startswith("#/components/schemas/") else label

    def note(self, schema, value, label=""):
        """Notes the members of a valid value."""
        label = self._get_label(schema, label)
        schema = self.resolve(schema)
        if "oneOf" in schema:
            number = next(i for i, choice in enumerate(schema["oneOf"]) if not self.find_schema_errors(choice, value))
            self.note(schema["oneOf"][number], value, f"{label}/{number}")
        elif "anyOf" in schema and value is not None:
            self.note(schema["anyOf"][0], value, label)
        elif isinstance(value, dict):
            for name, member in schema.get("properties", {}).items():
                if name in value:
                    self.seen.add((f"{label}.{name}", "null" if value[name] is None else "value"))
                    self.note(member, value[name], f"{label}.{name}")
        elif isinstance(value, list):
            for item in value:
                self.seen.add((f"{label}[]", "null" if item is None else "value"))
                self.note(schema["items"], item, f"{label}[]")

    def list_unseen(self):
        """The members of answers and events that no answer has had: (member, "value" or "null"). Each that may be null must have
        been null and not null."""
        expected = set()
        for *_, operation in self.list_operations():
            for reference in operation["responses"].values():
                answer = self.resolve(reference)
                expected |= {(f"{reference.get('$ref', '').split('/')[-1]}: {name}", "value") for name in answer.get("headers", {})}
                for media in answer.get("content", {}).values():
                    for schema in (media["schema"], *media.get(EVENTS, {}).values()):
                        self._add_expected(schema, "", expected)
        return sorted(expected - self.seen)

    def _add_expected(self, schema, label, expected):
        label = self._get_label(schema, label)
        schema = self.resolve(schema)
        for number, choice in enumerate(schema.get("oneOf", [])):
            self._add_expected(choice, f"{label}/{number}", expected)
        if "anyOf" in schema:
            self._add_expected(schema["anyOf"][0], label, expected)
        members = [(f"{label}.{name}", member) for name, member in schema.get("properties", {}).items()]
        members += [(f"{label}[]", schema["items"])] if "items" in schema else []
        for name, member in members:
            if (name, "value") not in expected:
                expected |= {(name, kind) for kind in (("value", "null") if self._may_be_null(member) else ("value",))}
                self._add_expected(member, name, expected)

    def _may_be_null(self, schema):
        schema = self.resolve(schema)
        return "null" in schema.get("type", []) or any(choice.get("type") == "null" for choice in schema.get("anyOf", []))

    # Routes.

    def find_route_errors(self, served):
        """What is described and not served, or served and not described; `served` has (METHOD, path)."""
        described = {(method, path) for method, path, _ in self.list_operations()}
        return ([f"{method} {path} is described and not served" for method, path in sorted(described - served)]
                + [f"{method} {path} is served and not described" for method, path in sorted(served - described)])
