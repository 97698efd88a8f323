# The example town: everything that the map holds is in the model, and the model is the same to the byte on any
# number of threads.
. "$ROOT/tests/tool/expect.inc"
town=$ROOT/examples/town.pcg

totals() { # totals BUILDINGS DOORS WAYS: what --json says of them
    python3 - "$out" "$@" <<'END'
import json, sys
report = json.load(open(sys.argv[1]))["report"]
found = [report[key]["sum"] for key in ("buildings", "doors", "ways")]
assert found == [int(n) for n in sys.argv[2:]], found
END
}

# generate NAME OPTION…: builds NAME.glb, and NAME.png where this program can draw.
generate() {
    name=$1
    shift
    case " $LEFT_OUT " in
    *" png "*) ;;
    *) set -- "$@" -o "$name.png" --size 400x300 ;;
    esac
    run "$PCGC" run "$town" -o "$name.glb" -q "$@"
}

generate one --threads 1 --json
if grep -q 'GDAL was left out' "$err"; then
    expect_code 3 "without GDAL there is no town"
    done_testing
fi
expect_code 0 "the village is built"
expect "all of its buildings have a door" totals 39 39 9
generate two --threads 2
expect_code 0 "it is built on two threads"
expect "the same model" cmp one.glb two.glb
if [ -f one.png ]; then
    expect "the same picture" cmp one.png two.png
fi

# A whole country, where the data lies beside the project. What is far away has no windows.
map=$ROOT/../shared/data/liechtenstein.osm.pbf
if [ ! -f "$map" ]; then
    echo "# left out: no map of a country beside the project"
    done_testing
fi
run "$PCGC" run "$town" -p map="$map" -p near=0 -p far=0 --json --entities -o country.glb -q
expect_code 0 "a country is built"
expect "its buildings and ways are those that ogrinfo counts; one door each, but for two without a wall for it" \
    totals 3723 3721 2751
expect "what the map holds and cannot be used is named" python3 - "$out" <<'END'
import json, sys
result = json.load(open(sys.argv[1]))
bad = [p for p in result["outputs"] if p["port"] == "m.bad"][0]
assert bad["count"] == len(bad["entities"]) > 0
assert all(e["attributes"]["id"].startswith(("relation/", "way/", "node/")) for e in bad["entities"])
END
done_testing
