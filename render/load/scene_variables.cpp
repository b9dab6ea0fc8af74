#include "render/load/scene_variables.h"

#include <algorithm>
#include <cctype>
#include <set>

namespace tessera {

namespace {

bool is_name_character(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

/// Walks through a document in order and keeps the variables known so far.
class Substitution : public pugi::xml_tree_walker {
public:
    Substitution(const XmlDocument& document, const SceneVariables& given)
        : document_(document), given_(given), known_(given) {}

    bool for_each(pugi::xml_node& node) override {
        for (pugi::xml_attribute attribute : node.attributes()) {
            const std::string_view value = attribute.value();
            if (value.find('$') != std::string_view::npos)
                attribute.set_value(replace(value, XmlElement(document_, node), attribute.name()).c_str());
        }
        if (std::string_view(node.name()) == "default")
            define(XmlElement(document_, node));
        return true;
    }

    bool is_used(const std::string& name) const { return used_.count(name) > 0; }

private:
    void define(const XmlElement& element) {
        const std::string name = element.required("name");
        const std::string value = element.required("value");
        if (given_.count(name) > 0)
            used_.insert(name);
        else
            known_[name] = value;
    }

    std::string replace(std::string_view value, const XmlElement& element, const char* attribute) {
        std::string result;
        while (true) {
            const std::size_t dollar = std::min(value.find('$'), value.size());
            result += value.substr(0, dollar);
            if (dollar == value.size())
                return result;
            value.remove_prefix(dollar + 1);
            const std::string name = longest_known_name(value, element, attribute);
            used_.insert(name);
            result += known_[name];
            value.remove_prefix(name.size());
        }
    }

    /// As in Mitsuba, where $spp_high means "$spp" followed by "_high" if there is only spp.
    std::string longest_known_name(std::string_view text, const XmlElement& element, const char* attribute) const {
        const auto end = std::find_if_not(text.begin(), text.end(), is_name_character);
        const std::string whole(text.begin(), end);
        for (std::string name = whole; !name.empty(); name.pop_back())
            if (known_.count(name) > 0)
                return name;
        element.fail("the variable '$" + whole + "' is not defined (by a <default> before it, or by -D)",
                     attribute);
    }

    const XmlDocument& document_;
    const SceneVariables& given_;
    SceneVariables known_;
    std::set<std::string> used_;
};

} // namespace

void substitute_variables(XmlDocument& document, const SceneVariables& given, std::vector<LoadNote>& notes) {
    Substitution substitution(document, given);
    document.tree().traverse(substitution);
    for (const auto& [name, value] : given)
        if (!substitution.is_used(name))
            notes.push_back({{document.name(), 0, 0},
                             "the variable '" + name + "', given as '" + value + "', does not occur in the file"});
}

} // namespace tessera
