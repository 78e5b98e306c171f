#pragma once

#include "burnish/base/context.h"

namespace burnish::test {

inline Context with_threads(int threads) {
  Context context;
  context.threads = threads;
  return context;
}

}  // namespace burnish::test
