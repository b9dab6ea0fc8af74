// Files of `tessera render`, read as other programs read them: channel names, and the input of a denoiser.
#include "recon/picture/oidn.h"
#include "tests/app/program.h"
#include "tests/load/temporary_folder.h"

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <link.h>

namespace tessera::test {

namespace {

namespace fs = std::filesystem;
using testing::Contains;

/// Channels of an EXR file, read by OpenEXR without Tessera's code.
struct Channels {
    std::size_t width = 0, height = 0;
    std::map<std::string, std::vector<float>> values;

    std::set<std::string> names() const {
        std::set<std::string> names;
        for (const auto& [name, numbers] : values)
            names.insert(name);
        return names;
    }
    /// Returns three channels, interleaved by pixel. The layer "" is the plain picture.
    std::vector<float> pixels(const std::string& layer, const std::string& channels = "RGB") const {
        std::vector<float> pixels(3 * width * height);
        for (std::size_t c = 0; c < 3; ++c) {
            const std::string name = layer.empty() ? std::string(1, channels[c]) : layer + "." + channels[c];
            for (std::size_t i = 0; i < width * height; ++i)
                pixels[3 * i + c] = values.at(name)[i];
        }
        return pixels;
    }
};

Channels read_channels(const fs::path& file) {
    Imf::InputFile input(file.c_str());
    const auto window = input.header().dataWindow();
    EXPECT_EQ(window.min.x, 0);
    EXPECT_EQ(window.min.y, 0);
    Channels channels;
    channels.width = static_cast<std::size_t>(window.max.x + 1);
    channels.height = static_cast<std::size_t>(window.max.y + 1);
    Imf::FrameBuffer buffer;
    const Imf::ChannelList& list = input.header().channels();
    for (auto c = list.begin(); c != list.end(); ++c) {
        EXPECT_EQ(c.channel().type, Imf::FLOAT) << c.name();
        std::vector<float>& numbers = channels.values[c.name()];
        numbers.resize(channels.width * channels.height);
        buffer.insert(c.name(), Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(numbers.data()), sizeof(float),
                                           sizeof(float) * channels.width));
    }
    input.setFrameBuffer(buffer);
    input.readPixels(window.min.y, window.max.y);
    return channels;
}

/// Scene with an area light above a cube, outside the camera's view.
constexpr const char* hidden_lamp = R"(<scene version="3.0.0">
    <sensor type="perspective">
        <float name="fov" value="40"/>
        <transform name="to_world"><lookat origin="0, 1, 5" target="0, 0.5, 0" up="0, 1, 0"/></transform>
    </sensor>
    <shape type="rectangle">
        <transform name="to_world"><scale value="8"/><rotate x="1" angle="-90"/></transform>
        <bsdf type="diffuse"><rgb name="reflectance" value="0.7, 0.7, 0.6"/></bsdf>
    </shape>
    <shape type="cube">
        <transform name="to_world"><scale value="0.5"/><translate y="0.5"/></transform>
        <bsdf type="diffuse"><rgb name="reflectance" value="0.7, 0.2, 0.1"/></bsdf>
    </shape>
    <shape type="rectangle">
        <transform name="to_world"><rotate x="1" angle="90"/><translate y="4"/></transform>
        <emitter type="area"><rgb name="radiance" value="20, 18, 15"/></emitter>
    </shape>
</scene>)";

struct OtherPrograms : testing::Test {
    OtherPrograms() {
        fs::copy_file(fs::path(TESSERA_SOURCE_DIR) / "assets/cornell-box.xml", folder.path() / "box.xml");
        folder.write("hidden-lamp.xml", hidden_lamp);
    }
    Channels render(const std::string& arguments) const {
        const Outcome o = run(folder.path(), "render " + arguments + " -o out.exr");
        EXPECT_EQ(o.exit_code, 0) << arguments << "\n" << o.output;
        return o.exit_code == 0 ? read_channels(folder.path() / "out.exr") : Channels();
    }

    TemporaryFolder folder;
};

TEST_F(OtherPrograms, FindTheRawPrimalInEveryFile) {
    const std::set<std::string> plain{"R", "G", "B"};
    std::set<std::string> both = plain;
    both.insert({"primal.R", "primal.G", "primal.B"});
    EXPECT_EQ(render("box.xml -m gpr --size 24x16 --spp 4").names(), both);
    EXPECT_EQ(render("box.xml -m pt --size 24x16 --spp 4 --recon smoothed").names(), both);
    EXPECT_EQ(render("box.xml -m pt --size 24x16 --spp 4").names(), plain); // the picture is the raw primal
}

TEST_F(OtherPrograms, FindFeaturesAndGradientsByTheirUsualNames) {
    const Channels c = render("box.xml -m gpr --basis none --size 24x16 --spp 4 --buffers");
    for (const char* name : {"R", "primal.R", "primal.G", "primal.B", "primal_without_direct.R", "direct.R",
                             "dx.R", "dy.R", "primal_variance", "dx_variance", "dy_variance", "albedo.R",
                             "albedo.G", "albedo.B", "N.X", "N.Y", "N.Z", "Z", "roughness"})
        EXPECT_THAT(c.names(), Contains(name));
    for (const char* name : {"Z.R", "N.R", "roughness.R"})
        EXPECT_FALSE(c.values.contains(name)) << name;
    ASSERT_FALSE(c.values.empty());
    const std::vector<float> primal = c.pixels("primal"), without = c.pixels("primal_without_direct"),
                             direct = c.pixels("direct"), albedo = c.pixels("albedo"),
                             normal = c.pixels("N", "XYZ");
    for (std::size_t i = 0; i < primal.size(); ++i) {
        EXPECT_EQ(primal[i], without[i] + direct[i]) << i;
        EXPECT_GE(albedo[i], 0) << i;
        EXPECT_LE(albedo[i], 1 + 1e-5f) << i;
    }
    for (std::size_t i = 0; i < c.width * c.height; ++i) {
        EXPECT_LE(std::hypot(normal[3 * i], normal[3 * i + 1], normal[3 * i + 2]), 1 + 1e-5f) << i;
        EXPECT_GT(c.values.at("Z")[i], 0) << i;
        EXPECT_TRUE(std::isfinite(c.values.at("Z")[i])) << i;
    }
}

/// Calls Open Image Denoise by the signatures of its header oidn.h, without Tessera's code.
class Denoiser {
public:
    /// Loads the library that Tessera has found.
    Denoiser() {
        std::string path;
        dl_iterate_phdr(
            [](dl_phdr_info* info, std::size_t, void* found) {
                const std::string name = info->dlpi_name ? info->dlpi_name : "";
                if (name.find("libOpenImageDenoise.so") != std::string::npos)
                    *static_cast<std::string*>(found) = name;
                return 0;
            },
            &path);
        library_ = path.empty() ? nullptr : dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    }
    Denoiser(const Denoiser&) = delete;
    Denoiser& operator=(const Denoiser&) = delete;

    bool is_loaded() const { return library_ != nullptr; }

    std::vector<float> denoise(std::vector<float> color, std::vector<float> albedo, std::vector<float> normal,
                               std::size_t width, std::size_t height) const {
        void* const device = function<void*(int)>("oidnNewDevice")(0);
        function<void(void*)>("oidnCommitDevice")(device);
        void* const filter = function<void*(void*, const char*)>("oidnNewFilter")(device, "RT");
        std::vector<float> output(color.size());
        const auto set_image = [&](const char* name, std::vector<float>& pixels) {
            constexpr int float3 = 3;
            function<void(void*, const char*, void*, int, std::size_t, std::size_t, std::size_t, std::size_t,
                          std::size_t)>("oidnSetSharedFilterImage")(filter, name, pixels.data(), float3, width,
                                                                    height, 0, 3 * sizeof(float), 0);
        };
        set_image("color", color);
        set_image("albedo", albedo);
        set_image("normal", normal);
        set_image("output", output);
        const char* const set_bool =
            dlsym(library_, "oidnSetFilterBool") ? "oidnSetFilterBool" : "oidnSetFilter1b";
        function<void(void*, const char*, bool)>(set_bool)(filter, "hdr", true);
        function<void(void*)>("oidnCommitFilter")(filter);
        function<void(void*)>("oidnExecuteFilter")(filter);
        const char* message = nullptr;
        EXPECT_EQ(function<int(void*, const char**)>("oidnGetDeviceError")(device, &message), 0)
            << (message ? message : "");
        function<void(void*)>("oidnReleaseFilter")(filter);
        function<void(void*)>("oidnReleaseDevice")(device);
        return output;
    }

private:
    template <class Signature>
    Signature* function(const char* name) const {
        return reinterpret_cast<Signature*>(dlsym(library_, name));
    }

    void* library_ = nullptr;
};

/// Expects equal pixels except for rounding.
void expect_close(const std::vector<float>& found, const std::vector<float>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_NEAR(found[i], expected[i], 1e-3f * std::abs(expected[i]) + 1e-4f) << i;
}

/// A denoiser that reads primal, albedo and N makes the picture of `render -m pt --recon oidn`.
TEST_F(OtherPrograms, DenoiseTheFileToTheSamePicture) {
    if (!oidn_problem().empty())
        GTEST_SKIP() << oidn_problem();
    const Denoiser denoiser;
    ASSERT_TRUE(denoiser.is_loaded());
    const Channels c = render("hidden-lamp.xml -m pt --size 96x64 --spp 4 --recon oidn --buffers");
    ASSERT_FALSE(c.values.empty());
    for (float direct : c.pixels("direct"))
        ASSERT_EQ(direct, 0);
    const std::vector<float> primal = c.pixels("primal");
    const std::vector<float> found =
        denoiser.denoise(primal, c.pixels("albedo"), c.pixels("N", "XYZ"), c.width, c.height);
    expect_close(found, c.pixels(""));
    double change = 0, sum = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        change += std::abs(static_cast<double>(found[i] - primal[i]));
        sum += static_cast<double>(found[i]);
    }
    EXPECT_GT(change, 0.02 * sum) << "the denoiser has removed no noise";
}

/// Tessera adds directly visible emission after the denoiser.
TEST_F(OtherPrograms, DenoiseAFileWithAVisibleLamp) {
    if (!oidn_problem().empty())
        GTEST_SKIP() << oidn_problem();
    const Denoiser denoiser;
    ASSERT_TRUE(denoiser.is_loaded());
    const Channels c = render("box.xml -m pt --size 96x64 --spp 4 --recon oidn --buffers");
    ASSERT_FALSE(c.values.empty());
    std::vector<float> found = denoiser.denoise(c.pixels("primal_without_direct"), c.pixels("albedo"),
                                                c.pixels("N", "XYZ"), c.width, c.height);
    const std::vector<float> direct = c.pixels("direct");
    for (std::size_t i = 0; i < found.size(); ++i)
        found[i] += direct[i];
    expect_close(found, c.pixels(""));
}

} // namespace

} // namespace tessera::test
