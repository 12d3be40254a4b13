#!/usr/bin/env python3
"""GET /livez at ADDRESS every 10 ms for SECONDS, each time on a new connection. Prints a line of JSON: the delays in seconds,
the number of attempts that failed, begin and end (monotonic clock), and the longest time by which this program woke late.

One request at a time. While it has no answer, further ones are due: each of them waits from the time at which it was due, so
that an outage of 3 s is 300 delays and not a single one. A request that fails is sent again, and its delay continues."""

import json
import socket
import sys
import time

PERIOD = 0.01


def is_answered(address, timeout):
    host, port = address.rsplit(":", 1)
    try:
        with socket.create_connection((host, int(port)), timeout) as connection:
            connection.sendall(f"GET /livez HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n\r\n".encode())
            with connection.makefile("rb") as reader:
                return reader.readline().startswith(b"HTTP/1.1 200 ")
    except OSError:
        return False


def measure(address, seconds):
    delays, late, failed = [], 0.0, 0
    begin = time.monotonic()
    end = begin + seconds
    due = begin
    while due < end:
        now = time.monotonic()
        if now < due:
            time.sleep(due - now)
            now = time.monotonic()
            late = max(late, now - due)
            due = now  # the machine woke it late, not acsd
        while not is_answered(address, max(end - time.monotonic(), PERIOD)):
            if time.monotonic() >= end:
                break
            failed += 1
            time.sleep(PERIOD / 10)
        now = time.monotonic()
        while due <= min(now, end):
            delays.append(now - due)
            due += PERIOD
    return {"delays": delays, "failed": failed, "begin": begin, "end": max(end, time.monotonic()), "late": late}


if __name__ == "__main__":
    print(json.dumps(measure(sys.argv[1], float(sys.argv[2]))))
