#include "app/experiment/plan.h"

#include "app/cli/option_values.h"
#include "recon/enumeration.h"
#include "render/io/files.h"
#include "render/io/json_text.h"
#include "render/io/memory.h"
#include "render/settings/settings_table.h"

#include <cstdint>
#include <fstream>
#include <span>
#include <stdexcept>

#include <fmt/core.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

namespace fs = std::filesystem;
using nlohmann::json, nlohmann::ordered_json;

constexpr const char* const mark_key = "{\"plan\":";

json options_json(const ExperimentOptions& options) {
    PictureSettings settings = options.settings;
    json texts = json::object(), variations = json::array();
    for (const Setting& setting : settings_of(settings))
        texts[std::string(setting.id)] = setting.text();
    for (const Variation& v : options.variations)
        variations.push_back(fmt::format("{}={}", v.variable.id, fmt::join(v.values, ",")));
    std::vector<std::string> methods, norms;
    for (const Method method : options.methods)
        methods.emplace_back(short_name(method));
    for (const Norm norm : options.norms)
        norms.emplace_back(to_string(norm));
    return {{"command", options.command},
            {"methods", fmt::format("{}", fmt::join(methods, ","))},
            {"norms", fmt::format("{}", fmt::join(norms, ","))},
            {"vary", variations},
            {"settings", texts},
            {"seed", settings.render.seed},
            {"effort", options.effort.amount},
            {"unit", static_cast<int>(options.effort.unit)},
            {"halvings", options.halvings},
            {"seeds", options.seeds},
            {"any_machine", options.sharing.takes_any_machine}};
}

ExperimentOptions options_from(const ordered_json& from) {
    ExperimentOptions options;
    options.command = from.at("command");
    options.methods = parse_methods(from.at("methods"));
    options.norms = parse_norms(from.at("norms"));
    for (const ordered_json& text : from.at("vary"))
        options.variations.push_back(parse_variation(text.get<std::string>()));
    for (const Setting& setting : settings_of(options.settings))
        setting.set_text(from.at("settings").at(std::string(setting.id)).get<std::string>());
    options.settings.render.seed = from.at("seed");
    const int unit = from.at("unit");
    if (unit < 0 || unit >= static_cast<int>(enumerator_count<Effort::Unit>))
        throw std::runtime_error(fmt::format("unknown unit {}", unit));
    options.effort = {from.at("effort"), static_cast<Effort::Unit>(unit)};
    options.halvings = from.at("halvings");
    options.seeds = from.at("seeds");
    options.sharing.takes_any_machine = from.at("any_machine");
    return options;
}

/// Returns the JSON text of the plan without its first line and its end.
std::string contents(const JobPlan& plan) {
    std::string text = "\"works\":[";
    for (const JobPlan::Work& work : plan.works)
        text += fmt::format("{}\n{}", &work == plan.works.data() ? "" : ",",
                            to_text(json{{"options", options_json(work.options)}, {"scenes", work.scenes}}));
    text += "\n],\"jobs\":[";
    for (const JobPlan::Job& job : plan.jobs) {
        json line{{"work", job.work}, {"what", job.what}, {"file", job.file.string()}};
        if (job.is_reference)
            line["reference"] = true;
        for (const fs::path& file : job.known_in)
            line["known"].push_back(file.string());
        text += fmt::format("{}\n{}", &job == plan.jobs.data() ? "" : ",", to_text(line));
    }
    return text + "\n]";
}

JobPlan plan_from(const ordered_json& from) {
    JobPlan plan;
    for (const ordered_json& work : from.at("works"))
        plan.works.push_back({options_from(work.at("options")), work.at("scenes")});
    for (const ordered_json& from_job : from.at("jobs")) {
        JobPlan::Job& job = plan.jobs.emplace_back();
        job.work = from_job.at("work");
        job.what = from_job.at("what");
        job.file = from_job.at("file").get<std::string>();
        job.is_reference = from_job.value("reference", false);
        for (const std::string& file : from_job.value("known", std::vector<std::string>()))
            job.known_in.emplace_back(file);
        if (job.work >= plan.works.size())
            throw std::runtime_error("a job of an unknown experiment");
    }
    return plan;
}

} // namespace

fs::path plan_file(const fs::path& folder) {
    return folder / "jobs" / "plan.json";
}

void write_plan(const fs::path& file, const JobPlan& plan) {
    const std::string text = contents(plan);
    const std::string mark = fmt::format("{}\"{:08x}\",", mark_key, checksum(std::as_bytes(std::span(text))));
    if (plan_mark(file) != mark) // avoids a thousand workers rewriting the same file
        write_text(file, mark + "\n" + text + "}\n");
}

std::string plan_mark(const fs::path& file) {
    std::string line;
    std::getline(std::ifstream(file, std::ios::binary), line);
    return line.starts_with(mark_key) ? line : "";
}

JobPlan read_plan(const fs::path& file) {
    const std::string text = read_text(file), name = file.string();
    const ordered_json from = JsonText(text, name).parse();
    try {
        return plan_from(from);
    } catch (const std::exception& error) {
        throw std::runtime_error(
            fmt::format("{}: is not a list of jobs of this version ({})", name, error.what()));
    }
}

} // namespace tessera
