#!/usr/bin/env python3
"""An MCS in Python. You learn how another language uses the MCS-ACS library through its C interface: declare it, report events
to a session, and carry out the actions that the session wants. Standard library only.

    python3 mcs.py --library /opt/acs/lib/libacs_protocol_c.so.1 --listen 127.0.0.1:9001 lr-cassette.json

waits for an ACS, sends the plan when the ACS is registered and its TSC is Auto, prints the reports, and ends when the plan does.
The exit code is 0 if the plan is completed.

Parts: the C interface (Library, Session), a WebSocket server (Peer, RFC 6455), and the program that joins them (Mcs). The session
decides everything about the protocol: Acks, repeated reports, timers, a second ACS. It needs no thread: one loop waits for sockets
and timers.
"""

import argparse
import base64
import ctypes
import hashlib
import json
import pathlib
import selectors
import socket
import struct
import sys
import time

# ---- The C interface: acs/c/acs_protocol.h has the meaning of all fields and functions. -------------------------------------------

ABI_VERSION = 1
OK, ERROR_MESSAGE, ERROR_NOT_READY = 0, 6, 8
NONE, SEND_TEXT, CONNECT, CLOSE, START_TIMER, CANCEL_TIMER, EVENT = range(7)
REGISTERED, REQUEST_RECEIVED, ACK_RECEIVED, REQUEST_UNANSWERED, LINK_LOST, NOTED = 1, 3, 7, 8, 9, 13
SUCCESS = 0


class Text(ctypes.Structure):
    _fields_ = [("data", ctypes.c_void_p), ("length", ctypes.c_size_t)]

    def read(self):
        """A copy: the text itself is valid until the next call only."""
        return ctypes.string_at(self.data, self.length).decode()


class Sized(ctypes.Structure):
    """A structure that begins with its size, by which the library detects a wrong declaration."""

    def __init__(self):
        super().__init__(struct_size=ctypes.sizeof(self))


class Message(Sized):
    _fields_ = [("struct_size", ctypes.c_uint32), ("kind", ctypes.c_int32), ("result", ctypes.c_int32), ("notes", ctypes.c_uint32),
                ("command", Text), ("transaction_id", Text), ("text", Text), ("message", Text), ("error", Text),
                ("error_path", Text), ("error_expected", Text), ("error_found", Text)]


class Action(Sized):
    _fields_ = [("struct_size", ctypes.c_uint32), ("type", ctypes.c_int32), ("event", ctypes.c_int32), ("timer", ctypes.c_int32),
                ("result", ctypes.c_int32), ("reason", ctypes.c_int32), ("close_code", ctypes.c_uint32), ("flag", ctypes.c_uint32),
                ("connection", ctypes.c_uint64), ("token", ctypes.c_uint64), ("count", ctypes.c_uint64),
                ("delay_ms", ctypes.c_int64), ("text", Text), ("command", Text), ("transaction_id", Text), ("path", Text),
                ("message", Text)]


class AcsError(Exception):
    """A function of the library has refused its call."""


class Library:
    """Each function returns a result; call() raises an error unless it is one of the expected results."""

    def __init__(self, path):
        self._library = ctypes.CDLL(path)
        pointer, bytes_, size = ctypes.c_void_p, ctypes.c_char_p, ctypes.c_size_t
        number, time_, result = ctypes.c_uint64, ctypes.c_int64, ctypes.c_int32
        self._declare("acs_c_describe", result, ctypes.POINTER(Text))
        self._declare("acs_codec_create", ctypes.c_uint32, pointer, ctypes.POINTER(pointer))
        self._declare("acs_codec_make_request", pointer, bytes_, size, bytes_, size, time_, ctypes.POINTER(Message))
        self._declare("acs_codec_destroy", pointer)
        self._declare("acs_mcs_create", ctypes.c_uint32, pointer, ctypes.POINTER(pointer))
        self._declare("acs_mcs_connected", pointer, number, time_, time_)
        self._declare("acs_mcs_received", pointer, number, bytes_, size, time_, time_)
        self._declare("acs_mcs_closed", pointer, number, bytes_, size, time_, time_)
        self._declare("acs_mcs_timer_elapsed", pointer, result, time_, time_)
        self._declare("acs_mcs_send", pointer, bytes_, size, time_, time_, pointer)
        self._declare("acs_mcs_next_action", pointer, ctypes.POINTER(Action))
        self._declare("acs_mcs_destroy", pointer)

    def _declare(self, name, *arguments):
        function = getattr(self._library, name)
        function.argtypes = arguments
        function.restype = None if name.endswith("_destroy") else ctypes.c_int32

    def call(self, name, *arguments, expected=(OK,)):
        result = getattr(self._library, name)(*arguments)
        if result is not None and result not in expected:
            text = Text()
            self._library.acs_c_describe(result, ctypes.byref(text))
            raise AcsError(f"{name}: {text.read()}")
        return result

    def make_request(self, command, payload):
        """A request with a new transactionId. Raises an error with the JSON path if the payload is invalid."""
        codec, message = ctypes.c_void_p(), Message()
        self.call("acs_codec_create", ABI_VERSION, None, ctypes.byref(codec))
        try:
            result = self.call("acs_codec_make_request", codec, command, len(command), payload, len(payload), get_wall_time(),
                               ctypes.byref(message), expected=(OK, ERROR_MESSAGE))
            if result != OK:
                raise AcsError(message.error.read())
            return message.text.read().encode(), message.transaction_id.read()
        finally:
            self.call("acs_codec_destroy", codec)


def get_steady_time():
    return time.monotonic_ns() // 1_000_000


def get_wall_time():
    return time.time_ns() // 1_000_000


class Session:
    """The MCS side of the protocol. Everything that happens is reported with the two times."""

    def __init__(self, library):
        self._library = library
        self._handle = ctypes.c_void_p()
        library.call("acs_mcs_create", ABI_VERSION, None, ctypes.byref(self._handle))

    def close(self):
        self._library.call("acs_mcs_destroy", self._handle)
        self._handle = None

    def report(self, event, *arguments):
        self._library.call(f"acs_mcs_{event}", self._handle, *arguments, get_steady_time(), get_wall_time())

    def try_send(self, text):
        """False: no ACS is registered, or it takes no plans now."""
        result = self._library.call("acs_mcs_send", self._handle, text, len(text), get_steady_time(), get_wall_time(), None,
                                    expected=(OK, ERROR_NOT_READY))
        return result == OK

    def take_actions(self):
        """Carrying one out may call the session again; what that adds follows."""
        action = Action()
        while True:
            self._library.call("acs_mcs_next_action", self._handle, ctypes.byref(action))
            if action.type == NONE:
                return
            yield action


# ---- A WebSocket server: what RFC 6455 demands of one, within limits. ---------------------------------------------------------

MAX_PEERS = 8
MAX_HEAD = 16 * 1024  # bytes of the HTTP request
MAX_MESSAGE = 4 * 1024 * 1024  # bytes, all fragments
MAX_UNSENT = 8 * 1024 * 1024  # bytes that wait for a slow client; it is closed beyond
MAX_SILENCE = 60.0  # seconds without a byte; acsd sends a ping every 10 s
MAX_UPGRADE = 10.0  # seconds for the HTTP request
MAX_CLOSING = 5.0  # seconds between our Close and the end of the connection
READ_BYTES = 65536
MAX_PORT = 65535
INTERRUPTED = 130  # exit code after Ctrl-C

GUID = b"258EAFA5-E914-47DA-95CA-C5AB0DC85B11"
CONTINUATION, TEXT, BINARY, CLOSE_FRAME, PING, PONG = 0, 1, 2, 8, 9, 10
TOO_SLOW = "the client reads too slowly"
NORMAL, PROTOCOL_ERROR, ABNORMAL, TOO_BIG = 1000, 1002, 1006, 1009


class Violation(Exception):
    def __init__(self, code, reason):
        super().__init__(reason)
        self.code = code


class Peer:
    """One client. It does not block: receive() returns the messages that are complete, flush() sends what the socket takes."""

    def __init__(self, sock):
        self.socket = sock
        self.number = None  # of the connection, from the upgrade on
        self.upgraded = False
        self.unsent = bytearray()
        self.closing = False  # our Close was sent, or the last answer of a refused upgrade
        self.deadline = time.monotonic() + MAX_UPGRADE
        self._received = bytearray()
        self._fragments = bytearray()
        self._fragmented = False
        self._discarding = False  # what follows a refused upgrade or a violation

    def receive(self):
        """The complete messages. Raises Violation, and OSError if the connection has ended."""
        data = self.socket.recv(READ_BYTES)
        if not data:
            raise OSError("closed by the client")
        if self._discarding:
            return []
        self._received += data
        if not self.upgraded:
            self._upgrade()
        elif not self.closing:
            self.deadline = time.monotonic() + MAX_SILENCE
        messages = []
        try:
            while self.upgraded and (frame := self._take_frame()) is not None:
                message = self._handle_frame(*frame)
                if message is not None and not self.closing:
                    messages.append(message)
        except Violation:
            self._discard()
            raise
        return messages

    def _discard(self):
        """The connection is read until the client closes it, but needs no memory."""
        self._discarding = True
        self._received.clear()
        self._fragments.clear()

    def _upgrade(self):
        end = self._received.find(b"\r\n\r\n")
        if end < 0:
            if len(self._received) > MAX_HEAD:
                raise OSError("the HTTP request is too long")
            return
        request, *lines = bytes(self._received[:end]).decode("latin-1").split("\r\n")
        del self._received[:end + 4]
        headers = {name.strip().lower(): value.strip() for name, _, value in (line.partition(":") for line in lines)}
        key = headers.get("sec-websocket-key", "").encode()
        if (end > MAX_HEAD or not request.startswith("GET ") or headers.get("upgrade", "").lower() != "websocket"
                or headers.get("sec-websocket-version") != "13" or not key):
            self.unsent += b"HTTP/1.1 400 Bad Request\r\nContent-Length: 0\r\nConnection: close\r\n\r\n"
            self._discard()
            self._begin_end()
            return
        accept = base64.b64encode(hashlib.sha1(key + GUID).digest())
        self.unsent += (b"HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                        b"Sec-WebSocket-Accept: " + accept + b"\r\n\r\n")
        self.upgraded = True

    def _take_frame(self):
        """(final, opcode, payload), or None if a part is missing. The length is checked before the payload is awaited."""
        data = self._received
        if len(data) < 2:
            return None
        final, opcode, length = bool(data[0] & 0x80), data[0] & 0x0F, data[1] & 0x7F
        if data[0] & 0x70 or not data[1] & 0x80:
            raise Violation(PROTOCOL_ERROR, "a reserved bit, or a frame without a mask")
        if opcode >= CLOSE_FRAME and (length > 125 or not final):
            raise Violation(PROTOCOL_ERROR, "a control frame that is long or fragmented")
        head = 2 + {126: 2, 127: 8}.get(length, 0)
        if len(data) < head + 4:
            return None
        if length >= 126:
            length = int.from_bytes(data[2:head], "big")
        if length + len(self._fragments) > MAX_MESSAGE:
            raise Violation(TOO_BIG, "a message that is too big")
        if len(data) < head + 4 + length:
            return None
        mask, payload = data[head:head + 4], data[head + 4:head + 4 + length]
        del data[:head + 4 + length]
        key = int.from_bytes((bytes(mask) * (length // 4 + 1))[:length], "big")
        return final, opcode, (int.from_bytes(payload, "big") ^ key).to_bytes(length, "big")

    def _handle_frame(self, final, opcode, payload):
        """The message that this frame completes, or None."""
        if opcode == CLOSE_FRAME:
            self.close(int.from_bytes(payload[:2], "big") if len(payload) >= 2 else NORMAL, "")
        elif opcode == PING:
            if not self.send(PONG, payload):
                raise OSError(TOO_SLOW)
        elif opcode in (TEXT, BINARY, CONTINUATION):
            if (opcode == CONTINUATION) != self._fragmented:
                raise Violation(PROTOCOL_ERROR, "a fragment out of order")
            self._fragments += payload
            self._fragmented = not final
            if final:
                message = bytes(self._fragments)
                self._fragments.clear()
                return message
        elif opcode != PONG:
            raise Violation(PROTOCOL_ERROR, "an unknown opcode")
        return None

    def send(self, opcode, payload):
        """False: the client reads too slowly."""
        if self.closing:
            return True
        length = len(payload)
        head = bytes([0x80 | opcode])
        if length < 126:
            head += bytes([length])
        else:
            head += struct.pack("!BH", 126, length) if length < 1 << 16 else struct.pack("!BQ", 127, length)
        self.unsent += head + payload
        return len(self.unsent) <= MAX_UNSENT

    def close(self, code, reason):
        if self.upgraded:
            self.send(CLOSE_FRAME, struct.pack("!H", code) + reason.encode()[:123])
        self._begin_end()

    def _begin_end(self):
        if not self.closing:
            self.closing = True
            self.deadline = time.monotonic() + MAX_CLOSING

    def flush(self):
        del self.unsent[:self.socket.send(self.unsent)]
        if self.closing and not self.unsent:
            self.socket.shutdown(socket.SHUT_WR)


# ---- The program. --------------------------------------------------------------------------------------------------------------


class Mcs:
    def __init__(self, library, plan_file, host, port):
        plan = pathlib.Path(plan_file).read_bytes()
        # One transactionId for all attempts: the ACS recognises a repeated plan.
        self._request, self._transaction = library.make_request(b"ExecutionPlan", plan)
        self._plan_id = json.loads(self._request)["payload"]["planId"]
        self._session = Session(library)
        self._selector = selectors.DefaultSelector()
        self._listener = socket.create_server((host, port))
        self._listener.setblocking(False)
        self._selector.register(self._listener, selectors.EVENT_READ)
        self._peers = set()
        self._connections = {}  # peer by number; the session demands increasing numbers
        self._last_number = 0
        self._timers = {}  # deadline by timer
        self._sent = False
        self._tsc_auto = False
        self._exit_code = None

    def run(self):
        host, port = self._listener.getsockname()[:2]
        print(f"ready: ws={host}:{port}", flush=True)
        while self._exit_code is None or self._peers:
            for key, events in self._selector.select(self._get_wait()):
                if key.data is None:
                    self._accept()
                else:
                    self._serve(key.data, events)
            self._handle_deadlines()
            self._carry_out()
            self._watch()
        self._session.close()
        return self._exit_code

    # Sockets.

    def _accept(self):
        try:
            sock, _ = self._listener.accept()
        except OSError:
            return
        if len(self._peers) >= MAX_PEERS or self._exit_code is not None:
            sock.close()
            return
        sock.setblocking(False)
        peer = Peer(sock)
        self._peers.add(peer)
        self._selector.register(sock, selectors.EVENT_READ, peer)

    def _serve(self, peer, events):
        try:
            if events & selectors.EVENT_WRITE:
                peer.flush()
            if events & selectors.EVENT_READ:
                messages = peer.receive()
                if peer.upgraded and peer.number is None:
                    self._last_number += 1
                    peer.number = self._last_number
                    self._connections[peer.number] = peer
                    self._session.report("connected", peer.number)
                for message in messages:
                    self._session.report("received", peer.number, message, len(message))
                    self._carry_out()
        except (BlockingIOError, InterruptedError):
            pass
        except Violation as violation:
            peer.close(violation.code, str(violation))
        except OSError as error:
            self._end(peer, str(error))

    def _end(self, peer, reason):
        if peer not in self._peers:
            return
        self._peers.remove(peer)
        self._selector.unregister(peer.socket)
        peer.socket.close()
        if self._connections.pop(peer.number, None) is not None:
            text = reason.encode()
            self._session.report("closed", peer.number, text, len(text))

    def _watch(self):
        for peer in self._peers:
            write = selectors.EVENT_WRITE if peer.unsent else 0
            self._selector.modify(peer.socket, selectors.EVENT_READ | write, peer)

    # Time.

    def _get_wait(self):
        deadlines = [*self._timers.values(), *(peer.deadline for peer in self._peers)]
        return max(0.0, min(deadlines) - time.monotonic()) if deadlines else None

    def _handle_deadlines(self):
        now = time.monotonic()
        for timer in [timer for timer, deadline in self._timers.items() if deadline <= now]:
            del self._timers[timer]
            self._session.report("timer_elapsed", timer)
        for peer in [peer for peer in self._peers if peer.deadline <= now]:
            self._end(peer, "not closed in time" if peer.closing else "no message for a long time")

    # What the session wants.

    def _carry_out(self):
        for action in self._session.take_actions():
            peer = self._connections.get(action.connection)
            if action.type == SEND_TEXT and peer is not None:
                if not peer.send(TEXT, action.text.read().encode()):
                    self._end(peer, TOO_SLOW)
            elif action.type == CLOSE and peer is not None:
                if action.close_code == ABNORMAL:
                    self._end(peer, action.message.read())
                else:
                    peer.close(action.close_code, action.message.read())
            elif action.type == START_TIMER:
                self._timers[action.timer] = time.monotonic() + action.delay_ms / 1000
            elif action.type == CANCEL_TIMER:
                self._timers.pop(action.timer, None)
            elif action.type == EVENT:
                self._handle_event(action)
            self._try_plan()

    def _handle_event(self, action):
        if action.event == REGISTERED:
            print("the ACS is registered", flush=True)
        elif action.event == REQUEST_RECEIVED:
            self._handle_report(action.command.read(), json.loads(action.text.read())["payload"])
        elif action.event == ACK_RECEIVED and action.transaction_id.read() == self._transaction:
            accepted = action.result == SUCCESS
            print(f"plan {self._plan_id}: {'accepted' if accepted else 'refused'}: {action.message.read()}", flush=True)
            if not accepted:
                self._finish(1)
        elif action.event == REQUEST_UNANSWERED:
            print(f"plan {self._plan_id}: no answer; it is sent again", flush=True)
            self._sent = False
        elif action.event == LINK_LOST:
            print(f"the link is lost: {action.message.read()}", flush=True)
            self._tsc_auto = False
        elif action.event == NOTED:
            print(f"note: {action.text.read()} {action.message.read()}", file=sys.stderr, flush=True)

    def _handle_report(self, command, payload):
        if command == "RobotPositionUpdate":  # five times a second
            return
        members = [f"{name}={value}" for name, value in payload.items() if isinstance(value, (str, int, float))]
        print(command, *members, flush=True)
        if command == "TscStateUpdate":
            self._tsc_auto = payload["state"] == "Auto"
        elif command == "PlanReport" and payload["planId"] == self._plan_id:
            if payload["status"] in ("Completed", "Failed", "Cancelled", "Aborted"):
                self._finish(0 if payload["status"] == "Completed" else 1)

    def _try_plan(self):
        if self._tsc_auto and not self._sent and self._exit_code is None:
            self._sent = self._session.try_send(self._request)

    def _finish(self, exit_code):
        """The Acks that wait are sent before the Close."""
        self._exit_code = exit_code
        for peer in self._peers:
            peer.close(NORMAL, "the plan has ended")


def read_address(text):
    host, _, port = text.rpartition(":")
    if not (port.isascii() and port.isdigit() and len(port) <= 5 and int(port) <= MAX_PORT):
        raise argparse.ArgumentTypeError(f"'{text}' is not HOST:PORT with a port of 0 to {MAX_PORT}")
    return host, int(port)


def main():
    parser = argparse.ArgumentParser(description="An MCS that sends one plan to an ACS and prints its reports.")
    parser.add_argument("plan", help="JSON file with the payload of an ExecutionPlan")
    parser.add_argument("--listen", metavar="HOST:PORT", type=read_address, default=("127.0.0.1", 9001),
                        help="address of the server; port 0: a free one (default 127.0.0.1:9001)")
    parser.add_argument("--library", default="libacs_protocol_c.so.1", help="path of the C interface (default: as the loader finds it)")
    arguments = parser.parse_args()
    for output in (sys.stdout, sys.stderr):  # a report may have characters that the locale does not have
        output.reconfigure(errors="backslashreplace")
    try:
        return Mcs(Library(arguments.library), arguments.plan, *arguments.listen).run()
    except (AcsError, OSError) as error:
        print(error, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return INTERRUPTED


if __name__ == "__main__":
    sys.exit(main())
