#include "ui/picture_saver.h"

#include "render/load/png.h"
#include "ui/output_files.h"
#include "ui/screenshot.h"

namespace tessera {

namespace {

constexpr int frames_until_still = 3;

} // namespace

bool PictureSaver::after_frame(Viewer& viewer, glm::ivec2 pixels) {
    ViewerState& state = viewer.state();
    age_ = state.save_picture ? age_ + 1 : 0;
    if (age_ == frames_until_still) {
        state.save_picture = false;
        viewer.save([file = dated_file(".png"), screen = read_screen(pixels)] {
            write_png(file, screen.size, screen.rgb);
            return file.string();
        });
    }
    return age_ > 0;
}

} // namespace tessera
