"""Maps that nobody would draw: each ends in a message that names the feature, or in a result.

Of every file that is read, the features that the note counts are those that became shapes, were
left out or fit no output; `bad` has as many as were left out.
"""

import json
import math
import os
import re
import shutil
import subprocess
import sys
import time

GRAPH = """use gis
graph all {
    param map: path
    param crs: string = ""
    param origin: list<float> = []
    attr id: string
    attr name: string
    m: read_map(file = map, crs = crs, origin = origin, id => @id) {
        areas: polygons()
        lines: lines()
        points: points()
        field("name", to = @name)
    }
}
"""
NOTE = re.compile(r": (\d+) features: (\d+) became shapes, (\d+) of them mended; "
                  r"(\d+) are left out, (\d+) fit no output;")
failed = False


def check(holds, what, shown=""):
    """Prints the line of an expectation."""
    global failed
    print("%s %s" % ("ok" if holds else "not ok", what))
    if not holds:
        failed = True
        print("    " + str(shown)[:2000].replace("\n", "\n    "))


class Run:
    """A run of the graph on a file: what came out, and what was said."""

    def __init__(self, name, *options):
        self.name = name
        begun = time.monotonic()
        done = subprocess.run([os.environ["PCGC"], "run", "all.pcg", "-p", "map=" + name, "--json",
                               "--entities", *options], capture_output=True, check=False)
        self.seconds = time.monotonic() - begun
        self.code = done.returncode
        self.said = done.stderr.decode("utf-8", "replace")
        self.result = json.loads(done.stdout) if done.stdout else {"outputs": [], "diagnostics": []}
        self.messages = [d["message"] for d in self.result["diagnostics"]]
        note = [n for n in map(NOTE.search, self.messages) if n]
        self.counts = [int(x) for x in note[0].groups()] if note else None

    def list(self, port):
        for output in self.result["outputs"]:
            if output["port"] == "m." + port:
                return output["entities"]
        return []

    def ids(self, port):
        return [e["attributes"]["id"] for e in self.list(port)]

    def adds_up(self):
        """Whether each feature that was read has one fate."""
        read, shapes, mended, bad, unfit = self.counts
        return (read == shapes + bad + unfit and mended <= shapes and bad == len(self.list("bad")) and
                shapes <= sum(len(self.list(p)) for p in ("areas", "lines", "points")) and
                all(math.isfinite(x) for p in ("areas", "lines", "points") for e in self.list(p)
                    for corner in e["bounds"] for x in corner))


def expect(name, read, bad, *messages, options=()):
    """A map that is read: so many features, these ids of bad ones (or how many), these messages."""
    run = Run(name, *options)
    what = "%s: %s features, bad %s" % (name, read, bad)
    if run.counts is None:
        check(False, what, run.said)
        return run
    found = run.ids("bad") if isinstance(bad, list) else len(run.list("bad"))
    check(run.code == 0 and run.counts[0] == read and found == bad and run.adds_up(), what,
          (run.counts, found, run.said))
    for m in messages:
        check(any(m in x for x in run.messages), "%s says: %s" % (name, m), run.said)
    return run


def refuse(name, message):
    """A file that is no map."""
    run = Run(name)
    check(run.code == 3 and message in run.said and name in run.said,
          "%s is refused: %s" % (name, message), (run.code, run.said))


def write(name, content):
    with open(name, "wb") as f:
        f.write(content if isinstance(content, bytes) else content.encode())


def collection(name, *features):
    write(name, '{"type":"FeatureCollection","features":[%s]}' % ",".join(features))


def feature(geometry, properties="{}"):
    return '{"type":"Feature","properties":%s,"geometry":%s}' % (properties, geometry)


def polygon(*rings):
    return '{"type":"Polygon","coordinates":[%s]}' % ",".join(rings)


def ring(*points):
    return "[%s]" % ",".join("[%s,%s]" % p for p in points)


def square(x, y, side, clockwise=False):
    points = [(x, y), (x + side, y), (x + side, y + side), (x, y + side), (x, y)]
    return ring(*[("%.6f" % a, "%.6f" % b) for a, b in points[::-1 if clockwise else 1]])


POINT = '{"type":"Point","coordinates":[9,47]}'


def rings():
    """Bow ties and holes in every place."""
    def metres(*sides):
        return sum(sign * (side * 111194 * side * 76033) for sign, side in sides)
    collection("rings.geojson",
               feature(polygon(ring((9, 47), (9.001, 47.001), (9.001, 47), (9, 47.001), (9, 47)))),
               feature(polygon(square(9, 47, .01), square(9.02, 47, .001))),
               feature(polygon(square(9, 47, .01), square(9.001, 47.001, .008),
                               square(9.003, 47.003, .003))),
               feature(polygon(square(9, 47, .01), square(9.001, 47.001, .004),
                               square(9.003, 47.003, .004))),
               feature(polygon(square(9, 47, .01), square(9, 47, .01))),
               feature(polygon(square(9, 47, .01, True), square(9.001, 47.001, .001))),
               feature(polygon(square(9, 47, .01), square(9.005, 47.005, .01))))
    run = expect("rings.geojson", 7, ["4"], "0 is mended: self-intersection",
                 "1 is mended: hole lies outside shell", "2 is mended: holes are nested",
                 "3 is mended: self-intersection", "4 is left out: self-intersection",
                 "6 is mended: self-intersection")
    expected = [metres((.5, .001)), metres((1, .01), (1, .001)), metres((1, .01), (-1, .008)),
                metres((1, .01), (-2, .004), (1, .002)), metres((1, .01), (-1, .001)),
                metres((1, .01), (-1, .005))]
    found = [e["area"] for e in run.list("areas")]
    check(len(found) == 6 and all(abs(a - b) < b / 500 for a, b in zip(found, expected)),
          "holes are taken off their outlines; one outside is an area of its own", (found, expected))


def flat_rings():
    collection("flat.geojson",
               feature(polygon(ring((9, 47), (9, 47), (9, 47), (9, 47)))),
               feature(polygon(ring((9, 47), (9.001, 47), (9.002, 47), (9, 47)))),
               feature(polygon(ring((9, 47), (9.001, 47), (9.001, 47), (9.001, 47.001),
                                    (9.001, 47.001), (9, 47)))),
               feature(polygon(ring((9, 47), (9.001, 47), (9.001, 47.001), (9.001, 47), (9, 47)))),
               feature(polygon(ring((9, 47), (9.001, 47), (9, 47)))),
               feature(polygon(ring((9, 47), (9.001, 47), (9.001, 47.001)))),
               feature(polygon(ring((9, 47), ("9.0000000001", 47), (9, "47.0000000001"), (9, 47)))),
               feature('{"type":"LineString","coordinates":[[9,47],[9,47],[9,47]]}'))
    run = expect("flat.geojson", 8, ["0", "1", "3", "4", "7"],
                 "7 is left out: a line has less than two points")
    check([e["faces"] for e in run.list("areas")] == [1, 1, 1] and run.ids("areas") == ["2", "5", "6"],
          "points that repeat count once, a ring that is open is closed", run.said)


def numbers():
    values = ["NaN", "Infinity", "-Infinity", "1e400", "-1e400", "1e-400", "null", '"9"', "true",
              "[9]", "{}", "999999999999999999999999999999"]
    collection("numbers.geojson",
               *[feature(polygon(ring((9, 47), (v, 47.001), (9.001, 47), (9, 47)))) for v in values])
    expect("numbers.geojson", 12, ["0", "1", "2", "3", "4", "6", "7", "8", "9", "10", "11"],
           "3 is left out: a coordinate is not a finite number",
           "11 is left out: a point is too far from the origin")


def empty():
    geometries = ["null", "{}", "[]", "5", '"x"', '{"type":"Banana","coordinates":[1,2]}',
                  '{"type":"Polygon"}', '{"type":"Polygon","coordinates":5}',
                  '{"type":"Polygon","coordinates":[[[9]]]}', '{"coordinates":[9,47]}',
                  '{"type":5,"coordinates":[9,47]}', '{"type":"LineString","coordinates":[[9,47]]}',
                  '{"type":"GeometryCollection","geometries":[]}']
    for kind in ("Point", "LineString", "Polygon", "MultiPoint", "MultiPolygon"):
        geometries.append('{"type":"%s","coordinates":[]}' % kind)
    geometries += ['{"type":"Polygon","coordinates":[[]]}',
                   '{"type":"MultiPolygon","coordinates":[[]]}',
                   '{"type":"MultiPolygon","coordinates":[[[]]]}']
    collection("empty.geojson", *[feature(g) for g in geometries])
    expect("empty.geojson", len(geometries), [str(i) for i in range(len(geometries))],
           "0 is left out: it has no geometry")


def other_elements():
    """What is no feature at all among the features."""
    with_name = '{"type":"Feature","properties":{"name":%s},"geometry":' + POINT + "}"
    collection("others.geojson", "5", feature(POINT), "null", '"x,[{"', "[[1],2]", "{}",
               '{"type":"Banana"}', '{"type":"Feature"}', with_name % '{"a":[1,2]}', with_name % "7",
               '{"type":"Feature","properties":5,"geometry":%s}' % POINT, " -1")
    run = expect("others.geojson", 12,
                 ["features[%d]" % i for i in (0, 2, 3, 4, 11)] + ["1", "2", "3"],
                 "features[3] is left out: it is no object")
    check(run.ids("points") == ["0", "4", "5", "6"], "… and the others are read", run.said)
    write("wrong.geojson", '{"type":"FeatureCollection","features":5}')
    refuse("wrong.geojson", "is no map in OSM, GeoJSON, Shapefile or GeoPackage")


def deep():
    def nested(depth):
        return '{"type":"GeometryCollection","geometries":[' * depth + POINT + "]}" * depth
    collection("deep.geojson", feature(nested(20)), feature(nested(100)))
    run = expect("deep.geojson", 2, ["1"], "1 is left out: its geometry nests too deep")
    check(len(run.list("points")) == 1, "… and not too deep is read", run.said)
    collection("deeper.geojson", feature(nested(100000)))
    refuse("deeper.geojson", "Too many nested objects")
    write("brackets.geojson", '{"type":"Polygon","coordinates":' + "[" * 1000000)
    refuse("brackets.geojson", "is no map in OSM, GeoJSON, Shapefile or GeoPackage")


def corners_of_the_earth():
    across = polygon(ring((179.9, 47), (-179.9, 47), (-179.9, 47.1), (179.9, 47.1), (179.9, 47)))
    beyond = polygon(ring((179.9, 47), (180.1, 47), (180.1, 47.1), (179.9, 47.1), (179.9, 47)))
    collection("across.geojson", feature(across), feature(beyond))
    expect("across.geojson", 2, ["0", "1"], "0 is left out: a point is too far from the origin")
    run = expect("across.geojson", 2, [], options=("-p", "origin=[47, 180]"))
    check(len({round(e["area"]) for e in run.list("areas")}) == 1 and
          all(e["bounds"][1][0] - e["bounds"][0][0] < 16000 for e in run.list("areas")),
          "the antimeridian is no border for an origin near it", run.said)
    collection("poles.geojson", feature('{"type":"Point","coordinates":[0,90]}'),
               feature('{"type":"Point","coordinates":[120,90]}'),
               feature('{"type":"Point","coordinates":[0,91]}'),
               feature('{"type":"Point","coordinates":[720,0]}'),
               feature('{"type":"Point","coordinates":[10,-90]}'))
    expect("poles.geojson", 5, ["1", "2", "3"], options=("-p", "origin=[85, 10]"))


def texts():
    collection("texts.geojson", feature(POINT, '{"name":"%s"}' % ("x" * 3000000)),
               feature(POINT, '{"%s":"v","name":"y"}' % ("k" * 300000)),
               feature(POINT, '{"name":"\\ud800 \\u0000z"}'))
    run = expect("texts.geojson", 3, [])
    check([len(e["attributes"]["name"]) > 2999999 for e in run.list("points")] ==
          [True, False, False], "a long text is kept", "")
    write("bytes.geojson", ('{"type":"FeatureCollection","features":[%s]}'
                            % feature(POINT, '{"name":"@"}')).encode().replace(b"@", b"\xff\xc0\xaf"))
    expect("bytes.geojson", 1, [], "field 'name': 1 value cannot be read as string, the first '?' of 0")


def torn():
    collection("whole.geojson", *[feature(polygon(square(9 + i * .01, 47, .005))) for i in range(9)])
    with open("whole.geojson", "rb") as f:
        whole = f.read()
    for size in (1, 25, 60, 200, 700, len(whole) - 2):
        write("torn.geojson", whole[:size])
        refuse("torn.geojson", "is no map in OSM, GeoJSON, Shapefile or GeoPackage")


def many():
    collection("many.geojson", *[feature('{"type":"Point","coordinates":[%.6f,47]}' % (9 + i * 1e-6))
                                 for i in range(100000)])
    expect("many.geojson", 100000, 0)
    flat = feature(polygon(ring((9, 47), (9, 47), (9, 47), (9, 47))))
    collection("many_bad.geojson", *[flat] * 20000)
    run = expect("many_bad.geojson", 20000, 20000)
    check(sum("is left out" in m for m in run.messages) == 20, "twenty of them are told", run.said)
    seconds = []
    for n in (100000, 1000000):
        turns = [2 * math.pi * i / n for i in range(n)]
        points = ["[%.7f,%.7f]" % (9 + .01 * math.cos(a), 47 + .01 * math.sin(a)) for a in turns]
        collection("circle.geojson", feature(polygon("[%s,%s]" % (",".join(points), points[0]))))
        run = expect("circle.geojson", 1, 0)
        area = sum(e["area"] for e in run.list("areas"))
        check(abs(area / (math.pi * 1111.9 * 759) - 1) < .01, "… of %d points" % n, area)
        seconds.append(run.seconds)
    check(seconds[1] < 30 * seconds[0] + 5, "ten times the points take about ten times as long",
          seconds)


def osm():
    shutil.copy(os.path.join(os.environ["ROOT"], "examples/assets/maps/hamlet.osm"), "hamlet.osm")
    with open("hamlet.osm", encoding="utf-8") as f:
        hamlet = f.read()
    write("half.osm", hamlet[:len(hamlet) // 2])
    expect("half.osm", 0, [], "the reader of 'half.osm' says: XML parsing of OSM file failed")
    write("almost.osm", hamlet[:-8])
    expect("almost.osm", 4, [], "the reader of 'almost.osm' says: XML parsing of OSM file failed")
    write("references.osm", hamlet.replace("<nd ref", "<nd rf", 3))
    expect("references.osm", 7, ["way/101"])
    for what, value in (("nan", "nan"), ("far", "477.1")):
        write(what + ".osm", hamlet.replace('lat="47.1', 'lat="' + value, 5))
        expect(what + ".osm", 7, ["way/101", "way/102"],
               "the reader of '%s.osm' says: Invalid lon=9.519000" % what)
    write("bytes.osm", hamlet.encode().replace(b"hamlet", b"\xff\xfe"))
    expect("bytes.osm", 0, [], "the reader of 'bytes.osm' says: XML parsing of OSM file failed")


def pbf():
    extract = os.path.join(os.environ["ROOT"], "../shared/data/liechtenstein.osm.pbf")
    if not os.path.exists(extract):
        return
    with open(extract, "rb") as f:
        whole = f.read()
    for size in (30, 300000):
        write("torn.osm.pbf", whole[:size])
        run = Run("torn.osm.pbf")
        check(run.code == 0 and run.adds_up() and
              any("the reader of 'torn.osm.pbf' says: " in m for m in run.messages),
              "%d bytes of a PBF file" % size, run.said)
    changed = bytearray(whole)
    for i in range(200000, 200200):
        changed[i] ^= 0x5a
    write("changed.osm.pbf", bytes(changed))
    expect("changed.osm.pbf", 0, [], "the reader of 'changed.osm.pbf' says: ")


def databases():
    """Shapefiles and GeoPackages, which GDAL's own tool writes."""
    if not shutil.which("ogr2ogr"):
        return
    for form, name in (("GPKG", "whole.gpkg"), ("ESRI Shapefile", "whole.shp")):
        subprocess.run(["ogr2ogr", "-f", form, name, "hamlet.osm", "multipolygons"], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with open("whole.gpkg", "rb") as f:
        whole = f.read()
    for size in (100, 4096, len(whole) // 2):
        write("torn.gpkg", whole[:size])
        refuse("torn.gpkg", "database disk image is malformed")

    def shape(name, left_out=(), sizes=None):
        for part in ("shp", "shx", "dbf", "prj"):
            if part not in left_out:
                with open("whole." + part, "rb") as f:
                    write("%s.%s" % (name, part), f.read((sizes or {}).get(part, -1)))
    shape("bare", left_out=("dbf",))
    run = expect("bare.shp", 4, [], "'bare.shp' has no field 'name'")
    check(len(run.list("areas")) == 4, "… which has shapes", run.said)
    shape("lost", left_out=("shx",))
    refuse("lost.shp", "Unable to open lost.shx")
    shape("index", sizes={"shx": 104})
    refuse("index.shp", "Failed to read all values for 4 records in .shx file")
    shape("head", sizes={"shp": 50})
    refuse("head.shp", ".shp file is unreadable, or corrupt")
    shape("none", sizes={"shp": 0})
    refuse("none.shp", "is no map")
    shape("short", sizes={"shp": 330})
    run = expect("short.shp", 4, ["1", "2", "3"], "1 is left out: it has no geometry",
                 "the reader of 'short.shp' says: Error in fread()")
    shape("parts")
    with open("parts.shp", "r+b") as f:
        f.seek(100 + 8 + 36)
        f.write(b"\xff\xff\xff\x7f")
    expect("parts.shp", 4, ["0"], "the reader of 'parts.shp' says: Corrupted .shp file : shape 0")
    shape("records", sizes={"dbf": 833 + 2001 + 10})
    run = Run("records.shp")
    check(run.code == 0 and "the reader of 'records.shp' says: fread" in run.said,
          "records.shp: records that are not there", run.said)


def memory():
    """A feature whose text takes more than its share of the run's memory is refused."""
    run = Run("circle.geojson", "--max-memory", "128M")
    check(run.code == 3 and "circle.geojson" in run.said and "too" in run.said.lower(),
          "a feature that is too large for the memory", (run.code, run.said))


def main():
    write("all.pcg", GRAPH)
    write("point.geojson", POINT)
    if "GDAL was left out" in Run("point.geojson").said:
        print("ok without GDAL a map is an error")
        return 0
    for test in (rings, flat_rings, numbers, empty, other_elements, deep, corners_of_the_earth, texts,
                 torn, many, osm, pbf, databases, memory):
        test()
    return 1 if failed else 0


sys.exit(main())
