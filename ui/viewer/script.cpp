#include "ui/viewer/script.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <sstream>
#include <string_view>
#include <utility>

#include <fmt/core.h>

namespace tessera {

namespace {

struct StepKind {
    const char* word;
    int min_arguments, max_arguments;
    const char* usage;
    const char* help;
};

constexpr StepKind kinds[] = {
    {"wait", 1, 2, "wait scene | spp N | seconds S | reference",
     "waits for the scene, for N samples per pixel in all panes, for S seconds, or for a reference"},
    {"key", 1, 1, "key Ctrl+S", "presses and releases a key, or types a character"},
    {"hold", 1, 1, "hold B", "presses a key and holds it"},
    {"release", 1, 1, "release B", "releases a key"},
    {"modifiers", 1, 2, "modifiers ctrl shift | none", "sets the modifier keys that are held during mouse steps"},
    {"move", 1, 2, "move POINT",
     "moves the mouse; POINT is X Y, CONTROL or CONTROL@FX,FY (fractions of its size)"},
    {"click", 1, 2, "click POINT", "clicks the left mouse button"},
    {"choose", 2, 2, "choose CONTROL ITEM", "opens a list and clicks an item"},
    {"drag", 2, 4, "drag POINT POINT", "drags with the left mouse button, in 8 frames"},
    {"wheel", 1, 1, "wheel N", "turns the mouse wheel by N notches; positive is up"},
    {"set", 2, 2, "set NAME VALUE",
     "changes a setting of the active pane or of the viewer: tile 4, panes 2, exposure 1.5"},
    {"inspect", 3, 3, "inspect X Y PASS",
     "opens a sample of the active pane in the path inspector, and waits for it"},
    {"open", 1, 1, "open FILE", "opens a scene, an EXR reference or settings (JSON), as if dropped on the window"},
    {"reference", 1, 1, "reference FILE", "opens an EXR file to measure errors against"},
    {"screenshot", 1, 1, "screenshot FILE.png", "saves a picture of the window"},
    {"frames", 2, 2, "frames N LABEL",
     "draws N frames and prints median and 99th percentile of their times, milliseconds"},
    {"orbit", 2, 2, "orbit N LABEL", "does the same while the mouse drags the camera of the active pane"},
    {"print", 1, 1, "print TEXT", "prints TEXT on standard output"},
    {"quit", 0, 0, "quit", "ends the program; without this step the viewer stays open"},
};

std::vector<std::string> words_of(const std::string& line, const std::string& file, int number) {
    std::istringstream text(line);
    std::vector<std::string> words;
    for (text >> std::ws; text.peek() != EOF && text.peek() != '#'; text >> std::ws) {
        const bool quoted = text.peek() == '"';
        std::string word;
        text >> std::quoted(word);
        if (quoted && (text.unget(), text.get() != '"'))
            throw ScriptError(file, number, "missing closing quotation mark");
        words.push_back(std::move(word));
    }
    return words;
}

void check(const ScriptStep& step, const std::string& file) {
    const auto kind =
        std::find_if(std::begin(kinds), std::end(kinds), [&](const StepKind& k) { return step.word == k.word; });
    if (kind == std::end(kinds)) {
        std::string known;
        for (const StepKind& k : kinds)
            known += std::string(known.empty() ? "" : ", ") + k.word;
        throw ScriptError(file, step.line, "unknown step " + step.word + "; the steps are " + known);
    }
    const int count = static_cast<int>(step.arguments.size());
    if (count < kind->min_arguments || count > kind->max_arguments)
        throw ScriptError(file, step.line, std::string("usage: ") + kind->usage);
}

} // namespace

std::vector<ScriptStep> parse_script(std::istream& text, const std::string& file) {
    std::vector<ScriptStep> steps;
    std::string line;
    for (int number = 1; std::getline(text, line); ++number) {
        std::vector<std::string> words = words_of(line, file, number);
        if (words.empty())
            continue;
        ScriptStep step{words.front(), {words.begin() + 1, words.end()}, number};
        check(step, file);
        steps.push_back(std::move(step));
    }
    return steps;
}

std::vector<ScriptStep> read_script(const std::filesystem::path& file) {
    if (file == "-")
        return parse_script(std::cin, "standard input");
    std::ifstream text(file);
    if (!text)
        throw ScriptError(file.string(), 1, "the file cannot be read");
    return parse_script(text, file.string());
}

std::string script_help() {
    std::size_t longest = 0;
    for (const StepKind& kind : kinds)
        longest = std::max(longest, std::string_view(kind.usage).size());
    const auto usage_width = static_cast<int>(longest);
    std::ostringstream text;
    for (const StepKind& kind : kinds)
        text << "  " << std::left << std::setw(usage_width) << kind.usage << ' ' << kind.help << '\n';
    return text.str();
}

double quantile(std::vector<double> values, double fraction) {
    if (values.empty())
        return 0;
    std::sort(values.begin(), values.end());
    const double place = std::ceil(fraction * static_cast<double>(values.size())) - 1;
    return values[static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(values.size() - 1)))];
}

std::string FrameTimes::text() const {
    std::string line = fmt::format("frames {}: {}, median {:.1f} ms, 99th percentile {:.1f} ms", label,
                                   seconds.size(), quantile(seconds, 0.5) * 1e3, quantile(seconds, 0.99) * 1e3);
    if (!behind.empty())
        line +=
            fmt::format("; {} pictures, {:.1f} a second, behind the camera by a median of {:.1f} ms",
                        behind.size(), static_cast<double>(behind.size()) / period, quantile(behind, 0.5) * 1e3);
    return line;
}

} // namespace tessera
