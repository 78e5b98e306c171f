#pragma once

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "plain_mesh.h"
#include "stopwatch.h"

// What all programs that simplify share: reading the mesh, the clock, the peak of memory, and
// writing the result, so that they differ in the simplification alone. No burnish in here: peers
// are measured without it.
//   simplify_NAME MESH OUT.ply TRIANGLES [METHOD]
// Each prints two lines of seconds, on the wall and of the processor: from arrays in memory to
// arrays in memory, and of the library's simplification alone; and how many bytes more than the
// arrays that it was given the program held at most.

/// A line "VmRSS:  1234 kB" of what the kernel knows of this process, in bytes.
inline double kernel_says(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word != key + ":") continue;
    double kilobytes = 0;
    status >> kilobytes;
    return 1024 * kilobytes;
  }
  std::exit(1);
}

/// Measures from where it is made.
class Measurement {
 public:
  void begin_alone() { alone_ = Stopwatch(); }
  void end_alone() { spent_alone_ = alone_.seconds(); }
  void print() const {
    all_.print();
    spent_alone_.print();
    std::printf("%.0f\n", kernel_says("VmHWM") - held_before_);
  }

 private:
  double held_before_ = kernel_says("VmRSS");
  Seconds spent_alone_{};
  Stopwatch alone_, all_;
};

/// `simplify(mesh, triangles, measurement)` gives the result as a PlainMesh.
template <class Simplify>
int run_simplify_peer(char** argv, Simplify simplify) {
  const PlainMesh mesh = read_plain_mesh(argv[1]);
  Measurement measurement;
  const PlainMesh result = simplify(mesh, std::stoul(argv[3]), measurement);
  measurement.print();
  write_ply(argv[2], result);
  return 0;
}
