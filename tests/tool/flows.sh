# Random programs of the kind that flows are made of: run as flows they must be what they are node by
# node. Sanitized code is slow: it gets a sample.
case $BUILD in
*asan*) last=300 ;;
*) last=3000 ;;
esac
python3 "$ROOT/tests/rules/flows.py" 1 $last | "$BUILD/tests/rules/flows"
