// The predicted memory of reconstructions against the memory that they take.

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

TEST(ReconstructionMemory, IsAboutThePredicted) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers have their own allocators";
#endif
    for (const auto& [width, components] :
         {std::pair{480, 0}, {499, 0}, {480, 4}}) { // a width of 499 is padded to 500
        GradientImages images = noisy_images(width, 200);
        images.patch = 3;
        if (components == 0)
            add_fireflies(images, 8);
        for (int l = 0; l < components; ++l)
            images.components.push_back({Image<float>(width, 200, 0.5f), images.primal, images.dx, images.dy,
                                         images.primal_variance, images.dx_variance, images.dy_variance});
        const ReconstructionSize size{.width = width,
                                      .height = 200,
                                      .has_gradients = true,
                                      .is_demodulated = false,
                                      .components = components};
        for (const Norm norm : all_norms) {
            if (norm == Norm::oidn)
                continue; // needs a library that may be missing
            Reconstructor reconstructor;
            const double predicted = static_cast<double>(reconstructor.bytes_for(size, norm));
            const std::size_t before = bytes_in_use();
            std::size_t peak = before;
            const ParallelFor watched = [&](int count, const std::function<void(int)>& body) {
                peak = std::max(peak, bytes_in_use());
                serial_for(count, body);
                peak = std::max(peak, bytes_in_use());
            };
            const Reconstruction result = reconstructor.reconstruct(images, {norm, 0.2f}, watched);
            const double taken = static_cast<double>(std::max(peak, bytes_in_use()) - before);
            EXPECT_GT(predicted, 0.95 * taken) << to_string(norm) << " " << width << " " << components;
            const double image = static_cast<double>(sizeof(Rgb)) * width * 200;
            if (components == 0) { // the prediction includes fireflies, which are not clamped with components
                EXPECT_LT(predicted, 1.4 * taken + 1.1 * image) << to_string(norm) << " " << width;
            }
            // The prediction excludes solvers that exist already.
            const double again = static_cast<double>(reconstructor.bytes_for(size, norm));
            const bool has_solver = norm != Norm::none && norm != Norm::uniform && norm != Norm::smoothed;
            EXPECT_EQ(again < predicted, has_solver) << to_string(norm);
            // The reconstructor keeps a fit from the second picture on.
            const double kept = static_cast<double>(Reconstructor::bytes_to_keep(width, 200));
            const std::size_t before_second = peak = bytes_in_use();
            reconstructor.reconstruct(images, {norm, 0.2f}, watched);
            const std::size_t after_second = bytes_in_use();
            reconstructor.reconstruct(images, {norm, 0.2f}, watched);
            const double taken_more = static_cast<double>(std::max(peak, bytes_in_use()) - before_second);
            EXPECT_GT(again + kept, 0.95 * taken_more) << to_string(norm) << " " << width << " " << components;
            EXPECT_NEAR(static_cast<double>(after_second - before_second),
                        static_cast<double>(reconstructor.bytes_kept()),
                        20.0 * width * 200) // the picture and a few vectors
                << to_string(norm);
        }
    }
}

} // namespace
} // namespace tessera
