#include "app/cli/terminal.h"

#include <csignal>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

TEST(Interrupt, FirstSignalRequestsAnEnd) {
    const InterruptGuard guard;
    EXPECT_FALSE(interrupted());
    std::raise(SIGTERM);
    EXPECT_TRUE(interrupted());
}

TEST(Interrupt, SecondSignalKillsTheProcess) {
    for (int first : {SIGINT, SIGTERM})
        for (int second : {SIGINT, SIGTERM}) {
            const auto raise_both = [&] {
                const InterruptGuard guard;
                std::raise(first);
                std::raise(second);
            };
            EXPECT_EXIT(raise_both(), testing::KilledBySignal(second), "") << first << ", " << second;
        }
}

} // namespace

} // namespace tessera::test
