// store_samples SCENE.xml OUTPUT WIDTHxHEIGHT METHOD SEED SECONDS[,SECONDS...]: renders with depth 8 on one
// thread, and writes the samples taken so far to OUTPUT-SECONDS.samples when each number of CPU seconds is
// reached.

#include "render/load/mitsuba_xml.h"
#include "render/run/render.h"
#include "render/run/thread_pool.h"
#include "render/scene/scene.h"
#include "tests/bench/stored_samples.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <sstream>
#include <string>

namespace {

using namespace tessera;

Method method_named(const std::string& name) {
    for (const Method method : all_methods)
        if (short_name(method) == name)
            return method;
    throw std::invalid_argument(name + ": no such method");
}

void store(char** argv) {
    const std::string scene_file = argv[1], output = argv[2];
    glm::ivec2 size;
    if (std::sscanf(argv[3], "%dx%d", &size.x, &size.y) != 2)
        throw std::invalid_argument(std::string(argv[3]) + ": not WIDTHxHEIGHT");
    RenderSettings settings;
    settings.method = method_named(argv[4]);
    settings.seed = std::strtoull(argv[5], nullptr, 10);
    settings.max_depth = 8;
    const auto scene = std::make_shared<const Scene>(load_mitsuba_xml(scene_file).description);
    ThreadPool pool(1);
    Render render(scene, scene->camera(), size, settings);
    const double begin = pool.cpu_seconds();
    std::istringstream times(argv[6]);
    for (std::string time; std::getline(times, time, ',');) {
        do
            render.pass(pool);
        while (pool.cpu_seconds() - begin < std::stod(time));
        write_samples(output + "-" + time + ".samples", render.images());
        std::printf("%s %s: %d samples, %.2f s\n", output.c_str(), time.c_str(), render.spp(),
                    pool.cpu_seconds() - begin);
    }
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 7)
        return std::fputs("store_samples SCENE.xml OUTPUT WIDTHxHEIGHT METHOD SEED SECONDS[,SECONDS...]\n",
                          stderr),
               EXIT_FAILURE;
    try {
        store(argv);
    } catch (const std::exception& error) {
        return std::fprintf(stderr, "store_samples: %s\n", error.what()), EXIT_FAILURE;
    }
}
