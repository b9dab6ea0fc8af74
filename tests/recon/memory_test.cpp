// The memory that reconstructions announce, compared with the memory that they take.

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

TEST(ReconstructionMemory, IsAboutWhatIsAnnounced) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers have their own allocators";
#endif
    for (const auto& [width, components] :
         {std::pair{480, 0}, {499, 0}, {480, 4}}) { // 499 is solved on 500 columns
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
            const double announced = static_cast<double>(reconstructor.bytes_for(size, norm));
            const std::size_t before = bytes_in_use();
            std::size_t most = before;
            const ParallelFor watched = [&](int count, const std::function<void(int)>& body) {
                most = std::max(most, bytes_in_use());
                serial_for(count, body);
                most = std::max(most, bytes_in_use());
            };
            const Reconstruction result = reconstructor.reconstruct(images, {norm, 0.2f}, watched);
            const double taken = static_cast<double>(std::max(most, bytes_in_use()) - before);
            EXPECT_GT(announced, 0.95 * taken) << to_string(norm) << " " << width << " " << components;
            const double image = static_cast<double>(sizeof(Rgb)) * width * 200;
            if (components == 0) { // components of a basis have no fireflies, for which memory is announced
                EXPECT_LT(announced, 1.4 * taken + 1.1 * image) << to_string(norm) << " " << width;
            }
            // Solvers that it has are not counted again.
            const double again = static_cast<double>(reconstructor.bytes_for(size, norm));
            const bool has_solver = norm != Norm::none && norm != Norm::uniform && norm != Norm::smoothed;
            EXPECT_EQ(again < announced, has_solver) << to_string(norm);
            // A fit is kept from the second picture on.
            const double kept = static_cast<double>(Reconstructor::bytes_to_keep(width, 200));
            const std::size_t then = most = bytes_in_use();
            reconstructor.reconstruct(images, {norm, 0.2f}, watched);
            const std::size_t after = bytes_in_use();
            reconstructor.reconstruct(images, {norm, 0.2f}, watched);
            const double more = static_cast<double>(std::max(most, bytes_in_use()) - then);
            EXPECT_GT(again + kept, 0.95 * more) << to_string(norm) << " " << width << " " << components;
            EXPECT_NEAR(static_cast<double>(after - then), static_cast<double>(reconstructor.bytes_kept()),
                        20.0 * width * 200) // the picture itself, and a few vectors
                << to_string(norm);
        }
    }
}

} // namespace
} // namespace tessera
