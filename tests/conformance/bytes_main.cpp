#include <cstdio>
#include <cstdlib>

#include "conformance/subject.h"

// Prints a digest of what every operation makes of its sample, with its defaults and with each
// field set to other values, on a number of threads: conformance_bytes THREADS. Two builds agree
// where their outputs are equal.
int main(int argc, char** argv) {
  using namespace burnish::test;
  if (argc != 2) return 2;
  burnish::Context context;
  context.threads = std::atoi(argv[1]);
  for (const Subject& subject : subjects()) {
    const auto print = [&](const burnish::Settings& settings) {
      const auto outcome = subject.outcome(settings, context);
      const std::string method = to_string(burnish::Method{subject.name(), settings});
      const std::string result = outcome ? digest(bytes(*outcome)) : outcome.error().text();
      std::printf("%s %s\n", method.c_str(), result.c_str());
    };
    print({});
    for (const burnish::FieldInfo& field : subject.info.fields) {
      for (const burnish::Settings& settings : variations(subject, field)) print(settings);
    }
  }
}
