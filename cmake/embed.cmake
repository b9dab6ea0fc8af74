# tessera_embed(target file symbol): at build time, converts the text file to the header "embedded/<symbol>.h", which defines
# `inline constexpr std::string_view tessera::<symbol>`. Run as a script, this file writes that header.

# tessera_embed_folder(target folder symbol): embeds all files of a folder, text or binary, as an array of
# tessera::EmbeddedFile (app/cli/embedded_file.h), with their paths relative to the folder.

if(CMAKE_SCRIPT_MODE_FILE AND FOLDER)
  file(GLOB_RECURSE files RELATIVE ${FOLDER} ${FOLDER}/*)
  list(SORT files)
  set(arrays "")
  set(entries "")
  set(number 0)
  foreach(file ${files})
    file(READ ${FOLDER}/${file} bytes HEX)
    string(LENGTH "${bytes}" length)
    math(EXPR length "${length} / 2")
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
    string(APPEND arrays "inline constexpr unsigned char ${SYMBOL}_${number}[] = {${bytes}0};\n")
    string(APPEND entries "    {\"${file}\", ${SYMBOL}_${number}, ${length}},\n")
    math(EXPR number "${number} + 1")
  endforeach()
  file(WRITE "${OUTPUT}" "#pragma once
#pragma GCC system_header

#include \"app/cli/embedded_file.h\"

namespace tessera {

${arrays}
inline constexpr EmbeddedFile ${SYMBOL}[] = {
${entries}};

} // namespace tessera
")
  return()
endif()

if(CMAKE_SCRIPT_MODE_FILE)
  file(READ "${INPUT}" text)
  # Compilers do not warn about long strings in system headers.
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

function(tessera_embed_folder target folder symbol)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS ${folder}/*)
  set(headers ${CMAKE_CURRENT_BINARY_DIR}/embedded_headers)
  set(output ${headers}/embedded/${symbol}.h)
  file(MAKE_DIRECTORY ${headers}/embedded)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DFOLDER=${folder} -DOUTPUT=${output} -DSYMBOL=${symbol} -P ${TESSERA_EMBED_SCRIPT}
    DEPENDS ${files} ${TESSERA_EMBED_SCRIPT}
    COMMENT "Embedding ${symbol}"
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
  target_include_directories(${target} PRIVATE ${headers})
endfunction()
