# Ctrl+C at any moment leaves no half-written file; the line of progress in a real terminal.
python3 "$ROOT/tests/tool/interrupt.py"
first=$?
python3 "$ROOT/tests/tool/progress.py"
second=$?
[ $first -eq 0 ] && [ $second -eq 0 ]
