"""An MCS on plain sockets, for what mcs-sim does not do: it rejects the upgrade, sends fragments and half frames, resets
the connection, and stops reading. It acknowledges the reports of the ACS and records every message."""

import base64
import ctypes
import datetime
import hashlib
import itertools
import json
import socket
import struct
import threading
import time
import uuid

WEBSOCKET_GUID = "258EAFA5-E914-47DA-95CA-C5AB0DC85B11"
CONTINUATION, TEXT, CLOSE, PING, PONG = 0, 1, 8, 9, 10
FINAL, MASKED, LENGTH_BITS = 0x80, 0x80, 0x7F
SHORT_LENGTH, LENGTH_16, LENGTH_64 = 125, 126, 127
WAIT_SECONDS = 60


class Message:
    def __init__(self, connection, body):
        self.time = time.monotonic()
        self.connection = connection
        self.body = body
        self.command = body["command"]
        self.payload = body.get("payload")


def make_frame(opcode, payload, final=True):
    """A frame of a server: not masked (RFC 6455 5.1)."""
    head = bytes([(FINAL if final else 0) | opcode])
    if len(payload) <= SHORT_LENGTH:
        return head + bytes([len(payload)]) + payload
    if len(payload) < 1 << 16:
        return head + struct.pack("!BH", LENGTH_16, len(payload)) + payload
    return head + struct.pack("!BQ", LENGTH_64, len(payload)) + payload


def make_timestamp():
    return datetime.datetime.now().astimezone().isoformat(timespec="milliseconds")


class McsStub:
    """One ACS at a time; all attributes may be read by the test's thread."""

    def __init__(self, receive_buffer=None):
        self._listener = socket.socket()
        self._listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        if receive_buffer is not None:  # before listen(): it limits the offered window
            self._listener.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)
        self._listener.bind(("127.0.0.1", 0))
        self._listener.listen()
        self.address = f"127.0.0.1:{self._listener.getsockname()[1]}"
        self._changed = threading.Condition()
        self._messages = []
        self._socket = None
        self._sending = threading.Lock()  # a message of one thread is not inside that of another
        self._reading = threading.Event()
        self._reading.set()
        self._upgrades_to_refuse = 0
        self.upgrades_refused = 0
        self.unacknowledged = ()  # commands that get no Ack
        self.refused = ()  # commands whose Ack is Fail
        self._withheld_from = None  # Acks are withheld from the next message of this command on
        self._withholding = False
        threading.Thread(target=self._accept, daemon=True).start()

    def close(self):
        self._listener.close()
        self._reading.set()
        if self._socket is not None:
            self._socket.close()

    # The messages of the ACS.

    def count(self):
        with self._changed:
            return len(self._messages)

    def get(self, start=0, stop=None):
        with self._changed:
            return self._messages[start:stop]

    def wait_for(self, command, matches=lambda message: True, start=0, timeout=WAIT_SECONDS):
        """Returns the first matching message of the command from the index `start` on, preceded by its index."""
        deadline = time.monotonic() + timeout
        with self._changed:
            index = start
            while True:
                for index in range(index, len(self._messages)):
                    message = self._messages[index]
                    if message.command == command and matches(message):
                        return index, message
                index = max(start, len(self._messages))
                if not self._changed.wait(deadline - time.monotonic()) and time.monotonic() >= deadline:
                    last = [message.body for message in self._messages[-10:]]
                    raise AssertionError(f"no such {command} came within {timeout} s; the last: {last}")

    def wait_until_refused(self, count, timeout=WAIT_SECONDS):
        with self._changed:
            if not self._changed.wait_for(lambda: self.upgrades_refused >= count, timeout):
                raise AssertionError(f"{self.upgrades_refused} of {count} upgrades came")

    # The actions of the MCS.

    def send_text(self, text, fragments=1):
        """Sends one message. There is a PING between fragments, as RFC 6455 allows."""
        data = text.encode()
        size = -(-len(data) // fragments)
        parts = [data[begin:begin + size] for begin in range(0, len(data), size)]
        with self._sending:
            for number, part in enumerate(parts):
                if number > 0:
                    self._socket.sendall(make_frame(PING, b"between"))
                self._socket.sendall(make_frame(CONTINUATION if number else TEXT, part, number == len(parts) - 1))

    def send_request(self, command, payload, fragments=1, envelope=None):
        """Returns the transactionId. `envelope` has members that replace the usual ones."""
        request = {"command": command, "transactionId": str(uuid.uuid4()), "timestamp": make_timestamp(),
                   "payload": payload} | (envelope or {})
        self.send_text(json.dumps(request), fragments)
        return request["transactionId"]

    def ask(self, command, payload):
        """Returns the body of the Ack."""
        start = self.count()
        transaction = self.send_request(command, payload)
        return self.wait_for(command + "Ack", lambda ack: ack.body.get("transactionId") == transaction, start)[1].body

    def withhold_acks_from(self, command):
        """The next message of the command, and all after it up to the next Registration, get no Ack. The reader thread decides
        this for each message: with `unacknowledged` a test cannot know whether messages that arrive meanwhile still get
        their Acks."""
        with self._changed:
            self._withheld_from = command

    def wait_until_acks_are_read(self):
        """The ACS reads in order: when it answers a request it has read every Ack that was sent before."""
        self.ask("RequestAcsPlans", {})

    def refuse_upgrades(self, count):
        self._upgrades_to_refuse = count

    def close_link(self, code):
        self._socket.sendall(make_frame(CLOSE, struct.pack("!H", code)))

    def reset_link(self):
        """RST in the middle of a frame: its head announces more than is sent."""
        self._socket.sendall(make_frame(TEXT, b" " * 1000)[:100])
        # close() would wait for the reader thread, which uses the socket too. connect() to AF_UNSPEC resets it at once (Linux).
        unspecified = struct.pack("=H14x", socket.AF_UNSPEC)
        ctypes.CDLL(None).connect(self._socket.fileno(), unspecified, len(unspecified))

    def stop_reading(self):
        self._reading.clear()

    def resume_reading(self):
        self._reading.set()

    # The reader.

    def _accept(self):
        for connection in itertools.count(1):
            try:
                peer, _ = self._listener.accept()
            except OSError:
                return
            threading.Thread(target=self._serve, args=(peer, connection), daemon=True).start()

    def _serve(self, peer, connection):
        try:
            with peer, peer.makefile("rb", buffering=0) as stream:
                self._upgrade(peer, stream)
                while True:
                    self._reading.wait()
                    opcode, payload = self._read_frame(stream)
                    if opcode == CLOSE:
                        peer.sendall(make_frame(CLOSE, payload))
                        return
                    if opcode == PING:
                        self._send(peer, make_frame(PONG, payload))
                    elif opcode == TEXT:
                        self._take(peer, connection, payload)
        except (OSError, EOFError):
            pass

    def _send(self, peer, frame):
        with self._sending:
            peer.sendall(frame)

    def _upgrade(self, peer, stream):
        head = b""
        while not head.endswith(b"\r\n\r\n"):
            head += self._read(stream, 1)
        with self._changed:
            refused = self._upgrades_to_refuse > 0
            if refused:
                self._upgrades_to_refuse -= 1
                self.upgrades_refused += 1
                self._changed.notify_all()
        if refused:
            peer.sendall(b"HTTP/1.1 403 Forbidden\r\nContent-Length: 0\r\nConnection: close\r\n\r\n")
            raise EOFError
        lines = head.decode().split("\r\n")
        key = next(line.split(":", 1)[1].strip() for line in lines if line.lower().startswith("sec-websocket-key:"))
        accept = base64.b64encode(hashlib.sha1((key + WEBSOCKET_GUID).encode()).digest()).decode()
        peer.sendall(("HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                      f"Sec-WebSocket-Accept: {accept}\r\n\r\n").encode())
        self._socket = peer

    @staticmethod
    def _read(stream, count):
        data = b""
        while len(data) < count:
            part = stream.read(count - len(data))
            if not part:
                raise EOFError
            data += part
        return data

    def _read_frame(self, stream):
        first, second = self._read(stream, 2)
        length = second & LENGTH_BITS
        if length == LENGTH_16:
            length, = struct.unpack("!H", self._read(stream, 2))
        elif length == LENGTH_64:
            length, = struct.unpack("!Q", self._read(stream, 8))
        mask = self._read(stream, 4)
        data = self._read(stream, length)
        # SPEC section 1: one unfragmented TEXT frame for each message.
        assert first & FINAL and second & MASKED, "a fragment, or a frame that is not masked"
        return first & 0x0F, bytes(byte ^ mask[i % 4] for i, byte in enumerate(data))

    def _take(self, peer, connection, payload):
        message = Message(connection, json.loads(payload))
        with self._changed:
            self._messages.append(message)
            self._changed.notify_all()
            # Under the lock: when a test sees the message its Ack is sent.
            if self._is_acknowledged(message.command):
                result, text = ("Fail", "Refused by the test.") if message.command in self.refused else ("Success", "")
                ack = {"command": message.command + "Ack", "transactionId": message.body["transactionId"],
                       "timestamp": make_timestamp(), "result": result, "message": text, "payload": {}}
                self._send(peer, make_frame(TEXT, json.dumps(ack).encode()))

    def _is_acknowledged(self, command):
        if command.endswith("Ack") or command == "RobotPositionUpdate":
            return False
        if command == self._withheld_from:
            self._withheld_from, self._withholding = None, True
        elif command == "Registration":
            self._withholding = False
        return not self._withholding and command not in self.unacknowledged
