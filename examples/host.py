"""A program that compiles a graph, runs it and reads what it made, by libpcg.

    python3 examples/host.py libpcg.so.0 examples/house.pcg 12m
"""
import ctypes
import sys
from ctypes import POINTER, byref, c_char_p, c_double, c_size_t, c_uint32, c_void_p


class Handle(c_void_p):
    """A pointer that Python leaves one."""


class Mesh(ctypes.Structure):  # the head of pcg_mesh_view: `size` says how much of it we know
    _fields_ = [("size", c_size_t)] + [(name, c_size_t) for name in (
        "points", "faces", "loops", "corners", "triangles")] + [
        ("point", POINTER(c_double)), ("face_loops", POINTER(c_uint32))]


pcg = ctypes.CDLL(sys.argv[1])
pcg.pcg_compile_file.restype = pcg.pcg_run_new.restype = Handle
pcg.pcg_run_error.restype, pcg.pcg_program_output_count.restype = c_char_p, c_size_t

house = pcg.pcg_compile_file(sys.argv[2].encode(), None)
if not house:
    sys.exit("cannot compile " + sys.argv[2])
run = pcg.pcg_run_new(house, None)
if pcg.pcg_run_set(run, b"height", sys.argv[3].encode()) or pcg.pcg_run_execute(run):
    sys.exit(pcg.pcg_run_error(run).decode())
for output in range(pcg.pcg_program_output_count(house)):
    mesh = Mesh(size=ctypes.sizeof(Mesh))
    if pcg.pcg_run_output_mesh(run, c_size_t(output), byref(mesh)) == 0:
        top = max(mesh.point[3 * i + 2] for i in range(mesh.points))
        print("%d polygons, %d triangles, %.2f m high" % (mesh.faces, mesh.triangles, top))
pcg.pcg_run_free(run)
pcg.pcg_program_free(house)
