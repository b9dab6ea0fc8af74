#pragma once

#include <filesystem>
#include <istream>
#include <stdexcept>
#include <string>
#include <vector>

namespace tessera {

/// One line of a script: a word that says what to do, and what it needs.
struct ScriptStep {
    std::string word;
    std::vector<std::string> arguments;
    int line = 0; ///< in the file, from 1
};

/// Something is wrong with a line of a script: "steps.txt:3: no step is called jump".
class ScriptError : public std::runtime_error {
public:
    ScriptError(const std::string& file, int line, const std::string& what)
        : std::runtime_error(file + ":" + std::to_string(line) + ": " + what) {}
};

/// A line a step; words are divided by spaces, "double quotes" keep them together, and # begins a comment. Throws
/// ScriptError where a step is unknown or has the wrong number of arguments. `file` is for messages.
std::vector<ScriptStep> parse_script(std::istream& text, const std::string& file);

/// Throws ScriptError also where the file cannot be read.
std::vector<ScriptStep> read_script(const std::filesystem::path& file);

/// The steps that there are, a line each, for the help of the command line.
std::string script_help();

} // namespace tessera
