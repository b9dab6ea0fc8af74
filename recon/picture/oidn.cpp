#include "recon/picture/oidn.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <vector>

#include <dlfcn.h>
#include <glm/common.hpp>

namespace tessera {

namespace {

namespace fs = std::filesystem;

struct Device;
struct Filter;

/// Functions of the library, with the signatures of its header oidn.h.
struct Library {
    Device* (*new_device)(int type) = nullptr;
    void (*set_device_int)(Device*, const char* name, int value) = nullptr;
    void (*commit_device)(Device*) = nullptr;
    int (*device_error)(Device*, const char** message) = nullptr;
    void (*release_device)(Device*) = nullptr;
    Filter* (*new_filter)(Device*, const char* type) = nullptr;
    void (*set_image)(Filter*, const char* name, void* data, int format, std::size_t width, std::size_t height,
                      std::size_t offset, std::size_t pixel_stride, std::size_t row_stride) = nullptr;
    void (*set_bool)(Filter*, const char* name, bool value) = nullptr;
    void (*commit_filter)(Filter*) = nullptr;
    void (*execute)(Filter*) = nullptr;
    void (*release_filter)(Filter*) = nullptr;

    std::string problem; ///< why it cannot be used; empty: all functions were found
};

/// Constants of oidn.h.
constexpr int device_cpu = 1, format_float3 = 3;

/// Finds a function by its name in version 2, or in 1. Returns false if there is none.
template <class Function>
bool find(void* library, Function*& function, const char* name, const char* old_name = nullptr) {
    void* found = dlsym(library, name);
    if (!found && old_name)
        found = dlsym(library, old_name);
    function = reinterpret_cast<Function*>(found);
    return found != nullptr;
}

bool find_all(void* handle, Library& l) {
    return find(handle, l.new_device, "oidnNewDevice") &&
           find(handle, l.set_device_int, "oidnSetDeviceInt", "oidnSetDevice1i") &&
           find(handle, l.commit_device, "oidnCommitDevice") &&
           find(handle, l.device_error, "oidnGetDeviceError") &&
           find(handle, l.release_device, "oidnReleaseDevice") && find(handle, l.new_filter, "oidnNewFilter") &&
           find(handle, l.set_image, "oidnSetSharedFilterImage") &&
           find(handle, l.set_bool, "oidnSetFilterBool", "oidnSetFilter1b") &&
           find(handle, l.commit_filter, "oidnCommitFilter") && find(handle, l.execute, "oidnExecuteFilter") &&
           find(handle, l.release_filter, "oidnReleaseFilter");
}

constexpr std::string_view file_name = "libOpenImageDenoise.so";

/// Searches a folder for the library, down to the depth at which Python wheels install it. A file is returned as
/// it is.
std::vector<std::string> libraries_at(const fs::path& path) {
    std::error_code error;
    if (!fs::is_directory(path, error))
        return {path.string()};
    std::vector<std::string> found;
    constexpr auto options = fs::directory_options::skip_permission_denied;
    constexpr int deepest = 7;
    for (auto i = fs::recursive_directory_iterator(path, options, error); !error && i != fs::end(i);
         i.increment(error)) {
        if (i.depth() >= deepest)
            i.disable_recursion_pending();
        if (i->path().filename().string().starts_with(file_name))
            found.push_back(i->path().string());
    }
    std::ranges::sort(found);
    return found;
}

/// Searches the packages of a Python environment for the library.
std::vector<std::string> libraries_of_python(const fs::path& environment) {
    std::vector<std::string> found;
    std::error_code error;
    const auto entries_of = [&error](const fs::path& folder) {
        std::vector<fs::path> entries;
        for (fs::directory_iterator i(folder, error); !error && i != fs::end(i); i.increment(error))
            entries.push_back(i->path());
        return entries;
    };
    for (const fs::path& version : entries_of(environment / "lib"))
        for (const fs::path& package : entries_of(version / "site-packages"))
            if (package.filename().string().find("oidn") != std::string::npos)
                std::ranges::copy(libraries_at(package), std::back_inserter(found));
    return found;
}

std::vector<std::string> candidate_libraries() {
    if (const char* named = std::getenv("TESSERA_OIDN"); named && *named)
        return libraries_at(fs::absolute(named));
    std::vector<std::string> names{"libOpenImageDenoise.so.2", "libOpenImageDenoise.so.1",
                                   "libOpenImageDenoise.so.0", std::string(file_name)};
    if (const char* environment = std::getenv("VIRTUAL_ENV"); environment && *environment)
        std::ranges::copy(libraries_of_python(environment), std::back_inserter(names));
    return names;
}

Library load() {
    Library library;
    std::string last;
    for (const std::string& name : candidate_libraries()) {
        void* handle = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (handle && find_all(handle, library))
            return library; // the handle stays open
        last = handle ? name + " lacks functions of Open Image Denoise 1.4 or 2" : dlerror();
        if (handle)
            dlclose(handle);
    }
    const char* named = std::getenv("TESSERA_OIDN");
    library.problem = "Open Image Denoise was not found";
    if (named && *named)
        library.problem += std::string(" at TESSERA_OIDN=") + named;
    if (!last.empty())
        library.problem += " (" + last + ")";
    library.problem += ": install it from www.openimagedenoise.org or with `pip install pyoidn`, or set "
                       "TESSERA_OIDN to its file or to a folder that holds it";
    return library;
}

const Library& library() {
    static const Library loaded = load();
    return loaded;
}

/// Copy of an image for the filter, which takes non-const pointers.
struct SharedImage {
    RgbImage image;

    void give(Filter* filter, const char* name) {
        library().set_image(filter, name, image.data(), format_float3, static_cast<std::size_t>(image.width()),
                            static_cast<std::size_t>(image.height()), 0, sizeof(Rgb), 0);
    }
};

void check(Device* device) {
    const char* message = nullptr;
    if (library().device_error(device, &message) != 0)
        throw std::runtime_error(std::string("Open Image Denoise: ") + (message ? message : "unknown error"));
}

} // namespace

const std::string& oidn_problem() {
    return library().problem;
}

std::uint64_t bytes_of_oidn(int width, int height) {
    return 64'000'000 + 900 * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
}

Norm possible(Norm norm) {
    return norm == Norm::oidn && !oidn_problem().empty() ? Norm::guided : norm;
}

RgbImage denoised_by_oidn(const RgbImage& image, const FeatureImages& features) {
    if (!oidn_problem().empty())
        throw std::runtime_error(oidn_problem());
    const Library& oidn = library();
    const std::unique_ptr<Device, void (*)(Device*)> device(oidn.new_device(device_cpu), oidn.release_device);
    if (!device)
        check(nullptr); // throws the error of the thread
    oidn.set_device_int(device.get(), "numThreads", 1);
    oidn.set_device_int(device.get(), "setAffinity", 0); // the calling thread belongs to the caller
    oidn.commit_device(device.get());
    check(device.get());
    const std::unique_ptr<Filter, void (*)(Filter*)> filter(oidn.new_filter(device.get(), "RT"),
                                                            oidn.release_filter);
    check(device.get());
    if (!filter)
        throw std::runtime_error("Open Image Denoise: it has no filter RT");
    SharedImage colour{image}, albedo{features.albedo}, normal{features.normal},
        output{RgbImage(image.width(), image.height())};
    colour.give(filter.get(), "color");
    if (!features.empty()) {
        for (Rgb& a : albedo.image)
            a = glm::clamp(a, Rgb(0), Rgb(1));
        albedo.give(filter.get(), "albedo");
        normal.give(filter.get(), "normal");
    }
    output.give(filter.get(), "output");
    oidn.set_bool(filter.get(), "hdr", true);
    oidn.commit_filter(filter.get());
    oidn.execute(filter.get());
    check(device.get());
    return std::move(output.image);
}

} // namespace tessera
