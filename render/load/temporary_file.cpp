#include "render/load/temporary_file.h"

#include <atomic>
#include <string>
#include <system_error>
#include <utility>

#include <unistd.h>

namespace tessera {

TemporaryFile::TemporaryFile(std::filesystem::path final_path) : final_(std::move(final_path)) {
    static std::atomic<int> count = 0;
    temporary_ = final_;
    temporary_ += "." + std::to_string(::getpid()) + "-" + std::to_string(++count) + ".tmp";
}

TemporaryFile::~TemporaryFile() {
    std::error_code ignored;
    if (!temporary_.empty())
        std::filesystem::remove(temporary_, ignored);
}

void TemporaryFile::commit() {
    std::filesystem::rename(temporary_, final_);
    temporary_.clear();
}

} // namespace tessera
