# Random numbers are a matter of the seed, the node and the entity: what is edited elsewhere re-rolls nothing.
. "$ROOT/tests/tool/expect.inc"

cat >base.pcg <<'PCG'
graph base {
    attr n: int
    attr size: int
    first: rectangle() -> lots: copy(count = 5, index => @n)
    lots -> roll: set { assign(@size, rand_int(1, 1000)) } -> log(message = "roll " + @n + " " + @size)
    lots -> body: inner(size => @size) -> log(message = "body " + @n + " " + @size)
}
graph inner {
    attr size: int
    in  in: Shape
    out out: Shape
    in -> pick: set { assign(@size, rand_int(1, 1000)) } -> out
}
PCG
numbers() { # numbers FILE [OPTION…]
    "$PCGC" run "$@" -g base -q 2>&1 | sed -n 's/.*note: //p' | sort
}
# same WHAT SCRIPT: what sed makes of the graph draws the same numbers.
same() {
    sed "$2" base.pcg >edited.pcg
    numbers edited.pcg >edited
    expect "$1: the graph is another one" sh -c '! cmp -s base.pcg edited.pcg'
    expect "$1: the numbers are the same" cmp numbers edited
}
numbers base.pcg >numbers
expect "ten numbers are drawn" [ "$(wc -l <numbers)" = 10 ]

same "a node that draws, before" '4i\    rectangle() -> other: set { assign(@size, rand_int(1, 9)) }'
same "a node without a name, before" '4i\    rectangle() -> set { assign(@size, rand_int(1, 9)) } -> end: copy(count = 0)'
same "more entities behind" 's/count = 5/count = 4 + 1/; $a\graph more { rectangle() -> copy(count = 9) }'
same "an edge more out of the same port, behind the others" '6a\    lots -> scale(x = rand(1, 2)) -> gone: copy(count = 0)'
same "declarations in another order" '2{h;d};3G'
same "a step between, which passes entities on" 's/-> roll:/-> counter() -> roll:/'
same "a surrogate in place of the graph" \
    's/inner(size => @size)/dynamic(graph = "inn" + "er", size => @size) { in in: Shape; out out: Shape; attr size: int }/'
same "a surrogate whose graph is computed" \
    's/inner(size => @size)/dynamic(graph = @n < 9 ? "inner" : "none", size => @size) { in in: Shape; out out: Shape; attr size: int }/'
same "another node in the graph inside" '12a\    in -> gone: set { assign(@size, rand_int(1, 9)) } -> end: copy(count = 0)'

# A node without a name is known by which of its kind it is.
sed 's/first: rectangle/rectangle/' base.pcg >edited.pcg
numbers edited.pcg >unnamed
sed -i '4i\    rectangle() -> end: copy(count = 0)' edited.pcg
numbers edited.pcg >edited
expect "a node without a name re-rolls what others of its kind behind it make" sh -c '! cmp -s unnamed edited'

# The first edge carries the original: one that is put before others makes copies of what they carry.
sed '5i\    lots -> gone: copy(count = 0)' base.pcg >edited.pcg
numbers edited.pcg >edited
expect "an edge before the others re-rolls what they lead to" sh -c '! cmp -s numbers edited'

sed 's/pick:/chosen:/' base.pcg >edited.pcg
numbers edited.pcg >edited
expect "another name re-rolls that node" sh -c '! cmp -s numbers edited'
expect "and no other" sh -c 'grep roll numbers >a; grep roll edited >b; cmp a b'
numbers base.pcg --seed 2 >edited
expect "another seed re-rolls all" [ "$(cat numbers edited | sort | uniq -d | wc -l)" = 0 ]
done_testing
