// What ThreadSanitizer is not to report. Linked into every test of the tsan build.
//
// oneTBB is a library built without ThreadSanitizer, which therefore does not see how its threads
// wait for each other, and reports the handing over of its own tasks as races. parallel_for orders
// its caller and its chunks by atomics of its own as well, so that races between loop bodies, and
// between them and what comes before and after, are still found: only reports whose innermost
// function is one of oneTBB's templates, or the wrapper in parallel_for itself, are left out.
extern "C" const char* __tsan_default_suppressions();

extern "C" const char* __tsan_default_suppressions() {
  return "race_top:oneapi/tbb/\n"
         "race_top:src/burnish/base/parallel.cpp\n"  // its captures, read before the atomics in
                                                     // them
         "race_top:bits/atomic_base.h\n"             // atomics within oneTBB's tasks
         "race_top:c++/12/atomic\n"
         "called_from_lib:libtbb.so\n"
         "race:libembree3.so\n";  // its own threads build scenes; all that it calls back is whether
                                  // to go on
}
