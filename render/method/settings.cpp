#include "render/method/settings.h"

namespace tessera {

namespace {

struct Names {
    Method method;
    std::string_view short_name;
    std::string_view long_name;
};

constexpr Names names[] = {
    {Method::pt, "pt", "Path tracing"},
    {Method::pr, "pr", "Path reusing"},
    {Method::gpt, "gpt", "Gradient-domain path tracing"},
    {Method::gpr, "gpr", "Gradient-domain path reusing"},
};

} // namespace

std::string_view short_name(Method method) {
    return names[static_cast<int>(method)].short_name;
}
std::string_view long_name(Method method) {
    return names[static_cast<int>(method)].long_name;
}

std::optional<Method> method_from_name(std::string_view short_name) {
    for (const Names& n : names)
        if (n.short_name == short_name)
            return n.method;
    return {};
}

} // namespace tessera
