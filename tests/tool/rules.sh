# Random programs against the rules as tests/rules/interpreter.py reads them: in memory, and a sample
# of them as a .so by the C compiler, too. Sanitized code is slow: it gets a sample of both.
compare() {
    python3 "$ROOT/tests/rules/compare.py" "$BUILD/tests/rules/runner" "$@"
}
case $BUILD in
*asan*) compare 1 1000 && compare 1001 1010 "$PCGC" "$CC" ;;
*) compare 1 10000 && compare 10001 10060 "$PCGC" "$CC" ;;
esac
