// reconstruct_buffers PRIMAL.pfm DX.pfm DY.pfm OUT.pfm [NORM]: reconstructs the buffers of any renderer with
// Tessera's library. dx(x, y) is I(x+1, y) - I(x, y) and dy(x, y) is I(x, y+1) - I(x, y), with y counted downward.
#include "recon/norm.h"
#include "recon/picture/reconstruct.h"

#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>

/// PFM has the bottom row first; a negative scale means little-endian floats.
static tessera::RgbImage read_pfm(const char* path) {
    std::ifstream file(path, std::ios::binary);
    std::string kind;
    int width = 0, height = 0;
    float scale = 0;
    if (!(file >> kind >> width >> height >> scale) || kind != "PF" || scale >= 0 || width < 1 || height < 1)
        throw std::runtime_error(std::string(path) + ": is not a little-endian colour PFM file");
    file.get();
    tessera::RgbImage image(width, height);
    for (int y = height - 1; y >= 0; --y)
        file.read(reinterpret_cast<char*>(image.row(y)),
                  static_cast<std::streamsize>(sizeof(tessera::Rgb)) * width);
    if (!file)
        throw std::runtime_error(std::string(path) + ": is incomplete");
    return image;
}

int main(int argc, char** argv) try {
    if (argc < 5)
        throw std::runtime_error("usage: reconstruct_buffers PRIMAL.pfm DX.pfm DY.pfm OUT.pfm [NORM]");
    tessera::GradientImages images;
    images.primal = read_pfm(argv[1]);
    images.dx = read_pfm(argv[2]);
    images.dy = read_pfm(argv[3]);
    tessera::ReconstructionSettings settings;
    settings.norm = tessera::Norm::l2;
    for (const tessera::Norm norm : tessera::all_norms)
        if (argc > 5 && to_string(norm) == argv[5])
            settings.norm = norm;
    const tessera::RgbImage picture = tessera::reconstruct(images, settings).image;
    std::ofstream file(argv[4], std::ios::binary);
    file << "PF\n" << picture.width() << ' ' << picture.height() << "\n-1\n";
    for (int y = picture.height() - 1; y >= 0; --y)
        file.write(reinterpret_cast<const char*>(picture.row(y)),
                   static_cast<std::streamsize>(sizeof(tessera::Rgb)) * picture.width());
    return file.flush() ? 0 : 1;
} catch (const std::exception& error) {
    return std::fprintf(stderr, "reconstruct_buffers: %s\n", error.what()), 1;
}
