# Maps: counts agree with GDAL's own tool, bad features are named, and no file ends a run but with a message.
. "$ROOT/tests/tool/expect.inc"

cat >town.pcg <<'END'
use gis
graph town {
    param map: path
    param crs: string = ""
    param origin: list<float> = []
    attr id: string
    attr problem: string
    attr levels: int = 1
    attr height: length = 6m
    attr latitude: float
    m: read_map(file = map, crs = crs, origin = origin, id => @id, problem => @problem, latitude => @latitude) {
        buildings: polygons(where = "building")
        streets: lines(where = "highway")
        areas: polygons()
        lines: lines()
        points: points()
        field("building:levels", to = @levels)
        field("height", to = @height)
    }
}
END

# count PORT: what the last run with --json says of it.
count() {
    sed -n 's/.*"port":"m\.'"$1"'","type":"[A-Za-z]*","count":\([0-9]*\).*/\1/p' "$out"
}
# expect_count PORT N
expect_count() {
    [ "$(count "$1")" = "$2" ]
    result $? "$2 at $1"
}
read_map() {
    run "$PCGC" run town.pcg -p map="$1" --json --entities -q
}
geojson() { # geojson FILE GEOMETRY…: a building each
    file=$1 separator=
    shift
    printf '{"type":"FeatureCollection","features":[' >"$file"
    for geometry; do
        printf '%s{"type":"Feature","properties":{"building":"yes"},"geometry":%s}' "$separator" "$geometry" >>"$file"
        separator=,
    done
    printf ']}' >>"$file"
}

cp "$ROOT/examples/assets/maps/hamlet.osm" .
read_map hamlet.osm
if grep -q 'GDAL was left out' "$err"; then
    expect_code 3 "without GDAL a map is an error"
    done_testing
fi
expect_code 0 "a hamlet"
expect_count buildings 4
expect_count streets 2
expect_count points 1
expect_out '"id":"relation/201"'
expect_out '"id":"way/112","problem":"","levels":2,"height":7.46'
expect_err "way/115 is mended: self-intersection"
expect_err "field 'building:levels': 1 value cannot be read as int, the first 'several' of relation/201"
expect_err "field 'height': 1 value cannot be read as length, the first 'low' of way/115"
expect_err "7 features: 7 became shapes, 1 of them mended; 0 are left out, 0 fit no output; origin [47.14, 9.52]"

run "$PCGC" run town.pcg -p map=hamlet.osm -p origin="[47.13950, 9.51900]" --json
expect_out '"bounds":[[0,0,0],'

# ---- models go back on the map -------------------------------------------------------------------

run "$PCGC" run town.pcg -p map=hamlet.osm -o town.glb -o town.obj --json -q
expect_out '"seed":0,"origin":{"latitude":47.14,"longitude":9.52,"crs":"+proj=tmerc +lat_0=47.14 +lon_0=9.52 +k=1 '
expect "a GLB's scene has the origin" grep -aqF '],"extras":{"origin":{"latitude":47.14,"longitude":9.52,"crs":"+proj=tmerc ' town.glb
expect "an OBJ has it as a comment" grep -qx '# origin.latitude 47.14' town.obj
expect "… and its coordinate system" grep -q '^# origin.crs +proj=tmerc +lat_0=47.14 ' town.obj
if command -v gdaltransform >/dev/null; then
    # The first building's first vertex is node 5 of the file.
    crs=$(sed -n 's/^# origin.crs //p' town.obj)
    place=$(sed -n 's/^v \([^ ]*\) [^ ]* \(.*\)/\1 \2/p' town.obj | head -n 1 | awk '{print $1, -$2}')
    back=$(echo "$place" | gdaltransform -s_srs "$crs" -t_srs EPSG:4326 -output_xy)
    ran="echo $place | gdaltransform"
    echo "$back" >"$out"
    echo "$back" | awk '{printf "%.7f %.7f\n", $1, $2}' >back.txt
    awk -F'"' '/<node /{printf "%.7f %.7f\n", $6, $4}' hamlet.osm >nodes.txt
    expect "PROJ takes a vertex back to a node of the file" grep -qxFf nodes.txt back.txt
fi

cat >two.pcg <<'END'
use gis
graph two {
    param origin: list<float> = []
    a: read_map(file = "hamlet.osm", origin = origin) { houses: polygons(where = "building") }
    b: read_map(file = "other.osm", origin = origin) { houses: polygons(where = "building") }
}
END
sed 's/47\.1/47.2/g' hamlet.osm >other.osm
run "$PCGC" run two.pcg --json
expect_err "'other.osm' has its origin at [47.24, 9.52], a map before it at [47.14, 9.52], which stands for the result: the two do not fit together; give both one \`origin\`"
expect_out '"origin":{"latitude":47.14,'
run "$PCGC" run two.pcg -p origin="[47, 9]" --json
expect_code 0 "two maps about one origin"
expect_out '"origin":{"latitude":47,"longitude":9,'
expect "… fit together" sh -c '! grep -q "do not fit" "$1"' sh "$err"

# ---- what is missing -----------------------------------------------------------------------------

cat >torn.osm <<'END'
<osm version="0.6">
<node id="1" lat="47" lon="9"/><node id="2" lat="47.001" lon="9"/><node id="3" lat="47.001" lon="9.001"/>
<way id="10"><nd ref="1"/><nd ref="77"/><nd ref="78"/><nd ref="79"/><nd ref="1"/><tag k="building" v="yes"/></way>
<way id="11"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="1"/><tag k="building" v="yes"/></way>
<way id="12"><nd ref="1"/><nd ref="99"/><tag k="highway" v="track"/></way>
<relation id="20"><member type="way" ref="555" role="outer"/><tag k="type" v="multipolygon"/><tag k="building" v="yes"/></relation>
</osm>
END
read_map torn.osm
expect_code 0 "nodes and ways that are missing"
expect_count buildings 1
expect_count bad 3
expect_err "way/10 is left out: "
expect_err "way/12 is left out: less than two of its nodes are in the file"
expect_err "relation/20 is left out: its ways are not all in the file"

geojson bad.geojson '{"type":"Polygon","coordinates":[[[9,47],[9.001,47.001],[9.001,47],[9,47.001],[9,47]]]}' \
    '{"type":"Polygon","coordinates":[[[9,47],[9.01,47],[9.01,47.01],[9,47.01],[9,47]],[[9.001,47.001],[9.009,47.001],[9.009,47.009],[9.001,47.009],[9.001,47.001]],[[9.003,47.003],[9.006,47.003],[9.006,47.006],[9.003,47.006],[9.003,47.003]]]}' \
    '{"type":"Polygon","coordinates":[[[9,47],[NaN,47.001],[9.001,47],[9,47]]]}' \
    '{"type":"Polygon","coordinates":[[[9,47],[1e300,47.001],[9.001,47],[9,47]]]}' \
    '{"type":"Polygon","coordinates":[[[9,47],[9.001,47],[9,47]]]}' \
    '{"type":"Polygon","coordinates":[[[9,47],[9,47],[9,47],[9,47]]]}' \
    '{"type":"Polygon","coordinates":[]}' 'null' \
    '{"type":"MultiPolygon","coordinates":[[[[9,47],[9.001,47],[9.001,47.001],[9,47]]],[[[9.002,47],[9.003,47],[9.003,47.001],[9.002,47]]]]}'
read_map bad.geojson
expect_code 0 "bad areas"
expect_count buildings 3
expect_count bad 6
expect_err "0 is mended: self-intersection"
expect_err "1 is mended: holes are nested"
expect_err "2 is left out: a coordinate is not a finite number"
expect_err "7 is left out: it has no geometry"
expect_err "9 features: 3 became shapes, 2 of them mended; 6 are left out, 0 fit no output"

geojson empty.geojson
read_map empty.geojson
expect_code 0 "no features"
head -c 700 bad.geojson >torn.geojson
read_map torn.geojson
expect "a torn file ends in a message" grep -q "torn.geojson" "$err"
expect "… and no crash" test "$code" -lt 4
: >nothing.geojson
read_map nothing.geojson
expect_code 3 "an empty file"
expect_err "'nothing.geojson' is no map in OSM, GeoJSON, Shapefile or GeoPackage"
read_map absent.osm
expect_code 3 "no file"
expect_err "no map 'absent.osm'"
read_map /vsimem/x.geojson
expect_err "no map '/vsimem/x.geojson'"
head -c 3000 /bin/sh >noise.osm.pbf
read_map noise.osm.pbf
expect "noise ends in a message" test "$code" -lt 4 -a -s "$err"

sed 's/where = "building"/where = "building ="/' town.pcg >broken.pcg
run "$PCGC" run broken.pcg -p map=hamlet.osm
expect_code 3 "a broken condition"
expect_err "the condition of 'buildings', building =, has no sense at its character 11: expected a value"
sed 's/where = "building"/layer = "houses"/' town.pcg >broken.pcg
run "$PCGC" run broken.pcg -p map=hamlet.osm
expect_err "'hamlet.osm' has no layer 'houses': it has 'points', 'lines', "

if command -v python3 >/dev/null; then
    python3 - <<'END'
import math
n = 1000000
ring = ",".join("[%.7f,%.7f]" % (9 + 0.01 * math.cos(a), 47 + 0.01 * math.sin(a)) for a in (2 * math.pi * i / n for i in range(n)))
tangle = ",".join("[%.7f,%.7f]" % (9 + i * 7919 % 10007 / 1e5, 47 + i * 104729 % 10009 / 1e5) for i in range(20000))
for name, points, first in (("large", ring, "[9.0100000,47.0000000]"), ("tangle", tangle, "[9.0000000,47.0000000]")):
    with open(name + ".geojson", "w") as f:
        f.write('{"type":"Feature","properties":{"building":"yes"},"geometry":{"type":"Polygon","coordinates":[[%s,%s]]}}' % (points, first))
END
    run "$PCGC" run town.pcg -p map=large.geojson --json -q
    expect_count buildings 1
    expect_count bad 0
    run "$PCGC" run town.pcg -p map=tangle.geojson --json -q
    expect_count bad 1
    expect_err "and too much else to be mended"
fi

if command -v ogr2ogr >/dev/null; then
    ogr2ogr -f GPKG hamlet.gpkg hamlet.osm multipolygons >/dev/null 2>&1
    read_map hamlet.gpkg
    expect_count buildings 4
    ogr2ogr -t_srs EPSG:2056 hamlet.shp hamlet.osm multipolygons >/dev/null 2>&1
    read_map hamlet.shp
    expect_count buildings 4
    rm -f hamlet.prj
    read_map hamlet.shp
    expect_code 3 "no coordinate system"
    expect_err "does not name its coordinate system"
    run "$PCGC" run town.pcg -p map=hamlet.shp -p crs=EPSG:2056 --json
    expect_count buildings 4
fi

# ---- what a town has ------------------------------------------------------------------------------

{
    echo '<osm version="0.6">'
    # Nodes on a grid of seven by seven: 10 * row + column + 1.
    for row in 0 1 2 3 4 5 6; do
        for column in 0 1 2 3 4 5 6; do
            echo "<node id=\"$((10 * row + column + 1))\" lat=\"47.00${row}0\" lon=\"9.00${column}0\"/>"
        done
    done
    way() { # way ID NODE… -- TAG=VALUE…
        echo "<way id=\"$1\">"
        shift
        while [ "$1" != -- ]; do
            echo "<nd ref=\"$1\"/>"
            shift
        done
        shift
        for tag; do
            echo "<tag k=\"${tag%%=*}\" v=\"${tag#*=}\"/>"
        done
        echo '</way>'
    }
    way 301 1 2 12 11 1 -- building=house building:levels=3 "height=11,5 m" roof:shape=gabled
    way 302 1 5 45 -- ''
    way 303 45 41 1 -- ''
    way 304 12 14 34 32 12 -- ''
    way 306 6 7 17 16 6 -- ''
    way 307 61 62 67 -- waterway=stream
    way 308 51 52 62 61 51 -- natural=water
    echo '<relation id="401"><tag k="type" v="multipolygon"/><tag k="landuse" v="forest"/>'
    for member in 302:outer 303:outer 304:inner 306:outer; do
        echo "<member type=\"way\" ref=\"${member%:*}\" role=\"${member#*:}\"/>"
    done
    echo '</relation></osm>'
} | grep -v 'k="" ' >town.osm
cat >uses.pcg <<'END'
use gis
graph uses {
    attr id: string
    attr levels: int = 1
    attr height: length = 6m
    attr roof: string = "flat"
    m: read_map(file = "town.osm", id => @id) {
        buildings: polygons(where = "building")
        greens: polygons(where = "landuse in (forest, meadow, grass) or leisure = park")
        water: polygons(where = "natural = water")
        streams: lines(where = "waterway in (river, stream)")
        field("building:levels", to = @levels)
        field("height", to = @height)
        field("roof:shape", to = @roof)
    }
}
END
run "$PCGC" run uses.pcg --json --entities
expect_out '"id":"way/301","levels":3,"height":11.5,"roof":"gabled"'
expect_out '"port":"m.greens","type":"Shape","count":1,"faces":2,"vertices":12,"holes":1,'
expect_out '"id":"relation/401"'
expect_count water 1
expect_count streams 1

if command -v ogr2ogr >/dev/null && command -v python3 >/dev/null; then
    run python3 "$ROOT/tests/tool/maps_areas.py" hamlet.osm town.osm
    expect_code 0 "areas are those of GDAL"
fi

# ---- a real town -----------------------------------------------------------------------------------

extract=$ROOT/../shared/data/liechtenstein.osm.pbf
if [ -r "$extract" ] && command -v ogrinfo >/dev/null; then
    gdal_count() {
        ogrinfo -q "$extract" -sql "select count(*) from $1" 2>/dev/null | sed -n 's/.*COUNT.*= //p'
    }
    read_map "$extract"
    expect_count buildings "$(gdal_count 'multipolygons where building is not null')"
    expect_count streets "$(gdal_count 'lines where highway is not null')"
    expect_count buildings 3723
    expect_count streets 2751
    expect_count bad 27
    expect_err "features: 8528 became shapes, 0 of them mended; 27 are left out, 0 fit no output"
    run python3 "$ROOT/tests/tool/maps_areas.py" "$extract"
    expect_code 0 "areas and lines are those of GDAL"
    run "$PCGC" run town.pcg -p map="$extract" --json --entities
    bad=$(sed 's/.*"port":"m.bad"//; s/"port":"m.buildings".*//' "$out" | grep -o '"id":"[a-z]*/[0-9]*"' | sort -u | wc -l)
    [ "$bad" = 27 ]
    result $? "each that is left out has its id"
fi
done_testing
