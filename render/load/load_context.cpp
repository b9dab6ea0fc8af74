#include "render/load/load_context.h"

namespace tessera {

namespace {
constexpr int deepest_nesting = 64;
}

XmlElement LoadContext::resolve(const XmlElement& element) const {
    return element.tag() == "ref" ? resolve_id(element) : element;
}

XmlElement LoadContext::resolve_id(const XmlElement& element) const {
    const std::string id = element.required("id");
    const auto found = ids.find(id);
    if (found == ids.end())
        element.fail("nothing in the file has the id '" + id + "'", "id");
    return found->second;
}

std::vector<XmlElement> LoadContext::take_nested(Properties& properties, std::string_view tag) const {
    std::vector<XmlElement> result =
        properties.take_all([&](const XmlElement& element) { return resolve(element).tag() == tag; });
    for (XmlElement& element : result)
        element = resolve(element);
    return result;
}

LoadContext::File LoadContext::take_file(Properties& properties) const {
    const auto parameter = properties.take("filename");
    if (!parameter)
        properties.element().fail("'" + properties.type() + "' needs a 'filename'");
    return {*parameter, files.find(*parameter, "value")};
}

NestingGuard::NestingGuard(LoadContext& context, const XmlElement& element) : context_(context) {
    if (context.depth >= deepest_nesting)
        element.fail("nested too deep: is this a circle of references?");
    ++context.depth;
}

} // namespace tessera
