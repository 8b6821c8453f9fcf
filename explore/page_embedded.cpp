#include "explore/page.hpp"

namespace skinfit {

namespace web {
std::span<const EmbeddedFile> embedded_files();
}  // namespace web

std::span<const EmbeddedFile> page_files() {
    return web::embedded_files();
}

}  // namespace skinfit
