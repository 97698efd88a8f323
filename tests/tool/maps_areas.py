"""Compares areas and lines of maps with GDAL's own: which there are, and how large each area is.

    maps_areas.py MAP…

Each map goes through pcgc, and through ogr2ogr into the projection that pcgc names. Prints the
lines of expectations.
"""

import csv
import json
import os
import subprocess
import sys

GRAPH = """use gis
graph all {
    param map: path
    attr id: string
    attr problem: string
    m: read_map(file = map, id => @id, problem => @problem) {
        areas: polygons(layer = "multipolygons")
        lines: lines(layer = "lines")
    }
}
"""
LAYERS = {"areas": ("multipolygons", "OGR_GEOM_AREA"), "lines": ("lines", "0")}


def ours(path):
    """The projection, and what came out: port -> id -> entity."""
    done = subprocess.run([os.environ["PCGC"], "run", "all.pcg", "-p", "map=" + path, "--json",
                           "--entities"], capture_output=True, check=True)
    result = json.loads(done.stdout)
    ports = {o["port"][2:]: o["entities"] for o in result["outputs"]}
    return result["origin"]["crs"], {
        port: {e["attributes"]["id"]: e for e in ports[port]} for port in LAYERS}


def theirs(path, crs, layer, size):
    """GDAL's features: id -> size."""
    if os.path.exists("theirs.gpkg"):
        os.unlink("theirs.gpkg")
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    subprocess.run(["ogr2ogr", "-f", "GPKG", "theirs.gpkg", path, layer, "-t_srs", crs], check=True,
                   **quiet)
    done = subprocess.run(["ogr2ogr", "-f", "CSV", "/vsistdout/", "theirs.gpkg", "-dialect", "OGRSQL",
                           "-sql", "select *, %s as size from %s" % (size, layer)],
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=True)
    found = {}
    for row in csv.DictReader(done.stdout.decode().splitlines()):
        if layer == "lines":
            name = "way/" + row["osm_id"]
        else:
            name = "relation/" + row["osm_id"] if row["osm_id"] else "way/" + row["osm_way_id"]
        found[name] = float(row["size"])
    return found


def main():
    with open("all.pcg", "w", encoding="utf-8") as f:
        f.write(GRAPH)
    failed = False
    for path in sys.argv[1:]:
        crs, found = ours(path)
        for port, (layer, size) in LAYERS.items():
            expected = theirs(path, crs, layer, size)
            name = os.path.basename(path)
            same = expected and set(expected) == set(found[port])
            print("%s %s of %s: the same %d" % ("ok" if same else "not ok", port, name,
                                                len(expected)))
            if port == "lines":
                failed = failed or not same
                continue
            sound = {i: e for i, e in found[port].items() if not e["attributes"]["problem"]}
            wrong = [(i, a, sound[i]["area"]) for i, a in expected.items()
                     if i in sound and abs(a - sound[i]["area"]) > 1e-6 * a + 1e-3]
            print("%s %s of %s: each as large as GDAL says" % ("not ok" if wrong else "ok", port,
                                                               name))
            for row in wrong[:10]:
                print("    %s: %.4f expected, found %.4f" % row)
            failed = failed or wrong or not same
    return 1 if failed else 0


sys.exit(main())
