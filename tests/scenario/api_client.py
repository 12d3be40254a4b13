"""Requests to the operator API whose answers are compared with its description."""

import http.client
import json
import socket
import threading

REQUEST_SECONDS = 20


class ApiClient:
    """Every answer that is not as described is an AssertionError."""

    def __init__(self, description, address):
        self._description = description
        self.address = address

    def request(self, method, target, body=None, headers=None):
        """(status, text, headers) of the answer."""
        connection = http.client.HTTPConnection(self.address, timeout=REQUEST_SECONDS)
        try:
            connection.request(method, target, body=body, headers=headers or {})
            response = connection.getresponse()
            text = response.read().decode()
        finally:
            connection.close()
        errors = self._description.find_answer_errors(method, target, response.status, dict(response.getheaders()), text)
        assert not errors, "\n".join(errors)
        return response.status, text, response.headers

    def ask(self, method, target, expected, body=None, headers=None):
        """The text of an answer with this status; the body is JSON unless it is bytes."""
        body = body if body is None or isinstance(body, bytes) else json.dumps(body).encode()
        status, text, _ = self.request(method, target, body, headers)
        assert status == expected, f"{method} {target} {body}: expected {expected}, found {status}: {text[:300]}"
        return text

    def get(self, target):
        return json.loads(self.ask("GET", target, 200))

    def post(self, target, body=None, expected=202):
        return self.ask("POST", target, expected, {} if body is None else body)

    def list_routes(self):
        """(METHOD, path) of each; the answer to a path that does not exist lists them."""
        connection = http.client.HTTPConnection(self.address, timeout=REQUEST_SECONDS)
        try:
            connection.request("GET", "/v1/ghosts")
            response = connection.getresponse()
            text = response.read().decode()
        finally:
            connection.close()
        assert response.status == 404, text
        return {tuple(line.split(" ", 1)) for line in json.loads(text)["error"].splitlines()[1:]}


class EventReader:
    """A stream of events, which a thread reads."""

    def __init__(self, address, after=None):
        self._connection = http.client.HTTPConnection(address, timeout=None)
        self._connection.request("GET", "/v1/events" + ("" if after is None else f"?after={after}"))
        self._socket = self._connection.sock  # getresponse() forgets it, because the stream ends with the connection
        self._response = self._connection.getresponse()
        self.status = self._response.status
        self.content_type = self._response.getheader("Content-Type")
        self._changed = threading.Condition()
        self._events = []  # (type, number or None, data)
        self._thread = threading.Thread(target=self._read, daemon=True)
        self._thread.start()

    def _read(self):
        event = {}
        try:
            for line in map(bytes.decode, self._response):
                if line.strip():
                    name, _, value = line.rstrip("\n").partition(": ")
                    event[name] = value
                    continue
                if "event" in event:
                    with self._changed:
                        number = int(event["id"]) if "id" in event else None
                        self._events.append((event["event"], number, json.loads(event["data"])))
                        self._changed.notify_all()
                event = {}
        except (OSError, ValueError, AttributeError):
            pass  # closed

    def wait_for(self, is_meant, seconds):
        with self._changed:
            assert self._changed.wait_for(lambda: any(map(is_meant, self._events)), seconds), self._events[-10:]

    def close(self):
        """All events that were read."""
        self._socket.shutdown(socket.SHUT_RDWR)
        self._thread.join()
        self._response.close()
        self._connection.close()
        return self._events
