// Files of a render's samples, with which many reconstructions can be compared on the same samples.
#pragma once

#include "recon/image.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace tessera {

/// Calls visit(image) for every image of `images`, in a fixed order. Basis components are left out.
template <class Images, class Visit>
void for_each_stored_image(Images& images, Visit&& visit) {
    auto& d = images.demodulation;
    auto& b = images.brightest;
    auto& h = images.halves;
    auto& g = images.features;
    for (auto* image : {&images.primal, &images.dx, &images.dy, &images.very_direct, &d.value, &d.albedo,
                        &d.sampled_albedo, &d.sampled_variance, &d.value_covariance, &b.primal, &b.dx, &b.dy,
                        &b.albedo, &h.primal, &h.dx, &h.dy, &g.albedo, &g.normal})
        visit(*image);
    for (auto* image : {&images.primal_variance, &images.dx_variance, &images.dy_variance, &d.albedo_variance,
                        &d.sampled_weight, &d.unexplained_variance, &b.half, &g.nearness, &g.roughness})
        visit(*image);
}

/// Writes the samples to a private file format in native byte order. Throws std::runtime_error on failure.
inline void write_samples(const std::filesystem::path& path, const GradientImages& images) {
    std::ofstream file(path, std::ios::binary);
    const auto put = [&](const void* from, std::size_t size) {
        file.write(static_cast<const char*>(from), static_cast<std::streamsize>(size));
    };
    put(&images.patch, sizeof(images.patch));
    put(&images.brightest.samples, sizeof(images.brightest.samples));
    for_each_stored_image(images, [&](const auto& image) {
        const std::int32_t size[2] = {image.width(), image.height()};
        put(size, sizeof(size));
        put(image.data(), image.size() * sizeof(*image.data()));
    });
    if (!file.flush())
        throw std::runtime_error(path.string() + ": cannot be written");
}

/// Reads a file of write_samples(). Throws std::runtime_error if it cannot be read or is too short.
inline GradientImages read_samples(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    const auto get = [&](void* to, std::size_t size) {
        if (!file.read(static_cast<char*>(to), static_cast<std::streamsize>(size)))
            throw std::runtime_error(path.string() + ": cannot be read");
    };
    GradientImages images;
    get(&images.patch, sizeof(images.patch));
    get(&images.brightest.samples, sizeof(images.brightest.samples));
    for_each_stored_image(images, [&](auto& image) {
        std::int32_t size[2];
        get(size, sizeof(size));
        image = std::remove_reference_t<decltype(image)>(size[0], size[1], Unfilled());
        get(image.data(), image.size() * sizeof(*image.data()));
    });
    return images;
}

} // namespace tessera
