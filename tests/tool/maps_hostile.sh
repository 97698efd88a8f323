# Maps that nobody would draw, torn files, files without what belongs to them.
exec python3 "$ROOT/tests/tool/maps_hostile.py"
