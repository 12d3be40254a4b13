"""TCP proxies that a test can cut, between acsd and the MCS, the broker or an arm. A callback gets each WebSocket message
from acsd to the MCS, or each line to an arm, before it is forwarded."""

import socket
import threading


class FrameReader:
    """Extracts the text messages from a client's byte stream: HTTP upgrade first, then masked frames (RFC 6455)."""

    def __init__(self):
        self._buffer = b""
        self._upgraded = False

    def feed(self, data):
        self._buffer += data
        if not self._upgraded:
            _, separator, rest = self._buffer.partition(b"\r\n\r\n")
            if not separator:
                return []
            self._upgraded, self._buffer = True, rest
        messages = []
        while (frame := self._take_frame()) is not None:
            opcode, payload = frame
            if opcode == 1:
                messages.append(payload.decode())
        return messages

    def _take_frame(self):
        data = self._buffer
        if len(data) < 2:
            return None
        length, offset = data[1] & 0x7F, 2
        if length in (126, 127):
            size = 2 if length == 126 else 8
            if len(data) < offset + size:
                return None
            length, offset = int.from_bytes(data[offset:offset + size], "big"), offset + size
        if len(data) < offset + 4 + length:
            return None
        mask, offset = data[offset:offset + 4], offset + 4
        payload = bytes(byte ^ mask[i % 4] for i, byte in enumerate(data[offset:offset + length]))
        self._buffer = data[offset + length:]
        return data[0] & 0x0F, payload


class LinkProxy:
    """on_message(text) is called on the proxy's thread before the text is forwarded; without it nothing is parsed."""

    def __init__(self, target_port, on_message=None):
        self._target_port = target_port
        self._on_message = on_message
        self._lock = threading.Lock()
        self._sockets = set()
        self._cut = False
        self.connections = 0
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port = self._listener.getsockname()[1]
        threading.Thread(target=self._accept, daemon=True).start()

    def _accept(self):
        while True:
            try:
                client, _ = self._listener.accept()
            except OSError:
                return
            with self._lock:
                if self._cut:
                    client.close()
                    continue
                try:
                    server = socket.create_connection(("127.0.0.1", self._target_port))
                except OSError:
                    client.close()
                    continue
                self._sockets |= {client, server}
                self.connections += 1
            threading.Thread(target=self._pump, args=(client, server, FrameReader() if self._on_message else None),
                             daemon=True).start()
            threading.Thread(target=self._pump, args=(server, client, None), daemon=True).start()

    def _pump(self, source, sink, reader):
        try:
            while data := source.recv(65536):
                for message in reader.feed(data) if reader else ():
                    self._on_message(message)
                sink.sendall(data)
        except OSError:
            pass
        self._end(source, sink)

    def _end(self, source, sink):
        for end in (source, sink):
            try:
                end.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass
        with self._lock:
            self._sockets.discard(source)
        source.close()  # the other direction closes the other end

    def cut(self):
        """Resets all connections without a close handshake, and rejects new ones until mend()."""
        with self._lock:
            self._cut = True
            ends, self._sockets = self._sockets, set()
        for end in ends:
            try:
                end.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass

    def mend(self):
        with self._lock:
            self._cut = False

    def close(self):
        self._listener.close()
        self.cut()


class LineProxy(LinkProxy):
    """on_message(line) is called before the line is forwarded. False: the line and everything after it are dropped, and the
    connection ends."""

    def _pump(self, source, sink, reader):
        if reader is None:
            super()._pump(source, sink, None)
            return
        try:
            with source.makefile("rb") as stream:
                for line in stream:
                    if not self._on_message(line.decode()):
                        break
                    sink.sendall(line)
        except OSError:
            pass
        self._end(source, sink)
