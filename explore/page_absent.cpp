#include "explore/page.hpp"

namespace skinfit {

std::span<const EmbeddedFile> page_files() {
    return {};
}

}  // namespace skinfit
