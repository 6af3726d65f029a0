"""Counts the numbers in VTU files, and those that are not finite, with Python's own libraries alone.

Appended raw data, compressed: for each array a header of UInt64 (blocks, bytes of a block, bytes of the last or 0, then the
compressed bytes of each block) and the blocks (VTK's file formats, XML, "appended").
"""
import array
import math
import re
import struct
import zlib

ARRAY = re.compile(rb'<DataArray type="(Float32|Float64)"[^>]*offset="(\d+)"')
LETTER = {b"Float32": "f", b"Float64": "d"}


def values(data, offset):
    blocks = struct.unpack_from("<Q", data, offset)[0]
    sizes = struct.unpack_from(f"<{blocks}Q", data, offset + 24)
    at = offset + 24 + 8 * blocks
    for size in sizes:
        yield zlib.decompress(data[at : at + size])
        at += size


def saved_numbers(folder):
    """(numbers, those that are not finite) in all .vtu files below `folder`."""
    count = bad = 0
    for path in sorted(folder.rglob("*.vtu")):
        data = path.read_bytes()
        start = data.index(b"_", data.index(b"<AppendedData")) + 1
        for kind, offset in ARRAY.findall(data[:start]):
            numbers = array.array(LETTER[kind], b"".join(values(data, start + int(offset))))
            count += len(numbers)
            bad += sum(not math.isfinite(x) for x in numbers)
    return count, bad
