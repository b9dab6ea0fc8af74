#include "ui/panels/found_actions.h"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace tessera {

namespace {

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::string first_word(const std::string& text) {
    std::istringstream words(lower(text));
    std::string word;
    words >> word;
    return word;
}

} // namespace

bool has_words(const std::string& entry, const std::string& text) {
    const std::string all = lower(entry);
    std::istringstream words(lower(text));
    for (std::string word; words >> word;)
        if (all.find(word) == std::string::npos)
            return false;
    return true;
}

std::vector<const Action*> actions_with(const std::string& text) {
    std::vector<const Action*> found;
    for (const Action& action : actions()) {
        const std::string all = std::string(action.menu) + " " + action.name + " " + action.help + " " +
                                to_string(action.shortcut) + " " + to_string(action.second_shortcut);
        if (has_words(all, text))
            found.push_back(&action);
    }
    const std::string first = first_word(text);
    std::stable_partition(found.begin(), found.end(), [&](const Action* action) {
        return !first.empty() && lower(action->name).rfind(first, 0) == 0;
    });
    return found;
}

} // namespace tessera
