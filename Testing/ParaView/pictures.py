# SPDX-License-Identifier: BSD-3-Clause
"""Pictures as arrays of numpy, and the mask that a mesh should leave in one. Needs no VTK."""
import struct
import zlib

import numpy


def read_png(path):
    """A PNG of 8 bits, RGB or RGBA, as (height, width, 3) bytes, the top row first."""
    data = path.read_bytes()
    width, height, depth, kind, _, _, interlaced = struct.unpack(">IIBBBBB", data[16:29])
    assert depth == 8 and kind in (2, 6) and not interlaced, (depth, kind, interlaced)
    packed, at = b"", 8
    while at < len(data):
        size, name = struct.unpack(">I4s", data[at:at + 8])
        if name == b"IDAT":
            packed += data[at + 8:at + 8 + size]
        at += size + 12
    channels = 3 if kind == 2 else 4
    rows = numpy.frombuffer(zlib.decompress(packed), numpy.uint8).reshape(height, 1 + width * channels)
    picture = numpy.zeros((height + 1, width + 1, channels), int)  # a border of zeros on the top and on the left
    for y in range(height):
        _unfilter(rows[y, 0], rows[y, 1:].reshape(width, channels).astype(int), picture, y + 1)
    return picture[1:, 1:, :3].astype(numpy.uint8)


def _unfilter(kind, row, picture, y):
    """One row of a PNG from its filtered bytes."""
    above = picture[y - 1]
    if kind == 0:
        picture[y, 1:] = row
    elif kind == 1:
        picture[y, 1:] = numpy.cumsum(row, axis=0) % 256
    elif kind == 2:
        picture[y, 1:] = (row + above[1:]) % 256
    else:
        for x in range(1, len(above)):
            a, b, c = picture[y, x - 1], above[x], above[x - 1]
            if kind == 3:
                guess = (a + b) // 2
            else:
                pa, pb, pc = abs(b - c), abs(a - c), abs(a + b - 2 * c)
                guess = numpy.where((pa <= pb) & (pa <= pc), a, numpy.where(pb <= pc, b, c))
            picture[y, x] = (row[x - 1] + guess) % 256


def write_png(path, picture):
    """Bytes (height, width, 3) as PNG."""
    height, width, _ = picture.shape
    rows = numpy.zeros((height, 1 + 3 * width), numpy.uint8)
    rows[:, 1:] = picture.reshape(height, -1)

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(rows.tobytes())) + chunk(b"IEND", b""))


def read_xwd(path):
    """A dump of an X screen of 32 bits a pixel, as Xvfb's -fbdir leaves it; (height, width, 3) bytes."""
    data = path.read_bytes()
    head = struct.unpack(">25I", data[:100])
    size, width, height, order, bits, line, colours = head[0], head[4], head[5], head[7], head[11], head[12], head[19]
    assert bits == 32, bits
    start = size + 12 * colours
    pixels = numpy.frombuffer(data, numpy.uint8, height * line, start).reshape(height, line // 4, 4)[:, :width]
    return pixels[:, :, 2::-1] if order == 0 else pixels[:, :, 1:]


def mask_of(triangles, width, height, scale):
    """The pixels that a mesh covers, seen along y with z upwards in parallel projection."""
    mask = numpy.zeros((height, width), bool)
    per_unit = height / (2 * scale)
    u = width / 2 + triangles[:, :, 0] * per_unit - 0.5  # a pixel's centre is at its number
    v = height / 2 - triangles[:, :, 2] * per_unit - 0.5
    for x, y in zip(u, v):
        left, right = max(0, int(numpy.ceil(x.min()))), min(width - 1, int(numpy.floor(x.max())))
        top, bottom = max(0, int(numpy.ceil(y.min()))), min(height - 1, int(numpy.floor(y.max())))
        if left > right or top > bottom:
            continue
        across, down = numpy.meshgrid(numpy.arange(left, right + 1), numpy.arange(top, bottom + 1))
        sides = [(x[i - 2] - x[i]) * (down - y[i]) - (y[i - 2] - y[i]) * (across - x[i]) for i in range(3)]
        inside = (sides[0] >= 0) & (sides[1] >= 0) & (sides[2] >= 0)
        inside |= (sides[0] <= 0) & (sides[1] <= 0) & (sides[2] <= 0)
        mask[top:bottom + 1, left:right + 1] |= inside
    return mask


def grown(mask):
    """With all neighbours of its pixels."""
    wide = numpy.pad(mask, 1)
    height, width = mask.shape
    return numpy.any([wide[y:y + height, x:x + width] for y in range(3) for x in range(3)], axis=0)
