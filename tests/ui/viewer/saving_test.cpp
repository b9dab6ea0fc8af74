// Saving of pictures as EXR and PNG.

#include "render/io/plain_images.h"
#include "tests/ui/viewer/current_folder.h"
#include "tests/ui/viewer_harness.h"
#include "ui/panes/showing.h"
#include "ui/state/file_names.h"

#include <atomic>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

namespace tessera::test {
namespace {

namespace fs = std::filesystem;

std::set<fs::path> files_in(const fs::path& folder) {
    std::set<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder))
        files.insert(entry.path().filename());
    return files;
}

TEST(DatedFile, NamesAreUnique) {
    const CurrentFolder folder;
    std::set<fs::path> names;
    for (int i = 0; i < 5; ++i)
        names.insert(dated_file("-charts.csv")); // all within one second, and no file is written
    EXPECT_EQ(names.size(), 5u);
    for (const fs::path& name : names)
        EXPECT_EQ(name.string().find("-charts.csv"), name.string().size() - 11);
}

struct SavedAsExr : testing::Test {
    CurrentFolder folder;
    ViewerOptions options = ViewerHarness::two_panes();
    std::atomic<int> calls = 0;
};

TEST_F(SavedAsExr, TheWriterGetsTheActivePane) {
    std::shared_ptr<const Scene> scene;
    const auto reference = std::make_shared<Reference>();
    options.write_exr = [&](const fs::path& file, const SavedPicture& picture) {
        EXPECT_EQ(file.extension(), ".exr");
        EXPECT_EQ(picture.snapshot->settings.method, Method::gpr);
        EXPECT_EQ(picture.reconstruction.alpha, 0.5f);
        EXPECT_EQ(picture.scene, scene);
        EXPECT_EQ(picture.reference, reference);
        if (++calls == 2)
            throw std::runtime_error("the disk is full");
    };
    ViewerHarness h({900, 600}, 1, options);
    h.state().panes[1].settings.reconstruction.alpha = 0.5f;
    h.rest(2);
    scene = h.state().scene;
    h.state().companions.reference = reference;
    h.type(Key::e, true);
    h.finish_saving();
    EXPECT_EQ(h.state().messages.back().text.find("Saved "), 0u);
    h.type(Key::e, true);
    h.finish_saving();
    EXPECT_EQ(h.state().messages.back().kind, Message::Kind::error);
    EXPECT_EQ(h.state().messages.back().text, "the disk is full");
}

TEST_F(SavedAsExr, FilesAreWrittenInTurnUnderDifferentNames) {
    std::atomic<int> at_once = 0;
    std::atomic<bool> go = false;
    options.write_exr = [&](const fs::path& file, const SavedPicture&) {
        EXPECT_EQ(++at_once, 1);
        while (!go)
            std::this_thread::yield();
        std::ofstream(file) << "exr";
        --at_once;
    };
    ViewerHarness h({900, 600}, 1, options);
    h.rest(2);
    for (int i = 0; i < 3; ++i)
        h.type(Key::e, true); // while the first is written
    go = true;
    h.finish_saving();
    EXPECT_EQ(files_in(folder.path).size(), 3u);
    EXPECT_EQ(h.state().messages.size(), 3u);
}

TEST_F(SavedAsExr, FilesWishedBeforeTheEndAreWritten) {
    std::atomic<bool> go = false;
    options.write_exr = [&](const fs::path&, const SavedPicture&) {
        while (!go)
            std::this_thread::yield();
        ++calls;
    };
    {
        ViewerHarness h({900, 600}, 1, options);
        h.rest(2);
        for (int i = 0; i < 3; ++i)
            h.type(Key::e, true);
        go = true;
    }
    EXPECT_EQ(calls, 3);
}

TEST_F(SavedAsExr, FailuresAtTheEndAreReported) {
    std::atomic<bool> go = false; // set when no further frame can show the message
    options.write_exr = [&](const fs::path&, const SavedPicture&) {
        while (!go)
            std::this_thread::yield();
        throw std::runtime_error("the disk is full " + std::to_string(++calls));
    };
    std::string told;
    {
        ViewerHarness h({900, 600}, 1, options);
        h.rest(2);
        h.state().save(SaveKind::exr);
        testing::internal::CaptureStderr();
        h.frame();
        h.state().save(SaveKind::exr);
        h.frame();
        go = true;
    }
    told = testing::internal::GetCapturedStderr();
    EXPECT_EQ(calls, 2);
    EXPECT_NE(told.find("the disk is full 2\n"), std::string::npos) << told;
}

TEST_F(SavedAsExr, TheReasonIsReportedIfNothingCanBeSaved) {
    options.write_exr = [&](const fs::path&, const SavedPicture&) { ++calls; };
    ViewerHarness h({900, 600}, 1, options);
    h.frames(2);
    h.type(Key::e, true); // without a scene
    ASSERT_EQ(h.state().messages.size(), 1u);
    EXPECT_EQ(h.state().messages.back().kind, Message::Kind::error);
    EXPECT_NE(h.state().messages.back().text.find("no picture to save"), std::string::npos);
    EXPECT_EQ(calls, 0);
}

TEST(SaveQueue, HasALowerPriorityThanDrawing) {
    const int own = getpriority(PRIO_PROCESS, 0);
    int there = own;
    SaveQueue queue;
    queue.add(
        [&] {
            there = getpriority(PRIO_PROCESS, 0);
            return std::string();
        },
        {});
    while (!queue.take())
        std::this_thread::yield();
    EXPECT_GT(there, own);
}

struct SavedView : testing::Test, ViewerHarness {
    CurrentFolder folder;
    ScreenPixels picture(int pane) {
        return view_picture(pane, CanvasShader(), viewer.pictures().images(), state());
    }
};

TEST_F(SavedView, HasTheImagesPixelsInTheColoursOnShow) {
    rest(2);
    state().display.tone.curve = Tone::Curve::srgb;
    state().display.view = ImageView(7, {0.1f, 0.9f}); // has no influence
    frames(2);
    const ScreenPixels saved = picture(1);
    const RgbImage& image = viewer.pictures().image(1).pixels();
    ASSERT_EQ(saved.size, glm::ivec2(image.width(), image.height()));
    for (const glm::ivec2 p : {glm::ivec2(0, 0), glm::ivec2(40, 3), glm::ivec2(5, 30), glm::ivec2(47, 35)}) {
        const Rgb& value = image(p.x, p.y);
        EXPECT_NEAR(saved.at(p.x, p.y)[0], srgb_byte(value.r), 1) << p.x << ' ' << p.y;
        EXPECT_NEAR(saved.at(p.x, p.y)[2], srgb_byte(value.b), 1) << p.x << ' ' << p.y;
    }
    state().display.tone.exposure = -1;
    EXPECT_NEAR(picture(1).at(5, 30)[0], srgb_byte(image(5, 30).r / 2), 1);
    state().panes[1].settings.buffer = Buffer::reused; // false colours
    frames(2);
    const ScreenPixels coloured = picture(1);
    const std::uint8_t* pixel = coloured.at(5, 30);
    EXPECT_FALSE(pixel[0] == pixel[1] && pixel[1] == pixel[2]);
}

TEST_F(SavedView, ShowsTheActivePaneAndItsDifference) {
    rest(2);
    const ScreenPixels own = picture(1);
    state().panes[1].settings.comparison = {Comparison::Kind::difference, 0};
    frames(2);
    EXPECT_NE(picture(1).rgb, own.rgb);
    state().panes[1].settings.comparison = {Comparison::Kind::wipe, 0};
    state().layout.wipe = 0;
    frames(2);
    EXPECT_EQ(picture(1).rgb, own.rgb); // the pane's own picture, without the wipe
}

TEST_F(SavedView, IsWrittenByItsActionOrReportsTheReason) {
    rest(2);
    type(Key::s, true, true);
    finish_saving();
    auto files = files_in(folder.path);
    ASSERT_EQ(files.size(), 1u);
    EXPECT_NE(files.begin()->string().find("-gpr-reconstruction.png"), std::string::npos) << *files.begin();
    EXPECT_EQ(state().messages.back().text.find("Saved "), 0u);
    state().panes[1].settings.buffer = Buffer::error_squared;
    frames(2);
    type(Key::s, true, true);
    finish_saving();
    EXPECT_EQ(state().messages.back().kind, Message::Kind::error);
    EXPECT_NE(state().messages.back().text.find("No reference"), std::string::npos);
    EXPECT_EQ(files_in(folder.path).size(), 1u);
}

TEST_F(SavedView, TheWindowIsWrittenByABackgroundThread) {
    rest(2);
    type(Key::f12);
    finish_saving();
    EXPECT_EQ(files_in(folder.path).size(), 1u);
    EXPECT_EQ(state().messages.back().text.find("Saved "), 0u);
}

TEST_F(SavedView, CanBeSavedUnderAChosenNameAndFolder) {
    fs::create_directory(folder.path / "pictures");
    rest(2);
    type(Key::s, true);
    frames(2);
    save("save");
    choose("file.kind", "window");
    choose("file.kind", "picture"); // the name has the kind's ending
    click("file/pictures");
    frames(2);
    click("file.open");
    finish_saving();
    const fs::path file = folder.path / "pictures/cornell-box-gpr.png";
    EXPECT_TRUE(fs::exists(file));
    EXPECT_THAT(state().layout.toast.text, testing::HasSubstr(file.string()));

    type(Key::s, true, true); // a dated name in the folder of the last save
    finish_saving();
    EXPECT_EQ(files_in(folder.path / "pictures").size(), 2u);
    type(Key::s, true); // the dialog offers an unused name
    frames(2);
    click("file.open");
    finish_saving();
    EXPECT_TRUE(fs::exists(folder.path / "pictures/cornell-box-gpr-2.png"));
    EXPECT_EQ(files_in(folder.path).size(), 1u);
}

/// A name that could not be written is not used for the next picture.
TEST_F(SavedView, ANameAppliesToOneSaveOnly) {
    rest(2);
    type(Key::s, true);
    frames(2);
    const fs::path beside = folder.path / "taken";
    std::ofstream(beside) << "a file, not a folder";
    state().save(SaveKind::picture, (beside / "first.png").string());
    finish_saving();
    EXPECT_EQ(state().messages.back().kind, Message::Kind::error);
    fs::remove(beside);
    fs::create_directory(beside);
    state().layout.save_folder = folder.path.string();
    state().save(SaveKind::picture);
    finish_saving();
    EXPECT_FALSE(fs::exists(beside / "first.png"));
    EXPECT_EQ(files_in(folder.path).size(), 2u) << "the folder, and a picture with a dated name";
}

TEST_F(SavedView, TheDialogSavesEachKind) {
    rest(2);
    const char* const kinds[] = {"window", "settings", "camera", "charts"};
    for (const char* kind : kinds) {
        type(Key::s, true);
        frames(2);
        choose("file.kind", kind);
        click("file.open");
        finish_saving();
        EXPECT_FALSE(state().wishes.saves.has_any()) << kind;
    }
    std::set<fs::path> expected;
    for (const char* name :
         {"window.png", "settings.json", "camera.json", "charts.csv", "charts.svg", "charts.png"})
        expected.insert(std::string("cornell-box-") + name);
    EXPECT_EQ(files_in(folder.path), expected);
}

} // namespace
} // namespace tessera::test
