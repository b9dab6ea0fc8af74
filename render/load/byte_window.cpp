#include "render/load/byte_window.h"

#include <algorithm>
#include <stdexcept>

namespace tessera {

ByteWindow::ByteWindow(std::istream& stream) : stream_(stream) {
    const std::streamoff begin = stream.tellg();
    stream.seekg(0, std::ios::end);
    const std::streamoff end = stream.tellg();
    stream.seekg(begin);
    if (begin < 0 || end < begin || !stream)
        throw std::runtime_error("the file cannot be read");
    unread_ = static_cast<std::uint64_t>(end - begin);
    buffer_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(capacity, unread_)));
}

bool ByteWindow::refill(std::size_t count) {
    if (unread_ == 0)
        return false;
    std::copy(bytes_.begin(), bytes_.end(), buffer_.begin());
    const std::size_t kept = bytes_.size();
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(buffer_.size() - kept, unread_));
    if (!stream_.read(buffer_.data() + kept, static_cast<std::streamsize>(wanted)))
        throw std::runtime_error("the file cannot be read");
    unread_ -= wanted;
    bytes_ = {buffer_.data(), kept + wanted};
    return bytes_.size() >= count;
}

} // namespace tessera
