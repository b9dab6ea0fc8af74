# tessera_precompile(target [headers...]): precompiles standard headers, glm and the given headers for the target. Sources
# must not rely on it: everything builds with CMAKE_DISABLE_PRECOMPILE_HEADERS=ON, and tests/house/check_house.py checks
# that each file includes what it uses. JSON and CLI11 slow compilation down here: every source that uses the precompiled
# header instantiates their templates again.
set(TESSERA_COMMON_HEADERS
  <algorithm> <array> <atomic> <charconv> <chrono> <cmath> <cstddef> <cstdint> <cstdio> <filesystem> <fstream>
  <functional> <limits> <map> <memory> <mutex> <numeric> <optional> <span> <sstream> <stdexcept> <stop_token> <string>
  <string_view> <thread> <utility> <variant> <vector>
  <glm/common.hpp> <glm/geometric.hpp> <glm/mat3x3.hpp> <glm/mat4x4.hpp> <glm/matrix.hpp> <glm/trigonometric.hpp>
  <glm/vec2.hpp> <glm/vec3.hpp>)

function(tessera_precompile target)
  target_precompile_headers(${target} PRIVATE ${TESSERA_COMMON_HEADERS} ${ARGN})
endfunction()

# tessera_optimise(target LEVEL): optimises a target less than -O3, to save compile time. Rendering and reconstruction run in
# recon and render, which keep -O3. The level is that of a whole target, as g++ 12 fails if a source and its precompiled
# header have different levels.
function(tessera_optimise target level)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${level}>)
endfunction()
