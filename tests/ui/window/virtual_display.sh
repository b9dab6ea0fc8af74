# Starts the test that sources this anew, with a virtual display: one that is not made anew when its last window is
# closed, as a program that starts in that moment would find none.
if [ -z "${TESSERA_WINDOW_TEST_INSIDE:-}" ]; then
    TESSERA_WINDOW_TEST_INSIDE=1 exec xvfb-run -a -s "-screen 0 1280x800x24 -noreset" "$0" "$@"
fi
