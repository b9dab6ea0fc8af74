#include "app/report/reports.h"
#include "ui/state/buffer.h"

#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>

namespace tessera {

namespace {

Method method_of(const Result& result) {
    return result.setup.settings.render.method;
}

/// Returns whether the result has the method and the reconstruction of the reference.
bool has_origin(const Result& result, const ReferenceOrigin& origin) {
    return method_of(result) == origin.method &&
           (!has_gradients(*origin.method) ||
            to_string(result.setup.settings.reconstruction.norm) == origin.reconstruction);
}

/// Returns the error of path tracing over that of the reference's method and reconstruction, at equal time on the
/// same kind of machine. Each error is the smallest over its setups. NaN if either was not measured, or if the
/// renders have equal samples instead of equal time.
double error_ratio(const ExperimentOptions& options, const std::vector<Result>& results,
                   const ReferenceOrigin& origin) {
    const Result *pt = nullptr, *same_as_reference = nullptr;
    const auto keep_better = [](const Result*& best, const Result& result) {
        if (is_significant(result) && (!best || error_of(result) < error_of(*best)))
            best = &result;
    };
    for (const Result& result : results)
        if (result.halvings == 0 && method_of(result) == Method::pt)
            keep_better(pt, result);
    for (const Result& result : results)
        if (pt && result.halvings == 0 && result.machine == pt->machine && has_origin(result, origin))
            keep_better(same_as_reference, result);
    if (!pt || !same_as_reference || options.effort.unit == Effort::Unit::spp)
        return std::numeric_limits<double>::quiet_NaN();
    return error_of(*pt) / error_of(*same_as_reference);
}

/// Explains the consequences if a reference is by one of the judged methods. Empty if it is by none of them, or
/// by path tracing.
std::string words_on_judged_method(const ExperimentOptions& options, const std::vector<Result>& results,
                                   const ReferenceOrigin& origin) {
    if (!origin.method || origin.method == Method::pt)
        return "";
    bool is_judged = false;
    for (const Result& result : results)
        is_judged = is_judged || method_of(result) == origin.method;
    if (!is_judged)
        return "";
    const std::string_view name = paper_name(*origin.method);
    const double ratio = error_ratio(options, results, origin);
    std::string reason;
    if (ratio > 1)
        reason = fmt::format("; at equal time its error is {:.2g} times lower than path tracing's", ratio);
    else if (std::isfinite(ratio))
        reason = fmt::format("; at equal time its error is {:.2g} times path tracing's", 1 / ratio);
    return fmt::format(
        " {0} is also judged here{1}. No picture has a seed of the reference. A bias of {0} would also be in the "
        "reference and not be visible here; tessera stability compares all methods with path tracing.",
        name, reason);
}

} // namespace

std::string describe_references(const Experiment& experiment, const std::string& scene,
                                const std::vector<Result>& results) {
    std::string text;
    for (const MeasuredScene& measured : experiment.scenes()) {
        if (measured.name() != scene)
            continue;
        for (const FolderReference* reference : measured.references()) {
            if (!reference->is_complete())
                continue;
            const ReferenceOrigin origin = origin_of(reference->image());
            text += fmt::format("{}Reference {}: by {}", text.empty() ? "" : " ",
                                reference->path().filename().string(),
                                origin.method ? paper_name(*origin.method) : "an unknown method");
            if (origin.method && has_gradients(*origin.method) && !origin.reconstruction.empty())
                text += fmt::format(", reconstructed by {}", origin.reconstruction);
            text += fmt::format("; relMSE of its own {:.2g}, estimated from its two independent halves.{}",
                                error_of(reference->image()).relative_mse,
                                words_on_judged_method(experiment.options(), results, origin));
        }
    }
    if (!text.empty())
        text += " relMSE multiplies a picture's differences to the two halves, whose noises are independent: the "
                "expectation does not contain the reference's own error.";
    return text;
}

} // namespace tessera
