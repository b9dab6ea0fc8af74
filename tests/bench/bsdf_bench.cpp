// Measures BSDF evaluations and samples per CPU second, for each kind of BSDF.

#include "tests/surface/bsdf_cases.h"

#include <array>
#include <string>

#include <benchmark/benchmark.h>

namespace {

using namespace tessera;
using namespace tessera::test;

struct BenchedBsdf {
    const char* name;
    Bsdf bsdf;
    float eta = 1; ///< relative index of refraction; 1: opaque, -1: transmits without refraction
};

std::vector<BenchedBsdf> benched_bsdfs() {
    using enum MicrofacetDistribution;
    const Rgb orange(0.8f, 0.5f, 0.2f);
    const auto diffuse = shared(DiffuseMaterial{{orange}}), metal = shared(copper(0.3f));
    return {{"diffuse", {Diffuse{orange}}},
            {"rough_diffuse", {RoughDiffuse{orange, 0.5f, false}}},
            {"rough_conductor_ggx", {rough(ggx, 0.2f)}},
            {"rough_conductor_beckmann", {rough(beckmann, 0.2f)}},
            {"conductor", resolved(copper(0))},
            {"dielectric", resolved(glass(0)), 1.5f},
            {"rough_dielectric", resolved(glass(0.2f)), 1.5f},
            {"thin_dielectric", resolved(DielectricMaterial{true})},
            {"plastic", {plastic(ggx, 0, orange, false)}},
            {"rough_plastic", {plastic(ggx, 0.2f, orange, false)}},
            {"phong", {Phong(30, orange, Rgb(0.2f))}},
            {"ward", {UncommonBsdf{Ward(WardVariant::balanced, {0.1f, 0.2f}, orange, Rgb(0.2f))}}},
            {"principled", resolved(PrincipledMaterial{})},
            {"principled_all", resolved(principled(0.3f, 0.5f)), 1.5f},
            {"thin_principled", resolved(thin_principled(0.4f, 0.8f)), -1},
            {"difftrans", {UncommonBsdf{DiffuseTransmitter{orange}}}, -1},
            {"hk", {UncommonBsdf{MediumLayer{orange, Rgb(0.5f), 0.5f, true}}}, -1},
            {"blend", resolved(blend(diffuse, metal, 0.3f))},
            {"coated_diffuse", resolved(coated(diffuse, Rgb(0.5f)))}};
}

/// Arguments of one call. Many different ones keep the branch predictor from learning their sequence.
struct Query {
    glm::vec3 to_previous, to_next;
    float lobe;
    glm::vec2 u;
};

/// Returns random queries. Both directions lie above the surface, or half of `to_next` below it if `transmits`.
std::array<Query, 1024> queries(bool transmits) {
    Uniform uniform(1);
    const auto above = [&uniform] {
        const float phi = 6.2831853f * uniform();
        return direction(std::acos(uniform()), phi);
    };
    std::array<Query, 1024> all;
    for (Query& q : all) {
        q = {above(), above(), uniform(), uniform.two()};
        if (transmits && uniform() < 0.5f)
            q.to_next.z = -q.to_next.z;
    }
    return all;
}

template <class Call>
void run(benchmark::State& state, const BenchedBsdf& c, Call&& call) {
    const auto all = queries(c.eta != 1);
    for (auto _ : state)
        for (const Query& q : all)
            benchmark::DoNotOptimize(call(q));
    state.counters["calls"] =
        benchmark::Counter(static_cast<double>(all.size()), benchmark::Counter::kIsIterationInvariantRate);
}

void evaluate(benchmark::State& state, const BenchedBsdf& c) {
    run(state, c, [&c](const Query& q) { return c.bsdf.evaluate(q.to_previous, q.to_next); });
}

void sample(benchmark::State& state, const BenchedBsdf& c) {
    run(state, c, [&c](const Query& q) { return c.bsdf.sample(q.to_previous, q.lobe, q.u); });
}

} // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv))
        return 1;
    for (const BenchedBsdf& c : benched_bsdfs()) {
        benchmark::RegisterBenchmark((std::string("evaluate/") + c.name).c_str(), evaluate, c);
        benchmark::RegisterBenchmark((std::string("sample/") + c.name).c_str(), sample, c);
    }
    benchmark::RunSpecifiedBenchmarks();
}
