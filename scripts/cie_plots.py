"""The two figures of cie.py as SVG: curves in the sun's vertical plane, and maps of the sky."""
import math

INK, MUTED, GRID = "#22211f", "#6b6a66", "#dddcd8"
MODEL, CIE = "#2a78d6", "#d9541e"

# Steps of half an aperture stop, dim to bright, in one hue.
LUMINANCE_LEVELS = [2 ** (k / 2) for k in range(-4, 10)]
LUMINANCE_DIM, LUMINANCE_BRIGHT = (9, 24, 51), (238, 245, 253)
# Model over CIE: blue where it is darker, red where it is brighter, grey within 10 %.
RATIO_LEVELS = [0.71, 0.8, 0.9, 1.1, 1.25, 1.5, 1.75, 2.0, 2.5]
RATIO_COLOURS = ["#1c5cab", "#5598e7", "#b7d3f6", "#f0efec", "#fbd5cd", "#f3a394", "#e0705c",
                 "#c23b2b", "#8f1d16", "#5c0d0a"]


def text(x, y, what, anchor="middle", colour=INK, size=11, extra=""):
    return (f'<text x="{x:g}" y="{y:g}" text-anchor="{anchor}" fill="{colour}" '
            f'font-size="{size}"{extra}>{what}</text>')


def document(width, height, body):
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
            f'width="{width}" height="{height}" font-family="sans-serif">\n'
            f'<rect width="{width}" height="{height}" fill="#ffffff"/>\n' + "\n".join(body) +
            "\n</svg>\n")


def line(x0, y0, x1, y1, colour=GRID, width=1.0, dash=""):
    dashes = f' stroke-dasharray="{dash}"' if dash else ""
    return (f'<line x1="{x0:.1f}" y1="{y0:.1f}" x2="{x1:.1f}" y2="{y1:.1f}" stroke="{colour}" '
            f'stroke-width="{width:g}"{dashes}/>')


def curve(points, colour, width, dash=""):
    where = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    dashes = f' stroke-dasharray="{dash}"' if dash else ""
    return (f'<polyline points="{where}" fill="none" stroke="{colour}" stroke-width="{width:g}"'
            f'{dashes} stroke-linejoin="round"/>')


def dot(x, y):
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="1.9" fill="#fff" stroke="{INK}"/>'


# --- The sun's vertical plane ---------------------------------------------------------------------

PANEL_WIDTH, PANEL_HEIGHT = 178, 190
LEAST, MOST = 0.1, 80.0  # Of L / Lz.


def panel(left, top, sun, model, cie, reference, labels):
    def x_of(zenith):
        return left + PANEL_WIDTH * (zenith + 90) / 180

    def y_of(value):
        return top + PANEL_HEIGHT * (math.log(MOST / value) / math.log(MOST / LEAST))

    bottom = top + PANEL_HEIGHT
    body = []
    for value in (0.1, 0.3, 1, 3, 10, 30):
        body.append(line(left, y_of(value), left + PANEL_WIDTH, y_of(value)))
        if labels:
            body.append(text(left - 5, y_of(value) + 4, f"{value:g}", "end", MUTED))
    for zenith in (-90, -45, 0, 45, 90):
        body.append(line(x_of(zenith), bottom, x_of(zenith), bottom + 4, MUTED))
        body.append(text(x_of(zenith), bottom + 16, f"{abs(zenith)}°", colour=MUTED))
    body.append(line(x_of(sun), top, x_of(sun), bottom, "#c9a227", 1, "2 3"))
    body.append(text(left + 4, top - 6, f"sun at {sun}°", "start", size=12))
    rows = [sorted(row.items()) for row in (cie, model, reference)]
    places = [[(x_of(z), y_of(v)) for z, v in row] for row in rows]
    body.append(curve(places[0], CIE, 2, "5 3"))
    body.append(curve(places[1], MODEL, 2))
    # Every other one, so that the curve stays visible.
    return body + [dot(x, y) for x, y in places[2][1::2]]


def plane(model, cie, reference):
    """Each {sun: {signed zenith angle: L / Lz}}, degrees."""
    body = []
    for i, sun in enumerate(model):
        left, top = 46 + (i % 4) * (PANEL_WIDTH + 28), 30 + (i // 4) * (PANEL_HEIGHT + 54)
        body += panel(left, top, sun, model[sun], cie[sun], reference[sun], i % 4 == 0)
    left, top = 46 + 3 * (PANEL_WIDTH + 28) + 12, 30 + PANEL_HEIGHT + 54 + 30
    body.append(curve([(left, top), (left + 28, top)], MODEL, 2))
    body.append(text(left + 38, top + 4, "Alpenglow, tables", "start"))
    body += [dot(left + dx, top + 24) for dx in (4, 14, 24)]
    body.append(text(left + 38, top + 28, "path-traced reference", "start"))
    body.append(curve([(left, top + 48), (left + 28, top + 48)], CIE, 2, "5 3"))
    body.append(text(left + 38, top + 52, "CIE clear sky 12", "start"))
    body.append(line(left, top + 72, left + 28, top + 72, "#c9a227", 1, "2 3"))
    body.append(text(left + 38, top + 76, "the sun", "start"))
    body.append(text(left, top + 110, "Up: luminance over the zenith's.", "start", MUTED))
    body.append(text(left, top + 126, "Across: zenith angle, to the right", "start", MUTED))
    body.append(text(left, top + 142, "towards the sun.", "start", MUTED))
    return document(46 + 4 * PANEL_WIDTH + 3 * 28 + 20, 30 + 2 * PANEL_HEIGHT + 54 + 30, body)


# --- Maps -----------------------------------------------------------------------------------------


def superlevel(values, place, level):
    """Closed polygons around values >= level of a grid whose node (i, j) lies at place(i, j). The
    grid is framed by nodes without light that lie on its border, so that every contour closes."""
    rows, columns = len(values), len(values[0])

    def value(i, j):
        return values[i][j] if 0 <= i < rows and 0 <= j < columns else 0.0

    def where(i, j):
        return place(min(max(i, 0), rows - 1), min(max(j, 0), columns - 1))

    def crossing(a, b):
        """Of the edge between nodes; logarithms are linear along it."""
        (inner, outer) = (a, b) if value(*a) >= level else (b, a)
        (x0, y0), (x1, y1) = where(*inner), where(*outer)
        if value(*outer) == 0:
            return x0, y0
        t = math.log(value(*inner) / level) / math.log(value(*inner) / value(*outer))
        return x0 + t * (x1 - x0), y0 + t * (y1 - y0)

    following = {}
    for i in range(-1, rows):
        for j in range(-1, columns):
            corners = [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)]
            crossed = [(a, b) for a, b in zip(corners, corners[1:] + corners[:1])
                       if (value(*a) >= level) != (value(*b) >= level)]
            # Round the cell, the contour leaves the inside on one edge and enters on the next.
            for k, (a, b) in enumerate(crossed):
                if value(*a) >= level:
                    following[frozenset((a, b))] = frozenset(crossed[(k + 1) % len(crossed)])
    polygons = []
    while following:
        first, edge = following.popitem()
        polygon = [crossing(*first)]
        while edge != first:
            polygon.append(crossing(*edge))
            edge = following.pop(edge)
        polygons.append(polygon)
    return polygons


def simplified(points, tolerance=3.0):
    """Douglas and Peucker: leaves out what is nearer than this to the line without it."""
    if len(points) < 3:
        return points
    (x0, y0), (x1, y1) = points[0], points[-1]
    length = math.hypot(x1 - x0, y1 - y0)

    def distance(p):
        if length < 1e-9:
            return math.hypot(p[0] - x0, p[1] - y0)
        return abs((x1 - x0) * (p[1] - y0) - (y1 - y0) * (p[0] - x0)) / length

    k = max(range(1, len(points) - 1), key=lambda i: distance(points[i]))
    if distance(points[k]) < tolerance:
        return [points[0], points[-1]]
    return simplified(points[:k + 1], tolerance)[:-1] + simplified(points[k:], tolerance)


def area(polygon):
    pairs = zip(polygon, polygon[1:] + polygon[:1])
    return abs(sum(a[0] * b[1] - a[1] * b[0] for a, b in pairs)) / 2


def path(polygons):
    """Whole numbers, each point relative to the one before: a third of the bytes."""
    parts = []
    for polygon in polygons:
        points = [(round(x), round(y)) for x, y in simplified(polygon + polygon[:1])[:-1]]
        if area(points) > 100:  # A pixel.
            steps = " ".join(f"{b[0] - a[0]},{b[1] - a[1]}" for a, b in zip(points, points[1:]))
            steps = steps.replace(" -", "-").replace(",-", "-")
            parts.append("M{},{}l{}z".format(*points[0], steps))
    return "".join(parts)


def luminance_colour(k):
    """Of what lies above k levels."""
    t = k / len(LUMINANCE_LEVELS)
    mixed = [round(a + t * (b - a)) for a, b in zip(LUMINANCE_DIM, LUMINANCE_BRIGHT)]
    return "#" + "".join(f"{x:02x}" for x in mixed)


LUMINANCE_COLOURS = [luminance_colour(k) for k in range(len(LUMINANCE_LEVELS) + 1)]
RADIUS = 56


def half_disc(values, zeniths, azimuths, levels, colours):
    """The half on the right of the sun's plane: zenith at (0, 0), the sun's side up, in tenths."""
    def place(i, j):
        r, a = 10 * RADIUS * zeniths[i] / 90, math.radians(azimuths[j])
        return r * math.sin(a), -r * math.cos(a)

    least, most = min(map(min, values)), max(map(max, values))
    body = []
    for k, level in enumerate([least] + levels):
        following = levels[k] if k < len(levels) else math.inf
        if level <= most and following > least:
            shape = superlevel(values, place, max(level, least))
            body.append(f'<path fill="{colours[k]}" fill-rule="evenodd" d="{path(shape)}"/>')
    return body


def scale(left, top, levels, digits, colours, title):
    """Colours side by side, with the levels at the steps."""
    width = 24
    body = [text(left, top - 8, title, "start")]
    for k, colour in enumerate(colours):
        body.append(f'<rect x="{left + k * width}" y="{top}" width="{width}" height="12" '
                    f'fill="{colour}"/>')
    body.append(f'<rect x="{left}" y="{top}" width="{width * len(colours)}" height="12" '
                f'fill="none" stroke="{MUTED}" stroke-width="0.5"/>')
    for k, level in enumerate(levels):
        label = f"{level:{digits}}"
        body.append(text(left + (k + 1) * width, top + 24, label, colour=MUTED, size=9))
    return body


def marks(sun):
    """The rim, and a cross on the sun."""
    y = -RADIUS * sun / 90
    return [f'<circle r="{RADIUS}" fill="none" stroke="{MUTED}" stroke-width="0.7"/>',
            f'<path d="M-3,{y:.1f}h6M0,{y - 3:.1f}v6" stroke="#c9a227" stroke-width="1.4"/>']


def disc(x, y, sun, left, right):
    return [f'<g transform="translate({x},{y})">', '<g transform="scale(-.1,.1)">', *left, "</g>",
            '<g transform="scale(.1)">', *right, "</g>",
            line(0, -RADIUS, 0, RADIUS, "#ffffff", 0.6), *marks(sun), "</g>"]


def maps(model, cie, zeniths, azimuths):
    """Each {sun: rows of L / Lz}: above both, half and half, below their ratio."""
    body = []
    for i, sun in enumerate(model):
        x = 66 + i * (2 * RADIUS + 12)
        body.append(text(x, 20, f"sun at {sun}°", size=12))
        halves = [half_disc(values[sun], zeniths, azimuths, LUMINANCE_LEVELS, LUMINANCE_COLOURS)
                  for values in (model, cie)]
        body += disc(x, 88, sun, *halves)
        body += [text(x - RADIUS + 24, 158, "Alpenglow", colour=MUTED, size=10),
                 text(x + RADIUS - 24, 158, "CIE 12", colour=MUTED, size=10)]
        ratio = [[a / b for a, b in zip(*rows)] for rows in zip(model[sun], cie[sun])]
        half = half_disc(ratio, zeniths, azimuths, RATIO_LEVELS, RATIO_COLOURS)
        body += disc(x, 228, sun, [f'<g id="r{sun}">', *half, "</g>"],
                     [f'<use href="#r{sun}"/>'])
    body += scale(16, 326, LUMINANCE_LEVELS, ".2g", LUMINANCE_COLOURS,
                  "luminance over the zenith's (above)")
    body += scale(480, 326, RATIO_LEVELS, ".3g", RATIO_COLOURS, "Alpenglow over CIE 12 (below)")
    body.append(text(740, 338, "rim: horizon; +: the sun", "start", MUTED, 10))
    return document(2 * 66 + 6 * (2 * RADIUS + 12), 362, body)
