#!/usr/bin/env python3
"""make_queries.py FOLDER: writes NAME.atmosphere.json and NAME.queries.json of every truth set.

The presets' atmospheres come from `alpenglow presets` (its path in the environment variable
ALPENGLOW); the hard ones are changed here. Ids are kind/sun/details, the sun by the elevation that
sets the query's band: at the ground hit or the lowest point of rays from space, else at the observer.
"""
import json
import math
import os
import subprocess
import sys

SUNS = [90, 60, 30, 12, 5, 1, -2, -5, -8, -11, -15, -18]
PRESETS = ["earth", "earth-fig6", "earth-clear", "earth-hazy", "mars"]


def degrees(x):
    return math.degrees(x)


class Queries:
    """The queries of one set. Lengths given for Earth are scaled to the planet's atmosphere."""

    def __init__(self, atmosphere):
        self.rg = atmosphere["bottom_radius_m"]
        self.rt = atmosphere["top_radius_m"]
        self.scale = min(1.0, (self.rt - self.rg) / 60e3)
        self.list = []
        self.ids = set()

    def add(self, name, **fields):
        if name in self.ids:
            raise ValueError("twice: " + name)
        self.ids.add(name)
        self.list.append({"id": name, **fields})

    def altitude(self, h):
        return h if h <= 2 else h * self.scale

    def dip(self, h):
        return degrees(math.acos(self.rg / (self.rg + h)))

    def irradiance(self, sun, h):
        h = self.altitude(h)
        self.add(f"irradiance/{sun}/{h:g}m", kind="irradiance", altitude_m=h,
                 sun_zenith_deg=90 - sun)

    def ray(self, kind, sun, h, zenith, azimuth, distance=None, detail=""):
        h = self.altitude(h)
        length = "" if distance is None else f"-{distance:g}m"
        self.add(f"{kind}/{sun}/{h:g}m-v{zenith:.6g}-a{azimuth:g}{detail}{length}", altitude_m=h,
                 view_zenith_deg=zenith, sun_zenith_deg=90 - sun, azimuth_deg=azimuth,
                 distance_m=distance)

    def horizon(self, sun, h, offset, azimuth):
        """`offset` degrees above the horizon."""
        h = self.altitude(h)
        zenith = 90 + self.dip(h) - offset
        self.add(f"horizon/{sun}/{h:g}m-{offset:+g}deg-a{azimuth:g}", altitude_m=h,
                 view_zenith_deg=zenith, sun_zenith_deg=90 - sun, azimuth_deg=azimuth,
                 distance_m=None)

    def aureole(self, sun, h, angle):
        """`angle` degrees from the sun, on the side of the zenith."""
        zenith = 90 - sun - angle if 90 - sun >= angle else 90 - sun + angle
        self.ray("aureole", sun, h, zenith, 0, detail=f"-{angle:g}deg")

    def antisolar(self, sun, h):
        """Exactly opposite the sun, if that is the sky; else opposite in azimuth only."""
        zenith = 90 + sun if sun < 0 else min(90 - sun, 85)
        self.ray("antisolar", sun, h, zenith, 180)

    def place_sun(self, sun, azimuth, turn):
        """Zenith angle and azimuth at the observer of a sun that stands at elevation `sun`,
        `azimuth` from the view, at a point of the ray that is `turn` degrees round the planet."""
        z, a, t = map(math.radians, (90 - sun, azimuth, turn))
        x, y, up = math.sin(z) * math.cos(a), math.sin(z) * math.sin(a), math.cos(z)
        # The verticals differ by a turn about y, towards the view.
        x0 = x * math.cos(t) + up * math.sin(t)
        up0 = up * math.cos(t) - x * math.sin(t)
        zenith = degrees(math.atan2(math.hypot(x0, y), up0))
        return zenith, degrees(math.atan2(y, x0))

    def from_space(self, kind, sun, h, off_nadir, azimuth, point_radius, name):
        """A ray whose band is set where it first has `point_radius`, or at its lowest point."""
        h = self.space(h)
        r = self.rg + h
        sine = r * math.sin(math.radians(off_nadir)) / point_radius
        turn = degrees(math.asin(min(sine, 1.0))) - off_nadir
        zenith, around = self.place_sun(sun, azimuth, turn)
        self.add(f"{kind}/{sun}/{name}-a{azimuth:g}", altitude_m=h, view_zenith_deg=180 - off_nadir,
                 sun_zenith_deg=zenith, azimuth_deg=around, distance_m=None)

    def space(self, h):
        """Altitudes in space keep their ratio to the planet's radius, above the atmosphere."""
        return max(h * self.rg / 6360e3, 3 * (self.rt - self.rg)) if self.rg < 3e6 else h

    def down(self, sun, h, off_nadir, azimuth):
        if h < 60e3:
            self.ray("down", sun, h, 180 - off_nadir, azimuth)
        else:
            # Small planets fill less of the view.
            rim = degrees(math.asin(self.rg / (self.rg + self.space(h))))
            off_nadir = round(min(off_nadir, 0.9 * rim), 3)
            self.from_space("down", sun, h, off_nadir, azimuth, self.rg,
                            f"{self.space(h):g}m-{off_nadir:g}deg")

    def limb(self, sun, h, tangent, azimuth):
        """`tangent`: altitude of the ray's lowest point; a bit more than 0 passes the ground."""
        tangent = max(tangent * self.scale, 0.1)
        point = self.rg + tangent
        off = degrees(math.asin(point / (self.rg + self.space(h))))
        self.from_space("limb", sun, h, off, azimuth, point, f"{self.space(h):g}m-t{tangent:g}m")


def day_part(q, sun, i, full):
    """What every sun gets; `i` turns the azimuths and altitudes through the sun directions."""
    azimuths = [0, 60, 120, 180]
    turn = lambda k: azimuths[(i + k) % 4]
    q.irradiance(sun, 0)
    if full:
        q.irradiance(sun, [1000, 10000][i % 2])
    sky = [(0, 0), (30, 1), (60, 2), (80, 0), (87, 3), (89.5, 1), (89.95, 2)]
    for k, (zenith, a) in enumerate(sky[i % 2::2] if full else sky[i % 3::3]):
        q.ray("sky", sun, 2, zenith, turn(a))
    if full or i % 2 == 0:
        q.ray("sky", sun, [1000, 10000, 30000][i % 3], [60, 85, 88, 30][i % 4],
              turn(1))
    q.horizon(sun, 2, [0.005, -0.005, 0.05, -0.05][i % 4], turn(2))
    if full:
        q.horizon(sun, [2, 1000, 10000][i % 3], [-0.05, 0.05, -0.005, 0.005][i % 4], turn(3))


def rest(q, sun, i, full):
    azimuths = [0, 60, 120, 180]
    turn = lambda k: azimuths[(i + k) % 4]
    if sun > 0 and (full or i % 2 == 1):
        q.aureole(sun, 2, [0.3, 1, 3, 10][i % 4])
        if full and i % 2 == 0:
            q.aureole(sun, [2, 1000][i % 2], [1, 3, 10, 0.3][i % 4])
    if full and (sun < 0 or i % 2 == 0):
        q.antisolar(sun, [2, 10000][i % 2])
    if full or i % 2 == 0:
        q.down(sun, [1000, 10000, 400e3, 36e6][i % 4], [0, 20, 60][i % 3] if i % 4 != 3 else 3,
               turn(2))
    if full and i % 4 == 1:
        q.down(sun, [400e3, 1000, 10000][i % 3], [20, 0, 60][i % 3], turn(1))
    tangents = [0, 0.2, 0.5, 1, 2, 5, 10, 20, 40]
    if full or i % 3 == 1:
        q.limb(sun, [400e3, 36e6][i % 2], 1000 * tangents[(5 * i) % 9], turn(3))
    # Every band has short and long, up, level and down.
    lengths = [100, 1000, 10000, 50000, 100000]
    heights = [2, 1000, 10000]
    zeniths = [90, 75, 95]
    for k in range(1 if not full else 1 + i % 2):
        h, zenith = heights[(i + 2 * k) % 3], zeniths[(i + k) % 3]
        if h == 2 and zenith > 90:
            zenith = 90
        q.ray("segment", sun, h, zenith, turn(k), q.altitude(lengths[(2 * i + k) % 5]))


def queries_of(atmosphere, full):
    q = Queries(atmosphere)
    for i, sun in enumerate(SUNS):
        day_part(q, sun, i, full)
    for i, sun in enumerate(SUNS):
        rest(q, sun, i, full)
    return q.list


def evening_queries(atmosphere):
    """What a scene at ground level sees under a sun that stands still, 3 degrees high."""
    q = Queries(atmosphere)
    sun = 3
    azimuths = [0, 30, 90, 150, 180]
    for h in (0, 100):
        q.irradiance(sun, h)
    for i, h in enumerate((2, 100)):
        for k, zenith in enumerate((0, 30, 60, 75, 83, 87, 89, 89.8)):
            for a in azimuths[(i + k) % 2::2]:
                q.ray("sky", sun, h, zenith, a)
        for k, offset in enumerate((0.005, -0.005, 0.05, -0.05)):
            q.horizon(sun, h, offset, azimuths[(2 * i + k) % 5])
        for angle in (0.5, 2, 8):
            q.aureole(sun, h, angle)
        q.antisolar(sun, h)
        for k, length in enumerate((100, 1000, 10000, 50000)):
            q.ray("segment", sun, h, 90 - 0.5 * i, azimuths[k], length)
    q.down(sun, 100, 60, 90)
    return q.list


def changed(base, **fields):
    result = json.loads(json.dumps(base))
    result.update(fields)
    return result


def hard_atmospheres(presets):
    """Named after what makes them hard; all from Earth's."""
    fig6 = presets["earth-fig6"]

    def haze(asymmetry):
        mie = {"scattering_per_m": [1e-4] * 3, "extinction_per_m": [1e-4 / 0.9] * 3,
               "scale_height_m": 1200, "asymmetry": asymmetry}
        return changed(fig6, mie=mie)

    def times(factor, scale_height=1.0, **fields):
        result = changed(fig6, **fields)
        for part in ("rayleigh", "mie"):
            for name, value in result[part].items():
                if name.endswith("_per_m"):
                    result[part][name] = [factor * x for x in value]
            result[part]["scale_height_m"] *= scale_height
        return result

    return {
        "haze85": haze(0.85),
        "haze93": haze(0.93),
        "thick5": times(5.0),
        "planet60km": times(10.0, 0.1, bottom_radius_m=60e3, top_radius_m=66e3),
        "rayleigh-only": changed(fig6, mie=None),
        "mie-only": changed(fig6, rayleigh=None),
    }


def main():
    folder = sys.argv[1]
    program = os.environ.get("ALPENGLOW", "alpenglow")
    presets = {}
    for name in PRESETS:
        presets[name] = json.loads(subprocess.check_output([program, "presets", name]))
    sets = {**presets, **hard_atmospheres(presets), "evening": presets["earth"]}
    for name, atmosphere in sets.items():
        with open(f"{folder}/{name}.atmosphere.json", "w") as file:
            json.dump(atmosphere, file, indent=2)
            file.write("\n")
        queries = (evening_queries(atmosphere) if name == "evening"
                   else queries_of(atmosphere, name in PRESETS))
        lines = ",\n  ".join(json.dumps(q) for q in queries)
        with open(f"{folder}/{name}.queries.json", "w") as file:
            file.write('{"queries": [\n  ' + lines + "]}\n")


if __name__ == "__main__":
    main()
