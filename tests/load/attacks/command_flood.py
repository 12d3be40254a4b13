#!/usr/bin/env python3
"""Sends operator commands to ADDRESS for ROBOT until standard input ends, 16,000 at a time: 16 connections with 1,000 each, which
are all sent before an answer is read. Prints a line of JSON: the number of answers by status."""

import collections
import json
import os
import socket
import sys
import threading

SENDERS = 16
COMMANDS = 1_000  # of one connection
TIMEOUT = 60
NICENESS = 10  # the sender is another machine in a plant


def make_requests(address, robot):
    bodies = ('{"on":true}', '{"on":false}')
    return b"".join(f"POST /v1/robots/{robot}/maintenance HTTP/1.1\r\nHost: {address}\r\nContent-Length: {len(body)}\r\n\r\n"
                    f"{body}".encode() for _ in range(COMMANDS // 2) for body in bodies)


def send_round(address, requests, counts):
    host, port = address.rsplit(":", 1)
    try:
        with socket.create_connection((host, int(port)), TIMEOUT) as connection:
            writer = threading.Thread(target=send_all, args=(connection, requests))
            writer.start()
            with connection.makefile("rb") as reader:
                for _ in range(COMMANDS):
                    status = reader.readline().split()[1].decode()
                    headers = dict(line.decode().strip().split(": ", 1) for line in iter(reader.readline, b"\r\n"))
                    reader.read(int(headers["Content-Length"]))
                    counts[status] += 1
            writer.join()
    except (OSError, IndexError, KeyError, ValueError):
        counts["lost connection"] += 1


def send_all(connection, requests):
    try:
        connection.sendall(requests)
    except OSError:
        pass  # the reader counts it


def main():
    address, robot = sys.argv[1:]
    os.nice(NICENESS)
    requests = make_requests(address, robot)
    counts, ending = collections.Counter(), threading.Event()

    def send_rounds():
        while not ending.is_set():
            send_round(address, requests, counts)

    for _ in range(SENDERS):
        threading.Thread(target=send_rounds, daemon=True).start()
    sys.stdin.read()
    ending.set()
    print(json.dumps(dict(counts)), flush=True)
    os._exit(0)


if __name__ == "__main__":
    main()
