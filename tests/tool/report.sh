# Totals that `report` adds up: in --json, in .json and .csv files, and where nothing was reported.
. "$ROOT/tests/tool/expect.inc"

cat >totals.pcg <<'END'
graph totals {
    attr n: int
    attr zero: float
    rectangle(width = 2m, height = 3m) -> copy(count = 4, index => @n)
        -> report { value("lot.area", area(in)); value("b, \"c\"", @n) }
        -> report { value(@n > 1 ? "large" : "a", @zero / @zero); value("half", 0.5) } -> out
    out out: Shape
}
END
printf 'graph none { rectangle() }\n' >none.pcg

run "$PCGC" run totals.pcg --json
expect_code 0 "a report"
expect_out '"report":{"a":{"sum":null,"count":2,"least":null,"most":null},"b, '
expect_out ':{"sum":6,"count":4,"least":0,"most":3},"half":'
run "$PCGC" run totals.pcg -o totals.csv -o totals.json
expect_code 0 "written to files"
printf 'key,sum,count,average,least,most\na,,2,,,\n"b, ""c""",6,4,1.5,0,3\nhalf,2,4,0.5,0.5,0.5\nlarge,,2,,,\nlot.area,24,4,6,6,6\n' >wanted.csv
expect "the table as it should be" cmp totals.csv wanted.csv
expect "and in JSON" grep -q '"half":{"sum":2,"count":4,"least":0.5,"most":0.5}' totals.json
run "$PCGC" run none.pcg --json
expect "no report where nothing was reported" sh -c "! grep -q report $out"
run "$PCGC" run none.pcg -o - -f csv
expect_out "key,sum,count,average,least,most"
done_testing
