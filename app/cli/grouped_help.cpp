#include "app/cli/grouped_help.h"

#include "app/cli/option_values.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace tessera {

namespace {

struct HelpGroup {
    std::string name;
    std::vector<std::string> options; ///< in the order of the help
};

/// Returns the groups in the order of the help. The first group that lists an option has it.
const std::vector<HelpGroup>& help_groups() {
    static const std::vector<HelpGroup> groups = {
        {"Everyday",
         {"-m", "--panes", "--recon", "--spp", "--time", "--quick", "--seeds", "--vary", "--size", "--max-depth",
          "-D", "--camera", "--cameras", "--sensor", "--crop", "--pixel-format", "--reference", "-o"}},
        {"Published settings", render_option_names()}, // the presets change these
        {"Expert", {"--alpha", "--seed", "--threads", "--clock", "--stats", "--buffers", "--strict"}},
        {"Jobs that processes share",
         {"--list", "--job", "--report", "--any-build", "--machine", "--any-machine", "--silence"}},
    };
    return groups;
}

constexpr std::size_t min_grouped = 12; // a command with fewer options has no groups

/// Lists the options of a group in the group's order.
class OrderedHelp : public CLI::Formatter {
public:
    std::string make_group(std::string name, bool is_positional,
                           std::vector<const CLI::Option*> options) const override {
        for (const HelpGroup& group : help_groups()) {
            const auto place = [&](const CLI::Option* option) {
                const auto is_named = [&](const std::string& word) { return option->check_name(word); };
                return std::find_if(group.options.begin(), group.options.end(), is_named) - group.options.begin();
            };
            if (group.name == name)
                std::ranges::stable_sort(options, {}, place);
        }
        return Formatter::make_group(name, is_positional, options);
    }
};

/// Assigns the options of a command to their groups.
void group_options(CLI::App& command) {
    const auto is_optional = [](const CLI::Option* option) { return option->nonpositional(); };
    if (command.get_options(is_optional).size() < min_grouped)
        return;
    for (CLI::Option* option : command.get_options(is_optional)) {
        const auto has = [&](const HelpGroup& group) {
            return std::ranges::any_of(group.options,
                                       [&](const std::string& name) { return option->check_name(name); });
        };
        const auto group = std::ranges::find_if(help_groups(), has);
        option->group(group == help_groups().end() ? "Other options" : group->name);
    }
    command.get_help_ptr()->group(
        help_groups().front().name); // CLI11 lists groups in the order of their first options
}

} // namespace

void group_help(CLI::App& app) {
    const auto formatter = std::make_shared<OrderedHelp>();
    for (CLI::App* command : app.get_subcommands({})) {
        command->formatter(formatter);
        group_options(*command);
    }
}

} // namespace tessera
