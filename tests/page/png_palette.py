"""Makes a PNG smaller: 256 colours, which is enough for a picture of a user interface."""

import struct
import zlib
from collections import Counter

SIGNATURE = b"\x89PNG\r\n\x1a\n"
COLOURS = 256


def _read_chunks(data):
    position = len(SIGNATURE)
    while position < len(data):
        length, kind = struct.unpack(">I4s", data[position:position + 8])
        yield kind, data[position + 8:position + 8 + length]
        position += 12 + length


def _make_chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def _unfilter(kind, line, above, size):
    """One line of pixels of `size` bytes."""
    if kind == 2:
        return bytearray((value + up) & 255 for value, up in zip(line, above))
    line = bytearray(line)
    for i in range(len(line)) if kind else ():
        left = line[i - size] if i >= size else 0
        if kind == 1:
            line[i] = (line[i] + left) & 255
        elif kind == 3:
            line[i] = (line[i] + (left + above[i]) // 2) & 255
        else:
            corner = above[i - size] if i >= size else 0
            estimate = left + above[i] - corner
            distances = (abs(estimate - left), abs(estimate - above[i]), abs(estimate - corner))
            line[i] = (line[i] + (left, above[i], corner)[distances.index(min(distances))]) & 255
    return line


def read_pixels(data):
    """(width, lines): each pixel is 3 bytes."""
    chunks = list(_read_chunks(data))
    width, height, depth, colour_type, _, _, interlace = struct.unpack(">IIBBBBB", chunks[0][1])
    if depth != 8 or colour_type not in (2, 6) or interlace:
        raise ValueError("not a PNG of the browser")
    size = 4 if colour_type == 6 else 3
    raw = zlib.decompress(b"".join(content for kind, content in chunks if kind == b"IDAT"))
    lines, above, stride = [], bytearray(width * size), width * size + 1
    for row in range(height):
        line = raw[row * stride:(row + 1) * stride]
        above = _unfilter(line[0], line[1:], above, size)
        lines.append([bytes(above[i:i + 3]) for i in range(0, len(above), size)])
    return width, lines


def _find_nearest(palette, colour):
    """(square of the distance, index)"""
    red, green, blue = colour
    return min(((other[0] - red) ** 2 + (other[1] - green) ** 2 + (other[2] - blue) ** 2, i) for i, other in enumerate(palette))


def _choose_palette(colours):
    """The most frequent ones that differ: a rare colour is not replaced by one of another hue."""
    for distance in (800, 400, 200, 100, 50, 0):
        palette = colours[:1]
        for colour in colours[1:]:
            if len(palette) == COLOURS:
                break
            if _find_nearest(palette, colour)[0] > distance:
                palette.append(colour)
        if len(palette) == COLOURS:
            break
    return palette


def shrink(data):
    width, lines = read_pixels(data)
    counts = Counter()
    for line in lines:
        counts.update(line)
    palette = _choose_palette([colour for colour, _ in counts.most_common()])
    index = {colour: _find_nearest(palette, colour)[1] for colour in counts}
    raw = b"".join(b"\0" + bytes(index[pixel] for pixel in line) for line in lines)
    return (SIGNATURE + _make_chunk(b"IHDR", struct.pack(">IIBBBBB", width, len(lines), 8, 3, 0, 0, 0))
            + _make_chunk(b"PLTE", b"".join(palette)) + _make_chunk(b"IDAT", zlib.compress(raw, 9)) + _make_chunk(b"IEND", b""))
