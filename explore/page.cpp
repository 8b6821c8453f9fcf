#include "explore/page.hpp"

#include <algorithm>

namespace skinfit {

const EmbeddedFile* find_page_file(std::string_view path) {
    if (!path.starts_with('/')) return nullptr;
    const std::string_view name = path == "/" ? "index.html" : path.substr(1);
    const auto found = std::ranges::find(page_files(), name, &EmbeddedFile::name);
    return found == page_files().end() ? nullptr : &*found;
}

}  // namespace skinfit
