#include "render/io/files.h"
#include "render/io/text.h"
#include "render/load/load_context.h"

#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>

namespace tessera {

namespace {

/// Samples of a spectrum, each list as text.
struct Samples {
    std::string wavelengths, values; ///< separated by ", "
    std::string pairs;               ///< "400:0.1, 410:0.2"
};

Samples samples_of(const std::string& text) {
    Samples samples;
    std::istringstream lines(text);
    std::string line;
    float last = 0;
    for (int number = 1; std::getline(lines, line); ++number) {
        const std::string content = line.substr(0, line.find('#'));
        const std::optional<std::vector<float>> numbers = parse_numbers(content);
        if (numbers && numbers->empty())
            continue;
        if (!numbers || numbers->size() != 2)
            throw std::runtime_error("line " + std::to_string(number) + ": not a wavelength and a value");
        if (!((*numbers)[0] > last))
            throw std::runtime_error("line " + std::to_string(number) + ": the wavelengths must increase");
        last = (*numbers)[0];
        std::istringstream words(content);
        std::string wavelength, value;
        words >> wavelength >> value;
        if (wavelength.ends_with(','))
            wavelength.pop_back();
        const std::string separator = samples.pairs.empty() ? "" : ", ";
        samples.wavelengths += separator + wavelength;
        samples.values += separator + value;
        samples.pairs += separator + wavelength + ":" + value;
    }
    if (samples.pairs.empty())
        throw std::runtime_error("there are no samples in it");
    return samples;
}

} // namespace

void expand_spectrum_file(const XmlElement& element, pugi::xml_node node, const FileSearch& files,
                          std::vector<LoadNote>& notes) {
    const bool is_short = element.tag() == "spectrum" && element.has("filename") && !element.has("value");
    const bool is_parameter = element.tag() == "string" && element.attribute("name") == "filename" &&
                              std::string_view(node.parent().name()) == "spectrum";
    if (!is_short && !is_parameter)
        return;
    const char* const attribute = is_short ? "filename" : "value";
    try {
        const std::filesystem::path file = files.find(element, attribute);
        try {
            const Samples samples = samples_of(read_bytes(file));
            node.remove_attribute(attribute);
            node.append_attribute("value").set_value(is_short ? samples.pairs.c_str() : samples.values.c_str());
            if (is_parameter) {
                node.attribute("name").set_value("values");
                pugi::xml_node wavelengths = node.parent().append_child("string");
                wavelengths.append_attribute("name").set_value("wavelengths");
                wavelengths.append_attribute("value").set_value(samples.wavelengths.c_str());
            }
        } catch (const std::runtime_error& error) {
            element.fail("cannot load '" + element.attribute(attribute) + "': " + error.what(), attribute);
        }
    } catch (const LoadError& error) {
        notes.push_back(error.note("a default is used instead"));
    }
}

} // namespace tessera
