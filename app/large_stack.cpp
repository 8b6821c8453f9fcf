#include "app/large_stack.hpp"

#include <pthread.h>

#include <thread>

namespace skinfit {

void on_a_large_stack(const std::function<void()>& work) {
    constexpr std::size_t stack_bytes = std::size_t{8} << 20U;  // the usual limit of Linux
    ::pthread_attr_t attributes;
    ::pthread_attr_init(&attributes);
    ::pthread_attr_setstacksize(&attributes, stack_bytes);
    ::pthread_setattr_default_np(&attributes);
    ::pthread_attr_destroy(&attributes);
    std::jthread(work).join();
}

}  // namespace skinfit
