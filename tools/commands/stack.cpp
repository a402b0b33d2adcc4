#include "morsel/tools/commands/stack.h"

#include <pthread.h>
#include <sys/resource.h>

#include <cstddef>

namespace morsel::tools {
namespace {

constexpr std::size_t kStack = std::size_t{8} << 20;

bool is_enough_here() {
  rlimit limit{};
  return ::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= kStack;
}

void* call(void* work) {
  (*static_cast<const std::function<void()>*>(work))();
  return nullptr;
}

}  // namespace

void with_enough_stack(const std::function<void()>& work) {
  if (is_enough_here()) return work();
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, kStack);
  pthread_t thread{};
  const bool made =
      pthread_create(&thread, &attributes, call, const_cast<std::function<void()>*>(&work)) == 0;
  pthread_attr_destroy(&attributes);
  if (!made) return work();
  pthread_join(thread, nullptr);
}

}  // namespace morsel::tools
