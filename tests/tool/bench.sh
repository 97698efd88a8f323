# pcgc bench: what it tells, what it refuses; and that every workload of `make bench` works.
. "$ROOT/tests/tool/expect.inc"

cat >row.pcg <<'END'
graph row {
    param count: int = 3 range [0, 1000]
    param sizes: list<float> = [1, 2]
    rectangle(width = 4m, height = 3m) -> copy(count = count) -> tall: extrude(amount = 2m)
}
END
printf 'graph noisy {\n    attr n: int = 7\n    rectangle() -> copy(count = 2) -> c: condition(true)\n    c.no -> extrude()\n}\n' >noisy.pcg
printf 'graph bad {\n    param n: int = 0\n    rectangle() -> copy(count = 4 / n)\n}\n' >bad.pcg
printf 'graph wrong { lgo() }\n' >wrong.pcg
"$PCGC" row.pcg -o row.so

# ---- for people ----
run "$PCGC" bench row.pcg --runs 3
expect_code 0 "bench"
expect_out "row.pcg: 3 runs a line, medians"
expect_out "libtcc "
expect_empty "$err" "no summary, no progress"
run "$PCGC" bench noisy.pcg --runs 2 --warmups 1
expect "a warning is told once, not in each run" test "$(grep -c W0504 "$err")" = 1

# ---- for machines ----
cat >check.py <<'PY'
import json, sys
b = json.load(open(sys.argv[1]))
assert b["version"] == 1 and b["runs"] == 2
assert [p["name"] for p in b["passes"]][:2] == ["read", "parse"] and b["passes"][-1]["name"] == "libtcc"
points = b["points"]
assert [(p["parameters"]["count"], p["threads"]) for p in points] == [
    (n, t) for n in ("1", "10") for t in (1, 2)]
for p in points:
    n = int(p["parameters"]["count"])
    assert p["faces"] == 6 * n and p["entities"] == n and p["rounds"] == n + 2 and p["sent"] == 2 * n + 1
    assert p["memory"]["least"] > 1e5
    for part in ("compile", "run", "write"):
        for clock in ("wall", "cpu"):
            s = p[part][clock]
            assert 0 < s["least"] <= s["median"] <= s["most"] < 60, (part, clock, s)
PY
run "$PCGC" bench row.pcg --runs 2 --vary count=1,10 --threads 1,2 -o row.glb --json
expect_code 0 "over values and threads"
expect "each combination, with what it made and took" python3 check.py "$out"
expect "what was written is there" [ -s row.glb ]
run "$PCGC" bench row.pcg --runs 1 --warmups 0 --vary 'sizes=[1, 2],[3]' --json
expect_out '"sizes":"[1, 2]"'
expect_out '"sizes":"[3]"'
run "$PCGC" bench row.so --runs 1 -p count=5 --json
expect_code 0 "a compiled graph"
expect_out '"name":"load"'
expect_out '"faces":30'

# ---- what goes wrong ----
run "$PCGC" bench bad.pcg
expect_code 3 "a graph that fails"
expect_empty "$out" "is not told of as measured"
run "$PCGC" bench bad.pcg -p n=1 --vary n=2,0 --runs 1
expect_code 3 "one value with which it fails"
run "$PCGC" bench wrong.pcg
expect_code 1 "errors in the source"
expect_err "did you mean 'log'?"
run "$PCGC" bench nothing.pcg
expect_code 2 "no such file"
run "$PCGC" bench
expect_code 2 "no file"
run "$PCGC" bench - </dev/null
expect_code 2 "standard input"
run "$PCGC" bench row.pcg -o -
expect_code 2 "standard output"
run "$PCGC" bench row.pcg --runs 0
expect_code 2 "no run"
run "$PCGC" bench row.pcg --vary count
expect_code 2 "a name without values"
expect_err "option '--vary' takes name=value,value"
run "$PCGC" bench row.pcg --vary conut=1
expect_code 2 "a parameter that is not there"
for threads in 0 x 1,,2 1,2x 99999; do
    run "$PCGC" bench row.pcg --threads "$threads"
    expect_code 2 "--threads $threads"
done
run "$PCGC" bench row.pcg --vary count=1,2,3,4,5,6,7,8,9,10,11 --vary count=1,2,3,4,5,6,7,8,9,10,11 \
    --vary count=1,2,3,4,5,6,7,8,9,10
expect_code 2 "too many combinations"
run "$PCGC" bench row.pcg --max-rounds 2
expect_code 4 "a limit"

# ---- make bench ----
without= with_w6=w6
grep -q '^GDAL_LIBRARY = .' "$ROOT/config.mak" || { without="--without w6"; with_w6=; }
bench() {
    run python3 "$ROOT/bench/bench.py" --build "$BUILD" --quick "$@"
}
cat >workloads.py <<'PY'
import json, os, sys
printed, wanted = json.load(open(sys.argv[1])), sys.argv[2:]
assert printed["version"] == 1 and [w["name"] for w in printed["workloads"]] == wanted, printed
for w in printed["workloads"]:
    assert w["points"] and w["figures"], w["name"]
    for f in w["figures"]:
        assert isinstance(f["value"], (int, float)) and f["met"] in (None, True, False), f
    for p in w["points"]:
        for name, side in p["sides"].items():
            assert side["wall"]["least"] > 0 and side["memory"]["median"] > 1e5, (w["name"], name, side)
    for p in w["points"]:
        if w["name"] in ("w1", "w3"):
            assert len({s["counts"]["faces"] for s in p["sides"].values()}) == 1
PY
bench --json $without
expect_code 0 "every workload, at its smallest"
expect "valid JSON, of all of them" python3 workloads.py "$out" w1 w3 w4 $with_w6 c1 micro
bench micro w3
expect_code 0 "chosen workloads"
expect_out "w3  Recursion"
expect "as they are chosen" sh -c '! grep -q "^w1 " .out'
expect "with JSON" python3 workloads.py "$BUILD/bench/bench.json" w3 micro
expect "and a picture" grep -q '</svg>' "$BUILD/bench/growth.svg"
bench w9
expect_code 1 "a workload that is not there"
expect_err "no workload 'w9'"
bench w6 --map nothing.osm
[ -n "$without" ] || expect_code 1 "a workload that does not run"
done_testing
