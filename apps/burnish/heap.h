#pragma once

namespace burnish::app {

/// Has the heap keep what is freed for what comes next, and its first megabytes lie in large pages.
/// For a process that reads, computes, writes and ends, the system's handing out of small pages and
/// taking them back is otherwise a fifth of its time. To be called before other threads begin;
/// where the C library has no such settings nothing happens.
void prepare_heap();

}  // namespace burnish::app
