#include "render/run/reference_share.h"

#include "render/io/json_text.h"
#include "render/run/checkpoint.h"
#include "render/scene/camera.h"
#include "render/settings/settings_table.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Returns the values of all settings by their ids, for set_texts().
template <class Settings>
json texts_of(Settings& settings) {
    json texts;
    for (const Setting& setting : settings_of(settings))
        texts[std::string(setting.id)] = setting.text();
    return texts;
}

template <class Settings>
void set_texts(Settings& settings, const json& texts) {
    for (const Setting& setting : settings_of(settings))
        setting.set_text(texts.at(std::string(setting.id)).get<std::string>());
}

/// Header of a shard's file.
struct ShareFile {
    fs::path file;
    json header;
    ReferenceRecipe recipe; ///< includes the shard's number
    SceneSource source;
    Camera camera;
    SceneChecksums scene;
};

ReferenceRecipe recipe_from(const json& header) {
    ReferenceRecipe recipe;
    const json& identity = header.at("identity");
    recipe.size = {identity.at("width"), identity.at("height")};
    set_texts(recipe.settings, header.at("settings"));
    method_setting(recipe.settings.method).set_text(header.at("method").get<std::string>());
    header.at("seed").get_to(recipe.settings.seed);
    set_texts(recipe.reconstruction, header.at("reconstruction"));
    header.at("spp").get_to(recipe.spp);
    header.at("share").get_to(recipe.share.number);
    header.at("shares").get_to(recipe.share.count);
    passes_of(recipe); // throws if there is no such shard
    return recipe;
}

ShareFile read_header(const fs::path& file) {
    const json header = parse_json(read_identity(file));
    if (!header.is_object() || !header.contains("shares"))
        throw std::runtime_error(fmt::format("{}: is not a share of a reference", file.string()));
    try {
        const json& source = header.at("source");
        const auto scene = scene_checksums_from(header.at("identity").at("scene").get<std::string>());
        return {file,
                header,
                recipe_from(header),
                {source.at("file").get<std::string>(), source.at("variables"),
                 source.at("camera").get<std::string>(), false},
                parse_camera(header.at("camera").get<std::string>(), file.string()),
                scene.value()};
    } catch (const std::exception& error) {
        throw std::runtime_error(
            fmt::format("{}: is a share from another version of the program ({})", file.string(), error.what()));
    }
}

/// Throws if two shards are of different references.
void check_belongs(const ShareFile& share, const ShareFile& first) {
    const auto refuse = [&](const std::string& what) {
        throw std::runtime_error(fmt::format("{} and {} cannot be merged: the first is of {}", share.file.string(),
                                             first.file.string(), what));
    };
    if (const std::string other =
            identity_difference(to_text(share.header["identity"]), to_text(first.header["identity"]));
        !other.empty())
        refuse(other);
    if (share.recipe.share.count != first.recipe.share.count)
        refuse(fmt::format("{} shares, not {}", share.recipe.share.count, first.recipe.share.count));
    for (const char* key : {"spp", "reconstruction"})
        if (share.header[key] != first.header[key])
            refuse(fmt::format("{} {}, not {}", key, to_text(share.header[key]), to_text(first.header[key])));
}

/// Throws if shards are missing or repeated.
void check_complete(const std::vector<ShareFile>& shares) {
    std::map<int, fs::path> files;
    for (const ShareFile& share : shares)
        if (const auto [other, is_new] = files.emplace(share.recipe.share.number, share.file); !is_new)
            throw std::runtime_error(fmt::format("{} and {} are both share {} of {}", other->second.string(),
                                                 share.file.string(), share.recipe.share.number,
                                                 share.recipe.share.count));
    std::string missing;
    const int count = shares.front().recipe.share.count;
    for (int number = 1; number <= count; ++number)
        if (!files.contains(number))
            missing += fmt::format("{}{}", missing.empty() ? "" : ", ", number);
    if (!missing.empty())
        throw std::runtime_error(fmt::format("these of {} shares are missing: {}", count, missing));
}

std::array<Render, 2> empty_halves(const ShareFile& share) {
    RenderSettings other = share.recipe.settings;
    ++other.seed;
    return {Render(nullptr, share.camera, share.recipe.size, share.recipe.settings),
            Render(nullptr, share.camera, share.recipe.size, other)};
}

Memory memory_of(std::array<Render, 2>& halves) {
    Memory memory = halves[0].memory();
    append(memory, halves[1].memory());
    return memory;
}

} // namespace

std::string shard_identity(const PictureSubject& subject, const ReferenceRecipe& recipe) {
    const std::string whole = picture_identity(subject, recipe.settings, recipe.size);
    if (recipe.share.is_all())
        return whole;
    json identity = parse_json(whole);
    identity["share"] = fmt::format("{} of {}", recipe.share.number, recipe.share.count);
    identity["spp"] = recipe.spp;
    return to_text(identity);
}

std::string shard_header(const PictureSubject& subject, const ReferenceRecipe& recipe) {
    RenderSettings settings = recipe.settings;
    ReconstructionSettings reconstruction = recipe.reconstruction;
    return to_text(json{{"identity", parse_json(picture_identity(subject, recipe.settings, recipe.size))},
                        {"settings", texts_of(settings)},
                        {"method", method_setting(settings.method).text()},
                        {"seed", settings.seed},
                        {"reconstruction", texts_of(reconstruction)},
                        {"camera", camera_json(subject.camera)},
                        {"source",
                         {{"file", subject.source.file.string()},
                          {"variables", subject.source.variables},
                          {"camera", subject.source.camera.string()}}},
                        {"spp", recipe.spp},
                        {"share", recipe.share.number},
                        {"shares", recipe.share.count}});
}

ReferenceImage merge_shards(const std::vector<fs::path>& files, const fs::path& output) {
    std::vector<ShareFile> shares;
    for (const fs::path& file : files)
        shares.push_back(read_header(file));
    for (const ShareFile& share : shares)
        check_belongs(share, shares.front());
    check_complete(shares);
    std::ranges::sort(shares, {}, [](const ShareFile& share) { return share.recipe.share.number; });

    const ShareFile& first = shares.front();
    std::array<Render, 2> sum = empty_halves(first);
    restore(first.file, memory_of(sum));
    {
        std::array<Render, 2> more = empty_halves(first);
        for (std::size_t i = 1; i < shares.size(); ++i) {
            restore(shares[i].file, memory_of(more));
            for (std::size_t half = 0; half < 2; ++half)
                sum[half].add(more[half]);
        }
    }
    ReferenceImage reference = reference_of(sum, first.recipe, first.source, first.scene);
    write_reference(output, reference);
    return reference;
}

} // namespace tessera
