#include "core/memory.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include "core/input_error.hpp"

namespace skinfit {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// proc(5), /proc/meminfo
double system_memory_bytes() {
    std::ifstream file("/proc/meminfo");
    for (std::string word; file >> word;) {
        double kibibytes = 0.0;
        if (word == "MemAvailable:" && file >> kibibytes) return kibibytes * 1024.0;
    }
    return infinity;
}

/// proc(5), /proc/self/statm
double process_memory_bytes() {
    rlimit limit{};
    if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return infinity;
    double pages = 0.0;
    std::ifstream("/proc/self/statm") >> pages;
    return std::max(0.0, static_cast<double>(limit.rlim_cur) - pages * static_cast<double>(::sysconf(_SC_PAGESIZE)));
}

}  // namespace

double available_memory_bytes() {
    return std::min(system_memory_bytes(), process_memory_bytes());
}

void refuse_beyond_memory(double bytes, const std::string& where, const std::string& remedy) {
    constexpr double gigabyte = 1e9;
    const double available = available_memory_bytes();
    if (bytes <= available) return;
    throw InputError({.where = where,
                      .problem = fmt::format("needs {:.2g} GB of memory", bytes / gigabyte),
                      .why = fmt::format("{:.2g} GB are left", available / gigabyte),
                      .remedy = remedy});
}

}  // namespace skinfit
