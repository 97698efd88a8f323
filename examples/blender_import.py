"""Runs a graph and brings what it makes into Blender, by libpcg: a mesh for each output, with the
graph's attributes on its faces, materials, uvs and normals.

    blender -b --python blender_import.py -- libpcg.so.0 house.pcg height=12m -o house.blend

In Blender itself: `import blender_import as pcg; pcg.bring("libpcg.so.0", "house.pcg", height="12m")`.
"""
import ctypes
import os
import sys
from ctypes import POINTER, byref, c_bool, c_char_p, c_double, c_float, c_size_t, c_uint32, c_void_p

import bpy
import numpy as np

NUMBERS = {"int": 1, "bool": 1, "float": 1, "length": 1, "area": 1, "angle": 1, "ratio": 1,
           "seconds": 1, "vec2": 2, "vec3": 3, "color": 4}
KINDS = {1: "FLOAT", 2: "FLOAT2", 3: "FLOAT_VECTOR", 4: "FLOAT_COLOR"}


class Handle(c_void_p):
    """A pointer that Python leaves one."""


class Mesh(ctypes.Structure):
    """pcg_mesh_view"""
    _fields_ = [(n, c_size_t) for n in ("size", "points", "faces", "loops", "corners", "triangles")] + [
        ("point", POINTER(c_double)), ("face_loops", POINTER(c_uint32)),
        ("loop_corners", POINTER(c_uint32)), ("corner_points", POINTER(c_uint32)),
        ("normals", POINTER(c_float)), ("uvs", POINTER(c_float)),
        ("triangle_corners", POINTER(c_uint32)), ("triangle_faces", POINTER(c_uint32)),
        ("face_materials", POINTER(c_uint32)), ("face_entities", POINTER(c_uint32)),
        ("edges", c_size_t), ("edge_points", POINTER(c_uint32))]


class Material(ctypes.Structure):
    """pcg_material_view"""
    _fields_ = [("size", c_size_t), ("name", c_char_p), ("color", c_double * 4),
                ("texture", c_char_p), ("metallic", c_double), ("roughness", c_double),
                ("two_sided", c_bool)]


class Gate(ctypes.Structure):
    """pcg_gate"""
    _fields_ = [("name", c_char_p), ("document", c_char_p), ("type", c_char_p), ("collective", c_bool)]


def load(path):
    pcg = ctypes.CDLL(path)
    pcg.pcg_compile_file.restype = pcg.pcg_run_new.restype = Handle
    for name in ("run_error", "run_attribute", "program_attribute_name", "program_attribute_type"):
        getattr(pcg, "pcg_" + name).restype = c_char_p
    for name in ("program_output_count", "run_output_count", "run_material_count",
                 "program_attribute_count"):
        getattr(pcg, "pcg_" + name).restype = c_size_t
    return pcg


def array(at, count):
    """A copy of what the run lends; whole numbers with a sign, since they are reckoned with."""
    if not at or not count:
        return np.zeros(0, np.int64)
    lent = np.ctypeslib.as_array(at, (count,))
    return lent.astype(np.int64 if lent.dtype == np.uint32 else lent.dtype)


# ---- materials ------------------------------------------------------------------------------------


def linear(srgb):
    return srgb / 12.92 if srgb <= 0.04045 else ((srgb + 0.055) / 1.055) ** 2.4


def make_material(pcg, run, number):
    look = Material(size=ctypes.sizeof(Material))
    pcg.pcg_run_material(run, c_uint32(number), byref(look))
    material = bpy.data.materials.new(look.name.decode() or "material")
    material.use_nodes = True
    material.use_backface_culling = not look.two_sided
    nodes, links = material.node_tree.nodes, material.node_tree.links
    surface = next(n for n in nodes if n.type == "BSDF_PRINCIPLED")
    surface.inputs["Base Color"].default_value = [linear(c) for c in look.color[:3]] + [1]
    surface.inputs["Alpha"].default_value = look.color[3]
    surface.inputs["Metallic"].default_value = look.metallic
    surface.inputs["Roughness"].default_value = look.roughness
    if look.texture and os.path.exists(look.texture):
        image = nodes.new("ShaderNodeTexImage")
        image.image = bpy.data.images.load(look.texture.decode(), check_existing=True)
        links.new(image.outputs["Color"], surface.inputs["Base Color"])
    return material


# ---- geometry -------------------------------------------------------------------------------------


def polygons_of(view):
    """Blender's polygons have no holes: faces that have some come as triangles. For each polygon its
    face and how many corners it has; for all of them, one behind the other, the corners."""
    face_loops = array(view.face_loops, view.faces + 1)
    loop_corners = array(view.loop_corners, view.loops + 1)
    whole = np.flatnonzero(np.diff(face_loops) == 1)
    first = loop_corners[face_loops[whole]]
    totals = loop_corners[face_loops[whole] + 1] - first
    before = np.cumsum(totals) - totals
    corners = np.repeat(first - before, totals) + np.arange(totals.sum())
    triangle_faces = array(view.triangle_faces, view.triangles)
    holed = np.isin(triangle_faces, whole, invert=True)
    triangles = array(view.triangle_corners, 3 * view.triangles).reshape(-1, 3)[holed]
    return (np.concatenate([whole, triangle_faces[holed]]),
            np.concatenate([totals, np.full(len(triangles), 3)]),
            np.concatenate([corners, triangles.ravel()]))


def make_geometry(mesh, view, totals, corners):
    mesh.vertices.add(view.points)
    mesh.vertices.foreach_set("co", array(view.point, 3 * view.points))
    mesh.loops.add(len(corners))
    mesh.loops.foreach_set("vertex_index", array(view.corner_points, view.corners)[corners])
    mesh.polygons.add(len(totals))
    mesh.polygons.foreach_set("loop_start", np.cumsum(totals) - totals)
    mesh.polygons.foreach_set("loop_total", totals)
    mesh.edges.add(view.edges)
    mesh.edges.foreach_set("vertices", array(view.edge_points, 2 * view.edges))
    mesh.update(calc_edges=True)
    if view.uvs:
        uvs = array(view.uvs, 2 * view.corners).reshape(-1, 2)[corners]
        mesh.uv_layers.new(name="UVMap").data.foreach_set("uv", uvs.ravel())
    mesh.use_auto_smooth = True
    mesh.normals_split_custom_set(array(view.normals, 3 * view.corners).reshape(-1, 3)[corners])


# ---- attributes -----------------------------------------------------------------------------------


def put_numbers(pcg, run, output, mesh, name, kind, entities):
    count, width = pcg.pcg_run_output_count(run, c_size_t(output)), NUMBERS[kind]
    values = np.zeros((count, width))
    pcg.pcg_run_attribute_floats(run, c_size_t(output), name, c_size_t(width),
                                 values.ctypes.data_as(POINTER(c_double)))
    found = values[entities]
    if kind in ("int", "bool"):
        layer = mesh.attributes.new(name.decode(), "INT", "FACE")
        layer.data.foreach_set("value", found[:, 0].astype(np.int32))
        return
    layer = mesh.attributes.new(name.decode(), KINDS[width], "FACE")
    layer.data.foreach_set({1: "value", 4: "color"}.get(width, "vector"), found.ravel())


def put_texts(pcg, run, output, mesh, name, entities):
    """Texts are numbers of a list that is a property of the mesh."""
    count = pcg.pcg_run_output_count(run, c_size_t(output))
    texts = [pcg.pcg_run_attribute(run, c_size_t(output), c_size_t(e), name).decode()
             for e in range(count)]
    words = sorted(set(texts))
    numbers = np.array([words.index(t) for t in texts], np.int32)
    mesh[name.decode()] = words
    mesh.attributes.new(name.decode(), "INT", "FACE").data.foreach_set("value", numbers[entities])


def put_attributes(pcg, program, run, output, mesh, entities):
    mesh.attributes.new("entity", "INT", "FACE").data.foreach_set("value", entities.astype(np.int32))
    for i in range(pcg.pcg_program_attribute_count(program)):
        name = pcg.pcg_program_attribute_name(program, c_size_t(i))
        kind = pcg.pcg_program_attribute_type(program, c_size_t(i)).decode()
        if kind in NUMBERS:
            put_numbers(pcg, run, output, mesh, name, kind, entities)
        else:
            put_texts(pcg, run, output, mesh, name, entities)


# ---- the whole ------------------------------------------------------------------------------------


def make_object(pcg, program, run, output, materials):
    view, gate = Mesh(size=ctypes.sizeof(Mesh)), Gate()
    pcg.pcg_program_output(program, c_size_t(output), byref(gate))
    if pcg.pcg_run_output_mesh(run, c_size_t(output), byref(view)):
        raise RuntimeError(pcg.pcg_run_error(run).decode())
    mesh = bpy.data.meshes.new(gate.name.decode())
    faces, totals, corners = polygons_of(view)
    make_geometry(mesh, view, totals, corners)
    for material in materials:
        mesh.materials.append(material)
    mesh.polygons.foreach_set("material_index", array(view.face_materials, view.faces)[faces])
    put_attributes(pcg, program, run, output, mesh, array(view.face_entities, view.faces)[faces])
    made = bpy.data.objects.new(mesh.name, mesh)
    bpy.context.scene.collection.objects.link(made)
    return made


def bring(library, graph, **parameters):
    """The objects, one for each output that has something."""
    pcg = load(library)
    program = pcg.pcg_compile_file(graph.encode(), None)
    if not program:
        raise RuntimeError("%s has errors; pcgc check tells them" % graph)
    run = pcg.pcg_run_new(program, None)
    try:
        for name, value in parameters.items():
            if pcg.pcg_run_set(run, name.encode(), value.encode()):
                raise RuntimeError(pcg.pcg_run_error(run).decode())
        if pcg.pcg_run_execute(run):
            raise RuntimeError(pcg.pcg_run_error(run).decode())
        materials = [make_material(pcg, run, i) for i in range(pcg.pcg_run_material_count(run))]
        return [make_object(pcg, program, run, output, materials)
                for output in range(pcg.pcg_program_output_count(program))
                if pcg.pcg_run_output_count(run, c_size_t(output))]
    finally:
        pcg.pcg_run_free(run)
        pcg.pcg_program_free(program)


def main(words):
    where = words.index("-o") if "-o" in words else len(words)
    library, graph, *settings = words[:where]
    for made in bring(library, graph, **dict(s.split("=", 1) for s in settings)):
        mesh = made.data
        print("%s: %d polygons, %d materials" % (made.name, len(mesh.polygons), len(mesh.materials)))
    if where + 1 < len(words):
        bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(words[where + 1]))


if __name__ == "__main__" and "--" in sys.argv:
    main(sys.argv[sys.argv.index("--") + 1:])
