# The table of what shows each rule: every file in it exists, and no rule is without one.
python3 "$ROOT/tests/conformance.py"
