# Writes a C++ source that holds the named text files as string literals. A literal may be longer than the 65536
# characters that a compiler must take, of which -Wpedantic warns; CMakeLists.txt silences that for these sources alone.
# cmake -DOUTPUT=... -DNAMESPACE=... -DFILES="a.csv;b.csv" -P embed.cmake
set(entries "")
foreach(file IN LISTS FILES)
  get_filename_component(name "${file}" NAME)
  file(READ "${file}" text)
  string(APPEND entries "    {\"${name}\", R\"embedded(${text})embedded\"},\n")
endforeach()
file(WRITE "${OUTPUT}.new"
  "#include <array>\n\n#include \"core/embedded_file.hpp\"\n\n"
  "namespace ${NAMESPACE} {\n"
  "std::span<const skinfit::EmbeddedFile> embedded_files() {\n"
  "    static constexpr auto files = std::to_array<skinfit::EmbeddedFile>({\n${entries}    });\n"
  "    return files;\n"
  "}\n"
  "}  // namespace ${NAMESPACE}\n")
file(COPY_FILE "${OUTPUT}.new" "${OUTPUT}" ONLY_IF_DIFFERENT)
