"""The operator API of acsd, for tests and scripts: HTTP without TLS and tokens."""

import json
import urllib.error
import urllib.request

SECONDS = 20


def make_state(snapshot):
    """A snapshot as one dictionary: the members of the status, with the links as name: up, and plans, robots and alarms."""
    lists = {name: snapshot[name] for name in ("plans", "robots", "alarms")}
    return {**snapshot["status"], "links": {link["name"]: link["up"] for link in snapshot["status"]["links"]}, **lists}


def read_state(address, seconds=SECONDS):
    with urllib.request.urlopen(f"http://{address}/v1/snapshot", timeout=seconds) as response:
        return make_state(json.load(response))


def post(address, path, body=None, seconds=SECONDS):
    """The status of the answer and its JSON."""
    data = b"" if body is None else json.dumps(body).encode()
    try:
        with urllib.request.urlopen(f"http://{address}{path}", data=data, timeout=seconds) as response:
            return response.status, json.load(response)
    except urllib.error.HTTPError as error:
        with error:
            return error.code, json.load(error)
