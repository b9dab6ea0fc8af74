// `tessera stability`: its files, resumed jobs and rejected input.
#include "app/cli/opened_scene.h"
#include "app/cli/terminal.h"
#include "app/experiment/stability.h"
#include "render/io/files.h"
#include "render/sampling/sampling.h"
#include "render/scene/scene.h"
#include "tests/app/program.h"
#include "tests/load/temporary_folder.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include <glm/vec4.hpp>
#include <glm/vector_relational.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace tessera::test {

TEST(StabilityScenes, AreEmbeddedInTheProgram) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::temp_directory_path() / ("tessera-unpacked-" + std::to_string(getpid()));
    const fs::path own = fs::path(TESSERA_SOURCE_DIR) / "assets/stability";
    unpack_stability_scenes(folder);
    std::size_t files = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(own)) {
        if (!entry.is_regular_file())
            continue;
        ++files;
        EXPECT_EQ(read_bytes(folder / fs::relative(entry.path(), own)), read_bytes(entry.path())) << entry.path();
    }
    EXPECT_GT(files, 20u);
    fs::remove_all(folder);
}

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

const fs::path suite = fs::path(TESSERA_SOURCE_DIR) / "assets/stability";

class StabilityCommand : public testing::Test {
protected:
    std::string text(const fs::path& name) const {
        std::ostringstream out;
        out << std::ifstream(folder_.path() / name, std::ios::binary).rdbuf();
        return out.str();
    }
    /// Returns the files of finished jobs, sorted by name.
    std::set<fs::path> job_files(const fs::path& jobs) const {
        std::set<fs::path> files;
        for (const auto& entry : fs::directory_iterator(folder_.path() / jobs))
            if (entry.path().extension() == ".jsonl")
                files.insert(entry.path());
        return files;
    }
    std::string all_text(const fs::path& jobs) const {
        std::string all;
        for (const fs::path& file : job_files(jobs))
            all += text(file);
        return all;
    }
    Outcome stability(const std::string& rest) const {
        return run(folder_.path(), "stability '" + (suite / "no-light.xml").string() + "' '" +
                                       (suite / "texture.xml").string() + "' --size 24x18 --threads 1 --spp 4 " +
                                       rest);
    }
    TemporaryFolder folder_;
};

TEST_F(StabilityCommand, JudgesAllMethodsAndReusesFinishedJobs) {
    const std::string options = "--seeds 3 --reference refs --reference-spp 32 -o out";
    const Outcome o = stability(options);
    ASSERT_EQ(o.exit_code, 0) << o.output;
    const std::string csv = text("out/stability.csv"), page = text("out/stability.md");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 * (2 + 2 * 6)) << "two methods with six norms";
    EXPECT_THAT(csv, HasSubstr(",tone_mapped,tenfold,halo_energy,halo_peak,bad_pixels,"));
    EXPECT_THAT(csv, HasSubstr("\nno-light,pt,none,ok,"));
    EXPECT_THAT(csv, HasSubstr("\nno-light,gpr,weighted,ok,"));
    EXPECT_THAT(csv, Not(HasSubstr("fails"))) << csv;
    for (const char* part : {"| scene | pt | pr | gpt-none |", "## texture", "Known to fail: G-PT and G-PR",
                             "24x18", "Reference: by pt, relMSE of its own"})
        EXPECT_THAT(page, HasSubstr(part));
    for (const char* file : {"out/no-light.png", "out/texture.png", "refs/texture-24x18-d8.exr"})
        EXPECT_TRUE(fs::exists(folder_.path() / file)) << file;

    const std::string html = text("out/stability.html");
    for (const char* part : {"<a href=\"#texture\">", "<h2 id=\"texture\">", "Known to fail: G-PT and G-PR",
                             "<td class=\"words ok\">ok", "alt=\"gpr-guided\"", "<canvas>", "value=\"flicker\"",
                             "querySelectorAll('.compare')", ", FLIP 0.", "<svg xmlns", "</html>"})
        EXPECT_THAT(html, HasSubstr(part));
    for (const char* part : {"src=\"http", "<script src", "src=\"out"})
        EXPECT_THAT(html, Not(HasSubstr(part))) << "the page needs no other file";
    EXPECT_THAT(csv, HasSubstr(",relmse_error,flip,factor,"));

    const std::string jobs = all_text("out/scenes/texture/jobs");
    ASSERT_EQ(stability(options).exit_code, 0);
    EXPECT_EQ(all_text("out/scenes/texture/jobs"), jobs) << "nothing is rendered again";
    EXPECT_EQ(text("out/stability.csv"), csv);
}

TEST_F(StabilityCommand, RendersJobsWithoutArtefactsAgain) {
    const std::string options = "--seeds 2 --methods pt,pr --reference refs --reference-spp 32 -o out";
    ASSERT_EQ(stability(options).exit_code, 0);
    const std::size_t before = job_files("out/scenes/texture/jobs").size();
    for (const fs::path& file : job_files("out/scenes/texture/jobs")) {
        std::string lines;
        std::ifstream in(file);
        for (std::string line; std::getline(in, line);) {
            auto entry = nlohmann::json::parse(line);
            if (entry.contains("value"))
                entry["value"]["measurements"][0]["artefacts"] = nullptr; // as `tessera sweep` writes them
            lines += entry.dump() + "\n";
        }
        fs::remove(file);
        std::ofstream(file.parent_path() / ("of-a-sweep-" + file.filename().string())) << lines;
    }
    const Outcome o = stability(options);
    EXPECT_EQ(o.exit_code, 0) << o.output;
    EXPECT_EQ(job_files("out/scenes/texture/jobs").size(), 2 * before) << "all is rendered again";
    EXPECT_THAT(text("out/stability.csv"), HasSubstr("\ntexture,pr,none,"));
}

TEST_F(StabilityCommand, RejectsReferencesOfOtherMethodsThanPt) {
    ASSERT_EQ(run(folder_.path(), "reference '" + (suite / "no-light.xml").string() +
                                      "' --spp 4 --size 24x18 -m gpr -o refs/no-light-24x18-d8.exr")
                  .exit_code,
              exit_bad_input)
        << "there is no such folder";
    fs::create_directories(folder_.path() / "refs");
    ASSERT_EQ(run(folder_.path(), "reference '" + (suite / "no-light.xml").string() +
                                      "' --spp 4 --size 24x18 -m gpr -o refs/no-light-24x18-d8.exr")
                  .exit_code,
              0);
    const Outcome o = stability("--seeds 2 --reference refs -o out");
    EXPECT_EQ(o.exit_code, exit_bad_input);
    EXPECT_THAT(o.output, HasSubstr("no-light-24x18-d8.exr was not made by PT"));
}

TEST(StabilityScenes, LoadWithoutNotesAndStateWhatFails) {
    const std::vector<fs::path> files = built_in_stability_scenes();
    EXPECT_TRUE(fs::equivalent(files.front().parent_path(), suite)) << files.front();
    EXPECT_TRUE(std::is_sorted(files.begin(), files.end()));
    ThreadPool pool(1);
    for (const StabilityScene& scene : stability_scenes(files)) {
        for (const LoadNote& note : open_scene(scene.source, pool, nullptr).notes)
            ADD_FAILURE() << scene.source.file << ": " << note.text;
        EXPECT_GT(scene.fails.size(), 20u) << scene.source.file;
    }
}

/// Noise at the edge of a bright lamp is the same for all methods, and would hide their differences.
TEST(StabilityScenes, HideBrightLampsFromTheCamera) {
    constexpr float bright = 100; // most visible radiance is near 1
    ThreadPool pool(1);
    for (const StabilityScene& source : stability_scenes(built_in_stability_scenes())) {
        const OpenedScene opened = open_scene(source.source, pool, nullptr);
        const Scene& scene = *opened.scene;
        const Projection projection(scene.camera(), scene.size());
        const glm::vec3 eye = projection.ray({0, 0}).origin;
        for (int i = 0; i < 200 && !scene.lights().empty(); ++i) {
            LightPoint lamp;
            if (!scene.lights().sample(eye, Random(1, 0, static_cast<std::uint32_t>(i)), 0, lamp) ||
                lamp.kind != LightPoint::Kind::surface ||
                std::max({lamp.radiance.r, lamp.radiance.g, lamp.radiance.b}) < bright)
                continue;
            const glm::vec4 seen = projection.project(lamp.position);
            const glm::vec2 pixel = glm::vec2(seen) / seen.w;
            const bool is_in_picture = seen.z > 0 && glm::all(glm::greaterThan(pixel, glm::vec2(0))) &&
                                       glm::all(glm::lessThan(pixel, glm::vec2(scene.size())));
            const glm::vec3 before = eye + 0.999f * (lamp.position - eye);
            EXPECT_FALSE(is_in_picture && !scene.intersector().occluded({eye, before}))
                << source.source.file << " " << pixel.x << " " << pixel.y;
        }
    }
}

TEST(StabilityScenes, VaryAsTheirCommentsState) {
    const std::vector<StabilityScene> scenes = stability_scenes({suite / "units.xml", suite / "bounces.xml"});
    ASSERT_EQ(scenes.size(), 4u);
    EXPECT_EQ(scenes[0].source.variables.at("unit"), "0.0001");
    EXPECT_EQ(scenes[2].source.variables.at("unit"), "100000");
    EXPECT_EQ(scenes[0].depth, 8);
    EXPECT_EQ(scenes[3].depth, 64);
}

TEST(StabilityScenes, StateWhatTheyNeed) {
    const auto scenes = stability_scenes({suite / "long-run.xml", suite / "bounces.xml"});
    EXPECT_EQ(scenes[0].needs.spp, 100000);
    EXPECT_EQ(scenes[0].needs.seeds, 3);
    EXPECT_EQ(scenes[0].needs.size, glm::ivec2(16, 16));
    EXPECT_FALSE(scenes[1].needs.spp || scenes[1].needs.seeds || scenes[1].needs.size);

    TemporaryFolder folder;
    const fs::path file = folder.path() / "odd.xml";
    for (const char* needs : {"64 samples", "-3 seeds", "16x pixels", "3 seeds, , 4 spp", "3 spp more"}) {
        std::ofstream(file) << "<!-- needs: " << needs << " --><scene version=\"3.0.0\"/>";
        EXPECT_THROW(stability_scenes({file}), BadInput) << needs;
    }
}

} // namespace

} // namespace tessera::test
