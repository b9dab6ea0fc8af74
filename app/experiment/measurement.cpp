#include "app/experiment/measured_run.h"
#include "recon/enumeration.h"

#include <limits>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

std::string to_string(const Effort& effort) {
    constexpr const char* units[] = {"spp", "CPU s", "s"};
    return fmt::format("{:g} {}", effort.amount, entry_of(units, effort.unit));
}

namespace {

/// Parses a number; dump() writes numbers that are not finite as null.
double number(const nlohmann::json& json) {
    return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

std::vector<double> numbers(const nlohmann::json& json) {
    std::vector<double> numbers;
    for (const nlohmann::json& element : json)
        numbers.push_back(number(element));
    return numbers;
}

nlohmann::ordered_json to_json(const std::optional<TileSpectrum>& tiles) {
    if (!tiles)
        return nullptr;
    return {{"error", tiles->error}, {"edges", tiles->edges}, {"edge_ratio", tiles->edge_ratio}};
}

std::optional<TileSpectrum> tiles_from_json(const nlohmann::json& json) {
    if (json.is_null())
        return {};
    return TileSpectrum{number(json.at("error")), number(json.at("edges")), number(json.at("edge_ratio"))};
}

nlohmann::ordered_json to_json(const std::optional<Artefacts>& a) {
    if (!a)
        return nullptr;
    return {{"relmse", a->error.relative_mse},
            {"relmse_standard_error", a->error.standard_error},
            {"mean", a->mean},
            {"worst", a->worst},
            {"worst_pixel", {a->worst_pixel.x, a->worst_pixel.y}},
            {"bad_pixels", a->bad_pixels},
            {"pieces", a->pieces},
            {"tone_mapped", a->tone_mapped},
            {"tenfold", a->tenfold},
            {"halo_energy", a->halo_energy},
            {"halo_peak", a->halo_peak}};
}

/// Parses artefacts; empty if none were measured. Journals of older versions have none.
std::optional<Artefacts> artefacts_from_json(const nlohmann::json& json) {
    if (json.is_null())
        return {};
    Artefacts a;
    a.error = {number(json.at("relmse")), number(json.at("relmse_standard_error"))};
    a.mean = number(json.at("mean"));
    a.worst = numbers(json.at("worst"));
    a.worst_pixel = {json.at("worst_pixel").at(0), json.at("worst_pixel").at(1)};
    json.at("bad_pixels").get_to(a.bad_pixels);
    a.pieces = numbers(json.at("pieces"));
    // Journals of older versions lack these.
    a.tone_mapped = number(json.value("tone_mapped", nlohmann::json()));
    a.tenfold = number(json.value("tenfold", nlohmann::json()));
    a.halo_energy = number(json.value("halo_energy", nlohmann::json()));
    a.halo_peak = number(json.value("halo_peak", nlohmann::json()));
    return a;
}

nlohmann::ordered_json to_json(const Counters& c) {
    return {{"camera_paths", c.camera_paths},
            {"path_vertices", c.path_vertices},
            {"rays", c.rays},
            {"dark_paths", c.dark_paths},
            {"skipped_paths", c.skipped_paths},
            {"reused_paths", c.reused_paths},
            {"shifts", c.shifts},
            {"refused_samples", c.invalid_samples}};
}

Counters counters_from_json(const nlohmann::json& json) {
    Counters c;
    json.at("camera_paths").get_to(c.camera_paths);
    json.at("path_vertices").get_to(c.path_vertices);
    json.at("rays").get_to(c.rays);
    json.at("dark_paths").get_to(c.dark_paths);
    json.at("skipped_paths").get_to(c.skipped_paths);
    json.at("reused_paths").get_to(c.reused_paths);
    json.at("shifts").get_to(c.shifts);
    json.at("refused_samples").get_to(c.invalid_samples);
    return c;
}

} // namespace

nlohmann::ordered_json to_json(const Measurement& m) {
    return {{"halvings", m.halvings},
            {"seed", m.seed},
            {"spp", m.spp},
            {"cpu_seconds", m.cpu_seconds},
            {"wall_seconds", m.wall_seconds},
            {"reconstruction_cpu_seconds", m.reconstruction_cpu_seconds},
            {"relmse", m.relative_mse},
            {"relmse_floor_free", m.floor_free.relative_mse},
            {"relmse_floor_free_standard_error", m.floor_free.standard_error},
            {"tiles", to_json(m.tiles)},
            {"counters", to_json(m.counters)},
            {"artefacts", to_json(m.artefacts)},
            {"machine", m.machine},
            {"psnr", m.psnr},
            {"flip", m.flip}};
}

Measurement measurement_from_json(const nlohmann::json& json) {
    return {json.at("halvings"),
            json.at("seed"),
            json.at("spp"),
            json.at("cpu_seconds"),
            json.at("wall_seconds"),
            json.at("reconstruction_cpu_seconds"),
            number(json.at("relmse")),
            {number(json.at("relmse_floor_free")), number(json.at("relmse_floor_free_standard_error"))},
            tiles_from_json(json.at("tiles")),
            counters_from_json(json.at("counters")),
            artefacts_from_json(json.value("artefacts", nlohmann::json())),
            json.value("machine", ""),
            number(json.value("psnr", nlohmann::json())),
            number(json.value("flip", nlohmann::json()))};
}

} // namespace tessera
