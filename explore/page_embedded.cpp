#include "explore/page.hpp"

namespace skinfit {

namespace web {
extern const EmbeddedFile embedded_files[];
extern const std::size_t embedded_file_count;
}  // namespace web

std::span<const EmbeddedFile> page_files() {
    return {web::embedded_files, web::embedded_file_count};
}

}  // namespace skinfit
