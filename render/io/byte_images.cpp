#include "render/io/available_memory.h"
#include "render/io/files.h"
#include "render/io/picture_formats.h"

#include <algorithm>
#include <csetjmp>
#include <cstddef>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>

#include <png.h>
#include <turbojpeg.h>

// Only the simple readers of stb_image are compiled: fuzzing finds undefined behaviour or crashes in others.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_TGA
#define STBI_ONLY_BMP
#include <stb_image.h>
#pragma GCC diagnostic pop

namespace tessera {

namespace {

/// Returns an image of that size, after checking the size and the free memory.
ByteImage image_of(std::int64_t width, std::int64_t height, std::size_t file_bytes) {
    check_image_size(width, height, file_bytes);
    const auto bytes = 3 * static_cast<std::uint64_t>(width * height);
    require_memory(2 * bytes, "its pixels"); // the pixels, and the decoder's copy
    return {static_cast<int>(width), static_cast<int>(height), std::vector<std::uint8_t>(bytes)};
}

[[noreturn]] void fail(const std::string& what) {
    throw std::runtime_error("the picture cannot be read: " + what);
}

void check_not_cancelled(const std::function<bool()>& keep_reading) {
    if (!keep_reading())
        throw std::runtime_error("reading was cancelled");
}

/// Reads PNG. libpng reports errors by longjmp, so functions that call it have no local objects with
/// destructors, and no callback throws.
class PngReader {
public:
    explicit PngReader(std::string_view bytes) : left_(bytes) {
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
        info_ = png_ ? png_create_info_struct(png_) : nullptr;
        if (!info_) {
            png_destroy_read_struct(&png_, nullptr, nullptr);
            throw OutOfMemory("there is no memory to read a PNG picture");
        }
    }
    ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;

    /// Makes rows of RGBA if there is alpha and `keeps_alpha`, otherwise of RGB.
    bool read_header(bool keeps_alpha = false) {
        if (setjmp(png_jmpbuf(png_)) != 0)
            return false;
        png_set_user_limits(png_, max_image_edge, max_image_edge);
        png_set_read_fn(png_, this, read);
        png_read_info(png_, info_);
        png_set_strip_16(png_);
        if (keeps_alpha)
            png_set_tRNS_to_alpha(png_);
        else
            png_set_strip_alpha(png_);
        png_set_palette_to_rgb(png_);
        png_set_expand_gray_1_2_4_to_8(png_);
        png_set_gray_to_rgb(png_);
        passes_ = png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        return true;
    }
    bool read_row(std::uint8_t* row) {
        if (setjmp(png_jmpbuf(png_)) != 0)
            return false;
        png_read_row(png_, row, nullptr);
        return true;
    }

    std::int64_t width() const { return png_get_image_width(png_, info_); }
    std::int64_t height() const { return png_get_image_height(png_, info_); }
    std::size_t row_bytes() const { return png_get_rowbytes(png_, info_); }
    int passes() const { return passes_; }
    const char* error() const { return message_; }

private:
    static void on_error(png_structp png, png_const_charp what) {
        auto& reader = *static_cast<PngReader*>(png_get_error_ptr(png));
        std::strncpy(reader.message_, what, sizeof reader.message_ - 1);
        png_longjmp(png, 1);
    }
    static void on_warning(png_structp, png_const_charp) {}
    static void read(png_structp png, png_bytep data, std::size_t count) {
        auto& reader = *static_cast<PngReader*>(png_get_io_ptr(png));
        if (count > reader.left_.size())
            png_error(png, "the file ends too early");
        std::memcpy(data, reader.left_.data(), count);
        reader.left_.remove_prefix(count);
    }

    std::string_view left_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
    int passes_ = 1;
    char message_[256] = {};
};

struct TurboJpeg {
    TurboJpeg() : handle(tjInitDecompress()) {
        if (!handle)
            throw OutOfMemory("there is no memory to read a JPEG picture");
    }
    ~TurboJpeg() { tjDestroy(handle); }
    TurboJpeg(const TurboJpeg&) = delete;
    TurboJpeg& operator=(const TurboJpeg&) = delete;

    tjhandle handle;
};

} // namespace

bool is_png(std::string_view bytes) {
    return bytes.starts_with("\x89PNG\r\n\x1a\n");
}

bool is_jpeg(std::string_view bytes) {
    return bytes.starts_with("\xff\xd8\xff");
}

bool is_bmp(std::string_view bytes) {
    return bytes.starts_with("BM");
}

ByteImage parse_png(std::string_view bytes, const std::function<bool()>& keep_reading) {
    PngReader reader(bytes);
    if (!reader.read_header())
        fail(reader.error());
    ByteImage image = image_of(reader.width(), reader.height(), bytes.size());
    const std::size_t row_bytes = 3 * static_cast<std::size_t>(image.width);
    if (reader.row_bytes() != row_bytes)
        fail("its pixels cannot be converted to RGB");
    for (int pass = 0; pass < reader.passes(); ++pass)
        for (int y = 0; y < image.height; ++y) {
            check_not_cancelled(keep_reading);
            if (!reader.read_row(image.rgb.data() + row_bytes * static_cast<std::size_t>(y)))
                fail(reader.error());
        }
    return image;
}

ByteImage parse_png_alpha(std::string_view bytes, const std::function<bool()>& keep_reading) {
    PngReader reader(bytes);
    if (!reader.read_header(true))
        fail(reader.error());
    ByteImage image = image_of(reader.width(), reader.height(), bytes.size());
    const std::size_t row_bytes = 4 * static_cast<std::size_t>(image.width);
    if (reader.row_bytes() != row_bytes)
        fail("it has no alpha channel");
    std::vector<std::uint8_t> rgba(row_bytes * static_cast<std::size_t>(image.height));
    for (int pass = 0; pass < reader.passes(); ++pass)
        for (int y = 0; y < image.height; ++y) {
            check_not_cancelled(keep_reading);
            if (!reader.read_row(rgba.data() + row_bytes * static_cast<std::size_t>(y)))
                fail(reader.error());
        }
    for (std::size_t i = 0; i < image.rgb.size(); ++i)
        image.rgb[i] = rgba[i / 3 * 4 + 3];
    return image;
}

ByteImage parse_jpeg(std::string_view bytes, const std::function<bool()>& keep_reading) {
    const TurboJpeg jpeg;
    const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
    int width = 0, height = 0, subsampling = 0, colours = 0;
    if (tjDecompressHeader3(jpeg.handle, data, bytes.size(), &width, &height, &subsampling, &colours) != 0)
        fail(tjGetErrorStr2(jpeg.handle));
    ByteImage image = image_of(width, height, bytes.size());
    check_not_cancelled(keep_reading);
    // TJFLAG_LIMITSCANS: decoding thousands of scans of the whole picture would take minutes.
    const bool succeeded = tjDecompress2(jpeg.handle, data, bytes.size(), image.rgb.data(), width, 0, height,
                                         TJPF_RGB, TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS) == 0;
    const std::string why = succeeded ? "" : tjGetErrorStr2(jpeg.handle);
    // Many cameras write extraneous bytes between the parts of a file, which are harmless.
    if (!succeeded && (tjGetErrorCode(jpeg.handle) != TJERR_WARNING || why.find("extraneous bytes") == why.npos))
        fail(why);
    return image;
}

ByteImage parse_bmp_or_tga(std::string_view bytes, const std::function<bool()>& keep_reading) {
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    if (bytes.size() > std::size_t{1} << 30)
        fail("the file is larger than 1 GiB");
    const int size = static_cast<int>(bytes.size());
    int width = 0, height = 0, channels = 0;
    if (!stbi_info_from_memory(data, size, &width, &height, &channels))
        fail(stbi_failure_reason());
    ByteImage image = image_of(width, height, bytes.size());
    check_not_cancelled(keep_reading);
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(data, size, &width, &height, &channels, 3), stbi_image_free);
    if (!pixels || width != image.width || height != image.height)
        fail(pixels ? "its size is inconsistent" : stbi_failure_reason());
    std::copy_n(pixels.get(), image.rgb.size(), image.rgb.begin());
    return image;
}

RgbImage to_rgb(const ByteImage& picture) {
    RgbImage image(picture.width, picture.height);
    for (std::size_t i = 0; i < image.size(); ++i)
        image.data()[i] = Rgb(picture.rgb[3 * i], picture.rgb[3 * i + 1], picture.rgb[3 * i + 2]) / 255.0f;
    return image;
}

} // namespace tessera
