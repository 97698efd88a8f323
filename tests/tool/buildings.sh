# Every building of a real town, where the map is there: what is made of the footprints adds up, and each has one door.
. "$ROOT/tests/tool/expect.inc"

map=$ROOT/../shared/data/liechtenstein.osm.pbf
if [ ! -f "$map" ]; then
    echo "ok no map of a town here"
    exit 0
fi

cat >town.pcg <<'END'
use gis
graph town {
    param map: path
    attr id: string
    attr round: length = 0m
    out ground: Shape
    out mass: Shape
    out wall: Shape
    out tile: Shape
    out roof: Shape
    out parapet: Shape
    m: read_map(file = map, id => @id) { houses: polygons(where = "building") }
    block m.bad
    m.houses -> set { assign(@round, perimeter(in)) } -> ground
    m.houses -> extrude(amount = 6m) -> masses: color()
    masses -> mass
    masses -> faces: select { top; bottom; side }
    block faces.bottom
    faces.side -> decompose() -> walls: color()
    walls -> wall
    walls -> split(axis = y, repeat = true) { absolute(3m) } -> split(axis = x, repeat = true) { absolute(2.5m) } -> tile
    faces.top -> flat: flat_roof(height = 0.6m, width = 0.3m, sink = 0.2m)
    flat.roof -> roof
    flat.parapet -> parapet
}
END
run "$PCGC" run town.pcg -p map="$map" --json --entities
if grep -q 'GDAL was left out' "$err"; then
    expect_code 3 "without GDAL there is no town"
    done_testing
fi
expect_code 0 "a town is built"
expect "volumes, walls, tiles and roofs of each building add up" python3 - "$out" <<'END'
import collections, json, sys
ports = {p["port"]: p for p in json.load(open(sys.argv[1]))["outputs"]}
def sums(port, field):
    total = collections.defaultdict(float)
    for e in ports[port]["entities"]:
        total[e["attributes"]["id"]] += field(e)
    return total
def same(a, b):
    return a.keys() == b.keys() and all(abs(a[k] - b[k]) <= 1e-6 * abs(b[k]) for k in b)
area = sums("ground", lambda e: e["area"])
around = sums("ground", lambda e: e["attributes"]["round"])
wall, tile = sums("wall", lambda e: e["area"]), sums("tile", lambda e: e["area"])
mass, roof = sums("mass", lambda e: e["area"]), sums("roof", lambda e: e["area"])
assert len(area) == ports["ground"]["count"] > 3000
assert abs(ports["mass"]["volume"] - 6 * sum(area.values())) <= 1e-9 * ports["mass"]["volume"]
assert same(wall, {k: 6 * v for k, v in around.items()})
assert same(tile, wall)
assert same(mass, {k: 2 * area[k] + wall[k] for k in area})
assert sums("roof", lambda e: 1) == {k: 1 for k in area}
assert all(0 < roof[k] <= area[k] * (1 + 1e-9) for k in area)
END

cat >doors.pcg <<END
use gis
import buildings from "$ROOT/examples/buildings.pcg"
graph doors {
    param map: path
    attr id: string
    m: read_map(file = map, id => @id) { houses: polygons(where = "building"); streets: lines(where = "highway") }
    block m.bad
    m.houses -> holds: decompose_walls() -> holding
    m.houses  -> b.footprints
    m.streets -> b.streets
    b: buildings(detail = 1)
    block b.walls
    block b.windows
    out holding: Shape
}
graph decompose_walls {
    in house: Shape
    out wall: Shape
    house -> extrude(amount = 3m) -> select { side } -> decompose() -> c: condition(width(in) >= 1.8m)
    c.yes -> wall
}
END
run "$PCGC" run doors.pcg -p map="$map" --json --entities
expect_code 0 "its buildings are built"
expect "one door each, but where no wall is wide enough" python3 - "$out" <<'END'
import collections, json, sys
ports = {p["port"]: p for p in json.load(open(sys.argv[1]))["outputs"]}
def ids(port):
    return collections.Counter(e["attributes"]["id"] for e in ports[port]["entities"])
doors = ids("b.doors")
assert len(doors) > 3000 and set(doors.values()) == {1}
assert set(doors) == set(ids("holding"))
END
done_testing
