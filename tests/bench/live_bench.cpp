// live_bench SCENE.xml [SECONDS]: measures the delay of reconstructions delays a render of 1280x720 pixels in the
// viewer's session, on all hardware threads. Delays are wall time, so other work on the machine counts.

#include "recon/picture/oidn.h"
#include "render/load/mitsuba_xml.h"
#include "render/scene/scene.h"
#include "render/session/session.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

namespace {

using namespace tessera;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

void measure(const std::shared_ptr<const Scene>& scene, Norm norm, double seconds) {
    Session session(1, 0);
    session.set_reconstruction(0, {.norm = norm});
    RenderRequest request{scene, scene->camera(), {1280, 720}, {}};
    session.submit(0, std::move(request));
    const auto start = Clock::now();
    std::map<int, double> published; // samples per pixel -> seconds since the start
    std::vector<double> delays;
    int reconstructed = 0;
    while (seconds_since(start) < seconds) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        const auto snapshot = session.latest(0);
        if (!snapshot || snapshot->coarse())
            continue;
        published.emplace(snapshot->spp, seconds_since(start));
        if (snapshot->reconstruction_spp > reconstructed) {
            reconstructed = snapshot->reconstruction_spp;
            delays.push_back(seconds_since(start) - published[reconstructed]);
        }
    }
    std::sort(delays.begin(), delays.end());
    if (delays.empty())
        std::printf("%-9s no reconstruction within %.0f s\n", to_string(norm).data(), seconds);
    else
        std::printf("%-9s %3zu reconstructions of %3zu pictures: delay %.3f s (median), %.3f s (maximum)\n",
                    to_string(norm).data(), delays.size(), published.size(), delays[delays.size() / 2],
                    delays.back());
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 2)
        return std::fputs("live_bench SCENE.xml [SECONDS]\n", stderr), EXIT_FAILURE;
    try {
        const auto scene = std::make_shared<const Scene>(load_mitsuba_xml(argv[1]).description);
        for (const Norm norm : all_norms)
            if (norm != Norm::oidn || oidn_problem().empty())
                measure(scene, norm, argc > 2 ? std::atof(argv[2]) : 10);
    } catch (const std::exception& error) {
        return std::fprintf(stderr, "live_bench: %s\n", error.what()), EXIT_FAILURE;
    }
}
