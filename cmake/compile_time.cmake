# tessera_precompile(target [headers...]): the standard headers, glm and what else is given are compiled once for the
# target. No source may count on that: with CMAKE_DISABLE_PRECOMPILE_HEADERS=ON everything builds as well, and
# tests/house/check_house.py sees to it that each file includes what it uses. JSON and CLI11 are no good here: what their
# inline functions instantiate is instantiated again at the end of every source that takes them (crops.cpp: 4.4 CPU
# seconds with both, 3.7 without a precompiled header, 3.1 with one that has neither).
set(TESSERA_COMMON_HEADERS
  <algorithm> <array> <atomic> <charconv> <chrono> <cmath> <cstddef> <cstdint> <cstdio> <filesystem> <fstream>
  <functional> <limits> <map> <memory> <mutex> <numeric> <optional> <span> <sstream> <stdexcept> <stop_token> <string>
  <string_view> <thread> <utility> <variant> <vector>
  <glm/common.hpp> <glm/geometric.hpp> <glm/mat3x3.hpp> <glm/mat4x4.hpp> <glm/matrix.hpp> <glm/trigonometric.hpp>
  <glm/vec2.hpp> <glm/vec3.hpp>)

function(tessera_precompile target)
  target_precompile_headers(${target} PRIVATE ${TESSERA_COMMON_HEADERS} ${ARGN})
endfunction()

# tessera_optimise(target LEVEL): less than -O3, where the time that compiling takes is worth more than the time that
# running does. Pictures come from the -O3 of recon and render. It is for whole targets, as g++ 12 fails where a source is
# optimised otherwise than the precompiled header that it takes.
function(tessera_optimise target level)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${level}>)
endfunction()
