#!/usr/bin/env python3
"""terrain.py [SOURCE.npz]: makes samples/data/jacksboro.png again, the sample height map.

SOURCE is sample_data/jacksboro_fault_dem.npz of matplotlib, by default as Debian's package
`python-matplotlib-data` installs it. Prints what samples/data/README.md says of the picture.
Needs nothing but Python 3.
"""
import ast
import math
import struct
import sys
import zipfile
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SOURCE = "/usr/share/matplotlib/mpl-data/sample_data/jacksboro_fault_dem.npz"
PICTURE = ROOT / "samples/data/jacksboro.png"

# The ellipsoid of GPS and of the grid's degrees, WGS 84.
EQUATOR_M = 6378137.0
FLATTENING = 1 / 298.257223563


def read_array(archive, name):
    """An array of numpy's format 1.0: its shape and its values, row by row."""
    data = archive.read(name + ".npy")
    if data[:8] != b"\x93NUMPY\x01\x00":
        raise SystemExit(f"{name} is no array of numpy's format 1.0.")
    length = struct.unpack_from("<H", data, 8)[0]
    header = ast.literal_eval(data[10:10 + length].decode("latin-1"))
    code = {"<i2": "h", "<f8": "d"}[header["descr"]]
    if header["fortran_order"]:
        raise SystemExit(f"{name} stands column by column, rows were expected.")
    count = math.prod(header["shape"])
    return header["shape"], struct.unpack_from(f"<{count}{code}", data, 10 + length)


def write_png(path, width, height, values):
    """16-bit grey, each row as differences to the one above."""
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    packed = bytearray()
    above = bytes(2 * width)
    for row in range(height):
        line = struct.pack(f">{width}H", *values[row * width:(row + 1) * width])
        packed.append(2)
        packed += bytes((now - then) & 255 for now, then in zip(line, above))
        above = line
    path.write_bytes(b"\x89PNG\r\n\x1a\n" +
                     chunk(b"IHDR", struct.pack(">2I5B", width, height, 16, 0, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(bytes(packed), 9)) + chunk(b"IEND", b""))


def metres_per_degree(latitude_deg):
    """West to east, and south to north, on the ellipsoid."""
    eccentricity2 = FLATTENING * (2 - FLATTENING)
    phi = math.radians(latitude_deg)
    bend = 1 - eccentricity2 * math.sin(phi) ** 2
    return (math.radians(EQUATOR_M / math.sqrt(bend) * math.cos(phi)),
            math.radians(EQUATOR_M * (1 - eccentricity2) / bend ** 1.5))


def main():
    with zipfile.ZipFile(sys.argv[1] if len(sys.argv) > 1 else SOURCE) as archive:
        (height, width), elevation = read_array(archive, "elevation")
        # "ymin" is row 0, the north edge: it is the larger latitude.
        west, east, north, south, dx, dy = (
            read_array(archive, name)[1][0] for name in ("xmin", "xmax", "ymin", "ymax", "dx", "dy"))
    if not (north > south and east > west and min(elevation) >= 0):
        raise SystemExit("The grid doesn't lie as expected.")
    write_png(PICTURE, width, height, elevation)
    latitude, longitude = (north + south) / 2, (west + east) / 2
    along, up = metres_per_degree(latitude)
    print(f"{PICTURE.name}: {width}x{height}, {min(elevation)} to {max(elevation)} m, "
          f"centre {latitude:.6f} N, {longitude:.6f} E, "
          f"{along * dx:.2f} m west to east, {up * dy:.2f} m north to south a pixel")


if __name__ == "__main__":
    main()
