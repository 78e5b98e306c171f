#pragma once

#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstddef>

namespace burnish::test {

/// Does some work in a child process and gives the most memory that this took, in bytes. `work`
/// says whether it could be done.
template <class Work>
std::size_t peak_memory_of(Work work) {
  int ends[2];
  if (::pipe(ends) != 0) return 0;
  ::malloc_trim(0);  // so that the child does not work in what was freed here
  const pid_t child = ::fork();
  if (child == 0) {
    struct rusage before {
    }, after{};
    ::getrusage(RUSAGE_SELF, &before);
    const bool done = work();
    ::getrusage(RUSAGE_SELF, &after);
    const long grown = done ? after.ru_maxrss - before.ru_maxrss : -1;
    (void)!::write(ends[1], &grown, sizeof(grown));
    ::_exit(0);
  }
  long grown = -1;
  (void)!::read(ends[0], &grown, sizeof(grown));
  ::close(ends[0]);
  ::close(ends[1]);
  ::waitpid(child, nullptr, 0);
  EXPECT_GE(grown, 0) << "the work could not be done";
  return static_cast<std::size_t>(grown) * 1024;
}

}  // namespace burnish::test
