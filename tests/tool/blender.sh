# Debian's Blender (apt-get install blender python3-numpy) runs a graph by libpcg.so and gets its
# meshes, where it is installed.
. "$ROOT/tests/tool/expect.inc"

if [ -n "${SANITIZE-}" ] || [ ! -x /usr/bin/blender ]; then
    echo "ok left out: there is no blender, or it cannot load a sanitized library"
    done_testing
fi
mkdir home
export HOME="$PWD/home" PATH=/usr/bin:/bin # the system's Python is Blender's
if ! blender -b --factory-startup --python-exit-code 3 --python-expr "import numpy" >/dev/null 2>&1; then
    echo "ok left out: this blender has no numpy"
    done_testing
fi

cat >lots.pcg <<'END'
graph lots {
    param cell: length = 5m
    attr number: int
    attr share: float = 0.5
    attr tint: color = #ff0000
    attr name: string = "lot"
    rectangle(width = 10m, height = 5m)
        -> split(axis = x, repeat = true, slice_index => @number) { absolute(cell) }
        -> color(color = #336699)
        -> map_uv_faces()
        -> boxes: extrude(amount = 3m)
}
END
cat >look.py <<'END'
import bpy
for made in sorted(o.name for o in bpy.data.objects if o.type == "MESH" and o.data.name != "Cube"):
    mesh = bpy.data.objects[made].data
    points = [v.co for v in mesh.vertices]
    print("LOOK", made, len(mesh.polygons), "polygons,", len(mesh.uv_layers), "uv layer,",
          "to", [round(max(p[i] for p in points), 3) for i in range(3)])
    print("LOOK sound", not mesh.validate())
    for name in ("number", "entity", "share", "name"):
        print("LOOK", name, mesh.attributes[name].domain,
              sorted(set(a.value for a in mesh.attributes[name].data)))
    print("LOOK tint", sorted(set(tuple(a.color) for a in mesh.attributes["tint"].data)))
    print("LOOK names", list(mesh["name"]))
    surface = next(n for n in mesh.materials[0].node_tree.nodes if n.type == "BSDF_PRINCIPLED")
    print("LOOK blue %.3f" % surface.inputs["Base Color"].default_value[2])
    print("LOOK used", sorted(set(p.material_index for p in mesh.polygons)))
END
run blender -b --factory-startup --python-exit-code 3 --python "$ROOT/examples/blender_import.py" -- \
    "$BUILD/libpcg.so" lots.pcg cell=2m -o lots.blend
expect_code 0 "Blender runs the graph"
expect_out "boxes.out: 30 polygons, 1 materials"
run blender -b lots.blend --python-exit-code 3 --python look.py
expect_code 0 "and opens what it saved"
expect_out "LOOK boxes.out 30 polygons, 1 uv layer, to [10.0, 5.0, 3.0]"
expect_out "LOOK sound True"
expect_out "LOOK number FACE [0, 1, 2, 3, 4]"
expect_out "LOOK entity FACE [0, 1, 2, 3, 4]"
expect_out "LOOK share FACE [0.5]"
expect_out "LOOK name FACE [0]"
expect_out "LOOK names ['lot']"
expect_out "LOOK tint [(1.0, 0.0, 0.0, 1.0)]"
expect_out "LOOK blue 0.319"
expect_out "LOOK used [0]"

run blender -b --factory-startup --python-exit-code 3 --python "$ROOT/examples/blender_import.py" -- \
    "$BUILD/libpcg.so" "$ROOT/examples/house.pcg" height=8m
expect_code 0 "the house"
expect_out " polygons, "
run blender -b --factory-startup --python-exit-code 3 --python "$ROOT/examples/blender_import.py" -- \
    "$BUILD/libpcg.so" lots.pcg cell=wide
expect_code 3 "a value that does not fit"
expect_out "parameter 'cell' takes a length, as in 12m, not 'wide'"
done_testing
