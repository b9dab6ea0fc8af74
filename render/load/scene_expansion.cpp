#include "render/io/text.h"
#include "render/load/load_context.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <system_error>

namespace tessera {

namespace {

constexpr std::size_t max_include_depth = 15;     // as in Mitsuba
constexpr int max_includes = 10000;               // not tuned
constexpr std::size_t max_value_length = 1 << 20; // bytes; nested variables grow exponentially

bool is_name_character(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

/// The variables defined so far in the walk through a scene.
class Variables {
public:
    explicit Variables(const SceneVariables& given) : given_(given), known_(given) {}

    bool is_used(const std::string& name) const { return used_.count(name) > 0; }

    void define(const XmlElement& element) {
        const std::string name = element.required("name");
        const std::string value = element.required("value");
        if (given_.count(name) > 0)
            used_.insert(name);
        else
            known_[name] = value;
    }

    void replace_in(pugi::xml_attribute attribute, const XmlElement& element) {
        if (std::string_view(attribute.value()).find('$') != std::string_view::npos)
            attribute.set_value(replace(attribute.value(), element, attribute.name()).c_str());
    }

private:
    std::string replace(std::string_view value, const XmlElement& element, const char* attribute) {
        std::string result;
        while (true) {
            const std::size_t dollar = std::min(value.find('$'), value.size());
            result += value.substr(0, dollar);
            if (result.size() > max_value_length)
                element.fail("the variables make a value of more than a million characters", attribute);
            if (dollar == value.size())
                return result;
            value.remove_prefix(dollar + 1);
            const std::string name = longest_known_name(value, element, attribute);
            used_.insert(name);
            result += known_[name];
            value.remove_prefix(name.size());
        }
    }

    /// Returns the longest defined name at the start of the text after a "$". As in Mitsuba, $spp_high means
    /// "$spp" followed by "_high" if only spp is defined.
    std::string longest_known_name(std::string_view text, const XmlElement& element, const char* attribute) const {
        const auto end = std::find_if_not(text.begin(), text.end(), is_name_character);
        const std::string whole(text.begin(), end);
        for (std::string name = whole; !name.empty(); name.pop_back())
            if (known_.count(name) > 0)
                return name;
        element.fail("the variable '$" + whole + "' is not defined (by a <default> before it, or by -D)",
                     attribute);
    }

    const SceneVariables& given_;
    SceneVariables known_;
    std::set<std::string> used_;
};

/// Expands a document and, recursively, the documents that it includes.
class Expansion {
public:
    Expansion(Variables& variables, FileSearch& files, std::vector<LoadNote>& notes)
        : variables_(variables), files_(files), notes_(notes) {}

    void expand(XmlDocument& document) {
        Walker walker(*this, document);
        document.tree().traverse(walker);
    }

private:
    struct Walker : pugi::xml_tree_walker {
        Walker(Expansion& e, XmlDocument& d) : expansion(e), document(d) {}
        bool for_each(pugi::xml_node& node) override {
            expansion.visit(document, node, depth());
            return true;
        }
        Expansion& expansion;
        XmlDocument& document;
    };

    void visit(XmlDocument& document, pugi::xml_node node, int depth) {
        const XmlElement element(document, node);
        for (pugi::xml_attribute attribute : node.attributes())
            variables_.replace_in(attribute, element);
        if (element.tag() == "default")
            variables_.define(element);
        else if (element.tag() == "include")
            include(document, node);
        else if (element.tag() == "path" && depth == 1)
            files_.add_folder(element);
        else
            expand_spectrum_file(element, node, files_, notes_);
    }

    void include(XmlDocument& document, pugi::xml_node node) {
        const XmlElement element(document, node);
        const std::filesystem::path file = files_.find(element, "filename");
        fail_if_circular(element, file, document);
        if (chain_.size() >= max_include_depth)
            element.fail("files include each other more than " + std::to_string(max_include_depth) + " deep",
                         "filename");
        if (++includes_ > max_includes)
            element.fail("there are more than " + std::to_string(max_includes) + " included files", "filename");
        XmlDocument& included = document.include(
            node, std::make_unique<XmlDocument>(read_text(file), file.string(), file.parent_path()));
        note_version(document, included);
        chain_.push_back(&document);
        expand(included);
        chain_.pop_back();
    }

    void fail_if_circular(const XmlElement& element, const std::filesystem::path& file,
                          const XmlDocument& document) {
        std::vector<const XmlDocument*> open = chain_;
        open.push_back(&document);
        const auto is_same = [&](const XmlDocument* other) {
            std::error_code error;
            return std::filesystem::equivalent(file, other->name(), error);
        };
        const auto first = std::find_if(open.begin(), open.end(), is_same);
        if (first == open.end())
            return;
        std::string circle;
        for (auto each = first; each != open.end(); ++each)
            circle += (*each)->name() + " includes ";
        element.fail("a circle of files: " + circle + file.string(), "filename");
    }

    void note_version(const XmlDocument& outer, const XmlDocument& included) {
        const XmlElement root = included.root();
        const std::string& version = outer.version();
        if (root.has("version") && root.attribute("version") != version)
            notes_.push_back(
                {root.position("version"), "the version of the including file is used, '" + version + "'"});
    }

    Variables& variables_;
    FileSearch& files_;
    std::vector<LoadNote>& notes_;
    int includes_ = 0;
    std::vector<const XmlDocument*> chain_; // documents that enclose the one being expanded, outermost first
};

} // namespace

void expand_scene(XmlDocument& document, const SceneVariables& given, FileSearch& files,
                  std::vector<LoadNote>& notes) {
    Variables variables(given);
    Expansion(variables, files, notes).expand(document);
    for (const auto& [name, value] : given)
        if (!variables.is_used(name))
            notes.push_back({{document.name(), 0, 0},
                             "the variable '" + name + "', given as '" + value + "', does not occur in the file"});
}

} // namespace tessera
