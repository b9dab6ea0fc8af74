// What reconstructions say they will take, against what they take.

#include "recon/picture/reconstruct.h"
#include "tests/recon/test_images.h"

#include <algorithm>
#include <utility>

#include <gtest/gtest.h>
#include <malloc.h>

namespace tessera {
namespace {

using namespace test;

std::size_t bytes_in_use() {
    const struct mallinfo2 info = ::mallinfo2();
    return info.uordblks + info.hblkhd;
}

TEST(ReconstructionMemory, IsWhatWasTold) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers count for themselves";
#endif
    for (const auto& [width, parts] : {std::pair{480, 0}, {499, 0}, {480, 4}}) { // 499 is solved on 500 columns
        GradientImages images = noisy_images(width, 400);
        images.patch = 3;
        images.brightest.samples = 8;
        for (int l = 0; l < parts; ++l)
            images.parts.push_back({Image<float>(width, 400, 0.5f), images.primal, images.dx, images.dy,
                                    images.primal_variance, images.dx_variance, images.dy_variance});
        for (const Norm norm : all_norms) {
            if (norm == Norm::oidn)
                continue; // takes a library that may not be there
            Reconstructor reconstructor;
            const double told = static_cast<double>(reconstructor.bytes_for(width, 400, norm, 1, parts));
            const std::size_t before = bytes_in_use();
            std::size_t most = before;
            const ParallelFor watched = [&](int count, const std::function<void(int)>& body) {
                most = std::max(most, bytes_in_use());
                serial_for(count, body);
                most = std::max(most, bytes_in_use());
            };
            const Reconstruction result = reconstructor.reconstruct(images, {norm, 0.2f}, watched);
            const double taken = static_cast<double>(std::max(most, bytes_in_use()) - before);
            EXPECT_GT(told, 0.95 * taken) << to_string(norm) << " " << width << " " << parts;
            EXPECT_LT(told, 1.05 * taken) << to_string(norm) << " " << width << " " << parts;
            // What it has is not asked for twice.
            const double again = static_cast<double>(reconstructor.bytes_for(width, 400, norm, 1, parts));
            const bool has_solver = norm != Norm::none && norm != Norm::uniform && norm != Norm::smoothed;
            EXPECT_EQ(again < told, has_solver) << to_string(norm);
            // What it keeps from the second picture on.
            const double kept = static_cast<double>(Reconstructor::bytes_to_keep(width, 400));
            const std::size_t then = most = bytes_in_use();
            reconstructor.reconstruct(images, {norm, 0.2f}, watched);
            const std::size_t after = bytes_in_use();
            reconstructor.reconstruct(images, {norm, 0.2f}, watched);
            const double more = static_cast<double>(std::max(most, bytes_in_use()) - then);
            EXPECT_GT(again + kept, 0.95 * more) << to_string(norm) << " " << width << " " << parts;
            if (norm == Norm::guided && parts == 0) {
                EXPECT_LT(again + kept, 1.1 * more) << width;
            }
            EXPECT_NEAR(static_cast<double>(after - then), static_cast<double>(reconstructor.bytes_kept()),
                        20.0 * width * 400) // the picture itself, and a little
                << to_string(norm);
        }
    }
}

} // namespace
} // namespace tessera
