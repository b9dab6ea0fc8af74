// Ends the program with a message if the processor lacks instructions that it is compiled for. It runs before all
// other initialisation, and is itself compiled for any processor of the architecture.
#ifdef TESSERA_NEEDS_X86_64_V3

#include <cstring>

#include <unistd.h>

namespace {

void say(const char* text) {
    [[maybe_unused]] const auto written = write(STDERR_FILENO, text, std::strlen(text));
}

__attribute__((constructor(101))) void check_processor() {
    __builtin_cpu_init();
    const struct {
        bool is_there;
        const char* name;
    } needed[] = {{__builtin_cpu_supports("avx2") != 0, " AVX2"},
                  {__builtin_cpu_supports("fma") != 0, " FMA"},
                  {__builtin_cpu_supports("bmi") != 0, " BMI1"},
                  {__builtin_cpu_supports("bmi2") != 0, " BMI2"}};
    bool is_missing = false;
    for (const auto& n : needed)
        is_missing |= !n.is_there;
    if (!is_missing)
        return;
    say("tessera: this build needs a processor of level x86-64-v3. This one lacks");
    for (const auto& n : needed)
        if (!n.is_there)
            say(n.name);
    say(". Build it from source with -DTESSERA_ARCH=native.\n");
    _exit(1);
}

} // namespace

#endif
