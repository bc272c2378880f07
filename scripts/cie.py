#!/usr/bin/env python3
"""cie.py [--reference] [--standard]: Alpenglow's clear sky against the CIE standard clear sky 12.

Makes docs/data/cie_*.csv, docs/images/cie_*.svg and the tables in docs/cie.md again, from what
`alpenglow probe` answers (the environment variable ALPENGLOW names the program; default:
build/bin/alpenglow). Needs nothing but Python 3 and takes some 10 s. Two parts are costly; they are
made with an option and kept in their files otherwise:

  --reference  double-precision path tracing of every other ray (75 s of CPU)
  --standard   the solver as published at the paper's sizes, on the same rays (25 s of CPU)
"""
import argparse
import csv
import json
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import cie_plots

ROOT = Path(__file__).resolve().parent.parent
DATA = ROOT / "docs/data"
PROGRAM = os.environ.get("ALPENGLOW", str(ROOT / "build/bin/alpenglow"))

SUNS = [0, 15, 30, 45, 60, 75, 85]  # Zenith angles, degrees.
ZENITHS = [2.5 * i for i in range(36)] + [89]
# In the sun's vertical plane, negative away from the sun.
PLANE = [-z for z in reversed(ZENITHS[1:])] + ZENITHS
COARSE_PLANE = [z for z in PLANE if z % 5 == 0 or abs(z) == 89]
AZIMUTHS = [6 * i for i in range(31)]
SAMPLES = 65536

# From radiance at 680, 550 and 440 nm under a sun of the same irradiance in all three to luminance:
# the photopic curve V of the CIE at these wavelengths; and those of linear Rec. 709 for comparison.
PHOTOPIC = (0.017, 0.995, 0.023)
REC709 = (0.2126, 0.7152, 0.0722)

# Ratios are summed up as far as this from the zenith.
MOST_ZENITH = 80


# -b of the CIE's gradation: it is the light of an evenly lit layer of this optical depth.
CIE_DEPTH = 0.32


def gradation(z):
    """phi; 90 degrees and beyond are the horizon's limit."""
    return 1 - math.exp(-CIE_DEPTH / math.cos(z)) if z < math.pi / 2 else 1.0


def indicatrix(chi):
    """f."""
    far = math.exp(-3 * math.pi / 2)
    return 1 + 10 * (math.exp(-3 * chi) - far) + 0.45 * math.cos(chi) ** 2


def cie12(view, sun, azimuth):
    """L / Lz of the CIE standard clear sky 12; degrees."""
    z, zs, a = map(math.radians, (view, sun, azimuth))
    cos_chi = math.cos(z) * math.cos(zs) + math.sin(z) * math.sin(zs) * math.cos(a)
    chi = math.acos(max(-1.0, min(1.0, cos_chi)))
    return indicatrix(chi) * gradation(z) / (indicatrix(zs) * gradation(0))


def luminance(rgb, weights=PHOTOPIC):
    return sum(w * x for w, x in zip(weights, rgb))


def probe(atmosphere, rays, *options):
    """Of rays (sun, view, azimuth) from 2 m: sky radiance, and the reference's standard error."""
    queries = [{"id": str(i), "altitude_m": 2, "view_zenith_deg": view, "sun_zenith_deg": sun,
                "azimuth_deg": azimuth} for i, (sun, view, azimuth) in enumerate(rays)]
    with tempfile.TemporaryDirectory() as folder:
        asked, answered = f"{folder}/queries.json", f"{folder}/answers.json"
        Path(asked).write_text(json.dumps({"queries": queries}))
        subprocess.run([PROGRAM, "probe", atmosphere, "--queries", asked, "-o", answered, *options],
                       check=True)
        answers = json.loads(Path(answered).read_text())["answers"]
    return [(a["sky_radiance"], a.get("standard_error", {}).get("sky_radiance")) for a in answers]


def probe_plane(atmosphere, zeniths, *options):
    """{sun: {signed zenith angle: (radiance, error)}}"""
    rays = [(sun, z) for sun in SUNS for z in zeniths]
    found = probe(atmosphere, [(s, abs(z), 180 if z < 0 else 0) for s, z in rays], *options)
    plane = {sun: {} for sun in SUNS}
    for (sun, z), answer in zip(rays, found):
        plane[sun][z] = answer
    return plane


def relative(plane, weights=PHOTOPIC):
    """{sun: {signed zenith angle: L / Lz}}"""
    return {sun: {z: luminance(rgb, weights) / luminance(row[0][0], weights)
                  for z, (rgb, _) in row.items()} for sun, row in plane.items()}


def cie_plane(sun, z):
    return cie12(abs(z), sun, 180 if z < 0 else 0)


def write_plane(name, plane):
    fields = ["sun_zenith_deg", "view_zenith_deg", "red", "green", "blue", "luminance", "cie12"]
    with_error = plane[0][0][1] is not None
    lums = relative(plane)
    with open(DATA / name, "w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(fields + with_error * ["relative_error"])
        for sun, row in plane.items():
            for z, (rgb, error) in row.items():
                values = [*rgb, lums[sun][z], cie_plane(sun, z)]
                # The channels share their paths, so their errors add up.
                last = [f"{luminance(error) / luminance(rgb):.2g}"] if with_error else []
                out.writerow([sun, f"{z:g}", *(f"{x:.5g}" for x in values), *last])


def read_plane(name):
    plane = {sun: {} for sun in SUNS}
    with open(DATA / name, newline="") as file:
        for row in csv.DictReader(file):
            rgb = [float(row[c]) for c in ("red", "green", "blue")]
            plane[int(row["sun_zenith_deg"])][float(row["view_zenith_deg"])] = (rgb, None)
    return plane


def make_maps(atmosphere):
    """{sun: rows of L / Lz, a row for each of ZENITHS, a column for each of AZIMUTHS}"""
    rays = [(sun, z, a) for sun in SUNS for z in ZENITHS for a in AZIMUTHS]
    lums = iter([luminance(rgb) for rgb, _ in probe(atmosphere, rays)])
    maps = {}
    for sun in SUNS:
        rows = [[next(lums) for _ in AZIMUTHS] for _ in ZENITHS]
        maps[sun] = [[x / rows[0][0] for x in row] for row in rows]
    return maps


def write_maps(name, maps):
    with open(DATA / name, "w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["sun_zenith_deg", "view_zenith_deg", *(f"azimuth_{a}_deg" for a in AZIMUTHS)])
        for sun, rows in maps.items():
            for z, row in zip(ZENITHS, rows):
                out.writerow([sun, f"{z:g}", *(f"{x:.3g}" for x in row)])


def aerosol_to_depth(preset, depth):
    """The preset with aerosols raised to an optical depth at 550 nm; and the depth it had."""
    a = json.loads(subprocess.check_output([PROGRAM, "presets", preset]))
    top = a["top_radius_m"] - a["bottom_radius_m"]

    def column(part):
        return part["scale_height_m"] * (1 - math.exp(-top / part["scale_height_m"]))

    def optical_depth():
        return (a["rayleigh"]["scattering_per_m"][1] * column(a["rayleigh"]) +
                a["mie"]["extinction_per_m"][1] * column(a["mie"]))

    before = optical_depth()
    mie = a["mie"]["extinction_per_m"][1] * column(a["mie"])
    factor = 1 + (depth - before) / mie
    for name in ("scattering_per_m", "extinction_per_m"):
        a["mie"][name] = [factor * x for x in a["mie"][name]]
    return a, before


def percentile(values, share, weights=None):
    """Smallest value with at least this share of the weight up to it."""
    pairs = sorted(zip(values, weights or [1.0] * len(values)))
    rest = share * sum(w for _, w in pairs)
    for value, weight in pairs:
        rest -= weight
        if rest <= 1e-9:
            return value
    return pairs[-1][0]


def three(row, sun):
    """Of L / Lz over CIE's."""
    ratios = [x / cie_plane(sun, z) for z, x in row.items() if abs(z) <= MOST_ZENITH]
    return f"{percentile(ratios, 0.5):.2f} ({min(ratios):.2f} to {max(ratios):.2f})"


def largest_difference(a, b):
    """Of L / Lz over all rays, in per cent."""
    return 100 * max(abs(a[z] / b[z] - 1) for z in b)


def plane_table(plane, reference, standard):
    coarse = {sun: {z: row[z] for z in COARSE_PLANE} for sun, row in plane.items()}
    sources = [relative(coarse), relative(coarse, REC709), relative(reference)]
    lines = ["| sun zenith | tables, V | tables, Rec. 709 | reference, V | tables off by |"
             " solver `standard` off by |", "|---|---|---|---|---|---|"]
    paper = relative(standard)
    for sun in SUNS:
        cells = [three(source[sun], sun) for source in sources]
        cells += [f"{largest_difference(source[sun], sources[2][sun]):.2f} %"
                  for source in (sources[0], paper)]
        lines.append(f"| {sun}° | " + " | ".join(cells) + " |")
    return lines


def map_table(maps):
    lines = ["| sun zenith | median | 5 % | 95 % | least | greatest |", "|---|---|---|---|---|---|"]
    for sun, rows in maps.items():
        ratios, weights = [], []
        for z, row in zip(ZENITHS, rows):
            for azimuth, x in zip(AZIMUTHS, row):
                if z <= MOST_ZENITH:
                    ratios.append(x / cie12(z, sun, azimuth))
                    half = 0.5 if azimuth in (0, 180) else 1.0  # The seam of two mirrored halves.
                    weights.append(half * math.sin(math.radians(z)))
        values = [percentile(ratios, p, weights) for p in (0.5, 0.05, 0.95)]
        values += [min(ratios), max(ratios)]
        lines.append(f"| {sun}° | " + " | ".join(f"{x:.2f}" for x in values) + " |")
    return lines


def depth_table(depths):
    """Ratios away from the sun and about it, {optical depth: plane}."""
    lines = ["| sun zenith | optical depth | away from the sun: 60° | 80° | 89° |"
             " within 20° of the sun, greatest |", "|---|---|---|---|---|---|"]
    for sun in (45, 60, 75):
        for depth, plane in depths.items():
            ratios = {z: x / cie_plane(sun, z) for z, x in relative(plane)[sun].items()}
            near = max(x for z, x in ratios.items() if abs(z - sun) <= 20 and z <= MOST_ZENITH)
            cells = [f"{x:.2f}" for x in (depth, ratios[-60], ratios[-80], ratios[-89], near)]
            lines.append(f"| {sun}° | " + " | ".join(cells) + " |")
    return lines


def put_tables(tables):
    """Between `<!-- NAME -->` and `<!-- end -->` of docs/cie.md."""
    path = ROOT / "docs/cie.md"
    text = path.read_text()
    for name, lines in tables.items():
        head, found, rest = text.partition(f"<!-- {name} -->\n")
        if not found or "<!-- end -->" not in rest:
            sys.exit(f"{path} has no place for the table '{name}': a line <!-- {name} --> and,"
                     " after it, a line <!-- end --> were expected.")
        tail = rest[rest.index("<!-- end -->"):]
        text = head + found + "\n" + "\n".join(lines) + "\n\n" + tail
    path.write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--reference", action="store_true")
    parser.add_argument("--standard", action="store_true")
    options = parser.parse_args()
    DATA.mkdir(exist_ok=True)

    if options.reference:
        write_plane("cie_reference.csv", probe_plane("earth-fig7", COARSE_PLANE, "--method",
                                                     "reference", "--samples", str(SAMPLES)))
    if options.standard:
        write_plane("cie_standard.csv",
                    probe_plane("earth-fig7", COARSE_PLANE, "--solver", "standard"))
    plane = probe_plane("earth-fig7", PLANE)
    write_plane("cie_plane.csv", plane)
    maps = make_maps("earth-fig6")
    write_maps("cie_map.csv", maps)
    deep, depth = aerosol_to_depth("earth-fig7", CIE_DEPTH)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "deep.json")
        path.write_text(json.dumps(deep))
        deep_plane = probe_plane(str(path), PLANE)

    reference = read_plane("cie_reference.csv")
    put_tables({"plane": plane_table(plane, reference, read_plane("cie_standard.csv")),
                "map": map_table(maps),
                "depth": depth_table({depth: plane, CIE_DEPTH: deep_plane})})
    images = ROOT / "docs/images"
    cie = {sun: {z: cie_plane(sun, z) for z in PLANE} for sun in SUNS}
    (images / "cie_plane.svg").write_text(
        cie_plots.plane(relative(plane), cie, relative(reference)))
    cie_maps = {sun: [[cie12(z, sun, a) for a in AZIMUTHS] for z in ZENITHS] for sun in SUNS}
    (images / "cie_map.svg").write_text(cie_plots.maps(maps, cie_maps, ZENITHS, AZIMUTHS))


if __name__ == "__main__":
    main()
