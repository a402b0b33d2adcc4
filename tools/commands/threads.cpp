#include "morsel/tools/commands/threads.h"

#include <pthread.h>
#include <semaphore.h>

#include <cerrno>
#include <cstddef>
#include <vector>

namespace morsel::tools {
namespace {

void* wait_for(void* end) {
  while (sem_wait(static_cast<sem_t*>(end)) != 0 && errno == EINTR) {
  }
  return nullptr;
}

}  // namespace

int possible_threads(int wanted) {
  std::vector<pthread_t> threads(static_cast<std::size_t>(wanted) - 1);
  sem_t end;
  sem_init(&end, 0, 0);
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  constexpr std::size_t kStack = std::size_t{4} << 20;  // as large as those of oneTBB's
  pthread_attr_setstacksize(&attributes, kStack);
  std::size_t made = 0;
  while (made < threads.size() && pthread_create(&threads[made], &attributes, wait_for, &end) == 0) ++made;
  pthread_attr_destroy(&attributes);
  for (std::size_t i = 0; i < made; ++i) sem_post(&end);
  for (std::size_t i = 0; i < made; ++i) pthread_join(threads[i], nullptr);
  sem_destroy(&end);
  return static_cast<int>(made) + 1;
}

}  // namespace morsel::tools
