# tessera_embed(target file symbol): at build time, `file` (text) becomes the header "embedded/<symbol>.h", which
# holds `inline constexpr std::string_view tessera::<symbol>`. Run as a script, this file writes that header.

if(CMAKE_SCRIPT_MODE_FILE)
  file(READ "${INPUT}" text)
  # A system header: compilers do not warn of the length of its strings.
  file(WRITE "${OUTPUT}" "#pragma once
#pragma GCC system_header

#include <string_view>

namespace tessera {

inline constexpr std::string_view ${SYMBOL} = R\"embedded(${text})embedded\";

} // namespace tessera
")
  return()
endif()

set(TESSERA_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_FILE})

function(tessera_embed target file symbol)
  get_filename_component(input ${file} ABSOLUTE)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/embedded_headers)
  set(output ${folder}/embedded/${symbol}.h)
  file(MAKE_DIRECTORY ${folder}/embedded)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DINPUT=${input} -DOUTPUT=${output} -DSYMBOL=${symbol} -P ${TESSERA_EMBED_SCRIPT}
    DEPENDS ${input} ${TESSERA_EMBED_SCRIPT}
    COMMENT "Embedding ${symbol}"
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
  target_include_directories(${target} PRIVATE ${folder})
endfunction()
