# A compiled graph finds its files where the graph was compiled, or else beside itself.
. "$ROOT/tests/tool/expect.inc"

mkdir -p source/images moved/images
cp "$ROOT/examples/assets/walls/brick.jpg" source/images/wall.jpg
cp "$ROOT/examples/assets/walls/plaster.jpg" moved/images/wall.jpg
cat >source/wall.pcg <<'END'
graph wall {
    rectangle(width = 4m, height = 3m) -> texture(file = "images/wall.jpg")
}
END

# same A B WHAT: two models are the same, to the byte; differ: they are not.
same() {
    run cmp "$1" "$2"
    expect_code 0 "$3"
}
differ() {
    run cmp "$1" "$2"
    expect_code 1 "$3"
}

run "$PCGC" run source/wall.pcg -o source.glb
expect_code 0 "the graph itself"
run "$PCGC" "$PWD/source/wall.pcg" -o moved/wall.so
expect_code 0 "as a shared object"
run "$PCGC" "$PWD/source/wall.pcg" -o moved/wall
expect_code 0 "as an executable"

run "$PCGC" run moved/wall.so -o both.glb
expect_empty "$err" "both folders have the image: no message"
same source.glb both.glb "the one where it was compiled counts"

mv source elsewhere
run "$PCGC" run moved/wall.so -o moved.glb
expect_code 0 "the folder where it was compiled is gone"
expect_empty "$err" "the image beside the shared object is found"
differ source.glb moved.glb "it is another image"
(cd moved && "$PCGC" run wall.so -o ../inside.glb)
same moved.glb inside.glb "run from its own folder"
run ./moved/wall -o program.glb
expect_code 0 "the executable"
same moved.glb program.glb "finds the image beside itself"
ln -s moved/wall.so link.so
run "$PCGC" run link.so -o link.glb
same moved.glb link.glb "a link to it leads there, too"

rm -r moved/images
run "$PCGC" run moved/wall.so -o none.glb
expect_err "no image file 'images/wall.jpg'"

mkdir -p here/maps
cp "$ROOT/examples/assets/maps/village.osm" here/maps/mine.osm
(cd here && "$PCGC" run "$ROOT/examples/town.pcg" -p map=maps/mine.osm --json -q) >"$out" 2>"$err"
if grep -q 'GDAL was left out' "$err"; then
    done_testing
fi
expect_out '"buildings":{"sum":39' "a path given with -p is found from the current folder"
done_testing
