# Restarts the sourcing test under a virtual display. -noreset keeps the server alive when its last window closes, so
# that a program that starts at that moment finds it.
if [ -z "${TESSERA_WINDOW_TEST_INSIDE:-}" ]; then
    TESSERA_WINDOW_TEST_INSIDE=1 exec xvfb-run -a -s "-screen 0 1280x800x24 -noreset" "$0" "$@"
fi
