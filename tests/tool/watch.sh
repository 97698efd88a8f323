# pcgc watch, with files that are really saved.
python3 "$ROOT/tests/tool/watch.py"
