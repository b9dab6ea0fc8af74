# Starts the test that sources this anew, with a virtual display.
if [ -z "${TESSERA_WINDOW_TEST_INSIDE:-}" ]; then
    TESSERA_WINDOW_TEST_INSIDE=1 exec xvfb-run -a -s "-screen 0 1280x800x24" "$0" "$@"
fi
