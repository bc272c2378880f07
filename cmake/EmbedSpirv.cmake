# cmake -DINPUT=x.spv -DOUTPUT=x.h -DNAME=kX -P EmbedSpirv.cmake: SPIR-V as a C++ array.
file(READ "${INPUT}" bytes HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${bytes}")
string(REGEX REPLACE "(0x[0-9a-f]+,0x[0-9a-f]+,0x[0-9a-f]+,0x[0-9a-f]+,0x[0-9a-f]+,0x[0-9a-f]+,0x[0-9a-f]+,0x[0-9a-f]+,)"
       "\\1\n" words "${words}")
get_filename_component(file_name "${INPUT}" NAME)
file(WRITE "${OUTPUT}" "// Made from ${file_name} by cmake/EmbedSpirv.cmake.
#pragma once

#include <cstdint>

namespace alpenglow::shaders {
inline constexpr uint32_t ${NAME}[] = {
${words}};
}  // namespace alpenglow::shaders
")
