#include "bench/stopwatch.hpp"

#include <sys/resource.h>

#include <chrono>
#include <ctime>
#include <fstream>

#include "core/text.hpp"

namespace skinfit {
namespace {

Duration now() {
    timespec cpu{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &cpu);
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now().time_since_epoch();
    return {.wall_s = wall.count(), .cpu_s = static_cast<double>(cpu.tv_sec) + 1e-9 * static_cast<double>(cpu.tv_nsec)};
}

}  // namespace

Stopwatch::Stopwatch() : begin_(now()) {}

Duration Stopwatch::elapsed() const {
    const Duration end = now();
    return {.wall_s = end.wall_s - begin_.wall_s, .cpu_s = end.cpu_s - begin_.cpu_s};
}

std::string machine_name() {
    std::ifstream description("/proc/cpuinfo");
    for (std::string line; std::getline(description, line);) {
        if (line.starts_with("model name")) return std::string(trimmed(line.substr(line.find(':') + 1)));
    }
    return "unknown";
}

double peak_memory_mb() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

}  // namespace skinfit
